//! The slip that a step misses where a contact closes inside it.

use super::ErrorControl;
use super::VertexError;
use crate::StepState;
use crate::step::{Problem, Workspace};

/// The error of the slip of vertices that close in one of two substeps of `dt/2`, over `slip + slip_floor`.
///
/// Without inertia a substep weighs all of its slip with the normal stress at its end. A vertex that is open at its start
/// and closed at its end slides freely until its gap `g` closes, after about `t = g/v_n`, and substeps of any size may
/// arrest it from their start: they agree, and their ends tell nothing of the slip in between,
///
/// ```text
/// t abs(v_t - du_t/(dt/2)),   t <= dt/2
/// ```
///
/// A vertex that opens ends without friction, wherever it was before.
pub(super) fn landing<const C: usize>(
    p: &Problem<C>,
    w: &Workspace<C>,
    [start, half, end]: [&StepState<C>; 3],
    dt: f64,
    control: &ErrorControl,
) -> VertexError {
    let mut error = VertexError::default();
    if p.matrices.has_mass() || !w.contacts.can_open() {
        return error;
    }
    let size = 0.5 * dt;
    for (contact, at) in w.contacts.contacts.iter().zip(&end.contacts) {
        for (k, &vertex) in contact.part.vertices.iter().enumerate() {
            for [before, after] in [[start, half], [half, end]] {
                let [gap, closed] =
                    [before, after].map(|at| contact.gap(k, &at.displacement[vertex]));
                if gap <= 0.0 || closed > 0.0 {
                    continue;
                }
                let velocity = &before.velocity[vertex];
                let until = gap / -contact.gap(k, velocity);
                let share = if until > 0.0 {
                    (until / size).min(1.0)
                } else {
                    1.0
                };
                let moved = after.displacement[vertex] - before.displacement[vertex];
                let missed = contact.tangential(k, &(velocity * size - moved)).norm();
                let slip = at.slip[k];
                error.raise(share * missed / (slip + control.slip_floor), vertex, || {
                    slip
                });
            }
        }
    }
    error.error = p.ranks.largest(error.error);
    error
}
