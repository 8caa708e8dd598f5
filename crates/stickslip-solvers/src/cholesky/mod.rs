//! The one wrapper of faer's sparse Cholesky factorisation: order of elimination, pattern, factor, and the
//! two triangular solves.

#[cfg(feature = "condensed")]
mod congruence;
mod factor;
mod layout;
mod memory;
mod ordering;
#[cfg(feature = "condensed")]
mod side_by_side;
mod substitution;

pub(crate) use factor::Analysis;
pub(crate) use layout::Layout;
pub(crate) use memory::Memory;
pub(crate) use substitution::{Interior, tallest};

use nalgebra::SVector;

use crate::block::check_blocks;
use crate::field::{clear_masked, dot};
use crate::linear_solver::check_lengths;
use crate::{BlockMatrix, LinearSolver, Matrix, SolveError};

/// The largest relative residual of a regular operator: a condition number of 1e13.
const LEFT: f64 = 1e-3;

/// A pattern with its factor: the data of a linear problem on the free components.
#[derive(Debug)]
pub(crate) struct Factored<const C: usize> {
    pub(crate) layout: Layout<C>,
    analysis: Analysis,
    entries: Vec<f64>,
    /// The field in the order of elimination.
    pub(crate) x: Vec<f64>,
    work: Vec<f64>,
}

impl<const C: usize> Factored<C> {
    /// Orders the unknowns and allocates up to `allowed` bytes.
    pub(crate) fn analyse(
        operator: &BlockMatrix<C>,
        fixed: &[[bool; C]],
        allowed: usize,
    ) -> Result<Self, SolveError> {
        let (layout, upper) = Layout::new(operator, &[], fixed)?;
        let memory = Memory { allowed, beside: 0 };
        let analysis = Analysis::new(&layout, &upper, &memory)?;
        Ok(Self {
            entries: vec![0.0; analysis.symbolic.len_val()],
            x: vec![0.0; layout.unknowns()],
            work: vec![0.0; tallest(&analysis.symbolic)],
            layout,
            analysis,
        })
    }

    /// Factorises an operator of the analysed pattern.
    pub(crate) fn factorize(&mut self, operator: &BlockMatrix<C>) -> Result<(), SolveError> {
        (self.analysis).factorize(&self.layout, operator, &mut self.entries)
    }

    /// The number of entries of the factor.
    #[cfg(feature = "multigrid")]
    pub(crate) fn entries(&self) -> usize {
        self.entries.len()
    }

    /// The vertex of a pivot so small that rounding may have made it.
    #[cfg(feature = "multigrid")]
    pub(crate) fn rounded_pivot(&self) -> Option<usize> {
        (self.analysis).rounded_pivot(&self.layout, &self.entries, self.x.len())
    }

    /// `x <- B^-1 x`.
    pub(crate) fn solve(&mut self) {
        let factor = Interior {
            symbolic: &self.analysis.symbolic,
            factor: &self.entries,
            columns: self.x.len(),
        };
        factor.forward(&mut self.x, &mut self.work);
        factor.backward(&mut self.x, &mut self.work);
    }
}

/// A direct factorisation: exact to rounding for any shape of cells. An operator that is regular by rounding alone is
/// refused.
///
/// ```
/// use nalgebra::SVector;
/// use stickslip_fem::{P1, antiplane};
/// use stickslip_solvers::{Cholesky, LinearSolver};
///
/// // A layer of 1 m hangs from its top: u = f (1 - y^2)/(2 mu).
/// let space = P1::grid([1.0, 1.0], [4, 4])?;
/// let load = stickslip_fem::body_force(&space, |_| SVector::from([1e4]));
/// let top = space.trace(|x| x[1] == 1.0)?;
/// let fixed: Vec<_> = (0..space.vertex_count()).map(|p| [top.vertices().contains(&p)]).collect();
/// let (stiffness, mut u) = (antiplane(&space, 1e9)?, vec![SVector::zeros(); fixed.len()]);
/// let mut solver = Cholesky::new();
/// solver.prepare(&stiffness, &fixed)?;
/// solver.solve(&stiffness, &load, &mut u)?;
/// let lowest = space.vertex_at([0.5, 0.0]).map(|p| u[p][0]);
/// assert!(lowest.is_some_and(|u| (u - 5e-6).abs() < 1e-18));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Cholesky<const C: usize> {
    memory_limit: usize,
    factored: Option<Factored<C>>,
    residual: Vec<SVector<f64, C>>,
}

impl<const C: usize> Default for Cholesky<C> {
    fn default() -> Self {
        Self {
            memory_limit: 4 << 30,
            factored: None,
            residual: Vec::new(),
        }
    }
}

impl<const C: usize> Cholesky<C> {
    /// A solver without an operator so far.
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets the memory limit of the factor, with its pattern and workspace \[byte\]. The default is 4 GiB.
    ///
    /// A larger need is refused with [`SolveError::MemoryLimit`] before allocation.
    #[must_use]
    pub fn with_memory_limit(mut self, bytes: usize) -> Self {
        self.memory_limit = bytes;
        self
    }
}

impl<const C: usize> LinearSolver<BlockMatrix<C>, C> for Cholesky<C> {
    fn boxed_clone(&self) -> Box<dyn LinearSolver<BlockMatrix<C>, C>> {
        Box::new(Self {
            memory_limit: self.memory_limit,
            ..Self::default()
        })
    }

    fn prepare(
        &mut self,
        operator: &BlockMatrix<C>,
        fixed: &[[bool; C]],
    ) -> Result<(), SolveError> {
        check_blocks(operator, fixed)?;
        let fits = |factored: &Factored<C>| factored.layout.fits(operator, &[], fixed);
        let mut factored = match self.factored.take() {
            Some(factored) if fits(&factored) => factored,
            _ => Factored::analyse(operator, fixed, self.memory_limit)?,
        };
        factored.factorize(operator)?;
        self.factored = Some(factored);
        self.residual.resize(fixed.len(), SVector::zeros());
        Ok(())
    }

    fn solve(
        &mut self,
        operator: &BlockMatrix<C>,
        load: &[SVector<f64, C>],
        x: &mut [SVector<f64, C>],
    ) -> Result<(), SolveError> {
        let size = self.factored.as_ref().map_or(0, |f| f.layout.size());
        check_lengths(size, load, x)?;
        let Some(factored) = &mut self.factored else {
            return Ok(());
        };
        let lost = SolveError::NotFinite {
            iteration: 1,
            change: f64::NAN,
        };
        (factored.layout.gather(operator, load, x, &mut factored.x)).ok_or(lost.clone())?;
        let demanded = factored.x.iter().map(|x| x * x).sum::<f64>().sqrt();
        factored.solve();
        if !factored.x.iter().all(|x| x.is_finite()) {
            return Err(lost);
        }
        factored.layout.scatter(&factored.x, x);
        self.residual.copy_from_slice(load);
        operator.multiply_add(-1.0, x, &mut self.residual);
        for (residual, fixed) in self.residual.iter_mut().zip(factored.layout.fixed()) {
            clear_masked(residual, fixed);
        }
        let residual = dot(&self.residual, &self.residual).sqrt();
        // Backward stability leaves at most the condition number times the rounding unit.
        if residual > LEFT * demanded {
            return Err(SolveError::Singular {
                residual,
                load: demanded,
            });
        }
        Ok(())
    }
}
