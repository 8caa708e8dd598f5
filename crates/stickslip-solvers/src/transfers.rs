//! The interpolations of a hierarchy, and its finest mesh.

use crate::{MeshId, Prolongation, SolveError};

/// The interpolations between the levels of a hierarchy, coarsest first, and the finest mesh.
///
/// If the mesh is known, a simulation refuses to solve on another one of equal size. `stickslip_fem` gives both:
///
/// ```
/// use stickslip_fem::P1;
/// use stickslip_solvers::{Tnnmg, Transfers};
///
/// let space = P1::grid([2.0, 1.0], [2, 1])?.refined(3)?;
/// let transfers = Transfers::from(space.transfers());
/// assert_eq!(transfers.mesh(), Some(space.mesh().identity().into()));
/// let solver: Tnnmg<2> = Tnnmg::new(transfers);
/// // Or, at once:
/// let solver: Tnnmg<2> = Tnnmg::new(space.transfers());
/// # Ok::<(), stickslip_fem::FemError>(())
/// ```
///
/// The preparation of a solver refuses transfers that do not fit one another.
#[derive(Debug, Clone, Default)]
pub struct Transfers {
    prolongations: Vec<Prolongation>,
    mesh: Option<MeshId>,
}

impl Transfers {
    /// The interpolations, coarsest first.
    pub fn prolongations(&self) -> &[Prolongation] {
        &self.prolongations
    }

    /// The finest mesh, if known.
    pub fn mesh(&self) -> Option<MeshId> {
        self.mesh
    }

    /// Refuses interpolations that do not begin where those before end, and weights that are not finite.
    pub(crate) fn check(prolongations: &[Prolongation]) -> Result<(), SolveError> {
        for (level, pair) in prolongations.windows(2).enumerate() {
            let (rows, columns) = (pair[0].rows(), pair[1].cols());
            if rows != columns {
                return Err(SolveError::TransferMismatch {
                    level: level + 1,
                    rows,
                    columns,
                });
            }
        }
        for (level, prolongation) in prolongations.iter().enumerate() {
            let broken = prolongation.iter().find(|(weight, _)| !weight.is_finite());
            if let Some((&weight, (row, column))) = broken {
                return Err(SolveError::TransferWeight {
                    level,
                    row: row as usize,
                    column: column as usize,
                    weight,
                });
            }
        }
        Ok(())
    }
}

/// Interpolations to a known mesh.
impl<M: Into<MeshId>> From<(M, &[Prolongation])> for Transfers {
    fn from((mesh, prolongations): (M, &[Prolongation])) -> Self {
        Self {
            prolongations: prolongations.to_vec(),
            mesh: Some(mesh.into()),
        }
    }
}

impl From<&Self> for Transfers {
    fn from(transfers: &Self) -> Self {
        transfers.clone()
    }
}

/// Interpolations to an unknown mesh.
impl From<&[Prolongation]> for Transfers {
    fn from(prolongations: &[Prolongation]) -> Self {
        Self {
            prolongations: prolongations.to_vec(),
            mesh: None,
        }
    }
}
