//! Normal stresses that follow the displacement by an operator.

use nalgebra::SVector;

use super::from_body::Cause;
use super::{ContactSet, DiscreteContact, FromBody};
use crate::scene::Clamping;
use crate::{SceneError, StepError, StepState};

impl<const C: usize> DiscreteContact<C> {
    /// Makes each step find the normal stress with the displacement of its end, which changes it, or with fields.
    fn follow_displacement(&mut self, changes: bool) -> Result<(), SceneError> {
        if self.body.is_some() || changes && !self.bilateral {
            return Err(SceneError::unsupported(
                SceneError::IMPLICIT,
                "Scene::with_normal_stress_change with fixed normal velocities and given normal stresses: neither \
                 Contact::with_free_normal nor NormalStress::from_body",
            ));
        }
        let count = self.part.vertices.len();
        let zeros = || vec![0.0; count];
        self.body = Some(FromBody {
            cause: Cause::Displacement,
            beside: zeros(),
            trial: zeros(),
            unrelaxed: Vec::new(),
            missing: zeros(),
        });
        Ok(())
    }

    /// Refuses a tension that does not open the contact.
    pub(crate) fn check_pressure(&self, k: usize, normal_stress: f64) -> Result<(), StepError> {
        if normal_stress < 0.0 && !self.strength.opens && self.strength.least.is_none() {
            return Err(self.tension(k, normal_stress));
        }
        Ok(())
    }

    /// The error of a tension: with fields the one of their pore pressure.
    pub(crate) fn tension(&self, k: usize, normal_stress: f64) -> StepError {
        let vertex = self.part.vertices[k];
        match &self.fields {
            None => StepError::Tension {
                vertex,
                normal_stress,
            },
            Some(fields) => StepError::PorePressure {
                vertex,
                pore_pressure: fields.pressure[k],
                normal_stress: normal_stress + fields.pressure[k],
                by_slip: fields.are_fed(),
            },
        }
    }
}

impl<const C: usize> ContactSet<C> {
    /// Lets the normal stress follow the displacement.
    pub(crate) fn clamped_by(&mut self, clamping: Option<Clamping<C>>) {
        self.clamping = clamping;
    }

    /// Makes each step find normal stresses that follow the displacement with that of its end.
    pub(crate) fn follow_displacement(&mut self) -> Result<(), SceneError> {
        let all = self.clamping.is_some();
        let mut contacts = self.contacts.iter_mut();
        let mut following = contacts
            .by_ref()
            .filter(|own| all || own.fields.is_some() && own.body.is_none());
        following.try_for_each(|contact| contact.follow_displacement(all))
    }

    /// Starts from the normal stresses of a state, where they come from the deformation, with the given ones of a time.
    pub(crate) fn take_normal_stresses(&mut self, time: f64, from: &StepState<C>) {
        if let Some(clamping) = &mut self.clamping {
            clamping.follow(time, &from.displacement);
        }
        let change = self.clamping.as_ref().map_or(&[][..], |own| &own.values);
        for (contact, from) in self.contacts.iter_mut().zip(&from.contacts) {
            contact.take_normal_stress(time, from, change);
        }
    }

    /// Finds the changes of normal stresses that follow a displacement at a time.
    pub(crate) fn follow(&mut self, time: f64, displacement: &[SVector<f64, C>]) {
        if let Some(clamping) = &mut self.clamping {
            clamping.follow(time, displacement);
        }
    }

    /// The last changes of the normal stress at each vertex of the body; none if it does not follow the displacement.
    pub(crate) fn change(&self) -> &[f64] {
        self.clamping.as_ref().map_or(&[], |own| &own.values)
    }

    /// Makes normal stresses that follow the displacement those of a state.
    pub(crate) fn renew_normal_stresses(
        &mut self,
        time: f64,
        state: &mut StepState<C>,
    ) -> Result<(), StepError> {
        if self.clamping.is_none() && !self.have_fields() {
            return Ok(());
        }
        self.hold_fields(state);
        self.take_normal_stresses(time, state);
        self.set_time(time)?;
        self.check_tension(|_| 0.0)?;
        for (contact, state) in self.contacts.iter().zip(&mut state.contacts) {
            state.normal_stress.copy_from_slice(&contact.normal_stress);
        }
        Ok(())
    }

    /// The normal stress that follows the displacement, if any.
    pub(crate) fn clamping(&self) -> Option<&Clamping<C>> {
        self.clamping.as_ref()
    }

    /// Sets the normal stresses to those of a time and a displacement.
    pub(crate) fn set_normal_stress(
        &mut self,
        time: f64,
        displacement: &[SVector<f64, C>],
    ) -> Result<(), StepError> {
        if let Some(clamping) = &mut self.clamping {
            clamping.follow(time, displacement);
        }
        self.set_time(time)
    }
}
