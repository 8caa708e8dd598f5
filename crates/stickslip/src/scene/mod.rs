//! Scenes: operators, contacts, boundary conditions, loads and initial conditions.

mod any_contact;
mod check;
mod clone;
mod components;
mod contact;
mod dirichlet;
#[cfg(feature = "bie")]
mod fault_part;
mod forced_rupture;
mod initial;
mod load;
mod matrices;
mod normal_stress;
mod normal_stress_change;
mod normal_stress_effect;
mod open_walls;
mod part;
mod periodic;
#[cfg(feature = "fem")]
mod pins;
mod prescribed;
mod prestress;
mod relaxation;
mod sides;
mod strength;
mod viscosity;

#[cfg(test)]
pub(crate) use any_contact::erase;
pub(crate) use any_contact::{AnyContact, ErasedLaws};
pub(crate) use check::{check_field, check_scene, common_mesh, same_mesh};
pub(crate) use components::{NEW, components_of};
pub(crate) use initial::{Initial, or_zeros};
pub(crate) use load::{Load, Loads};
pub(crate) use matrices::Matrices;
pub(crate) use normal_stress::Source;
pub(crate) use normal_stress_change::{Clamping, NORMAL_STRESS_CHANGE};
pub(crate) use prescribed::{Prescribed, conditions_of};
pub(crate) use sides::Sides;
pub(crate) use strength::Strength;
pub(crate) use viscosity::{Lagged, first_coupled};

#[cfg(feature = "condensed")]
pub(crate) use check::check_reducible;
use check::{check_format, check_symmetry};
pub use components::Components;
pub use contact::Contact;
pub use normal_stress::NormalStress;
pub use normal_stress_change::NormalStressChange;
pub use part::{BoundaryPart, OppositeSide};

use std::sync::Arc;

use nalgebra::SVector;
use stickslip_friction::FrictionLaw;
use stickslip_solvers::{IntoOperator, MeshId, Operator, Walls};
use stickslip_state::{Reads, StateLaw};

use crate::SceneError;

/// The name of the stiffness matrix in messages.
pub(crate) const STIFFNESS: &str = "stiffness matrix";
pub(crate) const MASS: &str = "mass matrix";
pub(crate) const VISCOSITY: &str = "viscosity matrix";

/// A body with its contacts.
///
/// Pay only for what you use: without [`with_mass`](Scene::with_mass) the scene is quasi-static, and without a contact
/// with state it stores no state. Contacts, loads and viscosities add, as do fixed and driven parts. A second value of
/// a quantity that does not add is refused, and so are contradictory boundary conditions. The construction of a
/// [`Simulation`](crate::Simulation) checks everything.
///
/// | part | needed | default |
/// | --- | --- | --- |
/// | stiffness `A` | always | |
/// | space | for matrices without a known space | that of the other matrices or of the parts |
/// | mass `M` | for inertia | quasi-static |
/// | viscosity `C` | for Kelvin-Voigt or radiation damping | none |
/// | load `l` | | zero |
/// | contacts | for friction | none |
/// | fixed and driven components | | all free |
/// | periodic boundaries | | none |
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
    /// In a simulation, the summands of the viscosity, if there are several, and those that lag in explicit steps.
    pub(crate) viscosities: Vec<Op>,
    pub(crate) lagged: Option<Lagged<Op>>,
    pub(crate) loads: Vec<Load<C>>,
    pub(crate) contacts: Vec<AnyContact<C>>,
    pub(crate) prescribed: Vec<Prescribed<C>>,
    /// The two sides of each periodic boundary.
    pub(crate) periodic: Vec<[BoundaryPart; 2]>,
    pub(crate) initial: Initial<Op, C>,
    /// The normal stress that follows the displacement, if any.
    pub(crate) clamping: Option<Clamping<C>>,
    /// The body's mesh, if it is known.
    pub(crate) mesh: Option<MeshId>,
    /// The meshes on which matrices were assembled.
    pub(crate) assembled: Vec<(&'static str, MeshId)>,
    /// The walls of the surfaces along which the mesh was split.
    pub(crate) walls: Vec<Walls>,
    /// Walls of an open mesh without a contact between them are allowed.
    pub(crate) open_walls: bool,
    /// The operators are already in the local frames of their vertices.
    pub(crate) turned: bool,
    /// The first error: a matrix that is not an operator, or a repeated quantity that does not add.
    pub(crate) wrong: Option<SceneError>,
    /// The error of a stiffness matrix that is not symmetric.
    pub(crate) asymmetric: Option<SceneError>,
    /// Its symmetric part, in implicit steps.
    pub(crate) symmetric_part: Option<Op>,
}

impl<Op: Operator<C>, const C: usize> Scene<Op, C> {
    /// A body with the stiffness matrix `A` [N/m], without contacts, mass, loads or boundary conditions.
    ///
    /// A matrix of the finite element crate identifies its mesh. Parts, matrices and solvers of another mesh are
    /// refused, even of equal size.
    pub fn new(stiffness: impl IntoOperator<C, Operator = Op>) -> Self {
        let (mesh, walls) = (stiffness.mesh(), stiffness.walls());
        let stiffness = stiffness.into_operator();
        Self {
            assembled: mesh.map(|mesh| (STIFFNESS, mesh)).into_iter().collect(),
            wrong: check_format(STIFFNESS, &stiffness).err(),
            asymmetric: check_symmetry(STIFFNESS, &stiffness).err(),
            symmetric_part: None,
            stiffness,
            mass: None,
            viscosity: Vec::new(),
            viscosities: Vec::new(),
            lagged: None,
            loads: Vec::new(),
            contacts: Vec::new(),
            prescribed: Vec::new(),
            periodic: Vec::new(),
            initial: Initial::default(),
            clamping: None,
            mesh: None,
            walls,
            open_walls: false,
            turned: false,
        }
    }

    /// Sets the space of the operators, for matrices of the caller's own without a known space. Where neither they nor
    /// the scene identify one, the parts must be of one mesh, whichever it is.
    #[cfg(feature = "fem")]
    #[must_use]
    pub fn on<const D: usize>(mut self, space: &stickslip_fem::P1<D>) -> Self {
        self.repeat("space", self.mesh.is_some());
        self.mesh = Some(space.mesh().identity().into());
        let splits = space.mesh().split_surfaces();
        self.walls = splits.iter().map(Walls::from).collect();
        self
    }

    /// Adds a frictional surface; call it once for each.
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

    /// Adds inertia with the mass matrix `M` \[kg\], stored in the operator's [format of a mass](Operator::Mass): for
    /// finite elements one number per pair of vertices.
    #[must_use]
    pub fn with_mass(mut self, mass: impl IntoOperator<C, Operator = Op>) -> Self {
        self.repeat(MASS, self.mass.is_some());
        let mass = self.taken(MASS, mass);
        self.mass = mass.map(Operator::into_mass);
        self
    }

    /// Adds a force `C v` against the motion, with the viscosity matrix `C` [N s/m], symmetric and positive
    /// semidefinite: Kelvin-Voigt viscosity of the body, radiation damping, absorbing boundaries. `viscosity` and
    /// `dashpot` of the finite element crate assemble such matrices. Several of them add. Explicit steps of a lumped mass
    /// lag each that couples vertices, see [`CentralDifferences`](crate::CentralDifferences): give those one by one.
    #[must_use]
    #[doc(alias("radiation damping", "Kelvin-Voigt", "Rayleigh damping"))]
    pub fn with_viscosity(mut self, viscosity: impl IntoOperator<C, Operator = Op>) -> Self {
        let viscosity = self.taken(VISCOSITY, viscosity);
        self.viscosity.extend(viscosity);
        self
    }

    /// Adds a constant load, one vector per vertex \[N\].
    #[must_use]
    #[doc(alias = "Neumann")]
    pub fn with_load(mut self, load: Vec<SVector<f64, C>>) -> Self {
        self.loads.push(Load::Constant(load));
        self
    }

    /// Adds a time-dependent load: `history` fills one vector per vertex \[N\], initially zero, for the given time
    /// \[s\].
    #[must_use]
    #[doc(alias = "Neumann")]
    pub fn with_load_history(
        mut self,
        history: impl Fn(f64, &mut [SVector<f64, C>]) + Send + Sync + 'static,
    ) -> Self {
        self.loads.push(Load::History(Arc::new(history)));
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

    /// The viscosity matrices `C` [N s/m]; in a simulation only their sum. The simulation also stores the summands for
    /// an [`EnergyLedger`](crate::record::EnergyLedger).
    pub fn viscosity(&self) -> &[Op] {
        &self.viscosity
    }

    /// The operator of a matrix, unless it is invalid; records its mesh and its error.
    fn taken(
        &mut self,
        what: &'static str,
        matrix: impl IntoOperator<C, Operator = Op>,
    ) -> Option<Op> {
        let mesh = matrix.mesh();
        self.assembled.extend(mesh.map(|mesh| (what, mesh)));
        let operator = matrix.into_operator();
        let checked = check_format(what, &operator);
        match checked.and_then(|()| check_symmetry(what, &operator)) {
            Ok(()) => Some(operator),
            Err(error) => {
                self.wrong.get_or_insert(error);
                None
            }
        }
    }
}
