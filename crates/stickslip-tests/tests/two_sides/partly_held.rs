//! Vertices that open, and are part of more than one condition: rollers beside them, contacts that meet.

use nalgebra::SVector;
use stickslip::fem::{Elastic, GridDiagonal, Mesh, P1, elasticity};
use stickslip::friction::Tresca;
use stickslip::{
    Components, Condensed, Contact, GeneralizedAlpha, NormalStress, Scene, Simulation, Steps,
};

use crate::Outcome;
use crate::random_block::{Block, Random};

/// Under compression a contact that can open is one that cannot: to rounding, since the normal components are eliminated
/// in another order.
fn changes_nothing<const D: usize>(cases: u64) -> Outcome {
    let mut compared = 0;
    for seed in 0..cases {
        let random = &mut Random(seed);
        let mut block = Block::<D>::new(random, |random| random.below(2) == 0)?;
        let pressure = 1e-3 * block.modulus();
        for (_, stress) in &mut block.feet {
            *stress = random.between(0.0, 2.0) * pressure;
        }
        let (press, shear) = (1e-3 * block.height, random.between(-1e-3, 1e-3));
        let velocity =
            move |_: f64| std::array::from_fn(|c| if c + 1 == D { -press } else { shear });
        let mut closed = block.simulation(|_| false, velocity)?;
        let mut open = block.simulation(|_| true, velocity)?;
        let dt = random.between(0.1, 0.6);
        for _ in 0..3 {
            if closed.step(dt).is_err() {
                // A tension, by the shear of a narrow block.
                break;
            }
            open.step(dt)?;
            let [a, b] = [closed.snapshot(), open.snapshot()];
            let size = a.displacement.iter().map(SVector::amax).fold(0.0, f64::max);
            for (a, b) in a.displacement.iter().zip(b.displacement) {
                assert!((a - b).amax() < 1e-13 * size, "{D} {seed}: {a} {b}");
            }
            for (a, b) in a.contacts().zip(b.contacts()) {
                for k in 0..a.len() {
                    assert_eq!(b.opening(k), 0.0);
                    let stress = a.normal_stress(k) - b.normal_stress(k);
                    assert!(
                        stress.abs() < 1e-13 * pressure,
                        "{D} {seed} {k}: {stress:e}"
                    );
                    let slip = a.slip(k) - b.slip(k);
                    assert!(slip.abs() < 1e-13 * size, "{D} {seed} {k}: {slip:e}");
                }
            }
            compared += 1;
        }
    }
    assert!(compared > 2 * cases);
    Ok(())
}

#[test]
fn under_compression_the_right_to_open_changes_nothing() -> Outcome {
    changes_nothing::<2>(60)?;
    changes_nothing::<3>(12)
}

/// A block between rollers on all sides, pressed and pulled off, twice: pressure and gap are those of uniaxial strain at
/// every vertex of every contact.
fn is_pulled_off<const D: usize>(cases: u64) -> Outcome {
    for seed in 0..cases {
        let random = &mut Random(1000 + seed);
        let mut block = Block::<D>::new(random, |_| true)?;
        let stress = random.between(0.0, 1e-3) * block.modulus();
        for (_, own) in &mut block.feet {
            *own = stress;
        }
        let speed = block.height * random.between(1e-4, 1e-3);
        let velocity = move |time: f64| {
            let sign = if time.rem_euclid(4.0) < 1.0 {
                -1.0
            } else if time.rem_euclid(4.0) < 3.0 {
                1.0
            } else {
                -1.0
            };
            std::array::from_fn(|c| if c + 1 == D { sign * speed } else { 0.0 })
        };
        let mut body = block.simulation(|_| true, velocity)?;
        let dt = random.between(0.05, 0.3);
        let stops = [1.0, 3.0, 5.0, 7.0];
        let top = block.space.trace(|x| x[D - 1] == block.height)?;
        let area: f64 = top.weights().iter().sum();
        let (mut opened, mut failed) = (false, None);
        body.run(&Steps::constant(dt).until(8.0).stopping_at(stops), |at| {
            // The way of the top, downwards.
            let phase = at.time.rem_euclid(4.0);
            let down = speed
                * if phase < 1.0 {
                    phase
                } else if phase < 3.0 {
                    2.0 - phase
                } else {
                    phase - 4.0
                };
            let given = stress * block.height / block.modulus();
            let pressure = ((down + given) / block.height * block.modulus()).max(0.0);
            let gap = (-down - given).max(0.0);
            opened |= gap > 0.0;
            let scale = speed / block.height * block.modulus() + stress;
            for contact in at.contacts() {
                for k in 0..contact.len() {
                    let errors = [
                        (contact.normal_stress(k) - pressure).abs() / scale,
                        (contact.opening(k) - gap).abs() / speed,
                        contact.slip(k) / speed,
                        -contact.opening(k).min(0.0),
                    ];
                    if errors.iter().any(|&error| error > 1e-9) {
                        failed = Some((at.time, contact.point(k), errors));
                    }
                }
            }
            let pull = at.reaction(&top).map_or(f64::NAN, |pull| pull[D - 1]);
            let error = (pull / area + pressure - stress).abs();
            if error.is_nan() || error >= 1e-9 * scale {
                failed = Some((at.time, [pull / area, pressure, stress], [f64::NAN; 4]));
            }
        })?;
        assert!(failed.is_none(), "seed {seed}: {failed:?}");
        assert!(opened || stress > 0.0);
    }
    Ok(())
}

#[test]
fn a_block_between_rollers_is_pulled_off_its_contacts() -> Outcome {
    is_pulled_off::<2>(30)?;
    is_pulled_off::<3>(5)
}

/// Sheared, pressed and pulled with another pre-stress in each contact: where contacts meet both part at once, no
/// opening is negative, only one of opening and pressure is not zero, and the pressures balance the pull.
#[test]
fn contacts_that_meet_open_at_once_and_balance_the_pull() -> Outcome {
    let (mut open, mut closed, mut parted) = (0, 0, 0);
    for seed in 0..40 {
        let random = &mut Random(2000 + seed);
        let mut block = Block::<2>::new(random, |random| random.below(3) == 0)?;
        let pressure = 1e-3 * block.modulus();
        for (_, stress) in &mut block.feet {
            *stress = random.between(-0.2, 0.5) * pressure;
        }
        let (height, shear) = (block.height, random.between(-3e-4, 3e-4));
        let velocity = move |time: f64| [shear, 1e-3 * height * (3.0 * time).cos() - 1e-4 * height];
        let mut body = block.simulation(|_| true, velocity)?;
        let top = block.space.trace(|x| x[1] == height)?;
        for _ in 0..20 {
            body.step(0.15)?;
            let at = body.snapshot();
            let mut force = 0.0;
            for (contact, (foot, given)) in at.contacts().zip(&block.feet) {
                for k in 0..contact.len() {
                    let (stress, opening) = (contact.normal_stress(k), contact.opening(k));
                    assert!(opening >= 0.0 && stress >= 0.0 && opening * stress == 0.0);
                    force += (stress - given) * foot.weights()[k];
                    (open, closed) = (
                        open + usize::from(opening > 0.0),
                        closed + usize::from(opening == 0.0),
                    );
                }
            }
            let pull = at.reaction(&top)?[1];
            let scale = pressure
                * block
                    .feet
                    .iter()
                    .flat_map(|(foot, _)| foot.weights())
                    .sum::<f64>();
            assert!(
                (pull + force).abs() < 1e-9 * scale,
                "seed {seed}: {pull} {force} {scale}"
            );
            for pair in at.contacts().collect::<Vec<_>>().windows(2) {
                let gap = |k: usize| pair[1].opening(k);
                for (k, l) in
                    (0..pair[0].len()).flat_map(|k| (0..pair[1].len()).map(move |l| (k, l)))
                {
                    if pair[0].vertex(k) == pair[1].vertex(l) {
                        assert_eq!(pair[0].opening(k), gap(l));
                        parted += usize::from(gap(l) > 0.0);
                    }
                }
            }
        }
    }
    assert!(
        open > 100 && closed > 100 && parted > 20,
        "{open} {closed} {parted}"
    );
    Ok(())
}

/// Two layers between rollers, on both sides of a fault in one or two contacts: the jump is held along the fault at its
/// ends, and opens there with the others.
#[test]
fn a_fault_between_rollers_opens_at_its_ends() -> Outcome {
    for seed in 0..10 {
        let random = &mut Random(4000 + seed);
        let columns = 2 + random.below(4);
        let mesh = Mesh::<2>::grid([1.0, 2.0], [columns, 2], GridDiagonal::Rising)?
            .with_surface_where("fault", |x| x[1] == 1.0)?
            .split("fault")?;
        let space = P1::new(mesh);
        let elastic = Elastic {
            young_modulus: 1e7,
            poisson_ratio: random.between(0.0, 0.4),
        };
        let nu = elastic.poisson_ratio;
        let modulus = 1e7 * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
        let scene = Scene::new(elasticity(&space, &elastic)?)
            .fix(&space.trace(|x| x[0] == 0.0 || x[0] == 1.0)?, Components::X)
            .fix(&space.trace(|x| x[1] == 0.0)?, Components::Y)
            .prescribe_velocity(&space.trace(|x| x[1] == 2.0)?, Components::Y, |time| {
                [0.0, if time < 1.0 { -1e-4 } else { 1e-4 }]
            })
            .with_contact(
                Contact::between(
                    &space.part("fault+")?,
                    &space.part("fault-")?,
                    Tresca {
                        coefficient: random.between(0.0, 0.6),
                    },
                    NormalStress::from_body(0.0),
                )
                .allow_opening(),
            );
        let mut body = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;
        body.run(
            &Steps::constant(random.between(0.05, 0.3))
                .stopping_at([1.0])
                .until(3.0),
            |at| {
                let down = 1e-4 * (1.0 - (at.time - 1.0).abs());
                let fault = at.contact(0);
                for k in 0..fault.len() {
                    let (stress, opening) = (fault.normal_stress(k), fault.opening(k));
                    assert!(
                        (stress - modulus * down.max(0.0) / 2.0).abs() < 1e-12 * modulus,
                        "{} {k} {stress}",
                        at.time
                    );
                    assert!(
                        (opening + down.min(0.0)).abs() < 1e-12,
                        "{} {k} {opening}",
                        at.time
                    );
                }
            },
        )?;
    }
    Ok(())
}
