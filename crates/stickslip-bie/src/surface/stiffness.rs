//! The matrices of a surface.

use std::sync::Arc;

use nalgebra::SMatrix;

use super::SurfaceFault;
use super::averaging::Averaging;
use super::elements::Elements;
use super::pairs::SurfacePairs;
use crate::error::check_factor;
use crate::hmatrix::Compression;
use crate::interaction::{Interaction, Storage};
use crate::{CellKernel, CellNormalKernel, KernelError};

impl<const C: usize> SurfaceFault<C> {
    pub(crate) fn pairs(&self) -> SurfacePairs<'_, C> {
        SurfacePairs {
            elements: Elements::new(&self.cells, self.rock, &self.directions),
            cells: &self.cells,
            is_corrected: self.is_corrected,
        }
    }

    pub(crate) fn storage(&self) -> &Storage {
        &self.storage
    }

    fn interaction(&self) -> Arc<Interaction<C>> {
        let interaction = (self.interaction)
            .get_or_init(|| Arc::new(Interaction::new(&self.pairs(), &self.storage)));
        Arc::clone(interaction)
    }

    /// The stiffness matrix \[N/m\]: forces on cells due to slip, positive against it. It is computed on first use, with
    /// that of the normal stress, and shared by clones.
    pub fn stiffness(&self) -> CellKernel<C> {
        CellKernel::of_interaction(self.interaction(), self.cells.identity())
    }

    /// The change of normal stress per slip [Pa/m], compression positive. It is 0 on one plane in a whole space, and for slip
    /// along strike on a vertical one in a half space.
    pub fn normal_stiffness(&self) -> CellNormalKernel<C> {
        let cells = 0..self.cells.count();
        let bends = cells.map(|cell| self.cells.bend_at(cell)).collect();
        let normal = CellNormalKernel::new(self.interaction(), bends, self.cells.identity());
        if self.is_averaged {
            normal.averaged(Arc::new(Averaging::new(&self.cells)))
        } else {
            normal
        }
    }

    /// What the interaction takes, and how it is approximated. It is made if it is not there yet.
    pub fn compression(&self) -> Compression {
        self.interaction().compression()
    }

    /// The radiation damping as a viscosity matrix, for shear waves along the normal of each cell \[N s/m\]:
    /// `eta = mu/(2 c_s)` times its area.
    #[doc(alias = "quasi-dynamic")]
    pub fn radiation_damping(&self) -> CellKernel<C> {
        self.damping(1.0)
    }

    /// [`radiation_damping`](Self::radiation_damping) times a factor, finite and not negative.
    ///
    /// # Errors
    /// [`KernelError`] for a factor out of its range.
    pub fn radiation_damping_times(&self, factor: f64) -> Result<CellKernel<C>, KernelError> {
        check_factor(factor)?;
        Ok(self.damping(factor))
    }

    fn damping(&self, factor: f64) -> CellKernel<C> {
        let eta = 0.5 * factor * self.medium.shear_modulus / self.medium.shear_wave_speed;
        let cells = 0..self.cells.count();
        let blocks = cells.map(|cell| SMatrix::from_diagonal_element(eta * self.cells.area(cell)));
        CellKernel::of_diagonal(blocks.collect(), self.cells.identity())
    }
}
