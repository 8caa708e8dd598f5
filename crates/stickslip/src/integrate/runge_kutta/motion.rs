//! The unknowns of the equation at the stages of a step, and their weighted sums.

use std::ops::{AddAssign, Mul};

use nalgebra::SVector;

use super::tableau::{ERROR, STAGES, WEIGHTS};
use super::threads::on_shares;
use crate::StepState;

/// The unknowns of the equation, or a change of them.
#[derive(Clone)]
pub(super) struct Motion<const C: usize> {
    pub(super) displacement: Vec<SVector<f64, C>>,
    /// The states of all contacts, one after the other.
    pub(super) states: Vec<f64>,
}

/// The stages of a step.
pub(super) struct Stages<const C: usize> {
    /// `(u', alpha')` at the stages of the last step. The last stage is the first of the next step.
    pub(super) slopes: [Motion<C>; STAGES],
    /// `(u, alpha)` of a stage.
    pub(super) motion: Motion<C>,
    /// The difference of a step from the embedded method.
    pub(super) error: Motion<C>,
    /// The change of normal stresses in it; empty where none follows the displacement.
    pub(super) clamped: Vec<f64>,
    /// Copies while times inside of a step are shown.
    pub(super) dense: Option<Box<Dense<C>>>,
}

/// Copies of a step while times inside of it are shown; allocated on first use.
pub(super) struct Dense<const C: usize> {
    /// The first slope of the step, whose place the shown slopes take.
    pub(super) first: Motion<C>,
    pub(super) from: StepState<C>,
    pub(super) to: StepState<C>,
}

impl<const C: usize> Stages<C> {
    /// The stages of steps from a state.
    pub(super) fn new(state: &StepState<C>, clamps: bool) -> Self {
        let size = state.velocity.len();
        let states = state.contacts.iter().map(|contact| contact.states.len());
        let motion = Motion {
            displacement: vec![SVector::zeros(); size],
            states: vec![0.0; states.sum()],
        };
        Self {
            slopes: std::array::from_fn(|_| motion.clone()),
            error: motion.clone(),
            motion,
            clamped: vec![0.0; if clamps { size } else { 0 }],
            dense: None,
        }
    }
}

impl<const C: usize> Motion<C> {
    /// Copies the unknowns from the start of a step.
    pub(super) fn copy_from(&mut self, from: &StepState<C>) {
        self.displacement.copy_from_slice(&from.displacement);
        let mut rest = self.states.as_mut_slice();
        for contact in &from.contacts {
            let (states, others) = rest.split_at_mut(contact.states.len());
            states.copy_from_slice(&contact.states);
            rest = others;
        }
    }

    /// Sets the unknowns to `from` plus the step times the weighted slopes of the previous stages.
    pub(super) fn follow(
        &mut self,
        from: &StepState<C>,
        slopes: &[Self; STAGES],
        stage: usize,
        dt: f64,
    ) {
        match stage {
            1 => self.add_slopes::<1>(from, slopes, dt),
            2 => self.add_slopes::<2>(from, slopes, dt),
            3 => self.add_slopes::<3>(from, slopes, dt),
            4 => self.add_slopes::<4>(from, slopes, dt),
            5 => self.add_slopes::<5>(from, slopes, dt),
            _ => self.add_slopes::<6>(from, slopes, dt),
        }
    }

    fn add_slopes<const N: usize>(
        &mut self,
        from: &StepState<C>,
        slopes: &[Self; STAGES],
        dt: f64,
    ) {
        let shares = std::array::from_fn(|k| WEIGHTS[N][k] * dt);
        let fields: [_; N] = std::array::from_fn(|k| slopes[k].displacement.as_slice());
        let start = Some(from.displacement.as_slice());
        sum_slopes(&mut self.displacement, start, fields, shares);
        let mut first = 0;
        for contact in &from.contacts {
            let range = first..first + contact.states.len();
            first = range.end;
            let fields: [_; N] = std::array::from_fn(|k| &slopes[k].states[range.clone()]);
            let start = Some(contact.states.as_slice());
            sum_slopes(&mut self.states[range], start, fields, shares);
        }
    }

    /// Sets the difference of a step from the embedded method, that of displacements if they are asked for.
    pub(super) fn differ(&mut self, slopes: &[Self; STAGES], dt: f64, displacements: bool) {
        let shares = ERROR.map(|weight| weight * dt);
        if displacements {
            let fields = slopes.each_ref().map(|slope| slope.displacement.as_slice());
            sum_slopes(&mut self.displacement, None, fields, shares);
        }
        let fields = slopes.each_ref().map(|slope| slope.states.as_slice());
        sum_slopes(&mut self.states, None, fields, shares);
    }
}

/// `to = from + sum of shares times slopes`, in one pass; nothing for `from` is zero.
fn sum_slopes<T, const N: usize>(
    to: &mut [T],
    from: Option<&[T]>,
    slopes: [&[T]; N],
    shares: [f64; N],
) where
    T: Copy + Send + Sync + AddAssign + Mul<f64, Output = T>,
{
    on_shares(to, &|first, to| {
        let range = first..first + to.len();
        let slopes = slopes.map(|slope| &slope[range.clone()]);
        if let Some(from) = from {
            for (i, (to, from)) in to.iter_mut().zip(&from[range]).enumerate() {
                let mut sum = *from;
                for (slope, share) in slopes.iter().zip(shares) {
                    sum += slope[i] * share;
                }
                *to = sum;
            }
        } else {
            for (i, to) in to.iter_mut().enumerate() {
                let mut sum = slopes[0][i] * shares[0];
                for (slope, share) in slopes.iter().zip(shares).skip(1) {
                    sum += slope[i] * share;
                }
                *to = sum;
            }
        }
    });
}
