//! Linear problems: the body at rest.

use nalgebra::SVector;
use stickslip::tnnmg::SolveError;
use stickslip::{LinearSolver, Operator};

use crate::ffi::Krylov;
use crate::system::krylov;
use crate::world::or_abort;
use crate::{DistributedMatrix, DistributedSpace};

/// PETSc's conjugate gradients and multigrid, to rounding; for the equilibrium at the start of a scene.
#[derive(Debug)]
pub struct PetscGradients<const C: usize> {
    points: Vec<f64>,
    fixed: Vec<[bool; C]>,
    krylov: Option<Krylov>,
}

/// By how much each round reduces what the one before has left.
const REDUCTION: f64 = 1e-8;
const ROUNDS: usize = 6;
const MOST: usize = 2000;
/// Where rounding ends it.
const SMALL: f64 = 1e-14;

impl<const C: usize> PetscGradients<C> {
    /// A solver on a space, whose rigid motions multigrid is told.
    pub fn new<const D: usize>(space: &DistributedSpace<D>) -> Self {
        Self {
            points: space
                .points()
                .iter()
                .flat_map(|x| x.iter().copied())
                .collect(),
            fixed: Vec::new(),
            krylov: None,
        }
    }
}

impl<const C: usize> LinearSolver<DistributedMatrix<C>, C> for PetscGradients<C> {
    fn prepare(
        &mut self,
        operator: &DistributedMatrix<C>,
        fixed: &[[bool; C]],
    ) -> Result<(), SolveError> {
        let mut krylov = krylov(operator, fixed, &[], &self.points);
        let free: Vec<f64> = (fixed.iter().flatten())
            .map(|&fixed| f64::from(u8::from(!fixed)))
            .collect();
        if let Some(krylov) = &mut krylov {
            or_abort(krylov.linearize([&free, &free], [&[], &[]]));
        }
        self.krylov = krylov;
        self.fixed = fixed.to_vec();
        Ok(())
    }

    fn solve(
        &mut self,
        operator: &DistributedMatrix<C>,
        load: &[SVector<f64, C>],
        x: &mut [SVector<f64, C>],
    ) -> Result<(), SolveError> {
        let Some(krylov) = &mut self.krylov else {
            let (expected, found) = (0, load.len());
            return Err(SolveError::SizeMismatch { expected, found });
        };
        let (mut first, mut before) = (f64::NAN, f64::INFINITY);
        let mut correction = vec![0.0; C * x.len()];
        for iteration in 1..=ROUNDS {
            let mut residual = load.to_vec();
            operator.multiply_add(-1.0, x, &mut residual);
            for (residual, fixed) in residual.iter_mut().zip(&self.fixed) {
                for c in (0..C).filter(|&c| fixed[c]) {
                    residual[c] = 0.0;
                }
            }
            let square: f64 = residual.iter().map(|r| r.norm_squared()).sum();
            let size = operator.total(square).sqrt();
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
            let flat: Vec<f64> = residual.iter().flat_map(|r| r.iter().copied()).collect();
            let solved = krylov.solve(&flat, &mut correction, (REDUCTION, 0.0), MOST);
            let curvature = solved.map_or(-1.0, |(_, error)| error);
            if curvature < 0.0 {
                return Err(SolveError::IndefiniteDirection {
                    iteration,
                    curvature,
                });
            }
            for (x, step) in x.iter_mut().zip(correction.chunks_exact(C)) {
                *x += SVector::<f64, C>::from_column_slice(step);
            }
        }
        Ok(())
    }
}
