//! The Linker-Dieterich effect: the dependence of the state on changes of the normal stress.

use stickslip_friction::Nodal;
use stickslip_state::LogScale;

use super::places::Places;
use crate::SceneError;
use crate::checks::{finite, length, require};

/// `ln theta` moves by `-kappa ln(sigma_n/sigma_n,o)`.
#[derive(Clone)]
pub(crate) struct NormalStressEffect<T> {
    kappa: Nodal<f64>,
    shifted: fn(T, f64) -> T,
    shift_slope: fn(T, f64) -> f64,
}

impl<T: LogScale> NormalStressEffect<T> {
    pub(crate) fn new(kappa: Nodal<f64>) -> Self {
        Self {
            kappa,
            shifted: T::shifted,
            shift_slope: T::shift_slope,
        }
    }
}

impl<T: Copy> NormalStressEffect<T> {
    /// Checks the exponents.
    pub(crate) fn check(&self, count: usize) -> Result<(), SceneError> {
        let what = "normal-stress effect";
        length(what, &self.kappa, count)?;
        for (k, &kappa) in self.kappa.iter().enumerate() {
            finite(what, k, kappa)?;
            require(what, "non-negative", k, kappa, kappa >= 0.0)?;
        }
        Ok(())
    }

    /// The effect at some of the vertices.
    pub(crate) fn at(self, places: &Places) -> Result<Self, SceneError> {
        Ok(Self {
            kappa: places.select("normal-stress effect", self.kappa)?,
            ..self
        })
    }

    /// The state after a change of the normal stress, given by its logarithm, and its derivative in the old state.
    #[inline]
    pub(crate) fn shifted(&self, k: usize, state: T, stress: f64) -> (T, f64) {
        let kappa = *self.kappa.at(k);
        if kappa == 0.0 || stress == 0.0 {
            return (state, 1.0);
        }
        let by = -kappa * stress;
        ((self.shifted)(state, by), (self.shift_slope)(state, by))
    }
}
