//! Resolution of slip rates without inertia, and the scheme for a step that does not resolve them.

use stickslip_time::{BackwardEuler, RateScheme, SchemeProperties, Stage, UpdateFormula};

use super::{Problem, Workspace};
use crate::StepState;
use crate::numerics::NUMERICS;

/// Two half steps of backward Euler, which never slip beyond the balance of forces (no scheme of higher order is
/// contractive in every step: M. Spijker, Numer. Math. 42 (1983)). The second half step yields the rate after the slip
/// of the first.
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

/// Whether the slip rates of a stage are resolved. Schemes of second order move a vertex by about `dt (v_o + v)/2`,
/// with a rate from before the step. After a jump of load or strength this mean includes slip that is already complete,
/// and moves the vertex too far; friction does not let it slip back. The trapezoidal rule multiplies a rate that decays
/// as `exp(-t/T)` by `(1 - z/2)/(1 + z/2)`, `z = dt/T`. A step that resolves this time, `z <= 1`, satisfies
///
/// ```text
/// v . v_o >= abs(v_o)^2 / 3
/// ```
///
/// A rate whose effect on the forces is below the tolerance of the step does not count.
pub(super) fn are_resolved<const C: usize>(
    p: &Problem<C>,
    w: &Workspace<C>,
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
