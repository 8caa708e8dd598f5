//! A contact on its vertices: areas, normals, normal stress in force, laws.

use nalgebra::SVector;
use stickslip_friction::{Nodal, modulus};
use stickslip_solvers::{Frames, for_contact};

use super::fields::Fields;
use super::shear::check_tangential;
use super::trial::Vanished;
use super::{FromBody, Opening, Trial};
use crate::checks::{finite, length, require};
use crate::laws::{StateStart, StateStep, change};
use crate::scene::{AnyContact, Source, Strength};
use crate::sums::largest;
use crate::{BoundaryPart, SceneError, StepError};

/// A contact of a scene in a simulation.
#[derive(Clone)]
pub(crate) struct DiscreteContact<const C: usize> {
    pub(crate) part: BoundaryPart,
    /// Laws, and the states of the step.
    pub(crate) trial: Trial,
    pub(crate) strength: Strength<C>,
    /// The normal stresses that come from the deformation.
    pub(crate) body: Option<FromBody>,
    pub(crate) fields: Option<Box<Fields>>,
    pub(crate) bilateral: bool,
    /// The positions of the vertices in increasing order, if they are not in order.
    order: Option<Vec<u32>>,
    /// Friction depends on the slip rate at constant state.
    pub(crate) reads_rate: bool,
    /// The outward normals in the local frames, zero where the surface has no normal.
    pub(crate) outward: Vec<SVector<f64, C>>,
    /// The areas that bear its reactions: of all contacts at a vertex with this normal [m^(D-1)].
    pub(crate) bearing: Vec<f64>,
    pub(crate) opening: Option<Opening>,
    /// The components in which each vertex slides: those that are normal to no contact there.
    pub(crate) slides: Vec<[bool; C]>,
    /// The normal stress in force, 0 where the contact is open \[Pa\].
    pub(crate) normal_stress: Vec<f64>,
    /// `w abs(sigma_n)` and `w c` \[N\].
    pub(crate) forces: Vec<[f64; 2]>,
    /// The slip rates of the last evaluation, if friction or the state depends on them [m/s].
    pub(crate) rates: Option<Vec<f64>>,
    /// The last two differences between the proposed states and those in use, latest last; none without a state.
    pub(crate) changes: Option<[Vec<f64>; 2]>,
}

impl<const C: usize> DiscreteContact<C> {
    /// Checks a contact and allocates its memory; `slides` is set when all contacts are known.
    pub(crate) fn new(
        contact: AnyContact<C>,
        frames: &Frames<C>,
        normals: &[Option<SVector<f64, C>>],
    ) -> Result<Self, SceneError> {
        let AnyContact {
            part,
            laws,
            mut strength,
            bilateral,
            sides: _,
        } = contact;
        let count = part.vertices.len();
        let mut trial = Trial::new(laws?);
        trial.least = strength.least_states(count)?;
        *trial.caps_mut() = strength.caps(count)?;
        length("normal stress", &strength.normal_stress, count)?;
        length("cohesion", &strength.cohesion, count)?;
        if let Some(shear) = &strength.shear {
            length("shear stress", shear, count)?;
        }
        for k in 0..count {
            let normal = *strength.normal_stress.at(k);
            finite("normal stress", k, normal)?;
            // A history has the say from the first time on.
            let legal = normal >= 0.0
                || strength.opens
                || strength.history.is_some()
                || strength.source == Source::Body;
            let requirement =
                "0 or more (compression is positive, and `allow_opening` takes tension)";
            require("normal stress", requirement, k, normal, legal)?;
            let cohesion = *strength.cohesion.at(k);
            finite("cohesion", k, cohesion)?;
            require("cohesion", "non-negative", k, cohesion, cohesion >= 0.0)?;
            if let Some(shear) = &strength.shear {
                (shear.at(k).iter()).try_for_each(|&value| finite("shear stress", k, value))?;
                check_tangential(&part, k, shear.at(k))?;
            }
        }
        let turned =
            |(&vertex, vector): (&usize, &SVector<f64, C>)| frames.to_frame(vertex, *vector);
        if let Some(shear) = strength.shear.as_mut().filter(|_| !frames.is_empty()) {
            let each: Vec<_> = (0..count).map(|k| *shear.at(k)).collect();
            *shear = Nodal::PerVertex(part.vertices.iter().zip(&each).map(turned).collect());
        }
        let outward: Vec<_> = (normals.iter())
            .map(|normal| normal.unwrap_or(SVector::zeros()))
            .collect();
        let outward: Vec<_> = part.vertices.iter().zip(&outward).map(turned).collect();
        strength.relaxation.check(&strength)?;
        strength.check_limits(bilateral)?;
        let body = match strength.source {
            Source::Given => None,
            Source::Body | Source::Change => Some(FromBody::new(&strength, bilateral, &part)?),
        };
        let fields = Fields::new(&strength.fields, count)?;
        let delays = strength.relaxation.delays();
        let opens = body.is_some() && strength.opens;
        if fields.is_some() && (delays || opens) {
            return Err(SceneError::unsupported(
                "Contact::with_field",
                "a normal stress without delay, and sides that stay together under one from the body: neither \
                 NormalStress::with_relaxation_time, nor NormalStress::from_body with Contact::allow_opening",
            ));
        }
        let normal_stress: Vec<f64> = (0..count)
            .map(|k| strength.borne(*strength.normal_stress.at(k)))
            .collect();
        let forces = (0..count).map(|k| {
            let weight = part.weights[k];
            [weight * normal_stress[k], weight * strength.cohesion.at(k)]
        });
        let order = (!part.vertices.is_sorted()).then(|| {
            let mut order: Vec<u32> = (0..count as u32).collect();
            order.sort_unstable_by_key(|&k| part.vertices[k as usize]);
            order
        });
        Ok(Self {
            order,
            reads_rate: trial.reads_rate(count),
            forces: forces.collect(),
            normal_stress,
            bearing: Vec::new(),
            opening: None,
            slides: vec![[true; C]; count],
            rates: trial.may_weaken().then(|| vec![0.0; count]),
            changes: (trial.has_state()).then(|| [vec![0.0; count], vec![0.0; count]]),
            part,
            trial,
            strength,
            outward,
            body,
            fields,
            bilateral,
        })
    }

    /// The position of a vertex of the body, if it is one of the contact.
    pub(crate) fn position_of(&self, vertex: usize) -> Option<usize> {
        let vertices = &self.part.vertices;
        let Some(order) = &self.order else {
            return vertices.binary_search(&vertex).ok();
        };
        let at = |&k: &u32| vertices[k as usize];
        let found = order.binary_search_by_key(&vertex, at).ok()?;
        Some(order[found] as usize)
    }

    /// The number of states.
    pub(crate) fn state_count(&self) -> usize {
        usize::from(self.trial.has_state()) * self.part.vertices.len()
    }

    /// The slip rate of vertex number `k` [m/s].
    #[inline]
    pub(crate) fn slip_rate(&self, k: usize, velocity: &[SVector<f64, C>]) -> f64 {
        modulus(&self.tangential(k, &velocity[self.part.vertices[k]]))
    }

    /// The memory of the slip rates with those of velocities; `None` if nothing depends on them.
    pub(super) fn rates_of(
        &mut self,
        velocity: impl Fn(usize) -> SVector<f64, C> + Sync,
    ) -> Option<Vec<f64>> {
        let mut rates = self.rates.take()?;
        for_contact(rates.len(), &mut rates[..], &|places, rates| {
            for (rate, k) in rates.iter_mut().zip(places) {
                let own = velocity(self.part.vertices[k]);
                *rate = modulus(&self.tangential(k, &own));
            }
        });
        Some(rates)
    }

    /// The largest slip rate [m/s].
    pub(crate) fn max_slip_rate(&self, velocity: &[SVector<f64, C>]) -> f64 {
        largest((0..self.part.vertices.len()).map(|k| self.slip_rate(k, velocity)))
    }

    /// The tangential components of a vector at vertex number `k`.
    #[inline]
    pub(crate) fn tangential(&self, k: usize, vector: &SVector<f64, C>) -> SVector<f64, C> {
        let slides = &self.slides[k];
        SVector::from_fn(|c, _| if slides[c] { vector[c] } else { 0.0 })
    }

    pub(crate) fn cohesion(&self, k: usize) -> f64 {
        *self.strength.cohesion.at(k)
    }

    /// Sets the normal stress to that of a time, with a change at each vertex of the body, or none.
    pub(crate) fn set_time(&mut self, time: f64, change: &[f64]) -> Result<(), StepError> {
        self.force_rupture(time);
        self.set_caps(time);
        let constant =
            self.strength.history.is_none() && change.is_empty() && self.fields.is_none();
        if constant && self.body.is_none() {
            return Ok(());
        }
        match &self.body {
            // It holds all parts.
            Some(body) => self.normal_stress.copy_from_slice(&body.trial),
            None => (self.strength).give_normal_stress(time, &mut self.normal_stress),
        }
        for k in 0..self.normal_stress.len() {
            let mut stress = self.normal_stress[k];
            if self.body.is_none() {
                if !change.is_empty() {
                    stress += change[self.part.vertices[k]];
                }
                stress -= self.pore_pressure(k);
            }
            if !stress.is_finite() {
                self.normal_stress[k] = stress;
                return Err(self.lost_stress(k, change));
            }
            // That of an iteration can be tension on the way.
            if self.body.is_none() {
                self.check_pressure(k, stress)?;
            }
            let borne = self.strength.borne(stress);
            if let Some(fields) = &mut self.fields {
                fields.excess[k] = borne - stress;
            }
            self.normal_stress[k] = borne;
            self.forces[k][0] = self.part.weights[k] * self.normal_stress[k];
        }
        Ok(())
    }

    /// The error of a state that cannot follow the normal stress from a value to that in force.
    pub(crate) fn vanished(&self, Vanished(k): Vanished, from: &[f64]) -> StepError {
        StepError::NormalStressEffect {
            vertex: self.part.vertices[k],
            from: from[k],
            to: self.normal_stress[k],
        }
    }

    /// The state at vertex number `k` after a step from `(state, rate)` to a slip rate, while the normal stress
    /// changes; none where the law has no solution.
    pub(crate) fn advanced(
        &self,
        k: usize,
        step: StateStep,
        (state, rate): (f64, f64),
        to: f64,
        normal_stress: [f64; 2],
    ) -> Option<f64> {
        let laws = self.trial.laws();
        let follows = self.trial.follows_normal_stress();
        let moved = if follows {
            change(laws, k, state, normal_stress)?
        } else {
            0.0
        };
        let [before, after] = step.update.shares();
        let from = StateStart {
            step,
            state: laws.shifted(k, state, before * moved).0,
            rate,
            stress: after * moved,
            least: f64::NEG_INFINITY,
        };
        laws.followed(k, from, to).ok().map(|at| at.state)
    }

    /// The state at vertex number `k` after a change of the normal stress, and its derivative in the old state.
    pub(crate) fn moved(
        &self,
        k: usize,
        state: f64,
        [from, to]: [f64; 2],
    ) -> Result<(f64, f64), StepError> {
        let (vertex, laws) = (self.part.vertices[k], self.trial.laws());
        let stress = change(laws, k, state, [from, to]);
        let stress = stress.ok_or(StepError::NormalStressEffect { vertex, from, to })?;
        Ok(laws.shifted(k, state, stress))
    }
}
