//! The state follows the normal stress: the effect that Linker and Dieterich measured.

use stickslip_friction::Nodal;
use stickslip_state::LogScale;

use super::StateUpdate;
use super::check::{finite, length, require};
use crate::SceneError;

/// A state that is to follow a normal stress which vanishes, at a vertex of the contact.
#[derive(Debug)]
pub(crate) struct Unloaded {
    pub(crate) place: usize,
    pub(crate) normal_stress: [f64; 2],
}

/// `ln theta` moves by `-kappa ln(sigma_n/sigma_n,o)`, in the part of a step that [`StateUpdate::shares`] tells.
pub(crate) struct NormalStressEffect<T> {
    kappa: Nodal<f64>,
    shifted: fn(T, f64) -> T,
    shift_slope: fn(T, f64) -> f64,
    /// By how much `ln theta` moves at the end of the present step, one number a vertex.
    after: Vec<f64>,
}

impl<T: LogScale> NormalStressEffect<T> {
    pub(super) fn new(kappa: Nodal<f64>) -> Self {
        Self {
            kappa,
            shifted: T::shifted,
            shift_slope: T::shift_slope,
            after: Vec::new(),
        }
    }
}

impl<T: Copy> NormalStressEffect<T> {
    /// Checks the exponents and takes memory.
    pub(super) fn build(&mut self, count: usize) -> Result<(), SceneError> {
        let what = "normal-stress effect";
        length(what, &self.kappa, count)?;
        for (k, &kappa) in self.kappa.iter().enumerate() {
            finite(what, k, kappa)?;
            require(what, "non-negative", k, kappa, kappa >= 0.0)?;
        }
        self.after = vec![0.0; count];
        Ok(())
    }

    /// By how much `ln theta` moves while the normal stress goes from the first value to the second.
    pub(super) fn shift(&self, place: usize, normal_stress: [f64; 2]) -> Result<f64, Unloaded> {
        let (kappa, [from, to]) = (*self.kappa.at(place), normal_stress);
        if kappa == 0.0 || from == to {
            return Ok(0.0);
        }
        if !(from > 0.0 && to > 0.0) {
            return Err(Unloaded {
                place,
                normal_stress,
            });
        }
        Ok(-kappa * (to / from).ln())
    }

    /// Begins a step; returns the state from which the law goes on.
    pub(super) fn begin(
        &mut self,
        place: usize,
        state: T,
        update: StateUpdate,
        normal_stress: [f64; 2],
    ) -> Result<T, Unloaded> {
        let shift = self.shift(place, normal_stress)?;
        let [before, after] = update.shares();
        self.after[place] = after * shift;
        Ok((self.shifted)(state, before * shift))
    }

    /// What is left for the end of the present step.
    #[inline]
    pub(super) fn after(&self, place: usize) -> Shift<T> {
        self.by(self.after[place])
    }

    pub(super) fn by(&self, by: f64) -> Shift<T> {
        Shift {
            by,
            shifted: self.shifted,
            slope: self.shift_slope,
        }
    }
}

/// A shift of `ln theta`.
#[derive(Clone, Copy)]
pub(super) struct Shift<T> {
    by: f64,
    shifted: fn(T, f64) -> T,
    slope: fn(T, f64) -> f64,
}

impl<T> Shift<T> {
    pub(super) fn of(&self, state: T) -> T {
        (self.shifted)(state, self.by)
    }

    /// The derivative of what [`of`](Self::of) returns, in `state`.
    pub(super) fn slope(&self, state: T) -> f64 {
        (self.slope)(state, self.by)
    }
}
