//! A normal stress that follows that of the body with a delay.

use super::normal_stress::Source;
use super::strength::Strength;
use crate::checks::require;
use crate::{NormalStress, SceneError, StateUpdate};

impl NormalStress {
    /// Lets friction see a normal stress that approaches that of the body within a time `t*` \[s\], positive
    /// (V. Prakash, R. Clifton, 1993):
    ///
    /// ```text
    /// sigma' = (1/t* + V/L*) (sigma_body - sigma),     sigma = sigma_body at the start
    /// ```
    ///
    /// with `V/L*` by [`with_relaxation_distance`](Self::with_relaxation_distance), or without. Both together are the
    /// form `(V + V*)/L*` with `t* = L*/V*` (A. Rubin, J. Ampuero, J. Geophys. Res. 112 (2007)). Changes within `t*` are
    /// damped: the noise of an unsymmetric mesh, and the ill-posed short waves between two materials. Pressure, state and
    /// strength follow the relaxed stress ([`ContactView::normal_stress`](crate::ContactView::normal_stress));
    /// [`ContactView::body_normal_stress`](crate::ContactView::body_normal_stress) is the other one. A step integrates it
    /// exactly for constant slip rate and stress, at the means of both ends: it is of second order, as the state.
    ///
    /// A contact that may [open](crate::Contact::allow_opening) opens and closes by the stress of the body, at once. Where it
    /// is open both stresses are 0, and friction approaches that of the body from 0 once it has closed.
    ///
    /// Only a normal stress from the body relaxes: [`SceneError::Value`](crate::SceneError::Value).
    ///
    /// ```
    /// use stickslip::NormalStress;
    ///
    /// // Ten cells of 100 m at 6 km/s; and with the slip, over 0.2 m.
    /// let fault = NormalStress::from_body(120e6)
    ///     .with_relaxation_time(0.17)
    ///     .with_relaxation_distance(0.2);
    /// # let _ = fault;
    /// ```
    #[must_use]
    #[doc(alias("Prakash-Clifton", "regularization", "regularisation"))]
    pub fn with_relaxation_time(mut self, time: f64) -> Self {
        self.relaxation.time = Some(time);
        self
    }

    /// Lets friction see a normal stress that approaches that of the body within a slip of `L*` \[m\], positive, see
    /// [`with_relaxation_time`](Self::with_relaxation_time).
    #[must_use]
    pub fn with_relaxation_distance(mut self, distance: f64) -> Self {
        self.relaxation.distance = Some(distance);
        self
    }
}

/// `t*` \[s\] and `L*` \[m\] of a normal stress; without either it follows at once.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Relaxation {
    time: Option<f64>,
    distance: Option<f64>,
}

impl Relaxation {
    /// Whether the normal stress follows with a delay.
    pub(crate) fn delays(&self) -> bool {
        self.time.is_some() || self.distance.is_some()
    }

    /// `t*` and `L*`, infinite where not given.
    pub(crate) fn scales(&self) -> [f64; 2] {
        [self.time, self.distance].map(|scale| scale.unwrap_or(f64::INFINITY))
    }

    /// Refuses scales that are not positive, and a stress that does not follow the body.
    pub(crate) fn check<const C: usize>(&self, strength: &Strength<C>) -> Result<(), SceneError> {
        let scales = [
            ("relaxation time of the normal stress", self.time),
            ("relaxation distance of the normal stress", self.distance),
        ];
        let follows = strength.source != Source::Given;
        for (what, scale) in scales {
            let Some(scale) = scale else {
                continue;
            };
            let legal = scale > 0.0 && scale.is_finite();
            require(what, "positive and finite", 0, scale, legal)?;
            require(what, "of a normal stress from the body", 0, scale, follows)?;
        }
        Ok(())
    }

    /// The relaxed stress after a step of `dt` \[s\], from the relaxed one and that of the body at its start, to that of
    /// the body and by the slip rates of both ends.
    pub(crate) fn relaxed(
        &self,
        (dt, update): (f64, StateUpdate),
        [start, from]: [f64; 2],
        to: f64,
        rates: [f64; 2],
    ) -> f64 {
        let [time, distance] = self.scales();
        let steps = |rate: f64| dt * (1.0 / time + rate / distance);
        match update {
            StateUpdate::BackwardEuler => {
                let steps = steps(rates[1]);
                (start + steps * to) / (1.0 + steps)
            }
            StateUpdate::Midpoint => {
                let steps = steps(0.5 * (rates[0] + rates[1]));
                start - (0.5 * (from + to) - start) * (-steps).exp_m1()
            }
        }
    }
}
