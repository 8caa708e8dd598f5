//! The distance of two results of a step, per quantity.

use nalgebra::SVector;
use stickslip_friction::modulus;
use stickslip_solvers::Matrix;

use super::ErrorControl;
use crate::step::{Problem, Workspace};
use crate::sums::largest;
use crate::{LocalError, StepState};

/// Two results of a step, and its start.
pub(super) struct Ends<'a, const C: usize> {
    pub(super) start: &'a StepState<C>,
    pub(super) end: &'a StepState<C>,
    pub(super) coarser: &'a StepState<C>,
    /// The middle of the step by two substeps, with inertia: `coarser` is then the end of a single step with continuous
    /// velocity.
    pub(super) middle: Option<&'a StepState<C>>,
    /// The size of the step \[s\].
    pub(super) dt: f64,
    /// Twice the energy of the equilibrium, `u_0 . A u_0` \[J\].
    pub(super) at_rest: f64,
    /// The sum of the diagonal of the stiffness in this process [N/m].
    pub(super) trace: f64,
}

impl<const C: usize> Ends<'_, C> {
    /// The larger difference of a displacement at the end of the step and in its middle, where the single step is
    /// interpolated by Hermite's cubic. Two results that both arrest a node at once agree at the end; the middle
    /// measures its slip until then.
    fn away(&self, vertex: usize, size: impl Fn(&SVector<f64, C>) -> f64) -> f64 {
        let (start, end, coarser) = (self.start, self.end, self.coarser);
        let [from, fine, coarse] = [start, end, coarser].map(|state| &state.displacement[vertex]);
        let at_end = size(&(fine - coarse));
        let Some(middle) = self.middle else {
            return at_end;
        };
        let [before, after] = [start, coarser].map(|state| &state.velocity[vertex]);
        let cubic = (from + coarse) / 2.0 + (before - after) * (self.dt / 8.0);
        at_end.max(size(&(middle.displacement[vertex] - cubic)))
    }
}

/// The error of each quantity over `floor + abs(x)`, see [`ErrorControl`]. Raises the largest motion so far.
pub(super) fn distance<const C: usize>(
    p: &Problem<C>,
    w: &Workspace<C>,
    ends: &Ends<'_, C>,
    control: &ErrorControl,
    difference: &mut [SVector<f64, C>],
    largest_motion: &mut f64,
) -> LocalError {
    let mut error = of_contacts(p, w, ends, control);
    if p.moves_freely {
        let size = |field: &[SVector<f64, C>], origin: &[SVector<f64, C>], i: usize| {
            origin
                .get(i)
                .map_or(field[i], |origin| field[i] - origin)
                .norm()
        };
        let now = &ends.end.displacement;
        let farthest = largest((0..now.len()).map(|i| size(now, &p.equilibrium, i)));
        let scale = farthest + control.slip_floor;
        for (i, now) in now.iter().enumerate() {
            let away = ends.away(i, SVector::norm) / scale;
            error.displacement.raise(away, i, || now.norm());
        }
    }
    if control.motion > 0.0 {
        error.motion = control.motion * of_motion(p, w, ends, control, difference, largest_motion);
    }
    for found in [
        &mut error.slip_rate.error,
        &mut error.state.error,
        &mut error.slip.error,
        &mut error.displacement.error,
    ] {
        *found = p.ranks.largest(*found);
    }
    error
}

/// The error of states, of slip rates where friction depends on them and on a state, and of slip elsewhere.
fn of_contacts<const C: usize>(
    p: &Problem<C>,
    w: &Workspace<C>,
    ends: &Ends<'_, C>,
    control: &ErrorControl,
) -> LocalError {
    let (now, coarser) = (ends.end, ends.coarser);
    // As the motion, from the initial velocity on: the same in all frames that move uniformly.
    let since = |(i, v): (usize, &SVector<f64, C>)| {
        let from = p.initial_velocity.get(i);
        from.map_or(*v, |from| v - from).norm_squared()
    };
    let fastest = largest(now.velocity.iter().enumerate().map(since));
    let fastest = p.ranks.largest(fastest).sqrt();
    let floor = (control.slip_rate_floor).max(control.relative_slip_rate_floor * fastest);
    let mut error = LocalError::default();
    let states = now.contacts.iter().zip(&coarser.contacts);
    for (index, (contact, (at, coarser_at))) in w.contacts.contacts.iter().zip(states).enumerate() {
        for (k, &vertex) in contact.part.vertices.iter().enumerate() {
            if let Some((&a, &b)) = at.states.get(k).zip(coarser_at.states.get(k)) {
                let states = contact.trial.laws().distance(a, b);
                error.state.raise(states, vertex, || a);
            }
            // Where a vertex opens or closes its slip rate jumps, and friction does not tell it.
            let opens = contact.opening_axis(k).is_some()
                && [&ends.start.contacts[index], at, coarser_at]
                    .iter()
                    .any(|at| at.normal_stress[k] == 0.0);
            if at.states.is_empty() || !contact.reads_rate || opens {
                let away = ends.away(vertex, |difference| {
                    contact.tangential(k, difference).norm()
                });
                let away = away / (at.slip[k] + control.slip_floor);
                error.slip.raise(away, vertex, || at.slip[k]);
            } else {
                let rate = contact.tangential(k, &now.velocity[vertex]);
                let other = contact.tangential(k, &coarser.velocity[vertex]);
                let rates = rate_distance(rate, other, floor);
                error.slip_rate.raise(rates, vertex, || rate.norm());
            }
        }
    }
    error
}

/// The difference of `ln V` above a floor.
pub(super) fn rate_distance<const C: usize>(
    a: SVector<f64, C>,
    b: SVector<f64, C>,
    floor: f64,
) -> f64 {
    // At rest on both sides nothing differs.
    let larger = modulus(&a).max(modulus(&b));
    modulus(&(a - b)) / (larger + floor).max(f64::MIN_POSITIVE)
}

/// The error of the motion in the energy norm, `sqrt(du . A du + dv . M dv)`. With inertia its scale is the largest motion
/// so far: an arrest leaves waves of far less energy, for as long as nothing damps them. From the initial velocity on,
/// motion is the same in all frames that move uniformly.
fn of_motion<const C: usize>(
    p: &Problem<C>,
    w: &Workspace<C>,
    ends: &Ends<'_, C>,
    control: &ErrorControl,
    difference: &mut [SVector<f64, C>],
    largest_motion: &mut f64,
) -> f64 {
    let states = [ends.start, ends.end, ends.coarser];
    let mut sums = [0.0; 3];
    let fields = states.map(|state| state.displacement.as_slice());
    let stiffness = p.matrices.stiffness();
    add_squares(stiffness, fields, &p.equilibrium, difference, &mut sums);
    // What a force deforms at each frictional vertex by itself, slip that is not resolved, and creep.
    let deformed =
        (w.contacts.vertices.iter().zip(w.contacts.strengths())).map(|(&vertex, force)| {
            let own = stiffness.diagonal_block(vertex).diagonal().max();
            if own > 0.0 { force * force / own } else { 0.0 }
        });
    let unresolved = control.slip_floor.powi(2) * ends.trace;
    let mut floor = control.motion_floor.powi(2) * (deformed.sum::<f64>() + unresolved);
    if let Some(mass) = p.matrices.mass() {
        let fields = states.map(|state| state.velocity.as_slice());
        add_squares(mass, fields, &p.initial_velocity, difference, &mut sums);
        let size = stiffness.vertex_count();
        let inertia = (0..size).map(|i| mass.diagonal_block(i).diagonal().max());
        floor += control.slip_rate_floor.powi(2) * inertia.sum::<f64>();
    }
    let [before, after, square] = sums;
    // Rounding may leave a negative square.
    let floor = p.ranks.sum(floor) + control.motion_floor.powi(2) * ends.at_rest.max(0.0);
    let mut motion = before.max(after).max(0.0).sqrt();
    if p.matrices.has_mass() {
        motion = motion.max(*largest_motion);
        *largest_motion = motion;
    }
    let scale = motion + floor.sqrt();
    square.max(0.0).sqrt() / scale.max(f64::MIN_POSITIVE)
}

/// Adds the squares, in the norm of an operator, of a field's change since `origin` and of its distance to a coarser
/// field. An empty origin is zero.
fn add_squares<const C: usize>(
    operator: &dyn Matrix<C>,
    [start, now, coarser]: [&[SVector<f64, C>]; 3],
    origin: &[SVector<f64, C>],
    difference: &mut [SVector<f64, C>],
    [before, after, square]: &mut [f64; 3],
) {
    let mut from = |field: &[SVector<f64, C>], origin: &[SVector<f64, C>]| {
        if origin.is_empty() {
            return operator.quadratic(field);
        }
        for (difference, (field, origin)) in difference.iter_mut().zip(field.iter().zip(origin)) {
            *difference = field - origin;
        }
        operator.quadratic(difference)
    };
    *before += from(start, origin);
    *after += from(now, origin);
    *square += from(now, coarser);
}
