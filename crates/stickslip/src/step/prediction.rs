//! The prediction `u^`, `a^` of an update formula on the fields of a body.

use std::ops::Range;

use nalgebra::SVector;
use stickslip_solvers::{Divide, for_parts};
use stickslip_time::UpdateFormula;

use crate::StepState;

/// `u^` and `a^`, and the velocity of the start; no acceleration without mass.
pub(super) fn predict<const C: usize>(
    formula: &UpdateFormula,
    start: &StepState<C>,
    end: &mut StepState<C>,
) {
    let (to_u, to_a) = (&formula.displacement, &formula.acceleration);
    let fields = (
        &mut end.displacement[..],
        (&mut end.velocity[..], Part(&mut end.acceleration[..])),
    );
    for_parts(0..start.displacement.len(), fields, &|part,
                                                     (
        new_u,
        (new_v, Part(new_a)),
    )| {
        new_v.copy_from_slice(&start.velocity[part.clone()]);
        predict_part(formula, start, part, [new_u, new_a]);
    });
    for (i, w) in start.algorithmic.iter().enumerate() {
        end.displacement[i] += w * to_u.algorithmic;
        if let Some(acceleration) = end.acceleration.get_mut(i) {
            *acceleration += w * to_a.algorithmic;
        }
    }
}

/// `u^` and `a^` of a part of the vertices, without algorithmic accelerations; no acceleration for an empty one.
#[inline(always)]
pub(super) fn predict_part<const C: usize>(
    formula: &UpdateFormula,
    start: &StepState<C>,
    part: Range<usize>,
    [new_u, new_a]: [&mut [SVector<f64, C>]; 2],
) {
    let (to_u, to_a) = (&formula.displacement, &formula.acceleration);
    let (u, v) = (
        &start.displacement[part.clone()],
        &start.velocity[part.clone()],
    );
    for ((new_u, u), v) in new_u.iter_mut().zip(u).zip(v) {
        *new_u = u * to_u.displacement + v * to_u.velocity;
    }
    // In the cache by now.
    let Some(a) = start.acceleration.get(part) else {
        return;
    };
    for (i, (new_a, a)) in new_a.iter_mut().zip(a).enumerate() {
        new_u[i] += a * to_u.acceleration;
        *new_a = u[i] * to_a.displacement + v[i] * to_a.velocity + a * to_a.acceleration;
    }
}

/// A field that may be empty.
struct Part<'a, T>(&'a mut [T]);

impl<T: Send> Divide for Part<'_, T> {
    fn divide(self, vertices: usize, _: usize) -> (Self, Self) {
        let (before, behind) = self.0.split_at_mut(vertices.min(self.0.len()));
        (Self(before), Self(behind))
    }
}

/// `a^` of a vertex.
pub(super) fn predicted_acceleration<const C: usize>(
    formula: &UpdateFormula,
    start: &StepState<C>,
    vertex: usize,
) -> SVector<f64, C> {
    let to_a = &formula.acceleration;
    start.displacement[vertex] * to_a.displacement
        + start.velocity[vertex] * to_a.velocity
        + start.acceleration[vertex] * to_a.acceleration
}
