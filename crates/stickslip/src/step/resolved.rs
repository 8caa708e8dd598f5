//! Without inertia: whether a step resolves its rates, and the scheme of one that does not.

use stickslip_solvers::Operator;
use stickslip_time::{BackwardEuler, RateScheme, SchemeProperties, Stage, UpdateFormula};

use super::{Problem, Workspace};
use crate::StepState;
use crate::numerics::NUMERICS;

/// Two half steps of backward Euler, which never slip beyond where forces balance (no scheme of higher order is
/// contractive in every step: M. Spijker, Numer. Math. 42 (1983)). The second one leaves the rate behind what the first
/// has slipped.
pub(super) struct Halves;

const STAGES: [Stage; 2] = [
    Stage {
        share: 0.5,
        lead: 1.0,
        end: 0.5,
    },
    Stage {
        share: 0.5,
        lead: 1.0,
        end: 1.0,
    },
];

impl RateScheme for Halves {
    fn update_formula(&self, dt: f64) -> UpdateFormula {
        stickslip_time::QuasiStatic(BackwardEuler).update_formula(dt)
    }

    fn properties(&self) -> SchemeProperties {
        SchemeProperties {
            stages: &STAGES,
            ..BackwardEuler.properties()
        }
    }
}

/// Whether the slip rates of a stage are resolved. Schemes of second order move a vertex by `dt (v_o + v)/2` or so, with a
/// rate from before the step: behind a jump of load or strength that is an average over a slip which is over, and takes
/// the vertex too far, from where friction does not slip back. The trapezoidal rule multiplies a rate that decays as
/// `exp(-t/T)` by `(1 - z/2)/(1 + z/2)`, `z = dt/T`; a step that resolves this time, `z <= 1`, leaves
///
/// ```text
/// v . v_o >= abs(v_o)^2 / 3
/// ```
///
/// A rate that moves no force by more than the tolerance of the step does not count.
pub(super) fn are_resolved<Op: Operator<C>, const C: usize>(
    p: &Problem<Op, C>,
    w: &Workspace<Op, C>,
    start: &StepState<C>,
) -> bool {
    let tolerance = w.tolerance(&p.method);
    let resolved = w.contacts.vertices.iter().enumerate().all(|(k, &vertex)| {
        let slip = |v: &[nalgebra::SVector<f64, C>]| w.contacts.slip_velocity(k, &v[vertex]);
        let (now, before) = (slip(&w.end.velocity), slip(&start.velocity));
        let square = before.norm_squared();
        NUMERICS.resolved_ratio * now.dot(&before) >= square
            || square.sqrt() <= w.operators.velocity_of(tolerance, vertex)
    });
    p.ranks.all(resolved)
}
