//! Couplings on a body: the same bits in every run, and an end where only rounding is left.

use stickslip::Steps;
use stickslip::fem::Elastic;
use stickslip::problems::pipping_slider::{END, PippingSlider};

use crate::Outcome;
use crate::common::{Solver, bits, body, paper_slider};

#[test]
fn two_runs_give_the_same_bits() -> Outcome {
    let run = || -> Outcome<_> {
        let body = body(2);
        let space = body.space()?;
        let mut slider = paper_slider(&body, &space, Solver::Tnnmg, 1e-10)?;
        let mut reports = Vec::new();
        let mut peak = 0_f64;
        slider.run(&Steps::constant(END / 4000.0).count(2750), |at| {
            reports.push(at.report);
            peak = peak.max(at.max_slip_rate());
        })?;
        assert!(peak > 1e-3, "no event: {peak:e}");
        Ok((bits(&slider.snapshot()), reports))
    };
    assert_eq!(run()?, run()?);
    Ok(())
}

/// A stiff body that moves as a whole has a small norm, and rounding errors of a large one: an iteration ends where
/// nothing but those is left, whatever tolerance is asked for, soon after the eighth one, from which on it is looked at.
#[test]
fn what_rounding_leaves_of_an_iteration_ends_it() -> Outcome {
    let body = PippingSlider {
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
        assert!(report.coupling_iterations <= 12, "{report:?}");
    }
    Ok(())
}
