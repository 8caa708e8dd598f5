//! Static condensation: a sparse factorisation once, then a small dense problem on the frictional boundary.

mod boundary;
mod cache;
mod measure;
mod problem;

use nalgebra::SVector;

use stickslip_core::compiled;

use crate::block::check_blocks;
use crate::{
    BlockMatrix, Counters, Energy, FrictionalSolver, NonsmoothSolver, SolveError, SolveReport,
    Stopping,
};

use cache::Cache;
use problem::Problem;

/// Static condensation to the frictional vertices by a direct factorisation.
///
/// Without friction the problem is linear, and its matrix changes with the time step alone. With the frictional
/// components last in the order of elimination, the factor `L` leaves the Schur complement `S = L22 L22^T`, and a solve
/// is
///
/// 1. a forward substitution, which condenses the load: `g = r_F - L21 L11^-1 r_I`;
/// 2. the dense convex problem `min y.Sy/2 - g.y + sum_k phi_k(y_k)`, by the nonsmooth Newton method of
///    [`DenseNewton`](crate::DenseNewton), which converges from every start;
/// 3. a back substitution for the interior.
///
/// The method of choice for constant step sizes in two dimensions. A sticking slider of 655 000 unknowns takes 0.16 s
/// per step and 1.3 GB, with [`Tnnmg`](crate::Tnnmg) 0.41 s and 0.8 GB. The time of the latter grows with the slipping
/// part; it is for larger and three-dimensional bodies. The factors of the last few operators are kept: alternating
/// step sizes cost nothing.
///
/// Problems of one time step differ in friction alone. They need the first and the last of these once
/// ([`FrictionalSolver`]): the coupling of rate and state is dense.
///
/// The stopping norm is that of the whole field: a change of `y` moves the interior with it, `d = E y`. In the norm of
/// the operator that is `y.Sy`. Another norm, `N`, takes a back substitution or, for many problems with one operator,
/// the dense matrix `E^T N E`: [`FrictionalSolver::measure`] forms it once, in the time of a few factorisations. If
/// [`Stopping::equivalence`] is infinite, every iteration measures. If [`Stopping::relative`] is positive, a residual
/// at the level of its rounding errors ends the iteration, too; [`SolveReport::error`] then reports the remaining
/// error.
#[derive(Debug)]
#[doc(alias("static condensation", "Schur complement"))]
pub struct Condensed<const C: usize> {
    truncation: f64,
    memory_limit: usize,
    cache: Cache<C>,
    problem: Option<Problem<C>>,
    /// A load is condensed.
    loaded: bool,
    /// Whether changes can be measured on the boundary, once tested for this preparation.
    measurable: Option<bool>,
    /// Changes are measured on the boundary until the next load.
    measured: bool,
    counters: Counters,
}

impl<const C: usize> Default for Condensed<C> {
    fn default() -> Self {
        Self {
            truncation: 1e4,
            memory_limit: 4 << 30,
            cache: Cache::new(4),
            problem: None,
            loaded: false,
            measurable: None,
            measured: false,
            counters: Counters::default(),
        }
    }
}

impl<const C: usize> Condensed<C> {
    /// A solver without an operator so far.
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets the number of operators whose factors are kept, at least one. The default is 4, or as many as the memory
    /// limit allows.
    #[must_use]
    pub fn with_cached_factors(mut self, count: usize) -> Self {
        self.cache.capacity = count.max(1);
        self
    }

    /// Sets the memory limit of all factors together \[byte\]. The default is 4 GiB.
    ///
    /// A larger need is refused with [`SolveError::MemoryLimit`] before allocation.
    #[must_use]
    pub fn with_memory_limit(mut self, bytes: usize) -> Self {
        self.memory_limit = bytes;
        self
    }

    /// Sets the curvature, relative to the diagonal of the Schur complement, from which a component is left to the
    /// sweep alone. The default is `1e4`. Convergence hardly depends on it.
    #[must_use]
    pub fn with_truncation(mut self, ratio: f64) -> Self {
        self.truncation = ratio;
        self
    }
}

impl<const C: usize> NonsmoothSolver<BlockMatrix<C>, C> for Condensed<C> {
    fn boxed_clone(&self) -> Box<dyn NonsmoothSolver<BlockMatrix<C>, C>> {
        Box::new(Self {
            truncation: self.truncation,
            memory_limit: self.memory_limit,
            cache: Cache::new(self.cache.capacity),
            ..Self::default()
        })
    }

    fn prepare(&mut self, energy: &Energy<'_, BlockMatrix<C>, C>) -> Result<(), SolveError> {
        self.cache.suspend();
        (self.loaded, self.measurable) = (false, None);
        self.counters.preparations += 1;
        energy.check()?;
        let Energy {
            operator,
            vertices,
            fixed,
            ..
        } = *energy;
        let fits = |problem: &Problem<C>| problem.layout.fits(operator, vertices, fixed);
        if !self.problem.as_ref().is_some_and(fits) {
            self.cache.clear();
            self.problem = None;
            let problem = Problem::new(operator, vertices, fixed, self.memory_limit)?;
            self.problem = Some(problem);
        }
        let Some(problem) = &mut self.problem else {
            return Ok(());
        };
        if self.cache.find(operator.data()) {
            return Ok(());
        }
        check_blocks(operator, fixed)?;
        let capacity = problem.affordable(self.memory_limit);
        let count = problem.boundary.unknowns.count();
        let entries = problem.analysis.symbolic.len_val();
        let factor = self
            .cache
            .claim(capacity.min(self.cache.capacity), entries, count);
        self.counters.factorizations += 1;
        self.counters.factor_entries = entries;
        let (layout, analysis) = (&problem.layout, &mut problem.analysis);
        let stiffened = analysis.factorize_interior(layout, operator, &mut factor.entries)?;
        let scratch = problem.boundary.scratch();
        factor.schur.write(|schur| {
            analysis.schur(&factor.entries, layout.interior, scratch, schur);
            if stiffened {
                analysis.relax_schur(layout, schur);
            }
        });
        self.cache.adopt(operator.data());
        Ok(())
    }

    fn minimize(
        &mut self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        stopping: &Stopping<'_, BlockMatrix<C>>,
        v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError> {
        self.condense(energy, v)?;
        let (result, moved) = self.solve_boundary(energy, stopping, v);
        if moved {
            self.extend_solution(v)?;
        }
        self.loaded = false;
        result
    }

    fn frictional(&mut self) -> Option<&mut dyn FrictionalSolver<BlockMatrix<C>, C>> {
        Some(self)
    }

    fn counters(&self) -> Counters {
        self.counters
    }

    fn into_object(self) -> Box<dyn NonsmoothSolver<BlockMatrix<C>, C>> {
        object(self)
    }
}

compiled! {
    fn object<C>(solver: Condensed<C>) -> Box<dyn NonsmoothSolver<BlockMatrix<C>, C>> {
        Box::new(solver)
    }
}
