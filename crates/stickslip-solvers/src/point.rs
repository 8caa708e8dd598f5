//! One vertex: the local minimisation is the whole problem.

use nalgebra::{SMatrix, SVector};

use crate::block::{decouple, inverse};
use crate::{Energy, NonsmoothSolver, SolveError, SolveReport, Stopping};

/// Solves a scene of one vertex, a spring slider, exactly.
#[derive(Debug, Clone, Copy, Default)]
pub struct Point;

impl<const C: usize> NonsmoothSolver<SMatrix<f64, C, C>, C> for Point {
    fn boxed_clone(&self) -> Box<dyn NonsmoothSolver<SMatrix<f64, C, C>, C>> {
        Box::new(*self)
    }

    fn prepare(&mut self, energy: &Energy<'_, SMatrix<f64, C, C>, C>) -> Result<(), SolveError> {
        inverse(energy.operator, &energy.fixed[0])
            .map(|_| ())
            .ok_or(SolveError::IndefiniteBlock { vertex: 0 })
    }

    fn minimize(
        &mut self,
        energy: &Energy<'_, SMatrix<f64, C, C>, C>,
        _stopping: &Stopping<'_, SMatrix<f64, C, C>>,
        v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError> {
        let fixed = &energy.fixed[0];
        let prescribed = SVector::from_fn(|c, _| if fixed[c] { v[0][c] } else { 0.0 });
        let mut force = energy.load[0] - energy.operator * prescribed;
        let block = decouple(energy.operator, fixed);
        for c in 0..C {
            if fixed[c] {
                force[c] = 0.0;
            }
        }
        let minimizer = if energy.vertices.is_empty() {
            inverse(&block, &[false; C]).ok_or(SolveError::IndefiniteBlock { vertex: 0 })? * force
        } else {
            energy.potentials.minimize(0, &block, &force)
        };
        if !minimizer.iter().all(|value| value.is_finite()) {
            return Err(SolveError::NotFinite {
                iteration: 1,
                change: minimizer.norm(),
            });
        }
        v[0] = minimizer + prescribed;
        Ok(SolveReport {
            iterations: 1,
            cycles: 0,
            error: 0.0,
        })
    }
}
