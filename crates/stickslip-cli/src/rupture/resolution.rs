//! Whether cells resolve the front of a rupture.

use super::weakening::cohesive_zone;
use super::{Arguments, Benchmark};

/// The edges of cells in the length over which friction weakens that resolve it (S. Day et al., J. Geophys. Res. 110 (2005)).
const RESOLVED: f64 = 3.0;

impl Benchmark {
    /// The length at the front over which friction weakens, with its name \[m\]. The stiffness that resists slip is the
    /// harmonic mean of `G/(1 - nu)` on both sides.
    pub fn weakening_length(self) -> (&'static str, f64) {
        let rocks = self.rocks();
        let compliance: f64 = rocks.iter().map(|rock| rock.stiffness().recip()).sum();
        let stiffness = 2.0 / compliance;
        match self.law() {
            Some(law) => law.weakening_length(stiffness),
            None => ("cohesive zone", cohesive_zone(stiffness)),
        }
    }
}

/// Warns of cells that do not resolve the front.
pub(super) fn warn(arguments: &Arguments) {
    let (what, length) = arguments.problem.weakening_length();
    if arguments.cell > length / RESOLVED {
        note!(
            "warning: edges of {} m do not resolve the {what} of {length:.0} m at the front: take --cell {:.0} or less",
            arguments.cell,
            length / RESOLVED
        );
    }
}
