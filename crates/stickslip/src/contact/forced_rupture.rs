//! Contacts whose friction weakens by the larger of slip and time.

use stickslip_friction::{ForcedRupture, Response};

use super::DiscreteContact;
use crate::SceneError;
use crate::checks::length;
use crate::laws::at_least;
use crate::scene::Strength;

impl<const C: usize> Strength<C> {
    /// Checks the forced ruptures of so many vertices; memory for the least states that they give.
    pub(crate) fn least_states(&self, count: usize) -> Result<Vec<f64>, SceneError> {
        let Some(forced) = &self.forced else {
            return Ok(Vec::new());
        };
        length("forced rupture", forced, count)?;
        forced.iter().try_for_each(ForcedRupture::validate)?;
        Ok(vec![f64::NEG_INFINITY; count])
    }
}

impl<const C: usize> DiscreteContact<C> {
    /// Sets the least states that friction reads to those of a time.
    pub(crate) fn force_rupture(&mut self, time: f64) {
        let Some(forced) = &self.strength.forced else {
            return;
        };
        for (k, least) in self.trial.least.iter_mut().enumerate() {
            *least = forced.at(k).weakening(time).0;
        }
    }

    /// `mu(V, alpha)` at vertex number `k` and a time, and its slopes.
    pub(crate) fn response_at(&self, time: f64, k: usize, slip_rate: f64, state: f64) -> Response {
        let forced = self.strength.forced.as_ref();
        let least = forced.map_or(f64::NEG_INFINITY, |own| own.at(k).weakening(time).0);
        let (read, slope) = at_least(state, least);
        let mut response = self.trial.without_caps().response(k, slip_rate, read);
        response.state_slope *= slope;
        response.capped(self.strength.cap_at(time, k))
    }
}
