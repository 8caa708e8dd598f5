//! The linear step of one iteration: a correction for the Newton system on the kept unknowns.

use nalgebra::SVector;

use crate::BlockMatrix;
use crate::field::{add_scaled_pair, dot, scale_and_add_pair};
use crate::multigrid::{LOOK, Multigrid};

/// The linear step of one iteration.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum LinearStep {
    /// One multigrid cycle, at its best length.
    Cycle,
    /// Conjugate gradients, preconditioned by one cycle per step. They stop once the error of the linear problem has
    /// fallen by `reduction` (squared as the nonlinear error falls) or is below the tolerance; at most `max_cycles`.
    ConjugateGradients {
        /// The factor by which an iteration far from the solution reduces the linear error.
        reduction: f64,
        /// The largest number of cycles in one iteration.
        max_cycles: usize,
    },
}

/// The result of a linear step for its correction `d`.
#[derive(Clone, Copy)]
pub(crate) struct Correction {
    /// `d . H d`, which is `d . residual` as well for conjugate gradients.
    pub(crate) curvature: f64,
    /// `d . (residual before)`.
    pub(crate) decrease: f64,
    /// Square of the estimated error of the linear problem, in the norm of `H`.
    pub(crate) error: f64,
    /// The number of multigrid cycles.
    pub(crate) cycles: usize,
}

/// The fields of a linear step.
#[derive(Debug, Default)]
pub(crate) struct LinearSystem<const C: usize> {
    /// The right-hand side; after conjugate gradients, the remaining residual.
    pub(crate) residual: Vec<SVector<f64, C>>,
    pub(crate) correction: Vec<SVector<f64, C>>,
    /// The matrix times `direction`, or scratch.
    pub(crate) image: Vec<SVector<f64, C>>,
    preconditioned: Vec<SVector<f64, C>>,
    preconditioned_image: Vec<SVector<f64, C>>,
    direction: Vec<SVector<f64, C>>,
}

impl<const C: usize> LinearSystem<C> {
    /// Allocates for `size` vertices.
    pub(crate) fn resize(&mut self, size: usize) {
        for field in [
            &mut self.residual,
            &mut self.correction,
            &mut self.image,
            &mut self.preconditioned,
            &mut self.preconditioned_image,
            &mut self.direction,
        ] {
            field.resize(size, SVector::zeros());
        }
    }

    /// `f . V f` of forces at some vertices, for a cycle `V`.
    pub(crate) fn square_of(
        &mut self,
        multigrid: &mut Multigrid<C>,
        vertices: &[usize],
        mut force: impl FnMut(usize, &SVector<f64, C>) -> SVector<f64, C>,
    ) -> f64 {
        let (forces, solution) = (&mut self.preconditioned, &mut self.preconditioned_image);
        forces.fill(SVector::zeros());
        for (k, &vertex) in vertices.iter().enumerate() {
            forces[vertex] = force(k, &self.correction[vertex]);
        }
        multigrid.cycle(forces, solution, &mut self.image);
        dot(forces, solution)
    }

    /// Computes `correction` by one cycle, at the length that minimises the linear energy.
    ///
    /// A symmetric cycle leaves a share between 0 and `rho` of every part of the error. The best length is therefore
    /// above one and leaves at most `rho/(2 - rho)`.
    pub(crate) fn one_cycle(&mut self, multigrid: &mut Multigrid<C>) -> Correction {
        multigrid.cycle(&self.residual, &mut self.correction, &mut self.image);
        let curvature = dot(&self.correction, &self.image);
        let decrease = dot(&self.correction, &self.residual);
        let length = decrease / curvature;
        let length = if length.is_finite() { length } else { 1.0 };
        for correction in &mut self.correction {
            *correction *= length;
        }
        Correction {
            curvature: curvature * length * length,
            decrease: decrease * length,
            error: f64::INFINITY,
            cycles: 1,
        }
    }

    /// Computes `correction` by preconditioned conjugate gradients, until the squared error is below `target` or has
    /// fallen by the square of `reduction`.
    pub(crate) fn conjugate_gradients(
        &mut self,
        (multigrid, operator): (&mut Multigrid<C>, &BlockMatrix<C>),
        reduction: f64,
        target: f64,
        max_cycles: usize,
    ) -> Correction {
        // Square of the rate expected of a cycle while no second one has been seen.
        const FIRST_RATE: f64 = 0.1;
        self.correction.fill(SVector::zeros());
        let mut result = Correction {
            curvature: 0.0,
            decrease: 0.0,
            error: 0.0,
            cycles: 0,
        };
        let (mut first, mut previous, mut last_ratio) = (0.0, 0.0, 0.0);
        let mut ahead = 0.0;
        for cycle in 1..=max_cycles {
            // What is left after slow cycles is a linear problem of its own, to be solved exactly.
            let anew = cycle == 1 || multigrid.replace_cycles(operator, ahead);
            multigrid.cycle(
                &self.residual,
                &mut self.preconditioned,
                &mut self.preconditioned_image,
            );
            let square = dot(&self.residual, &self.preconditioned);
            result.cycles = cycle;
            // Zero, or so small that its square is, or spoiled: nothing more to gain here.
            if !(square > 0.0 && square.is_finite()) {
                result.error = square;
                break;
            }
            let ratio = if anew { 0.0 } else { square / previous };
            if cycle == 1 {
                first = square;
            }
            let curvature = if anew {
                std::mem::swap(&mut self.direction, &mut self.preconditioned);
                std::mem::swap(&mut self.image, &mut self.preconditioned_image);
                dot(&self.direction, &self.image)
            } else {
                scale_and_add_pair(
                    (&mut self.direction, &mut self.image),
                    ratio,
                    (&self.preconditioned, &self.preconditioned_image),
                )
            };
            if !(curvature > 0.0 && curvature.is_finite()) {
                result.error = square;
                break;
            }
            let length = square / curvature;
            add_scaled_pair(
                (&mut self.correction, &mut self.residual),
                length,
                (&self.direction, &self.image),
            );
            result.curvature += length * square;
            let rate = if anew {
                FIRST_RATE
            } else {
                // By chance a cycle does far better than the next one, which finds what it left.
                f64::max(ratio, last_ratio).min(1.0)
            };
            result.error = square * rate;
            (previous, last_ratio) = (square, ratio);
            let goal = target.max(reduction * reduction * first);
            if result.error <= goal {
                break;
            }
            ahead = if cycle % LOOK == 0 {
                // Cycles still to come at the pace seen so far.
                let gained = (first / result.error).ln().max(0.0);
                (result.error / goal).ln() * cycle as f64 / gained
            } else {
                0.0
            };
        }
        result.decrease = result.curvature;
        result
    }
}
