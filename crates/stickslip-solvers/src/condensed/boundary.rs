//! The problem on the boundary, and the transfers between it and the body.

use std::ptr;

use nalgebra::SVector;

use crate::cholesky::{Analysis, Interior, Layout};
use crate::dense::Goal;
use crate::energy::expect;
use crate::newton::Friction;
use crate::{BlockMatrix, Energy, FrictionalSolver, SolveError, SolveReport, Stopping};

use super::Condensed;
use super::cache::Factor;
use super::measure::Measure;
use super::problem::Problem;

/// Failure: a load or a result is not finite.
const LOST: SolveError = SolveError::NotFinite {
    iteration: 1,
    change: f64::NAN,
};

/// Failure: no preparation, or no condensed load, for a field of so many vertices.
fn unprepared(found: usize) -> SolveError {
    SolveError::SizeMismatch { expected: 0, found }
}

impl<const C: usize> Condensed<C> {
    /// Solves for `y` from its value in `v`, which stays as it is. Returns whether there is a result `y`, too.
    pub(super) fn solve_boundary(
        &mut self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        stopping: &Stopping<'_, BlockMatrix<C>>,
        v: &[SVector<f64, C>],
    ) -> (Result<SolveReport, SolveError>, bool) {
        let (Some(problem), Some(factor), true) =
            (&mut self.problem, self.cache.current(), self.loaded)
        else {
            return (Err(unprepared(v.len())), false);
        };
        let (size, frictional) = (problem.layout.size(), problem.layout.vertices().len());
        if let Err(error) = energy.check_sizes(size, frictional, stopping.norm, v) {
            return (Err(error), false);
        }
        let Problem {
            layout,
            analysis,
            boundary,
            places,
            fixed,
            y,
            x,
            extension,
            field,
            work,
            ..
        } = problem;
        boundary.force.copy_from_slice(&x[layout.interior..]);
        for (y, &vertex) in y.iter_mut().zip(layout.vertices()) {
            *y = v[vertex];
        }
        let goal = Goal {
            tolerance: stopping.at(v),
            equivalence: stopping.equivalence,
            rounding: stopping.relative > 0.0,
            max_iterations: stopping.max_iterations,
        };
        let friction = Friction {
            potentials: energy.potentials,
            vertices: places,
            fixed,
        };
        let mut measure = Measure {
            interior: interior(analysis, factor, layout),
            layout,
            dense: dense_norm(factor, energy.operator, stopping.norm, self.measured),
            norm: stopping.norm,
            extension,
            field,
            work,
            substitutions: 0,
        };
        let mut norm = |change: &[SVector<f64, C>]| measure.of(change);
        let ratio = self.truncation;
        let result = boundary.minimize(&factor.schur, &friction, ratio, &goal, &mut norm, y);
        self.counters.backward_substitutions += measure.substitutions;
        let result = result.map_err(|mut error| {
            // The dense problem counts along the boundary.
            if let SolveError::NotConvex { vertex, .. } | SolveError::NoEquilibrium { vertex, .. } =
                &mut error
            {
                *vertex = energy.vertices[*vertex];
            }
            error
        });
        let moved = match &result {
            Ok(_) => true,
            Err(SolveError::NotConverged { iterations, .. }) => *iterations > 0,
            Err(_) => false,
        };
        (result, moved)
    }

    /// Extends the solution `y` to the body.
    pub(super) fn extend_solution(&mut self, v: &mut [SVector<f64, C>]) -> Result<(), SolveError> {
        let (Some(problem), Some(factor)) = (&mut self.problem, self.cache.current()) else {
            return Err(unprepared(v.len()));
        };
        let Problem {
            layout,
            analysis,
            y,
            x,
            extension,
            work,
            ..
        } = problem;
        extension.copy_from_slice(x);
        layout.scatter_boundary(y, extension);
        let interior = interior(analysis, factor, layout);
        interior.backward(extension, work);
        self.counters.backward_substitutions += 1;
        let spoiled: f64 = extension.iter().map(|x| 0.0 * x).sum();
        if spoiled != 0.0 {
            return Err(LOST);
        }
        layout.scatter(extension, v);
        Ok(())
    }
}

impl<const C: usize> FrictionalSolver<BlockMatrix<C>, C> for Condensed<C> {
    fn condense(
        &mut self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        v: &[SVector<f64, C>],
    ) -> Result<(), SolveError> {
        (self.loaded, self.measured) = (false, false);
        let (Some(problem), Some(factor)) = (&mut self.problem, self.cache.current()) else {
            return Err(unprepared(energy.operator.rows()));
        };
        let (size, frictional) = (problem.layout.size(), problem.layout.vertices().len());
        energy.check_sizes(size, frictional, energy.operator, v)?;
        let Problem {
            layout,
            analysis,
            x,
            work,
            ..
        } = problem;
        (layout.gather(energy.operator, energy.load, v, x)).ok_or(LOST)?;
        let interior = interior(analysis, factor, layout);
        interior.forward(x, work);
        self.counters.forward_substitutions += 1;
        self.loaded = true;
        Ok(())
    }

    fn measure(&mut self, energy: &Energy<'_, BlockMatrix<C>, C>, norm: &BlockMatrix<C>) {
        let Some(problem) = &mut self.problem else {
            return;
        };
        if ptr::eq(norm, energy.operator) {
            return;
        }
        if self.measurable.is_none() {
            let affordable = problem.affordable_measured(self.memory_limit);
            let measurable =
                affordable > 0 && problem.layout.fits(norm, energy.vertices, energy.fixed);
            self.measurable = Some(measurable);
            if measurable {
                self.cache.measure_by(norm.data());
                let known = (self.cache.current()).is_some_and(|factor| !factor.gram.is_empty());
                if !known {
                    self.cache.shrink(affordable);
                    problem.measure(&mut self.cache, norm);
                }
            }
        }
        self.measured = self.measurable == Some(true);
    }

    fn minimize_condensed(
        &mut self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        stopping: &Stopping<'_, BlockMatrix<C>>,
        v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError> {
        let (result, moved) = self.solve_boundary(energy, stopping, v);
        if let (true, Some(problem)) = (moved, &self.problem) {
            for (y, &vertex) in problem.y.iter().zip(problem.layout.vertices()) {
                v[vertex] = *y;
            }
        }
        result
    }

    fn change_norm(
        &mut self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        norm: &BlockMatrix<C>,
        change: &[SVector<f64, C>],
    ) -> Result<f64, SolveError> {
        let (Some(problem), Some(factor)) = (&mut self.problem, self.cache.current()) else {
            return Err(unprepared(change.len()));
        };
        let (size, frictional) = (problem.layout.size(), problem.layout.vertices().len());
        energy.check_sizes(size, frictional, norm, change)?;
        let Problem {
            layout,
            analysis,
            y,
            extension,
            field,
            work,
            ..
        } = problem;
        for (y, &vertex) in y.iter_mut().zip(layout.vertices()) {
            *y = change[vertex];
        }
        let mut measure = Measure {
            interior: interior(analysis, factor, layout),
            layout,
            dense: dense_norm(factor, energy.operator, norm, self.measured),
            norm,
            extension,
            field,
            work,
            substitutions: 0,
        };
        let length = measure.of(y);
        self.counters.backward_substitutions += measure.substitutions;
        Ok(length)
    }

    fn is_definite_with(&mut self, slopes: &[f64]) -> bool {
        let (Some(problem), Some(factor)) = (&mut self.problem, self.cache.current()) else {
            return false;
        };
        let Problem {
            boundary, places, ..
        } = problem;
        boundary.is_definite_with(&factor.schur, places, slopes)
    }

    fn extend(&mut self, v: &mut [SVector<f64, C>]) -> Result<(), SolveError> {
        let (Some(problem), true) = (&mut self.problem, self.loaded) else {
            return Err(unprepared(v.len()));
        };
        expect([(problem.layout.size(), v.len())])?;
        for (y, &vertex) in problem.y.iter_mut().zip(problem.layout.vertices()) {
            *y = v[vertex];
        }
        self.extend_solution(v)
    }
}

/// The dense norm of boundary changes, if available: the Schur complement for the norm of the operator itself.
fn dense_norm<'a, const C: usize>(
    factor: &'a Factor<C>,
    operator: &BlockMatrix<C>,
    norm: &BlockMatrix<C>,
    measured: bool,
) -> Option<&'a [f64]> {
    if ptr::eq(norm, operator) {
        Some(factor.schur.columns())
    } else {
        measured.then_some(&*factor.gram)
    }
}

/// The part of a factor that eliminates the body.
fn interior<'a, const C: usize>(
    analysis: &'a Analysis,
    factor: &'a Factor<C>,
    layout: &Layout<C>,
) -> Interior<'a> {
    Interior {
        symbolic: &analysis.symbolic,
        factor: &factor.entries,
        columns: layout.interior,
    }
}
