//! A normal stress that follows that of the body with a delay: its closed form, the order, what is refused, restarts, and
//! a rupture on a mesh without symmetry.

use nalgebra::Vector2;
use stickslip::fem::{
    Elastic, GridDiagonal, Impedance, Mesh, P1, dashpot, elasticity, lumped_mass, traction,
};
use stickslip::friction::{LinearWeakening, Tresca};
use stickslip::state::{SlipWeakening, Weakening};
use stickslip::{BackwardEuler, GeneralizedAlpha};
use stickslip::{
    CentralDifferences, Components, Condensed, Contact, Diagonal, NormalStress, RateScheme, Scene,
    SceneError, Sdirk2, Simulation, Staggered, Steps,
};

use crate::{ELASTIC, Outcome};

const MEAN: f64 = 3.0;
const WAVE: f64 = 1.0;
const FREQUENCY: f64 = 1.3;
const RATE: f64 = 0.2;

/// A block under a pressure `MEAN + WAVE sin(FREQUENCY t)`, drawn over its base at a rate, without inertia.
fn pressed(stress: NormalStress, scheme: impl RateScheme + 'static) -> Outcome<Simulation<2>> {
    let space = P1::grid([2.0, 1.0], [2, 1])?;
    let [base, top] = [0.0, 1.0].map(|y| space.trace(move |x| x[1] == y));
    let (base, top) = (base?, top?);
    let sides = space.trace(|x| x[0] == 0.0 || x[0] == 2.0)?;
    let pressure = traction(&space, &top, |_| Vector2::new(0.0, -1.0))?;
    let start = pressure.clone();
    let scene = Scene::new(elasticity(&space, &ELASTIC)?)
        .with_contact(Contact::new(&base, Tresca { coefficient: 0.0 }, stress))
        .prescribe_velocity(&sides, Components::X, |_| [RATE, 0.0])
        .with_load(start.iter().map(|load| load * MEAN).collect())
        .with_load_history(move |time, load| {
            for (load, unit) in load.iter_mut().zip(&pressure) {
                *load += unit * (WAVE * (FREQUENCY * time).sin());
            }
        })
        .in_equilibrium(stickslip::Cholesky::new());
    Ok(Simulation::new(scene, scheme, Condensed::new())?)
}

/// `sigma' = r (p - sigma)` from `sigma(0) = p(0)`.
fn closed_form(rate: f64, time: f64) -> f64 {
    let ratio = FREQUENCY / rate;
    let (sine, cosine) = (FREQUENCY * time).sin_cos();
    let wave = sine - ratio * (cosine - (-rate * time).exp());
    MEAN + WAVE * wave / (1.0 + ratio * ratio)
}

/// The stress of the body is the pressure, and the relaxed one its closed form, to second order; to first order with
/// backward Euler.
#[test]
fn the_relaxed_stress_is_that_of_the_closed_form() -> Outcome {
    let (time, distance) = (0.4, 0.15);
    let by_time = NormalStress::from_body(0.0).with_relaxation_time(time);
    let by_both = by_time.clone().with_relaxation_distance(distance);
    let by_slip = NormalStress::from_body(0.0).with_relaxation_distance(distance);
    let rates = [
        (by_time, 1.0 / time),
        (by_both, 1.0 / time + RATE / distance),
        (by_slip, RATE / distance),
    ];
    for (stress, rate) in rates {
        for (scheme, order) in [(0, 2.0), (1, 2.0), (2, 1.0)] {
            let mut errors = Vec::new();
            for count in [40, 80, 160] {
                let mut block = match scheme {
                    0 => pressed(stress.clone(), GeneralizedAlpha::default())?,
                    1 => pressed(stress.clone(), Sdirk2)?,
                    _ => pressed(stress.clone(), BackwardEuler)?
                        .with_state_update(stickslip::StateUpdate::BackwardEuler),
                };
                block.run(&Steps::constant(3.0 / f64::from(count)).until(3.0), |_| ())?;
                let at = block.snapshot();
                let fault = at.contact(0);
                let pressure = MEAN + WAVE * (FREQUENCY * at.time).sin();
                let mut error = 0.0_f64;
                for k in 0..fault.len() {
                    assert!((fault.body_normal_stress(k) - pressure).abs() < 1e-9);
                    let exact = closed_form(rate, at.time);
                    error = error.max((fault.normal_stress(k) - exact).abs());
                }
                errors.push(error);
            }
            assert!(errors[0] < 0.1, "{errors:?}");
            for pair in errors.windows(2) {
                let found = (pair[0] / pair[1]).log2();
                assert!(found > order - 0.3, "{scheme} {rate}: {errors:?}");
            }
        }
    }
    Ok(())
}

#[test]
fn what_cannot_relax_is_refused() -> Outcome {
    let refused = |stress: NormalStress| -> Outcome<SceneError> {
        let space = P1::grid([2.0, 1.0], [2, 1])?;
        let base = space.trace(|x| x[1] == 0.0)?;
        let contact = Contact::new(&base, Tresca { coefficient: 0.1 }, stress);
        let scene = Scene::new(elasticity(&space, &ELASTIC)?).with_contact(contact);
        match Simulation::new(scene, BackwardEuler, Condensed::new()) {
            Ok(_) => Err("accepted".into()),
            Err(error) => Ok(error),
        }
    };
    let body = || NormalStress::from_body(1.0);
    for scale in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        for stress in [
            body().with_relaxation_time(scale),
            body().with_relaxation_distance(scale),
        ] {
            let error = refused(stress)?;
            let SceneError::Value { value, .. } = error else {
                return Err(error.into());
            };
            assert_eq!(value.to_bits(), scale.to_bits());
        }
    }
    let error = refused(NormalStress::from(1.0).with_relaxation_time(1.0))?;
    assert!(matches!(error, SceneError::Value { .. }), "{error}");
    Ok(())
}

/// The rock of TPV205.
const DENSITY: f64 = 2670.0;

/// A short fault of TPV205 in the plane, in cells of the size `h` \[m\] whose vertices beside it are moved at random by a
/// fifth of it.
fn rupture(h: f64, stress: NormalStress) -> Outcome<Simulation<2>> {
    let size = Vector2::new(8e3, 4e3);
    let grid = Mesh::<2>::grid(
        size.into(),
        [(size[0] / h) as usize, (size[1] / h) as usize],
        GridDiagonal::Rising,
    )?;
    let mut seed = 1u64;
    let mut random = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005);
        seed = seed.wrapping_add(1_442_695_040_888_963_407);
        0.4 * h * ((seed >> 11) as f64 / (1u64 << 53) as f64 - 0.5)
    };
    let near = |a: f64, b: f64| (a - b).abs() < 1e-6 * h;
    let points = grid.vertices().iter().map(|x| {
        let x = x - 0.5 * size;
        let outside = (0..2).any(|c| near(x[c].abs(), 0.5 * size[c]));
        if outside || near(x[1], 0.0) {
            x
        } else {
            x + Vector2::new(random(), random())
        }
    });
    let mesh = Mesh::new(points.collect(), grid.cells().flatten().copied().collect())?
        .with_surface_where("fault", |x| near(x[1], 0.0) && x[0].abs() < 3e3 + 1.0)?
        .split("fault")?;
    let space = P1::new(mesh);
    let [plus, minus] = ["fault+", "fault-"].map(|side| space.part(side));
    let plus = plus?;
    let law = LinearWeakening {
        static_friction: 0.677,
        dynamic_friction: 0.525,
    };
    let shear = |x: f64| if x.abs() < 1.6e3 { 81.6e6 } else { 70e6 };
    let contact = Contact::between(&plus, &minus?, law, stress)
        .with_state(SlipWeakening { slip_distance: 0.4 }, Weakening(0.0))
        .with_shear_stress(plus.map(|x| Vector2::new(shear(x[0]), 0.0)));
    let rock = Elastic::of_waves(DENSITY, 6000.0, 3464.0)?;
    let impedance = Impedance::of(&rock, DENSITY)?;
    let outside = space.trace(|x| (0..2).any(|c| near(x[c].abs(), 0.5 * size[c])))?;
    let scene = Scene::new(elasticity(&space, &rock)?)
        .with_mass(lumped_mass(&space, DENSITY)?)
        .with_viscosity(dashpot(&space, &outside, |_| impedance)?)
        .with_contact(contact);
    Ok(Simulation::new(scene, CentralDifferences, Diagonal::new())?
        .with_coupling(Staggered::default()))
}

/// The slip in the middle after 1.2 s, and the root mean square of the changes of the normal stress until then.
fn ruptured(h: f64, stress: NormalStress) -> Outcome<[f64; 2]> {
    let mut body = rupture(h, stress)?;
    let (mut squares, mut count) = (0.0, 0.0);
    body.run(&Steps::constant(h / 15e3).until(1.2), |at| {
        let fault = at.contact(0);
        // Beside the tips the normal stress changes in truth, too.
        for k in (0..fault.len()).filter(|&k| fault.point(k)[0].abs() < 2e3) {
            squares += (fault.normal_stress(k) / 120e6 - 1.0).powi(2);
            count += 1.0;
        }
    })?;
    let at = body.snapshot();
    let fault = at.contact(0);
    let middle = (0..fault.len()).find(|&k| fault.point(k)[0].abs() < 1e-3 * h);
    let middle = middle.ok_or("no vertex in the middle")?;
    Ok([fault.slip(middle), f64::sqrt(squares / count)])
}

/// With a delay the noise of the normal stress is less than without one, and slip is that under the prescribed stress.
#[test]
fn a_delay_damps_the_noise_of_an_unsymmetric_mesh() -> Outcome {
    for h in [200.0, 100.0] {
        let [prescribed, none] = ruptured(h, 120e6.into())?;
        let [_, at_once] = ruptured(h, NormalStress::from_body(120e6))?;
        let delayed = NormalStress::from_body(120e6).with_relaxation_time(0.2);
        let [slip, spread] = ruptured(h, delayed)?;
        assert!(prescribed > 1.0 && none == 0.0);
        assert!(
            (slip / prescribed - 1.0).abs() < 0.02,
            "{slip}, {prescribed}"
        );
        assert!(spread < at_once, "{h}: {spread}, {at_once}");
    }
    Ok(())
}

/// The memory of the delay is part of the state: the same bits follow from it.
#[test]
fn a_restored_rupture_goes_on_with_the_same_bits() -> Outcome {
    let stress = NormalStress::from_body(120e6)
        .with_relaxation_time(0.2)
        .with_relaxation_distance(0.4);
    let steps = Steps::constant(0.025).count(20);
    let mut whole = rupture(400.0, stress.clone())?;
    whole.run(&steps, |_| ())?;
    let middle = whole.state().clone();
    let at = whole.snapshot();
    let fault = at.contact(0);
    let apart = |k: usize| fault.body_normal_stress(k) != fault.normal_stress(k);
    assert!((0..fault.len()).any(apart));
    whole.run(&steps, |_| ())?;
    let mut other = rupture(400.0, stress)?;
    other.restore(&middle)?;
    other.run(&steps, |_| ())?;
    assert_eq!(whole.state(), other.state());
    {
        use stickslip::Checkpoint;
        let path = std::env::temp_dir().join(format!("stickslip-relaxed-{}", std::process::id()));
        Checkpoint::at(&path).save(&whole.snapshot(), &())?;
        let mut third = rupture(
            400.0,
            NormalStress::from_body(120e6)
                .with_relaxation_time(0.2)
                .with_relaxation_distance(0.4),
        )?;
        Checkpoint::at(&path).restore::<(), 2>(&mut third)?;
        assert_eq!(whole.state(), third.state());
        let mut at_once = rupture(400.0, NormalStress::from_body(120e6))?;
        let other = Checkpoint::at(&path).restore::<(), 2>(&mut at_once);
        std::fs::remove_file(&path)?;
        assert!(other.is_err());
    }
    Ok(())
}
