//! The matrices of a scene, whatever their format.

use std::sync::Arc;

use nalgebra::SVector;
use stickslip_solvers::{Basis, Matrix, MeshId, SolveError};

use super::any_solver::AnySolver;
use super::assembly::Body;
use crate::SceneError;

/// The matrices of a scene.
pub(crate) trait Matrices<const C: usize>: Send + Sync {
    /// `A` [N/m].
    fn stiffness(&self) -> &dyn Matrix<C>;

    /// `(A + A^T)/2` of a stiffness that is not symmetric, in implicit steps.
    fn symmetric_part(&self) -> Option<&dyn Matrix<C>>;

    /// `M` \[kg\].
    fn mass(&self) -> Option<&dyn Matrix<C>>;

    /// `C`, the sum of all viscosities [N s/m].
    fn viscosity(&self) -> Option<&dyn Matrix<C>>;

    /// One of them, in the order in which the scene was given them.
    fn viscosity_at(&self, number: usize) -> Option<&dyn Matrix<C>>;

    /// The numbers of those whose force lags in explicit steps.
    fn lagged(&self) -> &[usize];

    /// The relaxation time \[s\] of which they are multiples of the stiffness, if all are by their construction.
    fn relaxation(&self) -> Option<f64>;

    /// The sum of those that are part of the matrix of a step.
    fn prompt_viscosity(&self, implicit: bool) -> Option<&dyn Matrix<C>>;

    /// Splits a stiffness that is not symmetric, as its error says; refuses it with inertia, which no energy bounds then, in
    /// an initial equilibrium, and in a format without transposes.
    fn find_energy(&mut self, asymmetric: Option<&SceneError>) -> Result<(), SceneError>;

    /// Adds the viscosities, which have equal size.
    fn sum_viscosities(&mut self);

    /// Changes the solver of the equilibrium to the unknowns of a basis, and all matrices unless they are `turned` to it.
    fn change_basis(&mut self, basis: &Basis<C>, turned: bool) -> Result<(), SceneError>;

    /// Whether the scene starts in equilibrium.
    fn starts_in_equilibrium(&self) -> bool;

    /// The mesh of the solver for it.
    fn mesh_of_equilibrium(&self) -> Option<MeshId>;

    /// Solves `A u = l`, `u` having its fixed components. The solver is that of the initial equilibrium.
    fn solve_equilibrium(
        &mut self,
        fixed: &[[bool; C]],
        load: &[SVector<f64, C>],
        displacement: &mut [SVector<f64, C>],
    ) -> Result<(), SolveError>;

    /// The matrices, which nothing changes any more, and a body that assembles them for a solver, in an
    /// implicit or an explicit scheme.
    #[expect(clippy::type_complexity, reason = "both share the matrices")]
    fn into_body(
        self: Box<Self>,
        solver: AnySolver,
        implicit: bool,
    ) -> Result<(Arc<dyn Matrices<C>>, Box<dyn Body<C>>), SceneError>;
}

impl<const C: usize> dyn Matrices<C> + '_ {
    /// The stiffness matrix of the elastic energy: the symmetric part.
    pub(crate) fn energy_stiffness(&self) -> &dyn Matrix<C> {
        self.symmetric_part().unwrap_or(self.stiffness())
    }

    /// Whether there is inertia.
    pub(crate) fn has_mass(&self) -> bool {
        self.mass().is_some()
    }

    /// Whether the scene has inertia or damping, with which a sufficiently short step has a unique solution.
    pub(crate) fn is_resisted(&self) -> bool {
        self.has_mass() || self.viscosity().is_some()
    }

    /// Whether any viscosity lags in explicit steps.
    pub(crate) fn any_lags(&self) -> bool {
        !self.lagged().is_empty()
    }

    /// The viscosities whose force lags in explicit steps.
    pub(crate) fn lagged_viscosities(&self) -> impl Iterator<Item = &dyn Matrix<C>> {
        let numbers = self.lagged().iter();
        numbers.filter_map(|&number| self.viscosity_at(number))
    }

    /// `v . M v / 2` and `u . A u / 2` [J; J/m in 2D].
    pub(crate) fn energies(&self, v: &[SVector<f64, C>], u: &[SVector<f64, C>]) -> [f64; 2] {
        let kinetic = self.mass().map_or(0.0, |mass| 0.5 * mass.quadratic(v));
        [kinetic, 0.5 * self.stiffness().quadratic(u)]
    }

    /// Adds `C v` to `force`; false without viscosity.
    pub(crate) fn add_viscous_force(
        &self,
        v: &[SVector<f64, C>],
        force: &mut [SVector<f64, C>],
    ) -> bool {
        let viscosity = self.viscosity();
        if let Some(viscosity) = viscosity {
            viscosity.multiply_add(1.0, v, force);
        }
        viscosity.is_some()
    }

    /// Adds the force of one of the viscosities whose sum is `C`, by its index from 0; false without a viscosity of that index.
    pub(crate) fn add_viscous_force_of(
        &self,
        number: usize,
        v: &[SVector<f64, C>],
        force: &mut [SVector<f64, C>],
    ) -> bool {
        let viscosity = self.viscosity_at(number);
        if let Some(viscosity) = viscosity {
            viscosity.multiply_add(1.0, v, force);
        }
        viscosity.is_some()
    }
}
