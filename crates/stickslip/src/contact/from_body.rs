//! The normal stresses of a contact that come from the deformation.

use nalgebra::SVector;

use super::DiscreteContact;
use crate::checks::require;
use crate::laws::StateStep;
use crate::scene::{Source, Strength};
use crate::{BoundaryPart, ContactState, SceneError, StepError};

/// The quantity of a deformation that makes a normal stress.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Cause {
    /// The reactions of fixed normal velocities.
    Reaction,
    /// The displacement, by a [`NormalStressChange`](crate::NormalStressChange).
    Displacement,
}

/// The normal stresses of a contact that come from the deformation, during a step.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FromBody {
    pub(crate) cause: Cause,
    /// The part that does not depend on the deformation \[Pa\].
    pub(crate) beside: Vec<f64>,
    /// The normal stresses in trial \[Pa\]; negative in tension.
    pub(crate) trial: Vec<f64>,
    /// The normal stresses of the body itself, which the trial follows with a delay; empty without one \[Pa\].
    pub(crate) unrelaxed: Vec<f64>,
    /// The friction that the difference to those of the deformation makes \[N\].
    pub(crate) missing: Vec<f64>,
}

impl FromBody {
    /// The given normal stresses of a part, without reactions.
    pub(crate) fn new<const C: usize>(
        strength: &Strength<C>,
        bilateral: bool,
        part: &BoundaryPart,
    ) -> Result<Self, SceneError> {
        // A process may have no vertex of the part.
        let bears = !part.normals.is_empty() && C >= part.dimension;
        if !bears && !part.vertices.is_empty() {
            return Err(SceneError::unsupported(
                "a normal stress from the body",
                "a surface with normals, and a displacement along them: neither a point nor antiplane shear has one",
            ));
        }
        let count = part.vertices.len();
        let beside: Vec<f64> = (0..count).map(|k| *strength.normal_stress.at(k)).collect();
        let legal = bilateral && strength.history.is_none();
        let first = beside.first().copied().unwrap_or_default();
        require(
            "normal stress from the body",
            "the reaction of a fixed normal velocity, without with_free_normal and with_normal_stress_history,",
            0,
            first,
            legal,
        )?;
        Ok(Self {
            cause: Cause::Reaction,
            trial: beside.clone(),
            missing: vec![0.0; count],
            unrelaxed: if strength.relaxation.delays() {
                beside.clone()
            } else {
                Vec::new()
            },
            beside,
        })
    }
}

impl<const C: usize> DiscreteContact<C> {
    /// Whether the normal stress comes from reactions of the body.
    pub(crate) fn reacts(&self) -> bool {
        (self.body.as_ref()).is_some_and(|body| body.cause == Cause::Reaction)
    }

    /// Puts the normal stresses in trial in force, if they come from the body.
    pub(crate) fn use_trial_stress(&mut self) {
        let trial = self.body.iter().flat_map(|body| &body.trial);
        for (k, stress) in trial.enumerate() {
            let borne = self.strength.borne(*stress);
            if let Some(fields) = &mut self.fields {
                fields.excess[k] = borne - stress;
            }
            self.normal_stress[k] = borne;
            self.forces[k][0] = self.part.weights[k] * self.normal_stress[k];
        }
    }

    /// Refuses tension in the normal stress of the deformation, as friction sees it, beyond the rounding of forces at a
    /// vertex \[N\] and where the contact does not open. Beside a tip it is zero instead: there the stress depends on the
    /// mesh.
    pub(crate) fn check_tension(&self, rounding: impl Fn(usize) -> f64) -> Result<(), StepError> {
        let trial = self.body.iter().flat_map(|body| &body.trial);
        for (k, &normal_stress) in trial.enumerate() {
            if !self.reacts() {
                self.check_pressure(k, normal_stress)?;
                continue;
            }
            let side = self.part.opposite.as_ref();
            let beside_tip = side.is_some_and(|side| side.beside_tip[k]);
            // One without a normal has no side to part from.
            let opens = self.strength.opens
                && (self.opening_axis(k).is_some()
                    || self.outward[k] == SVector::<f64, C>::zeros());
            if normal_stress < 0.0
                && !opens
                && !beside_tip
                && -normal_stress * self.bearing[k] > rounding(self.part.vertices[k])
            {
                return Err(self.tension(k, normal_stress));
            }
        }
        Ok(())
    }

    /// The normal stress in trial that follows from that of the body at the end of a step.
    pub(crate) fn relax_stress(
        &self,
        k: usize,
        step: StateStep,
        from: &ContactState<C>,
        to: f64,
        rates: [f64; 2],
    ) -> f64 {
        let Some((&start, &body)) = from.relaxed_stress.get(k).zip(from.body_stress.get(k)) else {
            return to;
        };
        let relaxation = &self.strength.relaxation;
        relaxation.relaxed((step.dt, step.update), [start, body], to, rates)
    }

    /// Starts from the normal stress of a step, if it comes from the deformation: where it follows the displacement, from
    /// the given one of a time with the change at each vertex of the body.
    pub(crate) fn take_normal_stress(&mut self, time: f64, from: &ContactState<C>, change: &[f64]) {
        let Some(body) = &mut self.body else {
            return;
        };
        if body.cause == Cause::Reaction {
            body.trial.copy_from_slice(&from.normal_stress);
            if let Some(fields) = &self.fields {
                // The total one of the step, less the pressure in force.
                for (k, trial) in body.trial.iter_mut().enumerate() {
                    let total = *trial + from.pore_pressure[k] - from.excess_pressure[k];
                    *trial = total - fields.pressure[k];
                }
            }
            return;
        }
        self.strength.give_normal_stress(time, &mut body.beside);
        let places = body.beside.iter().zip(&self.part.vertices);
        for (trial, (beside, &vertex)) in body.trial.iter_mut().zip(places) {
            *trial = beside + change.get(vertex).copied().unwrap_or_default();
        }
        let pressures = self.fields.iter().flat_map(|fields| &fields.pressure);
        for (trial, pressure) in body.trial.iter_mut().zip(pressures) {
            *trial -= pressure;
        }
    }

    /// The normal stress by the forces on the fixed normal components, those in balance with reactions \[Pa\]; beside
    /// what is given.
    pub(crate) fn reaction(&self, k: usize, unbalanced: &SVector<f64, C>) -> f64 {
        // The outward normal is along one component of a bilateral contact.
        let along: f64 = (0..C)
            .filter(|&c| !self.slides[k][c])
            .map(|c| self.outward[k][c] * unbalanced[c])
            .sum();
        // A copy whose share another one has, where faults meet, has no normal stress of its own.
        let has_area = self.part.weights[k] > 0.0;
        if has_area {
            along / self.bearing[k]
        } else {
            0.0
        }
    }

    /// Puts the normal stresses in force that balance these forces. `stays_closed` says of a vertex that can open, in
    /// tension or not, whether it is closed then: open, it has none. Returns the largest change of a normal force \[N\].
    pub(crate) fn react_to(
        &mut self,
        mut unbalanced: impl FnMut(usize) -> SVector<f64, C>,
        mut stays_closed: impl FnMut(usize, bool) -> bool,
    ) -> f64 {
        let Some(mut body) = self.body.take() else {
            return 0.0;
        };
        let delays = !body.unrelaxed.is_empty();
        let mut change = 0.0_f64;
        for (k, &vertex) in self.part.vertices.iter().enumerate() {
            let stress =
                body.beside[k] + self.reaction(k, &unbalanced(vertex)) - self.pore_pressure(k);
            let open = self.opening_axis(k).is_some() && !stays_closed(vertex, stress < 0.0);
            let stress = if open { 0.0 } else { stress };
            if delays {
                body.unrelaxed[k] = stress;
            }
            // Friction with a delay keeps its own while the sides touch.
            if open || !delays {
                body.trial[k] = stress;
            }
            let force = self.part.weights[k] * body.trial[k].max(0.0);
            change = change.max((force - self.forces[k][0]).abs());
        }
        self.body = Some(body);
        self.use_trial_stress();
        change
    }

    /// Makes the reactions of the start part of the given normal stress, if that is the one at the start, and sets the
    /// normal stress to that of the start.
    pub(crate) fn start_from_body(&mut self, unbalanced: &[SVector<f64, C>]) {
        let reactions: Vec<f64> = (0..unbalanced.len())
            .map(|k| self.reaction(k, &unbalanced[k]))
            .collect();
        let holds = self.strength.source == Source::Change;
        if let Some(body) = &mut self.body {
            for (k, reaction) in reactions.into_iter().enumerate() {
                if holds {
                    body.beside[k] -= reaction;
                }
                let pressure = (self.fields.as_ref()).map_or(0.0, |own| own.pressure[k]);
                body.trial[k] = body.beside[k] + reaction - pressure;
            }
        }
    }
}
