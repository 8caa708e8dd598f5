//! Steady or nearly steady motion takes few steps.

use nalgebra::{SMatrix, Vector2};
use stickslip::friction::{RegularizedDieterichRuina, Tresca};
use stickslip::problems::spring_slider::{LoadPath, SpringSlider};
use stickslip::state::{Dieterich, LogTheta, PerrinRiceZheng};
use stickslip::{
    BoundaryPart, Contact, ErrorControl, GeneralizedAlpha, Newmark, Point, RateScheme, RungeKutta,
    Scene, Sdirk2, Simulation, Steps,
};

use crate::Outcome;

/// Blocks with inertia on springs stiffer than critical, five per cent off steady sliding: normal stress, slip distance,
/// stiffness over the critical one, and period over a turn.
const BLOCKS: [[f64; 4]; 4] = [
    [5e6, 5e-5, 1.5, 1e-2],
    [1e6, 1e-5, 1.2, 1e-3],
    [5e7, 1e-3, 3.0, 1e-4],
    [1e5, 1e-4, 10.0, 1e-1],
];

/// The logarithm of the rate after a slip of twenty slip distances, and the steps taken.
fn settles(
    [normal_stress, slip_distance, excess, period]: [f64; 4],
    scheme: Box<dyn RateScheme>,
    steps: Steps,
) -> Outcome<(f64, usize)> {
    let law = RegularizedDieterichRuina {
        a: 0.010,
        b: 0.015,
        reference_friction: 0.6,
        reference_velocity: 1e-6,
        slip_distance,
    };
    let critical = SpringSlider::critical_stiffness(normal_stress, 0.010, 0.015, slip_distance);
    let stiffness = excess * critical;
    let slider = SpringSlider {
        stiffness,
        normal_stress,
        mass: period * period * stiffness,
        damping: 0.0,
        load: LoadPath::steady(1e-6),
    };
    let scene = slider.steady(law, Dieterich { slip_distance }, 1.05e-6)?;
    let mut block = Simulation::new(scene, scheme, Point)?;
    let report = block.run(&steps.until(20.0 * slip_distance / 1e-6), |_| ())?;
    let rate = block.snapshot().max_slip_rate();
    Ok((rate.ln(), report.accepted + report.rejected))
}

/// They tend to it in some dozen steps, at tolerances of all sizes.
#[test]
fn steady_sliding_with_inertia_takes_few_steps() -> Outcome {
    let mut missed = Vec::new();
    for block in BLOCKS {
        let (expected, _) = settles(block, Box::new(Sdirk2), Steps::adaptive(1e-9))?;
        for tolerance in [1e-2, 1e-3, 1e-4, 1e-6] {
            for which in 0..4 {
                let scheme: Box<dyn RateScheme> = match which {
                    0 => Box::new(GeneralizedAlpha::default()),
                    1 | 3 => Box::new(Sdirk2),
                    _ => Box::new(Newmark::default()),
                };
                let mut steps = Steps::adaptive(tolerance).with_max_steps(20_000);
                if which == 3 {
                    // As the page on choosing a method names it.
                    steps = steps.with_error_control(ErrorControl::extrapolated(2));
                }
                let name = format!("{block:?}, {tolerance:e}, scheme {which}");
                match settles(block, scheme, steps) {
                    Ok((found, taken)) => {
                        let off = (found - expected).abs();
                        if off > tolerance * taken as f64 || taken > 500 {
                            missed.push(format!("{name}: {taken} steps, off by {off:e}"));
                        }
                    }
                    Err(failure) => missed.push(format!("{name}: {failure}")),
                }
            }
        }
    }
    assert!(missed.is_empty(), "{missed:#?}");
    Ok(())
}

/// A point dragged by a spring over a plane, the load point moving across: its way is a tractrix.
#[test]
fn few_adaptive_steps_follow_a_tractrix() -> Outcome {
    let (stiffness, length, velocity, end): (f64, f64, f64, f64) = (1e3, 1e-3, 1e-4, 30.0);
    let angle = (velocity * end / length).sinh().atan();
    let expected = Vector2::new(
        length - length * angle.cos(),
        velocity * end - length * angle.sin(),
    );
    let run = |scheme: Box<dyn RateScheme>, steps: Steps| -> Outcome<_> {
        let scene = Scene::new(SMatrix::<f64, 2, 2>::identity() * stiffness)
            .with_contact(Contact::new(
                BoundaryPart::point(1.0),
                Tresca { coefficient: 1.0 },
                1.0,
            ))
            .with_load_history(move |time, load| {
                load[0] += Vector2::new(stiffness * length, stiffness * velocity * time);
            });
        let mut point = Simulation::new(scene, scheme, Point)?;
        let report = point.run(&steps.until(end), |_| ())?;
        let off = (point.snapshot().displacement[0] - expected).norm() / length;
        Ok((off, report.accepted + report.rejected))
    };
    let mut missed = Vec::new();
    for which in 0..2 {
        let scheme = || -> Box<dyn RateScheme> {
            match which {
                0 => Box::new(Newmark::default()),
                _ => Box::new(Sdirk2),
            }
        };
        for tolerance in [1e-2, 1e-4, 1e-6] {
            let (off, count) = run(scheme(), Steps::adaptive(tolerance))?;
            // Each step may miss a share of the slip, which is three lengths; they add up to some of them.
            if off > 30.0 * tolerance || count > 300 {
                missed.push(format!(
                    "scheme {which}, {tolerance:e}: {off:.1e} in {count} steps"
                ));
            }
        }
    }
    assert!(missed.is_empty(), "{missed:#?}");
    Ok(())
}

/// The law of Perrin, Rice and Zheng through four and a half centuries of earthquakes, at times of 1e10 s: steps of some
/// units of rounding of the time are steps.
#[test]
fn centuries_do_not_end_at_the_rounding_of_their_time() -> Outcome {
    let slip_distance = 0.008;
    let law = RegularizedDieterichRuina {
        a: 0.010,
        b: 0.015,
        reference_friction: 0.6,
        reference_velocity: 1e-6,
        slip_distance: 2.0 * slip_distance,
    };
    let slider = SpringSlider {
        stiffness: 3.30904165e6,
        normal_stress: 50e6,
        mass: 0.0,
        damping: 32.04e9 / 2.0 / 3464.0,
        load: LoadPath::steady(1e-9),
    };
    let state = LogTheta((1.05 * 2.0 * slip_distance / 1e-9_f64).ln());
    let scene = || slider.scene(law, PerrinRiceZheng { slip_distance }, 1e-9, state);
    let end = 450.0 * 3.15576e7;
    for tolerance in [1e-5, 1e-7, 1e-9] {
        let mut block = RungeKutta::new(scene()?)?;
        block.run(&Steps::adaptive(tolerance).until(end), |_| ())?;
        assert_eq!(block.snapshot().time, end);
    }
    for tolerance in [1e-3, 1e-5] {
        let mut block = Simulation::new(scene()?, Sdirk2, Point)?;
        block.run(&Steps::adaptive(tolerance).until(end), |_| ())?;
        assert_eq!(block.snapshot().time, end);
    }
    Ok(())
}

/// Below the critical stiffness nothing without inertia and damping goes on: every method says what is missing.
#[test]
fn what_is_missing_is_said_by_every_method() -> Outcome {
    let law = RegularizedDieterichRuina {
        a: 0.010,
        b: 0.015,
        reference_friction: 0.6,
        reference_velocity: 1e-6,
        slip_distance: 0.008,
    };
    let slider = SpringSlider {
        stiffness: 3.30904165e6,
        normal_stress: 50e6,
        mass: 0.0,
        damping: 0.0,
        load: LoadPath::steady(1e-9),
    };
    let state = LogTheta((1.05 * 0.008 / 1e-9_f64).ln());
    let scene = || {
        let slip_distance = 0.008;
        slider.scene(law, Dieterich { slip_distance }, 1e-9, state)
    };
    let steps = Steps::adaptive(1e-5).until(1e10);
    let explicit = RungeKutta::new(scene()?)?.run(&steps, |_| ()).err();
    let implicit = Simulation::new(scene()?, Newmark::default(), Point)?
        .run(&steps, |_| ())
        .err();
    for failure in [explicit, implicit] {
        let failure = failure.ok_or("ended")?.to_string();
        assert!(
            failure.contains("add mass or radiation damping"),
            "{failure}"
        );
    }
    Ok(())
}
