//! Linear problems: the body at rest.

use nalgebra::SVector;
use stickslip::solvers::{Basis, SolveError};
use stickslip::{LinearSolver, Matrix};

use crate::ffi::Multigrid;
use crate::gradients::{Gradients, Linearization};
use crate::system::Shape;
use crate::{DistributedMatrix, DistributedSpace};

/// Conjugate gradients and PETSc's multigrid, to rounding; for the equilibrium at the start of a scene.
#[derive(Debug)]
pub struct PetscGradients<const C: usize> {
    shape: Shape<C>,
    fixed: Fixed<C>,
    multigrid: Option<Multigrid<C>>,
    gradients: Gradients<C>,
}

/// The fixed components, which are left out.
#[derive(Debug, Default)]
struct Fixed<const C: usize>(Vec<[bool; C]>);

impl<const C: usize> Linearization<C> for Fixed<C> {
    fn hide(&self, residual: &mut [SVector<f64, C>]) {
        for (residual, fixed) in residual.iter_mut().zip(&self.0) {
            for c in (0..C).filter(|&c| fixed[c]) {
                residual[c] = 0.0;
            }
        }
    }

    fn complete(&self, correction: &mut [SVector<f64, C>]) {
        self.hide(correction);
    }

    fn soften(&self, _: &[SVector<f64, C>], _: &mut [SVector<f64, C>]) {}

    fn curvature(&self, _: &[SVector<f64, C>]) -> f64 {
        0.0
    }

    fn complete_residual(
        &mut self,
        _: f64,
        _: &[SVector<f64, C>],
        _: &[SVector<f64, C>],
        _: &mut [SVector<f64, C>],
    ) {
    }
}

/// The factor by which each round reduces the residual.
const REDUCTION: f64 = 1e-8;
const ROUNDS: usize = 6;
const MOST: usize = 2000;
/// The relative error at which rounding ends the iteration.
const SMALL: f64 = 1e-14;

impl<const C: usize> PetscGradients<C> {
    /// A solver on a space, with its rigid-body modes as near-nullspace of multigrid.
    pub fn new<const D: usize>(space: &DistributedSpace<D>) -> Self {
        Self {
            shape: Shape::of(space),
            fixed: Fixed::default(),
            multigrid: None,
            gradients: Gradients::default(),
        }
    }
}

impl<const C: usize> LinearSolver<DistributedMatrix<C>, C> for PetscGradients<C> {
    fn prepare(
        &mut self,
        operator: &DistributedMatrix<C>,
        fixed: &[[bool; C]],
    ) -> Result<(), SolveError> {
        self.multigrid = None;
        self.multigrid = self.shape.multigrid(operator, fixed, &[]);
        self.fixed = Fixed(fixed.to_vec());
        self.gradients.resize(fixed.len());
        Ok(())
    }

    fn change_basis(&mut self, basis: &Basis<C>) {
        self.shape.change_basis(basis);
    }

    fn solve(
        &mut self,
        operator: &DistributedMatrix<C>,
        load: &[SVector<f64, C>],
        x: &mut [SVector<f64, C>],
    ) -> Result<(), SolveError> {
        let Some(multigrid) = &mut self.multigrid else {
            let (expected, found) = (0, load.len());
            return Err(SolveError::SizeMismatch { expected, found });
        };
        let gradients = &mut self.gradients;
        let (mut first, mut before) = (f64::NAN, f64::INFINITY);
        for iteration in 1..=ROUNDS {
            gradients.residual.copy_from_slice(load);
            operator.multiply_add(-1.0, x, &mut gradients.residual);
            self.fixed.hide(&mut gradients.residual);
            let square: f64 = gradients.residual.iter().map(|r| r.norm_squared()).sum();
            let size = operator.ranks().sum(square).sqrt();
            if !size.is_finite() {
                let change = size;
                return Err(SolveError::NotFinite { iteration, change });
            }
            if iteration == 1 {
                first = size;
            }
            if size <= SMALL * first || size > 0.5 * before {
                return Ok(());
            }
            before = size;
            let goal = (REDUCTION, 0.0);
            let solved = gradients.solve(operator, multigrid, &mut self.fixed, goal, MOST);
            if let Err(curvature) = solved {
                return Err(SolveError::IndefiniteDirection {
                    iteration,
                    curvature,
                });
            }
            for (x, step) in x.iter_mut().zip(&gradients.correction) {
                *x += step;
            }
        }
        Ok(())
    }
}
