//! Values of cells by the names of their materials.

use nalgebra::SVector;

use crate::{FemError, P1};

impl<const D: usize> P1<D> {
    /// A value for each cell by the names of [materials](crate::Mesh::with_material): the function of a cell for
    /// [`elasticity_by_cell`](crate::elasticity_by_cell), [`mass_by_cell`](crate::mass_by_cell) and similar functions.
    ///
    /// # Errors
    ///
    /// Each cell has to belong to exactly one of the named materials: [`FemError::CellValues`] names the first cell
    /// that does not. [`FemError::Unknown`] lists the existing names.
    ///
    /// ```
    /// use stickslip_fem::{Elastic, GridDiagonal, Mesh, P1, elasticity_by_cell, mass_by_cell};
    ///
    /// let strip = Mesh::<2>::grid([2.0, 1.0], [2, 1], GridDiagonal::Rising)?
    ///     .with_material("granite", &[0, 1])?
    ///     .with_material("sandstone", &[2, 3])?;
    /// let space = P1::new(strip).refined(2)?;
    /// let [granite, sandstone] = [5e10, 2e10].map(|young_modulus| Elastic { young_modulus, poisson_ratio: 0.25 });
    /// let rock = space.by_material(&[("granite", granite), ("sandstone", sandstone)])?;
    /// let stiffness = elasticity_by_cell(&space, rock)?;
    /// let density = space.by_material(&[("granite", 2700.0), ("sandstone", 2300.0)])?;
    /// let mass = mass_by_cell::<2, 1>(&space, density)?;
    /// let total: f64 = mass.data().iter().map(|block| block[0]).sum();
    /// assert!((total - 5000.0).abs() < 1e-9);
    /// # Ok::<(), stickslip_fem::FemError>(())
    /// ```
    pub fn by_material<T: Clone>(
        &self,
        values: &[(&str, T)],
    ) -> Result<impl Fn(&SVector<f64, D>, usize) -> T + use<T, D>, FemError> {
        const NONE: usize = usize::MAX;
        let mesh = self.mesh();
        let mut chosen = vec![NONE; mesh.cell_count()];
        for (k, &(name, _)) in values.iter().enumerate() {
            if values[..k].iter().any(|&(other, _)| other == name) {
                let name = name.to_owned();
                return Err(FemError::RepeatedName { name });
            }
            let Some((_, cells)) = mesh.materials().find(|(material, _)| *material == name) else {
                return Err(FemError::Unknown {
                    what: "material",
                    name: name.to_owned(),
                    known: mesh.materials().map(|(name, _)| name.to_owned()).collect(),
                });
            };
            for &cell in cells {
                if chosen[cell] != NONE {
                    let materials = [values[chosen[cell]].0, name].map(str::to_owned);
                    return Err(FemError::CellValues {
                        cell,
                        values: 2,
                        materials: materials.to_vec(),
                    });
                }
                chosen[cell] = k;
            }
        }
        if let Some(cell) = chosen.iter().position(|&k| k == NONE) {
            let holds = |(_, cells): &(&str, &[usize])| cells.binary_search(&cell).is_ok();
            let material = mesh.materials().find(holds);
            return Err(FemError::CellValues {
                cell,
                values: 0,
                materials: material
                    .map(|(name, _)| name.to_owned())
                    .into_iter()
                    .collect(),
            });
        }
        let values: Vec<T> = values.iter().map(|(_, value)| value.clone()).collect();
        Ok(move |_: &SVector<f64, D>, cell: usize| values[chosen[cell]].clone())
    }
}
