//! Contacts: frictional surfaces with their laws and normal stress.

use std::sync::Arc;

use nalgebra::SVector;
use stickslip_friction::{FrictionLaw, Nodal};
use stickslip_state::StateLaw;

use super::NormalStress;
use super::prestress::StressField;
use super::sides::Pairs;
use super::strength::{Strength, StressHistory};
use crate::fields::FaultField;
use crate::laws::NormalStressEffect;
use crate::{BoundaryPart, SceneError};

/// A frictional surface of a body: a part of its boundary, laws, normal stress.
///
/// The laws are static for each vertex: a friction law that reads another state than the state law's does not compile
/// (see [`Reads`](crate::state::Reads)). A scene erases their types, so that it holds contacts of different laws; boxed
/// laws, chosen at run time, are laws like others.
///
/// | | default | |
/// | --- | --- | --- |
/// | friction law, normal stress | | [`new`](Contact::new), [`per_vertex`](Contact::per_vertex) |
/// | state law, initial state | no state | [`with_state`](Contact::with_state) |
/// | normal velocity | zero: bilateral contact | [`with_free_normal`](Contact::with_free_normal) |
/// | normal stress in time | constant | [`with_normal_stress_history`](Contact::with_normal_stress_history) |
/// | effect of its changes on the state | none | [`with_normal_stress_effect`](Contact::with_normal_stress_effect) |
/// | weakening at a given time | none | [`with_forced_rupture`](Contact::with_forced_rupture); for any law [`with_friction_cap`](Contact::with_friction_cap) |
/// | tension | refused | [`allow_opening`](Contact::allow_opening) |
/// | laws at sample rates | must satisfy their contracts | [`unchecked`](Contact::unchecked) |
/// | cohesion, initial shear stress | zero | [`with_cohesion`](Contact::with_cohesion), [`with_shear_stress`](Contact::with_shear_stress) |
/// | pre-stress of the body | none | [`with_prestress`](Contact::with_prestress) |
/// | opposite side | a rigid surface | [`between`](Contact::between) |
/// | normal stress of the deformation | prescribed | [`NormalStress::from_body`] |
///
/// The surface has any orientation and curvature: the normal of a vertex is that of its part, see
/// [`BoundaryPart::with_normals`](crate::BoundaryPart::with_normals). Contacts whose normals differ by less than 30
/// degrees at a vertex share one normal, the mean weighted by area. Larger angles form an edge, along which a vertex
/// slides, or a corner, where it does not slide.
///
/// A quantity that is given twice is refused ([`SceneError::Repeated`]).
///
/// Where contacts meet at a vertex, their tractions add. Each has its own area, law and state; all see the velocity
/// that is tangential to all of them. Where a contact meets a fixed or driven part, Dirichlet conditions take
/// precedence, and friction acts on the remaining components. The slip rate is that of all tangential components.
///
/// ```
/// use nalgebra::SMatrix;
/// use stickslip::friction::{DieterichRuina, FrictionLaw};
/// use stickslip::problems::spring_slider::{AGING, FRICTION};
/// use stickslip::state::{LogTheta, StateLaw};
/// use stickslip::{Contact, GeneralizedAlpha, BoundaryPart, Point, Scene, Simulation, Steps};
///
/// // Laws chosen at run time.
/// type AnyFriction = Box<dyn FrictionLaw<State = LogTheta> + Send + Sync>;
/// type AnyState = Box<dyn StateLaw<State = LogTheta> + Send + Sync>;
/// let (friction, aging): (AnyFriction, AnyState) = (Box::new(FRICTION), Box::new(AGING));
///
/// let contact = Contact::new(BoundaryPart::point(1.0), friction, 1e6).with_state(aging, LogTheta(2.0));
/// let scene = Scene::new(SMatrix::<f64, 1, 1>::new(1e9))
///     .with_contact(contact)
///     .with_load_history(|time, load| load[0][0] = 1e9 * 1e-6 * time);
/// let mut simulation = Simulation::new(scene, GeneralizedAlpha::default(), Point)?;
/// simulation.run(&Steps::constant(0.1).count(10), |_| ())?;
/// assert!(simulation.snapshot().contact(0).state(0) > 2.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// A law that reads a state requires a state law:
///
/// ```compile_fail
/// # use nalgebra::SMatrix;
/// # use stickslip::problems::spring_slider::FRICTION;
/// # use stickslip::{Contact, BoundaryPart, Scene};
/// let scene = Scene::new(SMatrix::<f64, 1, 1>::new(1e9))
///     .with_contact(Contact::new(BoundaryPart::point(1.0), FRICTION, 1e6));
/// ```
#[derive(Clone)]
#[doc(alias("fault", "interface"))]
pub struct Contact<L, S: StateLaw, const C: usize> {
    pub(super) part: BoundaryPart,
    pub(super) friction: Nodal<L>,
    pub(super) evolution: Nodal<S>,
    pub(super) initial: Nodal<S::State>,
    pub(super) effect: Option<NormalStressEffect<S::State>>,
    pub(super) strength: Strength<C>,
    pub(super) bilateral: bool,
    pub(super) sampled: bool,
    pub(super) prestress: Option<StressField>,
    /// The pairs of a contact between two sides.
    pub(super) pairs: Option<Result<Pairs, SceneError>>,
    /// The first quantity that was given twice.
    pub(super) repeated: Option<&'static str>,
}

impl<L: FrictionLaw, const C: usize> Contact<L, (), C> {
    /// Friction on `part` by one law under a normal stress \[Pa\] (uniform or per vertex), positive in compression.
    /// Tension is refused, see [`allow_opening`](Contact::allow_opening).
    pub fn new(
        part: impl Into<BoundaryPart>,
        law: L,
        normal_stress: impl Into<NormalStress>,
    ) -> Self {
        Self::with_laws(part.into(), Nodal::Uniform(law), normal_stress.into())
    }

    /// Friction with one law per vertex, in the order of the part's vertices.
    pub fn per_vertex(
        part: impl Into<BoundaryPart>,
        laws: impl IntoIterator<Item = L>,
        normal_stress: impl Into<NormalStress>,
    ) -> Self {
        let laws = Nodal::PerVertex(laws.into_iter().collect());
        Self::with_laws(part.into(), laws, normal_stress.into())
    }

    pub(super) fn with_laws(
        part: BoundaryPart,
        friction: Nodal<L>,
        normal_stress: NormalStress,
    ) -> Self {
        Self {
            part,
            friction,
            evolution: Nodal::Uniform(()),
            initial: Nodal::Uniform(()),
            effect: None,
            strength: Strength {
                normal_stress: normal_stress.value,
                source: normal_stress.source,
                relaxation: normal_stress.relaxation,
                history: None,
                opens: false,
                least: None,
                largest: None,
                cohesion: Nodal::Uniform(0.0),
                shear: None,
                forced: None,
                cap: None,
                fields: Vec::new(),
            },
            bilateral: true,
            sampled: true,
            prestress: None,
            pairs: None,
            repeated: None,
        }
    }

    /// Adds a state that evolves by one law from `initial` (uniform or per vertex).
    pub fn with_state<S: StateLaw>(
        self,
        law: S,
        initial: impl Into<Nodal<S::State>>,
    ) -> Contact<L, S, C> {
        self.evolving(Nodal::Uniform(law), initial.into())
    }

    /// Adds a state with one law per vertex.
    pub fn with_state_per_vertex<S: StateLaw>(
        self,
        laws: impl IntoIterator<Item = S>,
        initial: impl Into<Nodal<S::State>>,
    ) -> Contact<L, S, C> {
        let laws = Nodal::PerVertex(laws.into_iter().collect());
        self.evolving(laws, initial.into())
    }

    fn evolving<S: StateLaw>(
        self,
        evolution: Nodal<S>,
        initial: Nodal<S::State>,
    ) -> Contact<L, S, C> {
        Contact {
            part: self.part,
            friction: self.friction,
            evolution,
            initial,
            effect: None,
            strength: Strength {
                forced: None,
                cap: None,
                ..self.strength
            },
            bilateral: self.bilateral,
            sampled: self.sampled,
            prestress: self.prestress,
            pairs: self.pairs,
            repeated: self.repeated,
        }
    }
}

impl<L, S: StateLaw, const C: usize> Contact<L, S, C> {
    /// Frees the normal velocity. The normal stress becomes a traction on the body: contact under a prescribed normal
    /// traction.
    #[must_use]
    pub fn with_free_normal(mut self) -> Self {
        self.bilateral = false;
        self
    }

    /// Skips the check of the laws. Otherwise each law is evaluated at some dozens of slip rates and states when a
    /// scene is built, and refused if it violates its contract there:
    /// [`SceneError::Friction`](crate::SceneError::Friction), [`SceneError::State`](crate::SceneError::State).
    #[must_use]
    pub fn unchecked(mut self) -> Self {
        self.sampled = false;
        self
    }

    /// Adds cohesion, the part of the strength that depends on neither normal stress nor state: the strength is `c + mu
    /// abs(sigma_n)` \[Pa\], with `c >= 0` (uniform or per vertex).
    #[must_use]
    pub fn with_cohesion(mut self, cohesion: impl Into<Nodal<f64>>) -> Self {
        self.repeat("cohesion", self.strength.cohesion != Nodal::Uniform(0.0));
        self.strength.cohesion = cohesion.into();
        self
    }

    /// Sets a time-dependent normal stress: `history` overwrites one value per vertex \[Pa\], initially that of
    /// [`new`](Contact::new), for the given time \[s\]. A step into tension fails, see
    /// [`allow_opening`](Contact::allow_opening).
    #[must_use]
    pub fn with_normal_stress_history(
        mut self,
        history: impl Fn(f64, &mut [f64]) + Send + Sync + 'static,
    ) -> Self {
        self.repeat("normal stress history", self.strength.history.is_some());
        self.strength.history = Some(StressHistory::new(history));
        self
    }

    /// Adds a field that lives on the fault and takes its pore pressure from the normal stress
    /// ([`FaultField`]): friction, and laws with a normal stress effect, see the effective normal stress. Pressures of
    /// several fields add. Pressure beyond the normal stress ends the run, unless the contact
    /// [opens](Contact::allow_opening) or keeps a [least normal stress](Contact::with_least_normal_stress); a step in which
    /// slip has raised it so far is shortened first. The contact has a given normal stress, or one
    /// that [follows the displacement](crate::Scene::with_normal_stress_change), and fixed normal velocities.
    #[must_use]
    #[doc(alias("pore pressure", "thermal pressurization", "injection"))]
    pub fn with_field(mut self, field: impl FaultField + 'static) -> Self {
        self.strength.fields.push(Arc::new(field));
        self
    }

    /// Opens the contact where the normal stress is negative, a tension: it then transmits only cohesion. Without this,
    /// tension is refused. Sides with a normal stress [from the body](crate::NormalStress::from_body) part, and close
    /// without penetration; the energy of normal motion that ends so is lost. A vertex whose normal motion a Dirichlet
    /// condition prescribes stays closed, and so does one where contacts meet, unless all of them can open along one
    /// normal: tension is refused there.
    #[must_use]
    pub fn allow_opening(mut self) -> Self {
        self.strength.opens = true;
        self
    }

    /// Sets the least normal stress that friction sees \[Pa\], above 0: where the given one less the pore pressure falls
    /// below, friction keeps it. Reports count these vertices
    /// ([`StepReport::at_least_normal_stress`](crate::integrate::StepReport::at_least_normal_stress)). The normal stress is
    /// given, or follows the displacement ([`Scene::with_normal_stress_change`](crate::Scene::with_normal_stress_change)).
    #[must_use]
    #[doc(alias("floor"))]
    pub fn with_least_normal_stress(mut self, stress: f64) -> Self {
        self.repeat("least normal stress", self.strength.least.is_some());
        self.strength.least = Some(stress);
        self
    }

    /// Sets the largest normal stress that friction sees \[Pa\], above 0 and the least one, likewise; reports count these
    /// vertices ([`StepReport::at_largest_normal_stress`](crate::integrate::StepReport::at_largest_normal_stress)).
    #[must_use]
    #[doc(alias("cap"))]
    pub fn with_largest_normal_stress(mut self, stress: f64) -> Self {
        self.repeat("largest normal stress", self.strength.largest.is_some());
        self.strength.largest = Some(stress);
        self
    }

    /// Adds an initial shear stress that the body exerts on the contact throughout \[Pa\] (one vector, or one per
    /// vertex), tangential to the surface: one with a part along the normal is refused
    /// ([`SceneError::ShearAlongNormal`]). It drives slip in its direction. Where friction balances it, the body is in
    /// equilibrium without deformation.
    #[must_use]
    pub fn with_shear_stress(mut self, shear: impl Into<Nodal<SVector<f64, C>>>) -> Self {
        self.repeat("shear stress", self.strength.shear.is_some());
        self.strength.shear = Some(shear.into());
        self
    }

    /// Records a quantity that was given before, and does not add.
    pub(super) fn repeat(&mut self, what: &'static str, given: bool) {
        if given {
            self.repeated.get_or_insert(what);
        }
    }
}
