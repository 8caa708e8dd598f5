//! Curves of laboratory fits by each state law, against the spring slider: other equations, by another method.

use stickslip::friction::DieterichRuina;
use stickslip::lab::{Evolution, LoadHistory, Parameters};
use stickslip::problems::spring_slider::{FRICTION, LoadPath, SpringScene, SpringSlider};
use stickslip::state::{KatoTullis, PerrinRiceZheng};
use stickslip::{RungeKutta, SceneError, Snapshot, Steps};

use crate::Outcome;

/// Times and coefficients of friction at the steps of a slider.
fn steps(scene: SpringScene, slider: &SpringSlider) -> Outcome<(Vec<f64>, Vec<f64>)> {
    let (mut times, mut friction) = (vec![0.0], Vec::new());
    let mut stepper = RungeKutta::new(scene)?;
    friction.push(stepper.snapshot().contact(0).coefficient(0));
    let plan = Steps::adaptive(1e-10)
        .stopping_at(slider.load.kinks())
        .until(60.0);
    stepper.run(&plan, |at: Snapshot<'_, 1>| {
        times.push(at.time);
        friction.push(at.contact(0).coefficient(0));
    })?;
    Ok((times, friction))
}

/// A velocity step up and one down: with local errors of 1e-10 in `ln V` the curves of both agree to 1e-8.
#[test]
fn fits_and_the_spring_slider_have_the_same_curves() -> Outcome {
    type Built = Box<dyn Fn(&SpringSlider, &DieterichRuina) -> Result<SpringScene, SceneError>>;
    let slower = DieterichRuina {
        a: 0.03,
        b: 0.034,
        ..FRICTION
    };
    let cases: [(Evolution<'_>, DieterichRuina, Built); 5] = [
        (
            Evolution::Aging,
            FRICTION,
            Box::new(|slider, law| slider.steady(*law, law.aging(), 1e-6)),
        ),
        (
            Evolution::Slip,
            FRICTION,
            Box::new(|slider, law| slider.steady(*law, law.slip(), 1e-6)),
        ),
        (
            Evolution::PerrinRiceZheng,
            FRICTION,
            Box::new(|slider, law| {
                let slip_distance = law.slip_distance;
                let friction = DieterichRuina {
                    slip_distance: 2.0 * slip_distance,
                    ..*law
                };
                slider.steady(friction, PerrinRiceZheng { slip_distance }, 1e-6)
            }),
        ),
        (
            Evolution::KatoTullis,
            FRICTION,
            Box::new(|slider, law| {
                let evolution = KatoTullis {
                    slip_distance: law.slip_distance,
                    aging_velocity: 1e-8,
                };
                slider.steady(*law, evolution, 1e-6)
            }),
        ),
        (
            Evolution::Nagata,
            slower,
            Box::new(|slider, law| {
                let (friction, evolution) = law.weakened_by_stress(2.0);
                slider.steady(friction, evolution, 1e-6)
            }),
        ),
    ];
    let slider = SpringSlider {
        stiffness: 3e9,
        normal_stress: 1e6,
        mass: 0.0,
        damping: 0.0,
        load: LoadPath::steady(1e-6).then(10.0, 1e-5).then(30.0, 3e-6),
    };
    let load = LoadHistory::new(1e-6, &[(10.0, 1e-5), (30.0, 3e-6)])?.ending(60.0)?;
    for (law, friction, built) in cases {
        let (times, exact) = steps(built(&slider, &friction)?, &slider)?;
        let curve = Parameters::one_state(&friction, 3e3).curve(&[law], &load, &times)?;
        let differences = curve
            .iter()
            .zip(&exact)
            .map(|(one, other)| (one - other).abs());
        let largest = differences.fold(0.0, f64::max);
        assert!(largest < 1e-8, "{law:?}: {largest:e}");
    }
    Ok(())
}
