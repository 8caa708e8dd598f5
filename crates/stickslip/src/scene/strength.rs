//! What the strength of a contact depends on beside its laws.

use std::sync::Arc;

use nalgebra::SVector;
use stickslip_friction::{ForcedCap, ForcedRupture, Nodal};

use super::normal_stress::Source;
use super::relaxation::Relaxation;
use crate::SceneError;
use crate::checks::require;
use crate::fields::FaultField;
use crate::laws::Places;

/// Sets values of all vertices for a time.
type Values = dyn Fn(f64, &mut [f64]) + Send + Sync;

/// The normal stress of a contact in time, of some of the vertices that it is given for.
#[derive(Clone)]
pub(crate) struct StressHistory {
    function: Arc<Values>,
    /// All of them, if `None`.
    places: Option<Places>,
    /// The values of all vertices where some are left out.
    all: Vec<f64>,
}

impl StressHistory {
    /// `function(t, stress)` sets the normal stress of all vertices \[Pa\] for a time \[s\].
    pub(crate) fn new(function: impl Fn(f64, &mut [f64]) + Send + Sync + 'static) -> Self {
        Self {
            function: Arc::new(function),
            places: None,
            all: Vec::new(),
        }
    }

    /// The history of the vertices at places among those of this one.
    pub(crate) fn at(self, places: &Places) -> Self {
        let places = match &self.places {
            None => places.clone(),
            Some(earlier) => earlier.at(places),
        };
        Self {
            all: vec![0.0; places.count],
            places: Some(places),
            ..self
        }
    }

    /// Sets the normal stress for a time.
    pub(crate) fn set(&mut self, time: f64, stress: &mut [f64]) {
        let Some(Places { places, .. }) = &self.places else {
            return (self.function)(time, stress);
        };
        // What the function finds does not depend on earlier times.
        self.all.fill(0.0);
        for (&k, value) in places.iter().zip(stress.iter()) {
            self.all[k] = *value;
        }
        (self.function)(time, &mut self.all);
        for (&k, value) in places.iter().zip(stress) {
            *value = self.all[k];
        }
    }
}

/// The normal stress and the other tractions of a contact.
#[derive(Clone)]
pub(crate) struct Strength<const C: usize> {
    pub(crate) normal_stress: Nodal<f64>,
    pub(crate) source: Source,
    pub(crate) relaxation: Relaxation,
    pub(crate) history: Option<StressHistory>,
    /// A tension opens the contact.
    pub(crate) opens: bool,
    /// The least normal stress that friction sees \[Pa\]; none by default.
    pub(crate) least: Option<f64>,
    /// The largest normal stress that friction sees \[Pa\]; none by default.
    pub(crate) largest: Option<f64>,
    pub(crate) cohesion: Nodal<f64>,
    pub(crate) shear: Option<Nodal<SVector<f64, C>>>,
    /// Forced rupture, which weakens friction beside its state.
    pub(crate) forced: Option<Nodal<ForcedRupture>>,
    /// A cap of friction.
    pub(crate) cap: Option<Nodal<ForcedCap>>,
    /// Fields on the fault, which take their pressure from the normal stress.
    pub(crate) fields: Vec<Arc<dyn FaultField>>,
}

impl<const C: usize> Strength<C> {
    /// Writes the given normal stress of a time, negative in tension \[Pa\].
    pub(crate) fn give_normal_stress(&mut self, time: f64, stresses: &mut [f64]) {
        for (k, stress) in stresses.iter_mut().enumerate() {
            *stress = *self.normal_stress.at(k);
        }
        if let Some(history) = &mut self.history {
            history.set(time, stresses);
        }
    }

    /// The normal stress that friction sees of one that is negative in tension \[Pa\].
    #[inline]
    pub(crate) fn borne(&self, stress: f64) -> f64 {
        let least = stress.max(self.least.unwrap_or(0.0));
        least.min(self.largest.unwrap_or(f64::INFINITY))
    }

    /// Refuses limits of the normal stress that are out of range, and limits of one that the body exerts.
    pub(crate) fn check_limits(&self, bilateral: bool) -> Result<(), SceneError> {
        let requirement = "above 0 and finite; allow_opening takes 0";
        let above = self.least.unwrap_or(0.0);
        for (what, option, limit, least, requirement) in [
            (
                "least normal stress",
                "Contact::with_least_normal_stress",
                self.least,
                0.0,
                requirement,
            ),
            (
                "largest normal stress",
                "Contact::with_largest_normal_stress",
                self.largest,
                above,
                "finite, and above 0 and the least normal stress",
            ),
        ] {
            let Some(limit) = limit else { continue };
            require(
                what,
                requirement,
                0,
                limit,
                limit > least && limit.is_finite(),
            )?;
            if self.source != Source::Given || !bilateral {
                return Err(SceneError::unsupported(
                    option,
                    "a given normal stress and fixed normal velocities: neither NormalStress::from_body nor \
                     Contact::with_free_normal",
                ));
            }
        }
        Ok(())
    }
}
