//! The matrices of a surface.

use std::sync::Arc;

use nalgebra::SMatrix;

use super::averaging::Averaging;
use super::dense::{Dense, assemble};
use super::elements::Elements;
use super::{SurfaceFault, SurfaceKernel, SurfaceNormalKernel};
use crate::KernelError;
use crate::error::check_factor;

impl<const C: usize> SurfaceFault<C> {
    fn interaction(&self) -> Arc<Dense<C>> {
        let interaction = self.interaction.get_or_init(|| {
            let elements = Elements::new(&self.cells, self.rock, &self.directions);
            Arc::new(assemble(&elements, &self.cells, self.is_corrected))
        });
        Arc::clone(interaction)
    }

    /// The stiffness matrix \[N/m\]: forces on cells due to slip, positive against it. It is computed on first use, with
    /// that of the normal stress, and shared by clones.
    pub fn stiffness(&self) -> SurfaceKernel<C> {
        SurfaceKernel::of_interaction(self.interaction(), self.cells.identity())
    }

    /// The change of normal stress per slip [Pa/m], compression positive. It is 0 on one plane in a whole space.
    pub fn normal_stiffness(&self) -> SurfaceNormalKernel<C> {
        let averaging = (self.is_averaged).then(|| Arc::new(Averaging::new(&self.cells)));
        SurfaceNormalKernel::new(self.interaction(), averaging, self.cells.identity())
    }

    /// The radiation damping as a viscosity matrix, for shear waves along the normal of each cell \[N s/m\]:
    /// `eta = mu/(2 c_s)` times its area.
    #[doc(alias = "quasi-dynamic")]
    pub fn radiation_damping(&self) -> SurfaceKernel<C> {
        self.damping(1.0)
    }

    /// [`radiation_damping`](Self::radiation_damping) times a factor, finite and not negative.
    ///
    /// # Errors
    /// [`KernelError`] for a factor out of its range.
    pub fn radiation_damping_times(&self, factor: f64) -> Result<SurfaceKernel<C>, KernelError> {
        check_factor(factor)?;
        Ok(self.damping(factor))
    }

    fn damping(&self, factor: f64) -> SurfaceKernel<C> {
        let eta = 0.5 * factor * self.medium.shear_modulus / self.medium.shear_wave_speed;
        let cells = 0..self.cells.count();
        let blocks = cells.map(|cell| SMatrix::from_diagonal_element(eta * self.cells.area(cell)));
        SurfaceKernel::of_diagonal(blocks.collect(), self.cells.identity())
    }
}
