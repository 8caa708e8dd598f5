//! The error of the motion of a body in a step, in the energy norm.

use nalgebra::SVector;
use stickslip_tnnmg::Operator;

use super::resolution::Resolution;
use crate::{Simulation, StepState};

/// Where a step began, and by what its motion is measured.
pub(super) struct Beginning<'a, const C: usize> {
    pub(super) start: &'a StepState<C>,
    /// The square of the motion up to which the body rests.
    pub(super) rest: f64,
    /// Memory for the difference of two fields.
    pub(super) difference: &'a mut [SVector<f64, C>],
    /// The largest motion of steps from rest, and how many were tried from here.
    pub(super) onset: &'a mut (f64, usize),
}

/// The share of its motion after a step, squared, with which a body that begins to move began it.
const FROM_REST: f64 = 1e-12;
/// The tries from rest after which what still differs is rounding.
const ONSETS: usize = 40;

impl<Op: Operator<C>, const C: usize> Simulation<Op, C> {
    /// The distance from `coarser` in the energy norm, relative to the motion. That of a body that begins to move is
    /// what the longest step tried from there led to: relative to its own motion a shorter one may be as far off, since
    /// motion that begins with a power of time looks alike at all scales.
    pub(super) fn motion_error(
        &self,
        beginning: &mut Beginning<'_, C>,
        coarser: &StepState<C>,
        resolution: &Resolution,
    ) -> f64 {
        let Beginning {
            start,
            rest,
            difference,
            onset: (farthest, tries),
        } = beginning;
        let now = &self.state;
        let mut sums = [0.0; 3];
        let fields = [*start, now, coarser].map(|state| state.displacement.as_slice());
        let stiffness = &self.scene.stiffness;
        add_squares(stiffness, fields, &self.equilibrium, difference, &mut sums);
        if let Some(mass) = &self.scene.mass {
            let fields = [*start, now, coarser].map(|state| state.velocity.as_slice());
            add_squares(mass, fields, &[], difference, &mut sums);
        }
        let [before, mut after, square] = sums;
        if before > FROM_REST * after {
            *farthest = 0.0;
        } else {
            *farthest = farthest.max(after);
            *tries += 1;
            if *farthest == 0.0 || *tries > ONSETS {
                return 0.0;
            }
            after = *farthest;
        }
        // Rounding may leave a negative square.
        let difference = square.max(0.0).sqrt() - self.open_motion(resolution);
        difference.max(0.0) / before.max(after).max(*rest).sqrt()
    }
}

/// Adds the squares, in the norm of an operator, of what a field was from `origin` at the start and is now, and of the
/// distance to a coarser one. An empty origin is zero.
fn add_squares<Op: Operator<C>, const C: usize>(
    operator: &Op,
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
