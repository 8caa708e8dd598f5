//! Staggered coupling: a fixed number of passes, for steps too small to need iteration.

use crate::{Coupling, CouplingReport, StepError, StepMaps};

/// State from rate and rate from state in `passes` passes, without a test of convergence.
///
/// The first pass uses the rate extrapolated from the last two steps, which is already of second order with the
/// midpoint state. It suits explicit schemes, whose steps are far below the time scale of rate and state. Its problems
/// are convex, and require no certificate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Staggered {
    passes: usize,
}

impl Staggered {
    /// Sets the number of passes per step, at least one.
    pub fn with_passes(passes: usize) -> Self {
        Self {
            passes: passes.max(1),
        }
    }
}

impl Default for Staggered {
    /// One pass.
    fn default() -> Self {
        Self::with_passes(1)
    }
}

impl Coupling for Staggered {
    fn couple(&self, maps: &mut dyn StepMaps, tolerance: f64) -> Result<CouplingReport, StepError> {
        maps.extrapolate_rates();
        for _ in 0..self.passes {
            maps.propose_states()?;
            maps.relax_states(1.0);
            maps.solve_once(tolerance)?;
        }
        Ok(CouplingReport {
            iterations: self.passes,
            ..CouplingReport::default()
        })
    }

    fn is_simultaneous(&self) -> bool {
        false
    }
}
