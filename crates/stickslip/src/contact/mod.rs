//! Contacts: where a body slides, by which laws, under which normal stress.

mod any;
pub(crate) mod check;
mod discrete_contact;
mod frictional_node;
mod laws;
mod normal_stress_effect;
mod set;
mod state_update;
mod states;
mod trial;
mod weakening;

pub(crate) use any::AnyContact;
pub(crate) use discrete_contact::DiscreteContact;
pub(crate) use laws::{StateStart, StateStep};
pub(crate) use normal_stress_effect::NormalStressEffect;
pub(crate) use set::ContactSet;
#[cfg(feature = "condensed")]
pub(crate) use set::place_normals;
pub use state_update::StateUpdate;
pub(crate) use trial::Trial;

use std::sync::Arc;

use nalgebra::SVector;
use stickslip_friction::{FrictionLaw, Nodal};
use stickslip_state::{LogScale, StateLaw};

use crate::BoundaryPart;

/// A surface on which a body slides: a part of its boundary, laws, normal stress.
///
/// The laws are static for each vertex: a friction law whose state the state law does not give does not
/// compile (see [`Reads`](crate::state::Reads)). A scene forgets their types, so that contacts of different
/// laws stand side by side; boxed laws, chosen at run time, are laws like others.
///
/// | | default | |
/// | --- | --- | --- |
/// | friction law, normal stress | | [`new`](Contact::new), [`per_vertex`](Contact::per_vertex) |
/// | state law, initial state | no state | [`with_state`](Contact::with_state) |
/// | normal velocity | zero: bilateral contact | [`with_free_normal`](Contact::with_free_normal) |
/// | normal stress in time | constant | [`with_normal_stress_history`](Contact::with_normal_stress_history) |
/// | what it does to the state | nothing | [`with_normal_stress_effect`](Contact::with_normal_stress_effect) |
/// | under tension | refused | [`allow_opening`](Contact::allow_opening) |
/// | laws at sample rates | must keep their contracts | [`unchecked`](Contact::unchecked) |
/// | cohesion, shear stress at the start | zero | [`with_cohesion`](Contact::with_cohesion), [`with_shear_stress`](Contact::with_shear_stress) |
///
/// The surface may point anywhere and be curved: the normal of a vertex is that of its part, see
/// [`BoundaryPart::with_normals`](crate::BoundaryPart::with_normals). Normals of contacts that meet within 30 degrees are one, their mean by area; others
/// make an edge or a corner, along which a vertex slides, or does not.
///
/// Where contacts meet at a vertex their tractions add, each with its own area, law and state, on the
/// velocity that is tangential to all of them. Where a contact meets a fixed or driven part, what is
/// prescribed holds, and friction acts on the components that are left; the slip rate is that of all
/// tangential components.
///
/// ```
/// use nalgebra::SMatrix;
/// use stickslip::friction::{DieterichRuina, FrictionLaw};
/// use stickslip::problems::{AGING, FRICTION};
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
/// A law that reads a state needs one:
///
/// ```compile_fail
/// # use nalgebra::SMatrix;
/// # use stickslip::problems::FRICTION;
/// # use stickslip::{Contact, BoundaryPart, Scene};
/// let scene = Scene::new(SMatrix::<f64, 1, 1>::new(1e9))
///     .with_contact(Contact::new(BoundaryPart::point(1.0), FRICTION, 1e6));
/// ```
#[doc(alias("fault", "interface"))]
pub struct Contact<L, S: StateLaw, const C: usize> {
    part: BoundaryPart,
    friction: Nodal<L>,
    evolution: Nodal<S>,
    initial: Nodal<S::State>,
    effect: Option<NormalStressEffect<S::State>>,
    strength: Strength<C>,
    bilateral: bool,
    sampled: bool,
}

/// Sets the normal stress of the vertices of a contact \[Pa\] for a time \[s\].
type StressHistory = Arc<dyn Fn(f64, &mut [f64]) + Send + Sync>;

/// What friction is multiplied with, and what is beside it.
#[derive(Clone)]
pub(crate) struct Strength<const C: usize> {
    pub(crate) normal_stress: Nodal<f64>,
    pub(crate) history: Option<StressHistory>,
    /// A tension opens the contact.
    pub(crate) opens: bool,
    pub(crate) cohesion: Nodal<f64>,
    pub(crate) shear: Option<Nodal<SVector<f64, C>>>,
}

impl<L: FrictionLaw, const C: usize> Contact<L, (), C> {
    /// Friction on `part` by one law under a normal stress \[Pa\] (one, or one a vertex), positive where it
    /// presses. A tension is refused, see [`allow_opening`](Contact::allow_opening).
    pub fn new(
        part: impl Into<BoundaryPart>,
        law: L,
        normal_stress: impl Into<Nodal<f64>>,
    ) -> Self {
        Self::with_laws(part.into(), Nodal::Uniform(law), normal_stress.into())
    }

    /// The same with a law a vertex, in the order of the part's vertices.
    pub fn per_vertex(
        part: impl Into<BoundaryPart>,
        laws: impl IntoIterator<Item = L>,
        normal_stress: impl Into<Nodal<f64>>,
    ) -> Self {
        let laws = Nodal::PerVertex(laws.into_iter().collect());
        Self::with_laws(part.into(), laws, normal_stress.into())
    }

    fn with_laws(part: BoundaryPart, friction: Nodal<L>, normal_stress: Nodal<f64>) -> Self {
        Self {
            part,
            friction,
            evolution: Nodal::Uniform(()),
            initial: Nodal::Uniform(()),
            effect: None,
            strength: Strength {
                normal_stress,
                history: None,
                opens: false,
                cohesion: Nodal::Uniform(0.0),
                shear: None,
            },
            bilateral: true,
            sampled: true,
        }
    }

    /// A state that evolves by one law from `initial` (one, or one a vertex).
    pub fn with_state<S: StateLaw>(
        self,
        law: S,
        initial: impl Into<Nodal<S::State>>,
    ) -> Contact<L, S, C> {
        self.evolving(Nodal::Uniform(law), initial.into())
    }

    /// The same with a law a vertex.
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
            strength: self.strength,
            bilateral: self.bilateral,
            sampled: self.sampled,
        }
    }
}

impl<L, S: StateLaw, const C: usize> Contact<L, S, C> {
    /// The normal velocity is free, and the normal stress is a traction on the body: contact under a
    /// prescribed normal traction.
    #[must_use]
    pub fn with_free_normal(mut self) -> Self {
        self.bilateral = false;
        self
    }

    /// Uses the laws as they are. Otherwise each is evaluated at some dozens of slip rates and states when a scene
    /// is built, and refused if it breaks its contract there:
    /// [`SceneError::Friction`](crate::SceneError::Friction), [`SceneError::State`](crate::SceneError::State).
    #[must_use]
    pub fn unchecked(mut self) -> Self {
        self.sampled = false;
        self
    }

    /// A part of the strength that no normal stress causes, and no state: the traction is
    /// `c + mu abs(sigma_n)` \[Pa\], with `c >= 0` (one, or one a vertex).
    #[must_use]
    pub fn with_cohesion(mut self, cohesion: impl Into<Nodal<f64>>) -> Self {
        self.strength.cohesion = cohesion.into();
        self
    }

    /// A normal stress that depends on time: `history` overwrites one value a vertex \[Pa\], that of
    /// [`new`](Contact::new) when it is called, for the time \[s\] given. A step into tension fails, see
    /// [`allow_opening`](Contact::allow_opening).
    #[must_use]
    pub fn with_normal_stress_history(
        mut self,
        history: impl Fn(f64, &mut [f64]) + Send + Sync + 'static,
    ) -> Self {
        self.strength.history = Some(Arc::new(history));
        self
    }

    /// The state follows the normal stress (M. Linker, J. Dieterich, J. Geophys. Res. 97 (1992)): with
    /// `kappa = zeta/b >= 0` (one, or one a vertex),
    ///
    /// ```text
    /// d(ln theta)/dt = (by the state law) - kappa sigma_n'/sigma_n
    /// ```
    ///
    /// so that a jump of the normal stress multiplies `theta` by `(sigma_n,o/sigma_n)^kappa`, and changes a
    /// coefficient that grows by `b ln theta` by `-zeta ln(sigma_n/sigma_n,o)`. It acts where the normal stress changes, see [`with_normal_stress_history`](Contact::with_normal_stress_history),
    /// and keeps the order in time of the method. The logarithm has no value for an open contact: a step that
    /// begins or ends with a normal stress of zero, and not with both, fails with
    /// [`StepError::NormalStressEffect`](crate::StepError::NormalStressEffect).
    ///
    /// ```
    /// use nalgebra::SMatrix;
    /// use stickslip::problems::FRICTION;
    /// use stickslip::state::{LogTheta, Ruina};
    /// use stickslip::{Contact, GeneralizedAlpha, BoundaryPart, Point, Scene, Simulation};
    ///
    /// let contact = Contact::new(BoundaryPart::point(1.0), FRICTION, 1e6)
    ///     .with_state(Ruina { slip_distance: 1e-5 }, LogTheta(2.0))
    ///     .with_normal_stress_history(|time, stress| stress[0] = if time > 0.0 { 2e6 } else { 1e6 })
    ///     .with_normal_stress_effect(0.3);
    /// let scene = Scene::new(SMatrix::<f64, 1, 1>::new(1e9)).with_contact(contact);
    /// let mut at_rest = Simulation::new(scene, GeneralizedAlpha::default(), Point)?;
    /// at_rest.step(1.0)?;
    /// let state = at_rest.snapshot().contact(0).state(0);
    /// assert!((state - (2.0 - 0.3 * 2f64.ln())).abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn with_normal_stress_effect(mut self, kappa: impl Into<Nodal<f64>>) -> Self
    where
        S::State: LogScale,
    {
        self.effect = Some(NormalStressEffect::new(kappa.into()));
        self
    }

    /// Where the normal stress is negative, a tension, the contact is open and transmits nothing but cohesion;
    /// without this a tension is refused. Where the normal velocity is held the surfaces stay side by side.
    #[must_use]
    pub fn allow_opening(mut self) -> Self {
        self.strength.opens = true;
        self
    }

    /// A shear stress that the body exerts on the contact from the start, all along \[Pa\] (one vector, or one
    /// a vertex): it drives slip in its direction, and where friction holds it the body is in balance
    /// without being deformed.
    #[must_use]
    pub fn with_shear_stress(mut self, shear: impl Into<Nodal<SVector<f64, C>>>) -> Self {
        self.strength.shear = Some(shear.into());
        self
    }
}
