//! Meshes in other units of length.

use crate::fingerprint::fingerprint;
use crate::{FemError, Mesh};

impl<const D: usize> Mesh<D> {
    /// Multiplies the coordinates by a factor, positive and finite: `scaled(1e3)` turns kilometres of a file into metres.
    /// Parts, materials, surfaces and cuts stay as they are. It is another mesh: scale before spaces, parts and matrices are
    /// made of it.
    ///
    /// # Errors
    ///
    /// [`FemError::Value`] for another factor, [`FemError::DegenerateCell`] where the volume of a cell leaves the range of
    /// numbers.
    ///
    /// ```
    /// use stickslip_fem::{FemError, GridDiagonal, Mesh};
    ///
    /// let kilometres = Mesh::<2>::grid([4.0, 2.0], [4, 2], GridDiagonal::Rising)?;
    /// let metres = kilometres.scaled(1e3)?;
    /// assert_eq!(metres, Mesh::<2>::grid([4e3, 2e3], [4, 2], GridDiagonal::Rising)?);
    /// # Ok::<(), FemError>(())
    /// ```
    #[doc(alias = "units")]
    pub fn scaled(mut self, factor: f64) -> Result<Self, FemError> {
        let legal = factor > 0.0 && factor.is_finite();
        FemError::check("factor of a mesh", "positive and finite", factor, legal)?;
        for vertex in &mut self.vertices {
            *vertex *= factor;
        }
        for cell in 0..self.cell_count() {
            let volume = self.volume(cell);
            if !volume.is_normal() {
                return Err(FemError::DegenerateCell {
                    level: None,
                    cell,
                    volume,
                });
            }
        }
        self.fingerprint = fingerprint(&self.vertices, &self.cells);
        Ok(self)
    }
}
