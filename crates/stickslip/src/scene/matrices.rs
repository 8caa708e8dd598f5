//! Operations on the matrices of a scene, independent of their format.

use nalgebra::SVector;
use stickslip_solvers::{MeshId, Operator};

use super::Scene;

/// The matrices of a body, and the mesh that they belong to.
pub(crate) trait Matrices<const C: usize> {
    /// The body's mesh, if it is known.
    fn mesh(&self) -> Option<MeshId>;

    /// `v . M v / 2` and `u . A u / 2` [J; J/m in 2D].
    fn energies(&self, v: &[SVector<f64, C>], u: &[SVector<f64, C>]) -> [f64; 2];

    /// Adds `C v` to `force`; false without viscosity.
    fn add_viscous_force(&self, v: &[SVector<f64, C>], force: &mut [SVector<f64, C>]) -> bool;

    /// The same for one of the viscosities whose sum is `C`, counted from zero; false if there is none.
    fn add_viscous_force_of(
        &self,
        number: usize,
        v: &[SVector<f64, C>],
        force: &mut [SVector<f64, C>],
    ) -> bool;

    /// Whether the force of that viscosity lags in explicit steps; of any of them, without a number.
    fn lags(&self, number: Option<usize>) -> bool;

    /// Marks mesh and matrices.
    #[cfg(feature = "checkpoint")]
    fn describe(&self, fingerprint: &mut crate::marks::Fingerprint);
}

impl<Op: Operator<C>, const C: usize> Matrices<C> for Scene<Op, C> {
    fn mesh(&self) -> Option<MeshId> {
        self.mesh
    }

    fn energies(&self, v: &[SVector<f64, C>], u: &[SVector<f64, C>]) -> [f64; 2] {
        let mass = self.mass.as_ref();
        let kinetic = mass.map_or(0.0, |mass| 0.5 * mass.quadratic(v));
        [kinetic, 0.5 * self.stiffness.quadratic(u)]
    }

    fn add_viscous_force(&self, v: &[SVector<f64, C>], force: &mut [SVector<f64, C>]) -> bool {
        for viscosity in &self.viscosity {
            viscosity.multiply_add(1.0, v, force);
        }
        !self.viscosity.is_empty()
    }

    fn add_viscous_force_of(
        &self,
        number: usize,
        v: &[SVector<f64, C>],
        force: &mut [SVector<f64, C>],
    ) -> bool {
        let viscosity = self.summands().get(number);
        if let Some(viscosity) = viscosity {
            viscosity.multiply_add(1.0, v, force);
        }
        viscosity.is_some()
    }

    fn lags(&self, number: Option<usize>) -> bool {
        number.map_or(self.lagged.is_some(), |n| self.is_lagged(n))
    }

    #[cfg(feature = "checkpoint")]
    fn describe(&self, fingerprint: &mut crate::marks::Fingerprint) {
        fingerprint.words("the mesh", self.mesh.map(|mesh| mesh.fingerprint));
        fingerprint.operator("the stiffness matrix", &self.stiffness);
        if let Some(mass) = &self.mass {
            fingerprint.operator("the mass matrix", mass);
        }
        for viscosity in &self.viscosity {
            fingerprint.operator("the viscosity matrix", viscosity);
        }
    }
}
