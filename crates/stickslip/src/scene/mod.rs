//! Scenes: operators, contacts, boundary conditions, loads and initial conditions.

mod any_contact;
mod check;
mod clamping;
mod clone;
mod components;
mod conditions;
mod contact;
mod dirichlet;
#[cfg(feature = "bie")]
mod fault_part;
mod forced_rupture;
mod friction_cap;
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

#[cfg(test)]
pub(crate) use any_contact::erase;
pub(crate) use any_contact::{AnyContact, ErasedLaws};
pub(crate) use check::{check_conditions, check_field, check_matrices, common_mesh, same_mesh};
pub(crate) use clamping::{Clamping, NORMAL_STRESS_CHANGE};
pub(crate) use components::{NEW, components_of};
pub(crate) use conditions::Conditions;
pub(crate) use initial::{Initial, or_zeros};
pub(crate) use load::{Load, Loads};
pub(crate) use normal_stress::Source;
pub(crate) use prescribed::{Prescribed, conditions_of};
pub(crate) use sides::Sides;
pub(crate) use strength::Strength;

#[cfg(feature = "condensed")]
pub(crate) use check::check_reducible;
use check::{check_format, check_symmetry};
pub use components::Components;
pub use contact::Contact;
pub use normal_stress::NormalStress;
pub use part::{BoundaryPart, OppositeSide};

use std::sync::Arc;

use nalgebra::SVector;
use stickslip_friction::FrictionLaw;
use stickslip_solvers::{IntoOperator, LinearSolver, Operator};
use stickslip_state::{Reads, StateLaw};

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
    /// The solver for the static equilibrium, if the scene starts from it.
    pub(crate) equilibrium: Option<Box<dyn LinearSolver<Op, C>>>,
    pub(crate) conditions: Conditions<C>,
}

impl<Op: Operator<C>, const C: usize> Scene<Op, C> {
    /// A body with the stiffness matrix `A` [N/m], without contacts, mass, loads or boundary conditions.
    ///
    /// A matrix of the finite element crate identifies its mesh. Parts, matrices and solvers of another mesh are
    /// refused, even of equal size.
    ///
    /// A matrix of one's own enters here, too, and takes any solver for its format; explicit steps by
    /// [`RungeKutta`](crate::RungeKutta) take every one. A row of blocks, coupled by springs:
    ///
    /// ```
    /// use stickslip::friction::RegularizedDieterichRuina;
    /// use stickslip::nalgebra::{Matrix1, Vector1};
    /// use stickslip::problems::spring_slider::{AGING, FRICTION};
    /// use stickslip::state::LogTheta;
    /// use stickslip::{BoundaryPart, Contact, Matrix, Operator, RungeKutta, Scene, Steps};
    ///
    /// struct Row {
    ///     diagonal: Vec<f64>,
    ///     coupling: f64,
    /// }
    ///
    /// impl Matrix<1> for Row {
    ///     fn vertex_count(&self) -> usize {
    ///         self.diagonal.len()
    ///     }
    ///
    ///     fn product_at(&self, i: usize, x: &[Vector1<f64>]) -> Vector1<f64> {
    ///         let neighbours = [i.checked_sub(1), Some(i + 1)].into_iter().flatten();
    ///         let beside: Vector1<f64> = neighbours.filter_map(|j| x.get(j)).sum();
    ///         x[i] * self.diagonal[i] + beside * self.coupling
    ///     }
    ///
    ///     fn diagonal_block(&self, i: usize) -> Matrix1<f64> {
    ///         Matrix1::new(self.diagonal[i])
    ///     }
    /// }
    ///
    /// impl Operator<1> for Row {
    ///     type Mass = Self;
    ///
    ///     fn into_mass(self) -> Self {
    ///         self
    ///     }
    ///
    ///     fn combination_with(terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) -> Self {
    ///         let size = terms.iter().copied().chain(mass).map(|(_, term)| term.diagonal.len()).max();
    ///         let mut sum = Row { diagonal: vec![0.0; size.unwrap_or(0)], coupling: 0.0 };
    ///         sum.set_combination_with(terms, mass);
    ///         sum
    ///     }
    ///
    ///     fn set_combination_with(&mut self, terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) {
    ///         let terms = || terms.iter().copied().chain(mass);
    ///         self.coupling = terms().map(|(factor, term)| factor * term.coupling).sum();
    ///         for (i, diagonal) in self.diagonal.iter_mut().enumerate() {
    ///             *diagonal = terms().map(|(factor, term)| factor * term.diagonal[i]).sum();
    ///         }
    ///     }
    ///
    ///     fn add_to_diagonal(&mut self, i: usize, block: &Matrix1<f64>) {
    ///         self.diagonal[i] += block[0];
    ///     }
    /// }
    ///
    /// // Ten blocks of 1 m^2, each on a spring that is pulled at 1 um/s, and with springs to its neighbours.
    /// let (own, between, velocity) = (2e9, 5e8, 1e-6);
    /// let neighbours = |i: usize| if i == 0 || i == 9 { 1.0 } else { 2.0 };
    /// let stiffness = (0..10).map(|i| own + neighbours(i) * between).collect();
    /// let blocks = BoundaryPart {
    ///     vertices: (0..10).collect(),
    ///     weights: vec![1.0; 10],
    ///     ..BoundaryPart::point(1.0)
    /// };
    /// let scene = Scene::new(Row { diagonal: stiffness, coupling: -between })
    ///     .with_viscosity(Row { diagonal: vec![5e6; 10], coupling: 0.0 })
    ///     .with_contact(
    ///         Contact::new(blocks, RegularizedDieterichRuina::from(FRICTION), 1e6)
    ///             .with_state(AGING, LogTheta(0.0)),
    ///     )
    ///     .with_load_history(move |time, load| load.fill(Vector1::new(own * velocity * time)));
    /// let mut row = RungeKutta::new(scene)?;
    /// row.run(&Steps::adaptive(1e-6).until(3600.0), |_| ())?;
    /// // In the end all slide as they are pulled.
    /// let rates = row.snapshot().velocity;
    /// assert!(rates.iter().all(|rate| (rate[0] / velocity - 1.0).abs() < 1e-3), "{rates:?}");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(stiffness: impl IntoOperator<C, Operator = Op>) -> Self {
        // What computes is compiled for these numbers.
        const {
            assert!(
                C == 1 || C == 2 || C == 3,
                "scenes have one, two or three components"
            )
        };
        let (mesh, walls) = (stiffness.mesh(), stiffness.walls());
        let stiffness = stiffness.into_operator();
        let wrong = check_format(STIFFNESS, &stiffness).err();
        let asymmetric = check_symmetry(STIFFNESS, &stiffness).err();
        Self {
            conditions: Conditions {
                assembled: mesh.map(|mesh| (STIFFNESS, mesh)).into_iter().collect(),
                walls,
                wrong,
                asymmetric,
                ..Conditions::default()
            },
            stiffness,
            mass: None,
            viscosity: Vec::new(),
            equilibrium: None,
        }
    }

    /// Sets the space of the operators, for matrices of the caller's own without a known space. Where neither they nor
    /// the scene identify one, the parts must be of one mesh, whichever it is.
    #[cfg(feature = "fem")]
    #[must_use]
    pub fn on<const D: usize>(mut self, space: &stickslip_fem::P1<D>) -> Self {
        self.repeat("space", self.conditions.mesh.is_some());
        self.conditions.mesh = Some(space.mesh().identity().into());
        let splits = space.mesh().split_surfaces();
        self.conditions.walls = splits.iter().map(stickslip_solvers::Walls::from).collect();
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
        self.conditions.contacts.push(contact.into());
        self
    }

    /// Adds a constant load, one vector per vertex \[N\].
    #[must_use]
    #[doc(alias = "Neumann")]
    pub fn with_load(mut self, load: Vec<SVector<f64, C>>) -> Self {
        self.conditions.loads.push(Load::Constant(load));
        self
    }

    /// Adds a load of fixed shape: `factor(t)` times one vector per vertex \[N\], for a time `t` \[s\]. Its cost is that of the
    /// vertices with a force.
    ///
    /// ```
    /// # use nalgebra::{SMatrix, Vector1};
    /// # use stickslip::{Newmark, Point, Scene, Simulation};
    /// // 2 kg under 12 N/s.
    /// let scene = Scene::new(SMatrix::<f64, 1, 1>::zeros())
    ///     .with_mass(SMatrix::<f64, 1, 1>::new(2.0))
    ///     .with_scaled_load(vec![Vector1::new(3.0)], |time| 4.0 * time);
    /// let mut pushed = Simulation::new(scene, Newmark::default(), Point)?;
    /// pushed.step(0.5)?;
    /// assert!((pushed.state().velocity[0][0] - 12.0 / 2.0 * 0.5_f64.powi(2) / 2.0).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    #[doc(alias = "Neumann")]
    pub fn with_scaled_load(
        mut self,
        load: Vec<SVector<f64, C>>,
        factor: impl Fn(f64) -> f64 + Send + Sync + 'static,
    ) -> Self {
        let load = Load::Scaled(load, Arc::new(factor));
        self.conditions.loads.push(load);
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
        self.conditions.loads.push(Load::History(Arc::new(history)));
        self
    }
}
