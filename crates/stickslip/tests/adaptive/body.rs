//! The elastic slider with steps that are quantised: one factor a size, kept.

use std::cell::Cell;
use std::rc::Rc;

use nalgebra::SVector;
use stickslip::friction::ConvexPotential;
use stickslip::problems::{AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, Slider};
use stickslip::state::LogTheta;
use stickslip::tnnmg::{Energy, SolveError, SolveReport, Stopping};
use stickslip::{
    Adaptive, BlockMatrix, Condensed, ErrorControl, NonsmoothSolver, Sdirk2, Simulation,
};

use crate::Outcome;

/// The direct solver, whose factorisations are shown outside.
struct Counting(Condensed<2>, Rc<Cell<usize>>);

impl<P: ConvexPotential<2>> NonsmoothSolver<BlockMatrix<2>, P, 2> for Counting {
    fn prepare(&mut self, energy: &Energy<'_, BlockMatrix<2>, P, 2>) -> Result<(), SolveError> {
        self.0.prepare(energy)?;
        self.1.set(self.0.factorizations());
        Ok(())
    }

    fn minimize(
        &mut self,
        energy: &Energy<'_, BlockMatrix<2>, P, 2>,
        stopping: &Stopping<'_, BlockMatrix<2>>,
        v: &mut [SVector<f64, 2>],
    ) -> Result<SolveReport, SolveError> {
        self.0.minimize(energy, stopping, v)
    }
}

/// Factorisations and accepted and rejected steps up to the first event.
fn cost(adaptive: &Adaptive) -> Result<(usize, usize), Box<dyn std::error::Error>> {
    let body = Slider {
        refinements: 2,
        ..Slider::default()
    };
    let space = body.space()?;
    let scene = body
        .scene(&space)?
        .with_friction(&Slider::bottom(&space)?, FRICTION, NORMAL_STRESS)
        .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
    let count = Rc::new(Cell::new(0));
    let solver = Counting(Condensed::new().with_cached_factors(24), Rc::clone(&count));
    let mut slider = Simulation::new(scene, Sdirk2, solver)?;
    let mut peak = 0_f64;
    let report = adaptive.run(&mut slider, 10.2, &mut |at| {
        peak = peak.max(at.max_slip_rate());
    })?;
    assert!(peak > 5e-3, "no event: {peak:e}");
    Ok((count.get(), report.accepted + report.rejected))
}

#[test]
fn quantised_steps_share_their_factors() -> Outcome {
    let adaptive = Adaptive::new(1e-2)
        .with_first_step(1e-3)
        .with_error_control(ErrorControl {
            slip_rate_floor: 1e-12,
            ..ErrorControl::default()
        });
    let (many, steps) = cost(&adaptive)?;
    let (few, quantised) = cost(&adaptive.with_quantised_steps())?;
    // A whole and two halves: at most two operators a step, and both where none is kept.
    assert!(many > steps / 2, "{many} of {steps}");
    assert!(few <= 24 && few < many / 4, "{few} of {quantised}");
    Ok(())
}
