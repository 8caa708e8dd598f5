//! Dense matrices, of which single entries are known.

use nalgebra::DMatrix;
use stickslip_core::compiled;

use super::DenseNewton;
use crate::{NonsmoothSolver, Operator, Symmetric};

/// A matrix with access to single entries.
pub trait DenseOperator<const C: usize>: Operator<C> {
    /// The entry of two components, each given by vertex and component; zero for one without a row.
    fn at(&self, row: (usize, usize), column: (usize, usize)) -> f64;

    /// A solver for this format as an object, compiled in this crate.
    #[doc(hidden)]
    fn object(solver: DenseNewton<C>) -> Box<dyn NonsmoothSolver<Self, C>>;
}

compiled! {
    fn of_whole<C>(solver: DenseNewton<C>) -> Box<dyn NonsmoothSolver<DMatrix<f64>, C>> {
        Box::new(solver)
    }

    fn of_symmetric<C>(solver: DenseNewton<C>) -> Box<dyn NonsmoothSolver<Symmetric<C>, C>> {
        Box::new(solver)
    }
}

impl<const C: usize> DenseOperator<C> for DMatrix<f64> {
    #[inline]
    fn at(&self, (p, c): (usize, usize), (q, d): (usize, usize)) -> f64 {
        self[(C * p + c, C * q + d)]
    }

    fn object(solver: DenseNewton<C>) -> Box<dyn NonsmoothSolver<Self, C>> {
        of_whole(solver)
    }
}

impl<const C: usize> DenseOperator<C> for Symmetric<C> {
    #[inline]
    fn at(&self, (p, c): (usize, usize), (q, d): (usize, usize)) -> f64 {
        match (self.row(p, c), self.row(q, d)) {
            (Some(row), Some(column)) => self.entry(row, column),
            _ => 0.0,
        }
    }

    fn object(solver: DenseNewton<C>) -> Box<dyn NonsmoothSolver<Self, C>> {
        of_symmetric(solver)
    }
}
