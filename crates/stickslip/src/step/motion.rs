//! What a rule does to the fields of a body.

use nalgebra::SVector;
use stickslip_friction::modulus;
use stickslip_time::Rule;

use super::{StepState, Trial};
use crate::StepError;
use crate::contact::ContactSet;
use crate::scene::Constraints;

/// What the scheme knows of displacement and acceleration before the velocity; `acceleration` is empty
/// without mass.
pub(super) fn predict<const C: usize>(
    rule: &Rule,
    now: &StepState<C>,
    displacement: &mut [SVector<f64, C>],
    acceleration: &mut [SVector<f64, C>],
) {
    let (to_u, to_a) = (&rule.displacement, &rule.acceleration);
    let (u, v, a) = (&now.displacement, &now.velocity, &now.acceleration);
    if a.is_empty() {
        for ((displacement, u), v) in displacement.iter_mut().zip(u).zip(v) {
            *displacement = u * to_u.displacement + v * to_u.velocity;
        }
        return;
    }
    let fields = u.iter().zip(v).zip(a);
    for ((displacement, acceleration), ((u, v), a)) in
        displacement.iter_mut().zip(&mut *acceleration).zip(fields)
    {
        *displacement = u * to_u.displacement + v * to_u.velocity + a * to_u.acceleration;
        *acceleration = u * to_a.displacement + v * to_a.velocity + a * to_a.acceleration;
    }
    for (i, w) in now.carried.iter().enumerate() {
        displacement[i] += w * to_u.carried;
        acceleration[i] += w * to_a.carried;
    }
}

/// Where the velocity is prescribed, the rule has weights of its own for the displacement.
pub(super) fn move_prescribed<const C: usize>(
    rule: &Rule,
    now: &StepState<C>,
    constraints: &Constraints<C>,
    velocity: &[SVector<f64, C>],
    displacement: &mut [SVector<f64, C>],
) {
    let c_u = rule.displacement.new_velocity;
    for &vertex in &constraints.held {
        for c in (0..C).filter(|&c| constraints.fixed[vertex][c]) {
            let v = velocity[vertex][c];
            let moved = rule.prescribed.of(now.motion(vertex, c), v);
            displacement[vertex][c] = moved - c_u * v;
        }
    }
}

/// Refuses a field that is not finite.
pub(super) fn check_finite<const C: usize>(
    what: &'static str,
    field: &[SVector<f64, C>],
) -> Result<(), StepError> {
    // One pass without a branch; who it was is asked only if somebody was.
    let mut sound = true;
    for vector in field {
        for c in 0..C {
            sound &= vector[c].is_finite();
        }
    }
    if sound {
        return Ok(());
    }
    for (vertex, vector) in field.iter().enumerate() {
        if let Some(&value) = vector.iter().find(|value| !value.is_finite()) {
            return Err(StepError::Data {
                what,
                vertex,
                value,
            });
        }
    }
    Ok(())
}

/// Adds the way from the old displacement to the new one to the slip of all contacts.
pub(super) fn add_slip<const C: usize>(
    rule: &Rule,
    contacts: &ContactSet<C>,
    trial: &Trial<C>,
    state: &mut StepState<C>,
) {
    let c_u = rule.displacement.new_velocity;
    for (contact, now) in contacts.contacts.iter().zip(&mut state.contacts) {
        for (k, &vertex) in contact.part.vertices.iter().enumerate() {
            let new = trial.velocity[vertex] * c_u + trial.displacement[vertex];
            let moved = contact.tangential(k, &(new - state.displacement[vertex]));
            now.slip[k] += modulus(&moved);
        }
    }
}

/// `u`, `v` and `a` of the new time take the place of the old ones.
pub(super) fn accept<const C: usize>(
    rule: &Rule,
    trial: &mut Trial<C>,
    contacts: &ContactSet<C>,
    state: &mut StepState<C>,
) {
    // Before anything of the old motion is overwritten.
    for i in 0..state.carried.len() {
        for c in 0..C {
            let (from, v) = (state.motion(i, c), trial.velocity[i][c]);
            state.carried[i][c] = rule.carried.of(from, v);
        }
    }
    let c_u = rule.displacement.new_velocity;
    let fields = trial.velocity.iter().zip(&trial.displacement);
    for (u, (v, predicted)) in state.displacement.iter_mut().zip(fields) {
        *u = v * c_u + predicted;
    }
    let c_a = rule.acceleration.new_velocity;
    let fields = trial.velocity.iter().zip(&trial.acceleration);
    for (a, (v, predicted)) in state.acceleration.iter_mut().zip(fields) {
        *a = v * c_a + predicted;
    }
    for (contact, now) in contacts.contacts.iter().zip(&mut state.contacts) {
        for (earlier, &vertex) in now.earlier.iter_mut().zip(&contact.part.vertices) {
            *earlier = state.velocity[vertex];
        }
    }
    std::mem::swap(&mut state.velocity, &mut trial.velocity);
}
