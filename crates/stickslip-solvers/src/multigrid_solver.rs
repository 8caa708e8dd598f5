//! Linear problems by multigrid.

use nalgebra::SVector;

use crate::block::check_blocks;
use crate::field::clear_masked;
use crate::linear_solver::check_lengths;
use crate::linear_step::LinearSystem;
use crate::multigrid::{Linearization, Multigrid};
use crate::parts::inside;
use crate::{Basis, BlockMatrix, LinearSolver, Matrix, MeshId, SolveError, Transfers};

/// Conjugate gradients, preconditioned by a V(1, 1) cycle on a hierarchy of levels: time and memory are proportional to
/// the unknowns.
#[derive(Debug)]
pub struct MultigridSolver<const C: usize> {
    multigrid: Multigrid<C>,
    fixed: Vec<[bool; C]>,
    linear: LinearSystem<C>,
}

/// Relative accuracy: the share of the first error, in the energy norm, at the level of rounding.
const REDUCTION: f64 = 1e-15;
/// Far more cycles than well-shaped cells need. Slivers take thousands, since a smoother treats their unknowns one
/// vertex at a time.
const MAX_CYCLES: usize = 20_000;
/// Corrections of the residual: the first removes the rounding error of its recursion.
const ROUNDS: usize = 3;

impl<const C: usize> MultigridSolver<C> {
    /// A solver for the finest of the levels that `transfers` connect.
    pub fn new(transfers: impl Into<Transfers>) -> Self {
        Self {
            multigrid: Multigrid::new(&transfers.into(), 1, 1),
            fixed: Vec::new(),
            linear: LinearSystem::default(),
        }
    }
}

impl<const C: usize> LinearSolver<BlockMatrix<C>, C> for MultigridSolver<C> {
    fn boxed_clone(&self) -> Box<dyn LinearSolver<BlockMatrix<C>, C>> {
        Box::new(Self {
            multigrid: self.multigrid.unprepared(),
            fixed: Vec::new(),
            linear: LinearSystem::default(),
        })
    }

    fn change_basis(&mut self, basis: &Basis<C>) {
        self.multigrid.change_basis(basis);
    }

    fn prepare(
        &mut self,
        operator: &BlockMatrix<C>,
        fixed: &[[bool; C]],
    ) -> Result<(), SolveError> {
        self.fixed.clear();
        check_blocks(operator, fixed)?;
        self.multigrid.prepare(operator, fixed, &[])?;
        // Factorises on the coarsest level.
        self.multigrid.refresh(
            operator,
            &Linearization {
                vertices: &[],
                hessians: &[],
                dropped: &[],
            },
        )?;
        self.linear.resize(operator.rows());
        self.fixed.extend_from_slice(fixed);
        Ok(())
    }

    fn solve(
        &mut self,
        operator: &BlockMatrix<C>,
        load: &[SVector<f64, C>],
        x: &mut [SVector<f64, C>],
    ) -> Result<(), SolveError> {
        check_lengths(self.fixed.len(), load, x)?;
        let mut first = f64::NAN;
        for round in 0..ROUNDS {
            let residual = &mut self.linear.residual;
            residual.copy_from_slice(load);
            operator.multiply_add(-1.0, x, residual);
            for (residual, fixed) in residual.iter_mut().zip(&self.fixed) {
                clear_masked(residual, fixed);
            }
            let step = inside(load.len(), || {
                self.linear.conjugate_gradients(
                    (&mut self.multigrid, operator),
                    REDUCTION,
                    0.0,
                    MAX_CYCLES,
                )
            });
            if !(step.curvature.is_finite() && step.error.is_finite()) {
                return Err(SolveError::NotFinite {
                    iteration: step.cycles,
                    change: step.curvature,
                });
            }
            if step.cycles == MAX_CYCLES {
                return Err(SolveError::NotConverged {
                    iterations: step.cycles,
                    change: step.error.max(0.0).sqrt(),
                    tolerance: REDUCTION * step.curvature.sqrt(),
                });
            }
            for (x, correction) in x.iter_mut().zip(&self.linear.correction) {
                *x += correction;
            }
            if round == 0 {
                first = step.curvature;
            }
            if step.curvature <= 1e-28 * first {
                break;
            }
        }
        Ok(())
    }

    fn mesh(&self) -> Option<MeshId> {
        self.multigrid.mesh
    }
}
