//! Dense problems with friction.

mod blocks;
mod direction;
mod elimination;
mod estimate;
mod factor;
mod gradients;
mod kernels;
mod matrix;
mod operator;
mod problem;
mod system;
mod unknowns;
mod workspace;

pub(crate) use matrix::DenseMatrix;
pub(crate) use operator::DenseOperator;
pub(crate) use unknowns::Unknowns;
pub(crate) use workspace::{Goal, Workspace};

use std::ptr;

use nalgebra::SVector;

use crate::block::check_blocks;
use crate::energy::expect;
use crate::newton::Friction;
use crate::parts::inside_contact;
use crate::{
    Counters, Energy, FrictionalSolver, NonsmoothSolver, SolveError, SolveReport, Stopping,
};

use problem::Problem;

/// The nonsmooth Newton method for a dense matrix `S`: `min y.Sy/2 - g.y + sum_k phi_k(y_k)`.
///
/// For bodies without an interior: a Schur complement, a boundary integral, a Craig-Bampton reduction. Unknowns without
/// friction are eliminated once per operator, if it is definite on them. Loads are condensed once per step
/// ([`FrictionalSolver`]). One iteration has three parts: a nonlinear Gauss-Seidel sweep, each local problem solved
/// exactly; Newton's method on the smooth components, with a dense factorisation that serves for further steps while
/// they shrink; a line search. It converges from every start. [`Condensed`](crate::Condensed) adds a sparse
/// factorisation.
///
/// ```
/// use nalgebra::{DMatrix, SVector};
/// use stickslip_friction::{Radial, Tresca};
/// use stickslip_solvers::{DenseNewton, Energy, NonsmoothSolver, Stopping};
///
/// // Two vertices, coupled; a force of 3 N moves the first one, the second sticks.
/// let matrix = DMatrix::from_row_slice(2, 2, &[2.0, -1.0, -1.0, 2.0]);
/// let friction = vec![Radial { law: Tresca { coefficient: 0.5 }, force: 2.0, state: () }; 2];
/// let energy = Energy {
///     operator: &matrix,
///     load: &[SVector::from([3.0]), SVector::from([0.0])],
///     potentials: &friction,
///     vertices: &[0, 1],
///     fixed: &[[false], [false]],
/// };
/// let mut y = [SVector::from([0.0]); 2];
/// let mut solver = DenseNewton::<1>::new();
/// solver.prepare(&energy)?;
/// solver.minimize(&energy, &Stopping::in_energy_norm(&matrix, 1e-12), &mut y)?;
/// assert!((y[0][0] - 1.0).abs() < 1e-12 && y[1][0] == 0.0);
/// # Ok::<(), stickslip_solvers::SolveError>(())
/// ```
#[derive(Debug)]
pub struct DenseNewton<const C: usize> {
    truncation: f64,
    problem: Option<Problem<C>>,
    /// Whether a load is condensed.
    loaded: bool,
    /// Whether changes are measured by the unknowns alone until the next load.
    measured: bool,
    counters: Counters,
}

impl<const C: usize> Default for DenseNewton<C> {
    fn default() -> Self {
        Self {
            truncation: 1e4,
            problem: None,
            loaded: false,
            measured: false,
            counters: Counters::default(),
        }
    }
}

impl<const C: usize> DenseNewton<C> {
    /// A solver without an operator so far.
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets the curvature, relative to the diagonal of the matrix, from which a component is left to the sweep alone.
    /// The default is `1e4`. Convergence hardly depends on it.
    #[must_use]
    pub fn with_truncation(mut self, ratio: f64) -> Self {
        self.truncation = ratio;
        self
    }
}

/// Failure: a load or a result is not finite.
const LOST: SolveError = SolveError::NotFinite {
    iteration: 1,
    change: f64::NAN,
};

/// Failure: no preparation, or no condensed load, for a field of so many vertices.
fn unprepared(found: usize) -> SolveError {
    SolveError::SizeMismatch { expected: 0, found }
}

impl<const C: usize> DenseNewton<C> {
    /// Solves for the unknowns from their values in `v`, and writes them there if there is a result.
    fn solve<Op: DenseOperator<C>>(
        &mut self,
        energy: &Energy<'_, Op, C>,
        stopping: &Stopping<'_, Op>,
        v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError> {
        let (Some(problem), true) = (&mut self.problem, self.loaded) else {
            return Err(unprepared(v.len()));
        };
        let (size, frictional) = (problem.body_fixed.len(), problem.body_vertices.len());
        energy.check_sizes(size, frictional, stopping.norm, v)?;
        problem.gather(v);
        let goal = Goal {
            tolerance: stopping.at(v),
            equivalence: stopping.equivalence,
            rounding: stopping.relative > 0.0,
            max_iterations: stopping.max_iterations,
        };
        let unknowns = problem.work.unknowns.clone();
        let (norm, measured) = (stopping.norm, self.measured && problem.measured);
        let (work, matrix, (vertices, fixed), y, mut measure) =
            problem.parts(norm, &unknowns, measured);
        let friction = Friction {
            potentials: energy.potentials,
            vertices,
            fixed,
        };
        let truncation = self.truncation;
        let result = inside_contact(frictional, || {
            let mut norm = |change: &[SVector<f64, C>]| measure.of(change);
            work.minimize(matrix, &friction, truncation, &goal, &mut norm, y)
        });
        let moves = &problem.moves;
        let result = result.map_err(|mut error| {
            // The problem counts along what moves.
            if let SolveError::NotConvex { vertex, .. } | SolveError::NoEquilibrium { vertex, .. } =
                &mut error
            {
                *vertex = moves[*vertex];
            }
            error
        });
        self.counters.products += std::mem::take(&mut problem.work.gradients.products);
        let moved = match &result {
            Ok(_) => true,
            Err(SolveError::NotConverged { iterations, .. }) => *iterations > 0,
            Err(_) => false,
        };
        if moved {
            problem.scatter(v);
        }
        result
    }
}

impl<Op: DenseOperator<C>, const C: usize> NonsmoothSolver<Op, C> for DenseNewton<C> {
    fn boxed_clone(&self) -> Box<dyn NonsmoothSolver<Op, C>> {
        Box::new(Self {
            truncation: self.truncation,
            ..Self::default()
        })
    }

    fn prepare(&mut self, energy: &Energy<'_, Op, C>) -> Result<(), SolveError> {
        energy.check()?;
        self.loaded = false;
        self.counters.preparations += 1;
        let (fixed, vertices) = (energy.fixed, energy.vertices);
        check_blocks(energy.operator, fixed)?;
        let fits =
            |problem: &Problem<C>| problem.body_fixed == fixed && problem.body_vertices == vertices;
        let mut problem = match self.problem.take() {
            Some(problem) if fits(&problem) && problem.is_eliminating() => problem,
            _ => Problem::new(fixed, vertices, true)?,
        };
        if !problem.take(energy.operator) {
            problem = Problem::new(fixed, vertices, false)?;
            problem.take(energy.operator);
        }
        self.problem = Some(problem);
        Ok(())
    }

    fn minimize(
        &mut self,
        energy: &Energy<'_, Op, C>,
        stopping: &Stopping<'_, Op>,
        v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError> {
        if self.problem.is_none() {
            expect([(0, v.len())])?;
            return Ok(SolveReport::default());
        }
        self.condense(energy, v)?;
        let result = self.solve(energy, stopping, v);
        if matches!(&result, Ok(_) | Err(SolveError::NotConverged { .. })) {
            FrictionalSolver::<Op, C>::extend(self, v)?;
        }
        self.loaded = false;
        result
    }

    fn frictional(&mut self) -> Option<&mut dyn FrictionalSolver<Op, C>> {
        let eliminating = self.problem.as_ref().is_some_and(Problem::is_eliminating);
        if eliminating { Some(self) } else { None }
    }

    fn counters(&self) -> Counters {
        self.counters
    }

    fn into_object(self) -> Box<dyn NonsmoothSolver<Op, C>> {
        Op::object(self)
    }
}

impl<Op: DenseOperator<C>, const C: usize> FrictionalSolver<Op, C> for DenseNewton<C> {
    fn condense(
        &mut self,
        energy: &Energy<'_, Op, C>,
        v: &[SVector<f64, C>],
    ) -> Result<(), SolveError> {
        (self.loaded, self.measured) = (false, false);
        let Some(problem) = &mut self.problem else {
            return Err(unprepared(v.len()));
        };
        let (size, frictional) = (problem.body_fixed.len(), problem.body_vertices.len());
        energy.check_sizes(size, frictional, energy.operator, v)?;
        (problem.condense(energy.operator, energy.load, v)).ok_or(LOST)?;
        self.loaded = true;
        Ok(())
    }

    fn measure(&mut self, energy: &Energy<'_, Op, C>, norm: &Op) {
        let Some(problem) = &mut self.problem else {
            return;
        };
        if !ptr::eq(norm, energy.operator) {
            problem.measure(norm);
            self.measured = true;
        }
    }

    fn minimize_condensed(
        &mut self,
        energy: &Energy<'_, Op, C>,
        stopping: &Stopping<'_, Op>,
        v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError> {
        self.solve(energy, stopping, v)
    }

    fn change_norm(
        &mut self,
        energy: &Energy<'_, Op, C>,
        norm: &Op,
        change: &[SVector<f64, C>],
    ) -> Result<f64, SolveError> {
        let Some(problem) = &mut self.problem else {
            return Err(unprepared(change.len()));
        };
        let (size, frictional) = (problem.body_fixed.len(), problem.body_vertices.len());
        energy.check_sizes(size, frictional, norm, change)?;
        problem.gather(change);
        let unknowns = problem.work.unknowns.clone();
        let measured = self.measured && problem.measured;
        let (_, _, _, y, mut measure) = problem.parts(norm, &unknowns, measured);
        Ok(measure.of(y))
    }

    fn is_definite_with(&mut self, slopes: &[f64]) -> bool {
        self.problem.as_mut().is_some_and(|problem| {
            let Problem {
                work,
                matrix,
                places,
                ..
            } = problem;
            work.is_definite_with(matrix, places, slopes)
        })
    }

    fn extend(&mut self, v: &mut [SVector<f64, C>]) -> Result<(), SolveError> {
        let (Some(problem), true) = (&mut self.problem, self.loaded) else {
            return Err(unprepared(v.len()));
        };
        expect([(problem.body_fixed.len(), v.len())])?;
        problem.extend(v).ok_or(LOST)
    }
}
