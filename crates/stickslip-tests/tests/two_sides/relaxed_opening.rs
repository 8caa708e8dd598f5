//! Sides that part and close while friction sees their normal stress with a delay.

use nalgebra::Vector2;
use stickslip::fem::{Elastic, GridDiagonal, Mesh, P1, elasticity, lumped_mass};
use stickslip::friction::Tresca;
use stickslip::{
    CentralDifferences, Components, Condensed, Contact, Diagonal, GeneralizedAlpha, NormalStress,
    Scene, Simulation, Steps,
};

use crate::Outcome;

/// No strain across: stress and strain are those of a bar.
const BAR: Elastic = Elastic {
    young_modulus: 1.0,
    poisson_ratio: 0.0,
};
/// The relaxation time \[s\].
const TIME: f64 = 0.2;

/// A bar of two halves is pulled apart and pushed together again. Gap and pressure of the body are those without a delay.
/// The stress of friction follows in closed form, is 0 while the sides are apart, and grows from 0 once they touch.
#[test]
fn friction_follows_with_a_delay_while_sides_part_at_once() -> Outcome {
    let mesh = Mesh::<2>::grid([1.0, 2.0], [2, 4], GridDiagonal::Rising)?
        .with_surface_where("fault", |x| x[1] == 1.0)?
        .split("fault")?;
    let space = P1::new(mesh);
    let (initial, opens, closes) = (2e-4, 0.4, 1.3);
    let fault = Contact::between(
        &space.part("fault+")?,
        &space.part("fault-")?,
        Tresca { coefficient: 0.5 },
        NormalStress::from_body(initial).with_relaxation_time(TIME),
    )
    .allow_opening();
    let scene = Scene::new(elasticity(&space, &BAR)?)
        .fix(&space.trace(|x| x[1] == 0.0)?, Components::ALL)
        .prescribe_velocity(&space.trace(|x| x[1] == 2.0)?, Components::ALL, |time| {
            [0.0, if time <= 1.0 { 1e-3 } else { -2e-3 }]
        })
        .with_contact(fault);
    let mut bar = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;
    let dt = 0.05;
    // The pressure changes by `rate` within a step, which the rule of the mean misses by `rate dt^3/(12 t*^2)`.
    let bound = |rate: f64| rate * dt * dt / (12.0 * TIME);
    let (mut apart, mut closed) = (0, 0);
    bar.run(&Steps::constant(dt).until(2.0).stopping_at([1.0]), |at| {
        let time = at.time;
        let top = 1e-3 * time.min(1.0) - 2e-3 * (time - 1.0).max(0.0);
        let pressure = (initial - 0.5 * top).max(0.0);
        // `sigma = p + lag`, with the lag of a pressure that changes by a constant rate.
        let lag = |rate: f64, since: f64| rate * TIME * (1.0 - (-since / TIME).exp());
        let (exact, tolerance) = if time < opens + 1e-9 {
            (pressure + lag(0.5e-3, time), bound(0.5e-3))
        } else if time < closes + 1e-9 {
            (0.0, 0.0)
        } else {
            (pressure - lag(1e-3, time - closes), bound(1e-3))
        };
        let fault = at.contact(0);
        for k in 0..fault.len() {
            let gap = (top - 2.0 * initial).max(0.0);
            assert!((fault.opening(k) - gap).abs() < 1e-12, "{time}");
            assert!(
                (fault.body_normal_stress(k) - pressure).abs() < 1e-12,
                "{time}"
            );
            if fault.opening(k) > 1e-12 {
                apart += 1;
                assert_eq!(fault.normal_stress(k), 0.0);
            } else if (time - opens).abs() > 1e-9 && (time - closes).abs() > 1e-9 {
                closed += 1;
                let error = (fault.normal_stress(k) - exact).abs();
                assert!(
                    error < tolerance + 1e-12,
                    "{time}: {error:e}, {tolerance:e}"
                );
            }
        }
    })?;
    assert!(apart > 0 && closed > 0);
    Ok(())
}

fn block() -> Outcome<P1<2>> {
    Ok(P1::grid([0.25, 1.0], [2, 8])?)
}

/// A block that flies onto a rigid base and off again, with a friction coefficient.
fn flight(coefficient: f64, delay: Option<f64>) -> Outcome<Simulation<2>> {
    let space = block()?;
    let size = space.vertex_count();
    let stress = NormalStress::from_body(0.0);
    let stress = match delay {
        Some(time) => stress.with_relaxation_time(time),
        None => stress,
    };
    let foot = space.trace(|x| x[1] == 0.0)?;
    let scene = Scene::new(elasticity(&space, &BAR)?)
        .with_mass(lumped_mass(&space, 1.0)?)
        .with_displacement(vec![Vector2::new(0.0, 0.05); size])
        .with_velocity(vec![Vector2::new(0.1, -0.1); size])
        .with_contact(Contact::new(&foot, Tresca { coefficient }, stress).allow_opening());
    Ok(Simulation::new(scene, CentralDifferences, Diagonal::new())?)
}

/// Without friction a delay changes no motion: contact, impact and flight obey the stress of the body. With friction each
/// step without an impact is in balance, and the base holds the block back less the longer the delay.
#[test]
fn impact_obeys_the_stress_of_the_body() -> Outcome {
    let steps = Steps::constant(0.01).until(4.0);
    let (mut without, mut with) = (flight(0.0, None)?, flight(0.0, Some(0.5))?);
    without.run(&steps, |_| ())?;
    with.run(&steps, |_| ())?;
    let (one, other) = (without.snapshot(), with.snapshot());
    let apart = (one.displacement.iter().zip(other.displacement))
        .map(|(a, b)| (a - b).amax())
        .fold(0.0, f64::max);
    assert!(apart < 1e-12 && one.contact(0).opening(0) > 0.05);

    let mass = lumped_mass::<2, 2>(&block()?, 1.0)?;
    let mass: Vec<f64> = (0..without.state().velocity.len())
        .filter_map(|k| mass.get(k, k).map(|block| block[(0, 0)]))
        .collect();
    let mut lost = Vec::new();
    for delay in [None, Some(0.2), Some(1.0)] {
        let mut block = flight(0.3, delay)?;
        let momentum = |at: &[Vector2<f64>]| {
            let shares = mass.iter().zip(at).map(|(mass, v)| mass * v[0]);
            shares.sum::<f64>()
        };
        let start = momentum(&block.state().velocity);
        let mut pressed = 0;
        for _ in 0..400 {
            let from = block.state().clone();
            block.step(0.01)?;
            let residuals = block.residuals(&from);
            // After an impact accelerations are found anew, without its impulse.
            if residuals.acceleration > 1e-9 {
                continue;
            }
            let at = block.snapshot();
            let foot = at.contact(0);
            let presses = (0..foot.len()).all(|k| foot.body_normal_stress(k) > 0.0);
            pressed += usize::from(presses);
            // Rounding of the forces in contact, some 1e-2 N, where a block in flight has none.
            assert!(
                residuals.force <= 1e-9 * residuals.force_terms + 1e-12,
                "{delay:?} {residuals:?}"
            );
        }
        assert!(pressed > 50, "{pressed}");
        lost.push(start - momentum(&block.state().velocity));
    }
    assert!(
        lost[0] > lost[1] && lost[1] > lost[2] && lost[2] > 0.0,
        "{lost:?}"
    );
    Ok(())
}
