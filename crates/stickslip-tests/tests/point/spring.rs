//! One vertex on a spring, without meshes and multigrid: closed forms and published values.

use nalgebra::{SMatrix, Vector1, Vector2};
use stickslip::friction::{DieterichRuina, FrictionLaw, Tresca};
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{
    BackwardEuler, BoundaryPart, Contact, Newmark, Point, RateScheme, Scene, SceneError,
    Simulation, Steps,
};

use crate::Outcome;

/// The slider's parameters.
const FRICTION: DieterichRuina = DieterichRuina {
    a: 0.010,
    b: 0.015,
    reference_friction: 0.6,
    reference_velocity: 1e-6,
    slip_distance: 1e-5,
};
const NORMAL_STRESS: f64 = 49_050.0;
const COULOMB: Tresca = Tresca { coefficient: 0.6 };

/// A quasi-static spring slider of 1 m^2 that slides steadily at time zero, with the aging law.
fn steady(
    friction: DieterichRuina,
    stiffness: f64,
    rate: f64,
    scheme: impl RateScheme + 'static,
    end_of_spring: impl Fn(f64) -> f64 + Send + Sync + 'static,
) -> Result<Simulation<1>, SceneError> {
    let slip_distance = friction.slip_distance;
    let state = LogTheta((slip_distance / rate).ln());
    let force = NORMAL_STRESS * friction.coefficient(rate, state);
    let contact = Contact::new(BoundaryPart::point(1.0), friction, NORMAL_STRESS)
        .with_state(Dieterich { slip_distance }, state);
    let scene = Scene::new(SMatrix::<f64, 1, 1>::new(stiffness))
        .with_contact(contact)
        .with_load_history(move |time, load| load[0][0] = stiffness * end_of_spring(time))
        .with_displacement(vec![Vector1::new(-force / stiffness)])
        .with_velocity(vec![Vector1::new(rate)]);
    Simulation::new(scene, scheme, Point)
}

/// Coulomb: the slider sticks until the spring reaches the strength, then the force stays there.
fn tresca(scheme: impl RateScheme + 'static) -> Outcome {
    let (stiffness, pull, strength) = (2e6, 1e-3, 0.6 * 1e5);
    let scene = Scene::new(SMatrix::<f64, 1, 1>::new(stiffness))
        .with_contact(Contact::new(BoundaryPart::point(1.0), COULOMB, 1e5))
        .with_load_history(move |time, load| load[0][0] = stiffness * pull * time);
    let mut slider = Simulation::new(scene, scheme, Point)?;
    // It lets go at 30 s.
    let mut slid = 0;
    for _ in 0..100 {
        slider.step(0.7)?;
        let at = slider.snapshot();
        let exact = (pull * at.time - strength / stiffness).max(0.0);
        assert!((at.displacement[0][0] - exact).abs() < 1e-15);
        assert!(exact > 0.0 || at.velocity[0][0] == 0.0);
        slid += usize::from(exact > 0.0);
    }
    assert_eq!(slid, 100 - 42);
    Ok(())
}

#[test]
fn tresca_sticks_and_slides_exactly() -> Outcome {
    tresca(BackwardEuler)?;
    tresca(Newmark::default())
}

/// Two components: the slip is parallel to the pull, whatever its direction.
#[test]
fn tresca_slides_along_an_oblique_pull() -> Outcome {
    let (stiffness, pull, strength) = (2e6, Vector2::new(3e-3, -4e-3), 0.6 * 1e5);
    let scene = Scene::new(SMatrix::<f64, 2, 2>::identity() * stiffness)
        .with_contact(Contact::new(BoundaryPart::point(1.0), COULOMB, 1e5))
        .with_load_history(move |time, load| load[0] = pull * (stiffness * time));
    let mut slider = Simulation::new(scene, BackwardEuler, Point)?;
    for _ in 0..100 {
        slider.step(0.1)?;
        let at = slider.snapshot();
        let way = (pull.norm() * at.time - strength / stiffness).max(0.0);
        assert!((at.displacement[0] - pull.normalize() * way).norm() < 1e-14);
    }
    assert!(slider.snapshot().max_slip_rate() > 4e-3);
    Ok(())
}

/// From rest, above the critical stiffness, to steady sliding: `mu = mu0 + (a - b) ln(V/V0)`.
#[test]
fn a_stiff_spring_reaches_steady_sliding() -> Outcome {
    let pull = 1e-4;
    let critical = (FRICTION.b - FRICTION.a) * NORMAL_STRESS / FRICTION.slip_distance;
    let stiffness = 2.0 * critical;
    let mut slider = steady(FRICTION, stiffness, 1e-6, BackwardEuler, move |time| {
        pull * time
    })?;
    slider.run(&Steps::constant(1e-3).count(20_000), |_| ())?;
    let at = slider.snapshot();
    assert!((at.velocity[0][0] / pull - 1.0).abs() < 1e-10);
    assert!((at.contact(0).state(0) - (FRICTION.slip_distance / pull).ln()).abs() < 1e-10);
    let mu = stiffness * (pull * at.time - at.displacement[0][0]) / NORMAL_STRESS;
    let expected = FRICTION.reference_friction
        + (FRICTION.a - FRICTION.b) * (pull / FRICTION.reference_velocity).ln();
    assert!((mu - expected).abs() < 1e-10, "{mu}, {expected}");
    Ok(())
}

/// The growth rate of small oscillations about steady sliding at 2e-4 m/s [1/s] and their number
/// of peaks, from the peaks of the logarithm of the slip rate between 1 s and 5 s.
fn growth(stiffness: f64, dt: f64) -> Outcome<(f64, usize)> {
    const RATE: f64 = 2e-4;
    // The end of the spring was displaced by 1e-12 m, 1e-7 of the slip distance.
    let pulled = |time: f64| RATE * time + 1e-12;
    let mut slider = steady(FRICTION, stiffness, RATE, Newmark::default(), pulled)?;
    let mut logarithms: Vec<(f64, f64)> = Vec::new();
    let steps = Steps::constant(dt).count((5.0 / dt) as usize);
    slider.run(&steps, |at| {
        logarithms.push((at.time, (at.velocity[0][0] / RATE).ln()));
    })?;
    let peaks: Vec<(f64, f64)> = logarithms
        .windows(3)
        .filter(|w| w[1].0 > 1.0 && w[1].1 > w[0].1.max(w[2].1))
        .map(|w| w[1])
        .collect();
    let (first, last) = (peaks[0], peaks[peaks.len() - 1]);
    assert!(last.1 < 1e-3 && first.1 > 0.0, "not a small oscillation");
    Ok(((last.1 / first.1).ln() / (last.0 - first.0), peaks.len()))
}

/// Linear stability: the real part of the eigenvalue changes sign at `(b - a) sigma/L`.
#[test]
fn oscillations_grow_below_the_critical_stiffness() -> Outcome {
    let critical = (FRICTION.b - FRICTION.a) * NORMAL_STRESS / FRICTION.slip_distance;
    for (share, expected) in [
        (0.8, 1.0),
        (0.95, 0.25),
        (1.0, 0.0),
        (1.05, -0.25),
        (1.2, -1.0),
    ] {
        // The step damps or drives by its square: extrapolate.
        let (coarse, peaks) = growth(share * critical, 4e-4)?;
        let (fine, _) = growth(share * critical, 2e-4)?;
        let rate = (4.0 * fine - coarse) / 3.0;
        assert!((rate - expected).abs() < 2e-4, "{share}: {coarse}, {fine}");
        assert!((coarse - fine).abs() > 1e-5, "the step must show");
        // Four seconds at 14.142 rad/s sqrt(share): 8 to 10 periods.
        assert!((8..=10).contains(&peaks), "{peaks}");
    }
    Ok(())
}

/// The friction coefficients of a velocity step from 1 to 10 um/s at 10 s, at 11, 12, ... 17 s.
fn velocity_step(steps_a_second: usize) -> Outcome<Vec<f64>> {
    let friction = DieterichRuina {
        a: 0.005,
        b: 0.01,
        ..FRICTION
    };
    let stiffness = NORMAL_STRESS * 1e-3 / 1e-6;
    let pull = |time: f64| 1e-6 * time.min(10.0) + 1e-5 * (time - 10.0).max(0.0);
    let mut slider = steady(friction, stiffness, 1e-6, BackwardEuler, pull)?;
    let mut coefficients = Vec::new();
    let steps = Steps::constant(1.0 / steps_a_second as f64).count(17 * steps_a_second);
    slider.run(&steps, |at| {
        if at.step.is_multiple_of(steps_a_second) && at.step > 10 * steps_a_second {
            let force = stiffness * (pull(at.time) - at.displacement[0][0]);
            coefficients.push(force / NORMAL_STRESS);
        }
    })?;
    Ok(coefficients)
}

/// Against values published with another code, which integrates stress and state adaptively.
#[test]
fn a_velocity_step_follows_published_values() -> Outcome {
    const PUBLISHED: [f64; 7] = [
        0.60720485, 0.60186637, 0.5840091, 0.58563096, 0.58899543, 0.58998186, 0.58879751,
    ];
    let (coarse, fine) = (velocity_step(2000)?, velocity_step(4000)?);
    assert_eq!(fine.len(), PUBLISHED.len());
    for ((coarse, fine), published) in coarse.iter().zip(&fine).zip(PUBLISHED) {
        let (error, half) = (coarse - published, fine - published);
        assert!(half.abs() < 2e-5, "{fine}, {published}");
        assert!(
            (2.0 * half - error).abs() < 3e-7,
            "{coarse}, {fine}, {published}"
        );
    }
    Ok(())
}
