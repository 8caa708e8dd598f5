//! What the solver, or rounding, leaves open is no error of a step and no change of an iteration.

use stickslip::fem::Elastic;
use stickslip::problems::Slider;
use stickslip::{ErrorControl, Stepper, Steps};

use crate::Outcome;
use crate::common::{Solver, body, paper_slider};

/// Velocities of up to 2e-4 m/s, that of the top, on squares of half a metre: their norm is below
/// `2e-4 sqrt(5 E (4 / 0.5)^2)`, 30, whatever they are, and below a tolerance of 1e3 nothing is known of them.
#[test]
fn a_difference_below_the_tolerance_is_no_error() -> Outcome {
    let body = body(1);
    let space = body.space()?;
    for (tolerance, open) in [(1e3, true), (1e-10, false)] {
        let mut slider = paper_slider(&body, &space, Solver::Condensed, tolerance)?;
        slider.step(0.1)?;
        for dt in [1e-6, 1e-3, 1.0] {
            let error = slider.step_estimated(dt, &ErrorControl::default())?;
            if open {
                assert_eq!([error.slip_rate.error, error.motion], [0.0; 2], "{error}");
            } else {
                assert!(error.largest() > 0.0, "{error}");
            }
            slider.undo();
        }
        let steps = Steps::adaptive(1e-4).with_first_step(1e-6).until(2.0);
        let report = slider.run(&steps, |_| ())?;
        // The state's own error is left, of a step of first order over the decades of time.
        assert!(!open || report.accepted < 1000, "{report:?}");
    }
    Ok(())
}

/// A stiff body that moves as a whole has a small norm, and rounding errors of a large one: an iteration ends where
/// nothing but those is left, whatever tolerance is asked for, and as soon as that shows.
#[test]
fn what_rounding_leaves_of_an_iteration_ends_it() -> Outcome {
    let body = Slider {
        elastic: Elastic {
            young_modulus: 1e12,
            ..body(2).elastic
        },
        ..body(2)
    };
    let space = body.space()?;
    let mut slider = paper_slider(&body, &space, Solver::Tnnmg, 1e-17)?;
    for _ in 0..200 {
        let report = slider.step(1e-3)?;
        assert!(report.coupling_iterations <= 8, "{report:?}");
    }
    Ok(())
}
