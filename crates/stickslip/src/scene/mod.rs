//! What is simulated: operators, contacts, boundary data, loads, the state of motion at the start.

mod axes;
mod check;
mod clone;
mod coincident;
mod components;
mod constraints;
mod equilibrium;
mod error;
mod initial;
mod load;
mod matrices;
mod part;
mod start;
mod turn;

pub(crate) use axes::{Axes, components_of};
use check::check_matrix;
pub(crate) use check::{check_field, check_scene, common_mesh, same_mesh};
pub(crate) use coincident::check_walls;
pub use components::Components;
pub use constraints::BoundaryCondition;
pub(crate) use constraints::{Constraints, Prescribed};
pub(crate) use equilibrium::equilibrium;
pub use error::SceneError;
pub(crate) use initial::{Initial, or_zeros};
pub(crate) use load::{Load, Loads};
pub(crate) use matrices::Matrices;
pub use part::BoundaryPart;
pub(crate) use start::balance_rates;

use std::sync::Arc;

use nalgebra::SVector;
use stickslip_friction::FrictionLaw;
use stickslip_solvers::{IntoOperator, Operator};
use stickslip_state::{Reads, StateLaw};

use crate::Contact;
use crate::contact::AnyContact;

/// What messages call the matrices.
const STIFFNESS: &str = "stiffness matrix";
const MASS: &str = "mass matrix";
const VISCOSITY: &str = "viscosity matrix";

/// A body with its contacts.
///
/// Built step by step; what is left out is neither stored nor computed: without
/// [`with_mass`](Scene::with_mass) the scene is quasi-static, without a contact that has a state it holds no
/// state. Contacts, loads and viscosities add, as do fixed and driven parts; what is given twice and cannot be
/// added is refused, as is what contradicts itself. Everything is checked when a
/// [`Simulation`](crate::Simulation) is made of it.
///
/// | part | needed | default |
/// | --- | --- | --- |
/// | stiffness `A` | always | |
/// | space | of matrices that do not know theirs | that of the matrices that know one, or of the parts |
/// | mass `M` | for inertia | quasi-static |
/// | viscosity `C` | for Kelvin-Voigt or radiation damping | none |
/// | load `l` | | zero |
/// | contacts | for friction | none |
/// | fixed and driven components | | all free |
/// | initial `u`, `v`, time | | zero |
/// | initial `a` | | consistent: in balance with the forces |
///
/// ```
/// use nalgebra::SMatrix;
/// use stickslip::friction::Tresca;
/// use stickslip::{Contact, GeneralizedAlpha, BoundaryPart, Point, Scene, Simulation, Steps};
///
/// // A block of 1 m^2 on a spring of 1 MN/m that is pulled at 1 mm/s: Coulomb's stick and slide.
/// let (stiffness, load_velocity) = (1e6, 1e-3);
/// let scene = Scene::new(SMatrix::<f64, 1, 1>::new(stiffness))
///     .with_contact(Contact::new(BoundaryPart::point(1.0), Tresca { coefficient: 0.6 }, 1e5))
///     .with_load_history(move |time, load| load[0][0] = stiffness * load_velocity * time);
/// let mut simulation = Simulation::new(scene, GeneralizedAlpha::default(), Point)?;
/// simulation.run(&Steps::constant(1.0).count(100), |_| ())?;
/// let slid = simulation.snapshot().displacement[0][0];
/// assert!((slid - (100.0 * load_velocity - 0.6 * 1e5 / stiffness)).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Scene<Op: Operator<C>, const C: usize> {
    pub(crate) stiffness: Op,
    pub(crate) mass: Option<Op::Mass>,
    pub(crate) viscosity: Vec<Op>,
    /// Of a simulation, those whose sum is the viscosity, if there are several.
    pub(crate) viscosities: Vec<Op>,
    pub(crate) loads: Vec<Load<C>>,
    pub(crate) contacts: Vec<AnyContact<C>>,
    pub(crate) prescribed: Vec<Prescribed<C>>,
    pub(crate) initial: Initial<Op, C>,
    /// The fingerprint of the body's mesh, if it is known.
    pub(crate) mesh: Option<u64>,
    /// The meshes on which matrices were assembled.
    pub(crate) assembled: Vec<(&'static str, u64)>,
    /// Contacts may lie on both walls of an open mesh.
    pub(crate) open_walls: bool,
    /// The operators are in the frames of their vertices already.
    pub(crate) turned: bool,
    /// What was wrong first: a matrix that is no operator, or something given twice that cannot be added.
    pub(crate) wrong: Option<SceneError>,
}

impl<Op: Operator<C>, const C: usize> Scene<Op, C> {
    /// A body with the stiffness matrix `A` [N/m]; no contact, mass, load or support yet.
    ///
    /// A matrix of the finite element crate knows the mesh it was assembled on: whatever belongs to another one, of
    /// equal size even, is refused, be it a part, a matrix or a solver.
    pub fn new(stiffness: impl IntoOperator<C, Operator = Op>) -> Self {
        let mesh = stiffness.mesh();
        let stiffness = stiffness.into_operator();
        Self {
            assembled: mesh.map(|mesh| (STIFFNESS, mesh)).into_iter().collect(),
            wrong: check_matrix(STIFFNESS, &stiffness).err(),
            stiffness,
            mass: None,
            viscosity: Vec::new(),
            viscosities: Vec::new(),
            loads: Vec::new(),
            contacts: Vec::new(),
            prescribed: Vec::new(),
            initial: Initial::default(),
            mesh: None,
            open_walls: false,
            turned: false,
        }
    }

    /// The space from which the operators are, for matrices of one's own, which do not know it. Where neither they nor
    /// the scene know, the parts must be of one mesh, whichever it is.
    #[cfg(feature = "fem")]
    #[must_use]
    pub fn on<const D: usize>(mut self, space: &stickslip_fem::P1<D>) -> Self {
        self.repeat("space", self.mesh.is_some());
        self.mesh = Some(space.mesh().fingerprint());
        self
    }

    /// Lets contacts have two vertices at one place, which is refused otherwise
    /// ([`SceneError::Coincident`]): on the two walls of a mesh that is open there. Each wall slides on a rigid surface of
    /// its own, without regard to the other one.
    #[must_use]
    pub fn with_open_walls(mut self) -> Self {
        self.open_walls = true;
        self
    }

    /// A surface on which the body slides; call it once for each.
    #[must_use]
    pub fn with_contact<L, S>(mut self, contact: Contact<L, S, C>) -> Self
    where
        L: FrictionLaw + 'static,
        S: StateLaw + 'static,
        L::State: Reads<S::State>,
    {
        self.contacts.push(contact.into());
        self
    }

    /// Inertia with the mass matrix `M` \[kg\], which is kept in the operator's [format of a mass](Operator::Mass): of finite
    /// elements one number a pair of vertices.
    #[must_use]
    pub fn with_mass(mut self, mass: impl IntoOperator<C, Operator = Op>) -> Self {
        self.repeat(MASS, self.mass.is_some());
        let mass = self.taken(MASS, mass);
        self.mass = mass.map(Operator::into_mass);
        self
    }

    /// A force `C v` against the motion, with the viscosity matrix `C` [N s/m], symmetric and
    /// positive semidefinite: Kelvin-Voigt viscosity of the body, radiation damping, absorbing boundaries, as
    /// `viscosity` and `dashpot` of the finite element crate assemble them. Several of them add.
    #[must_use]
    #[doc(alias("radiation damping", "Kelvin-Voigt", "Rayleigh damping"))]
    pub fn with_viscosity(mut self, viscosity: impl IntoOperator<C, Operator = Op>) -> Self {
        let viscosity = self.taken(VISCOSITY, viscosity);
        self.viscosity.extend(viscosity);
        self
    }

    /// A constant load, one vector a vertex \[N\], beside those that are there.
    #[must_use]
    #[doc(alias = "Neumann")]
    pub fn with_load(mut self, load: Vec<SVector<f64, C>>) -> Self {
        self.loads.push(Load::Constant(load));
        self
    }

    /// A load that depends on time, beside those that are there: `history` fills one vector a vertex \[N\],
    /// all zero when it is called, for the time \[s\] given.
    #[must_use]
    #[doc(alias = "Neumann")]
    pub fn with_load_history(
        mut self,
        history: impl Fn(f64, &mut [SVector<f64, C>]) + Send + Sync + 'static,
    ) -> Self {
        self.loads.push(Load::History(Arc::new(history)));
        self
    }

    /// Keeps the marked components of the velocity at zero on `part`.
    #[must_use]
    #[doc(alias("Dirichlet", "clamp"))]
    pub fn fix(
        mut self,
        part: impl Into<BoundaryPart>,
        components: impl Into<Components<C>>,
    ) -> Self {
        self.prescribed.push(Prescribed {
            part: part.into(),
            components: components.into().0,
            velocity: None,
            turned: Vec::new(),
        });
        self
    }

    /// Prescribes the marked components of the velocity [m/s] on `part` as a function of time \[s\].
    #[must_use]
    #[doc(alias("Dirichlet", "driven boundary"))]
    pub fn prescribe_velocity(
        mut self,
        part: impl Into<BoundaryPart>,
        components: impl Into<Components<C>>,
        velocity: impl Fn(f64) -> [f64; C] + Send + Sync + 'static,
    ) -> Self {
        self.prescribed.push(Prescribed {
            part: part.into(),
            components: components.into().0,
            velocity: Some(Arc::new(velocity)),
            turned: Vec::new(),
        });
        self
    }

    /// The stiffness matrix `A` [N/m].
    pub fn stiffness(&self) -> &Op {
        &self.stiffness
    }

    /// The mass matrix `M` \[kg\], if there is inertia.
    pub fn mass(&self) -> Option<&Op::Mass> {
        self.mass.as_ref()
    }

    /// The viscosity matrices `C` [N s/m]; in a simulation their sum alone, beside which it keeps them for an
    /// [`EnergyLedger`](crate::record::EnergyLedger).
    pub fn viscosity(&self) -> &[Op] {
        &self.viscosity
    }

    /// Whether the scene has inertia or damping, with which a step that is short enough has a single solution.
    pub(crate) fn is_resisted(&self) -> bool {
        self.mass.is_some() || !self.viscosity.is_empty()
    }

    /// The operator of a matrix, unless it is none; its mesh and what is wrong with it are kept in mind.
    fn taken(
        &mut self,
        what: &'static str,
        matrix: impl IntoOperator<C, Operator = Op>,
    ) -> Option<Op> {
        let mesh = matrix.mesh();
        self.assembled.extend(mesh.map(|mesh| (what, mesh)));
        let operator = matrix.into_operator();
        match check_matrix(what, &operator) {
            Ok(()) => Some(operator),
            Err(error) => {
                self.wrong.get_or_insert(error);
                None
            }
        }
    }

    pub(super) fn repeat(&mut self, what: &'static str, given: bool) {
        if given {
            self.wrong.get_or_insert(SceneError::Repeated { what });
        }
    }
}
