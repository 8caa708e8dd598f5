//! The matrices of a scene beside the stiffness.

use stickslip_solvers::{IntoOperator, Operator};

use super::check::{check_format, check_symmetry};
use super::{MASS, Scene, VISCOSITY};

impl<Op: Operator<C>, const C: usize> Scene<Op, C> {
    /// Adds inertia with the mass matrix `M` \[kg\], stored in the operator's [format of a mass](Operator::Mass): for
    /// finite elements one number per pair of vertices.
    #[must_use]
    pub fn with_mass(mut self, mass: impl IntoOperator<C, Operator: Into<Op>>) -> Self {
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
    pub fn with_viscosity(mut self, viscosity: impl IntoOperator<C, Operator: Into<Op>>) -> Self {
        let viscosity = self.taken(VISCOSITY, viscosity);
        self.viscosity.extend(viscosity);
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

    /// The viscosity matrices `C` [N s/m], one by one.
    pub fn viscosity(&self) -> &[Op] {
        &self.viscosity
    }

    /// The operator of a matrix, unless it is invalid; records its mesh and its error.
    fn taken(
        &mut self,
        what: &'static str,
        matrix: impl IntoOperator<C, Operator: Into<Op>>,
    ) -> Option<Op> {
        let mesh = matrix.mesh();
        self.conditions
            .assembled
            .extend(mesh.map(|mesh| (what, mesh)));
        let operator: Op = matrix.into_operator().into();
        let checked = check_format(what, &operator);
        match checked.and_then(|()| check_symmetry(what, &operator)) {
            Ok(()) => Some(operator),
            Err(error) => {
                self.conditions.wrong.get_or_insert(error);
                None
            }
        }
    }
}
