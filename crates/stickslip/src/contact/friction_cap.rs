//! Contacts whose friction stays below a cap that falls with time.

use stickslip_friction::ForcedCap;

use super::DiscreteContact;
use super::trial::Trial;
use crate::SceneError;
use crate::checks::length;
use crate::laws::ContactLaws;
use crate::scene::Strength;

impl<const C: usize> Strength<C> {
    /// Checks the caps of so many vertices; memory for their values.
    pub(crate) fn caps(&self, count: usize) -> Result<Vec<f64>, SceneError> {
        let Some(caps) = &self.cap else {
            return Ok(Vec::new());
        };
        length("cap of friction", caps, count)?;
        caps.iter().try_for_each(ForcedCap::validate)?;
        Ok(vec![f64::INFINITY; count])
    }

    /// The cap of vertex number `k` at a time.
    pub(crate) fn cap_at(&self, time: f64, k: usize) -> f64 {
        let caps = self.cap.as_ref();
        caps.map_or(f64::INFINITY, |caps| caps.at(k).cap(time))
    }
}

impl Trial {
    /// The laws at any friction.
    pub(crate) fn without_caps(&self) -> &dyn ContactLaws {
        &*self.laws.laws
    }

    /// The largest coefficients of friction in force; empty where none are given.
    pub(crate) fn caps_mut(&mut self) -> &mut Vec<f64> {
        &mut self.laws.caps
    }
}

impl<const C: usize> DiscreteContact<C> {
    /// Sets the caps of friction to those of a time.
    pub(crate) fn set_caps(&mut self, time: f64) {
        let strength = &self.strength;
        for (k, cap) in self.trial.caps_mut().iter_mut().enumerate() {
            *cap = strength.cap_at(time, k);
        }
    }
}
