//! The operator of a fault of segments.

use std::sync::Arc;

use nalgebra::{DMatrix, SMatrix, SVector};
use stickslip_solvers::{Matrix, MeshId, Operator};

use super::rows::Rows;

/// The matrix of a [`SegmentFault`](crate::SegmentFault): dense, and a diagonal.
///
/// A product takes two operations and 8 bytes of memory per pair of cells, and allocates nothing. Copies and sums share the
/// dense numbers. `DMatrix::from` returns the dense matrix.
///
/// The matrix is not symmetric, see [`DippingKernel`](crate::DippingKernel): the stress is taken at centres of cells. Steps
/// that evaluate forces need no symmetry.
#[derive(Debug, Clone)]
#[doc(alias("boundary element", "displacement discontinuity method"))]
pub struct SegmentKernel {
    /// Multiples of dense matrices, each once.
    terms: Vec<(f64, Arc<Rows>)>,
    diagonal: Vec<f64>,
    mesh: Option<MeshId>,
}

impl SegmentKernel {
    pub(super) fn diagonal(diagonal: Vec<f64>, mesh: MeshId) -> Self {
        Self {
            terms: Vec::new(),
            diagonal,
            mesh: Some(mesh),
        }
    }

    pub(super) fn dense(rows: Arc<Rows>, mesh: MeshId) -> Self {
        Self {
            diagonal: vec![0.0; rows.count()],
            terms: vec![(1.0, rows)],
            mesh: Some(mesh),
        }
    }

    /// `A_ij`.
    pub fn entry(&self, i: usize, j: usize) -> f64 {
        let terms = self.terms.iter();
        let dense: f64 = terms.map(|(factor, rows)| factor * rows.entry(i, j)).sum();
        dense + if i == j { self.diagonal[i] } else { 0.0 }
    }

    /// `(A x)_i`.
    fn product(&self, i: usize, x: &[SVector<f64, 1>]) -> f64 {
        let terms = self.terms.iter().filter(|(factor, _)| *factor != 0.0);
        let dense: f64 = terms
            .map(|(factor, rows)| factor * rows.product_at(i, x))
            .sum();
        dense + self.diagonal[i] * x[i][0]
    }

    fn add(&mut self, factor: f64, term: &Self) {
        for (own, value) in self.diagonal.iter_mut().zip(&term.diagonal) {
            *own += factor * value;
        }
        for (own, rows) in &term.terms {
            let same = |(_, other): &&mut (f64, Arc<Rows>)| Arc::ptr_eq(other, rows);
            match self.terms.iter_mut().find(same) {
                Some((sum, _)) => *sum += factor * own,
                None => self.terms.push((factor * own, Arc::clone(rows))),
            }
        }
    }
}

impl Matrix<1> for SegmentKernel {
    fn vertex_count(&self) -> usize {
        self.diagonal.len()
    }

    fn mesh(&self) -> Option<MeshId> {
        self.mesh
    }

    fn product_at(&self, i: usize, x: &[SVector<f64, 1>]) -> SVector<f64, 1> {
        SVector::from([self.product(i, x)])
    }

    fn diagonal_block(&self, i: usize) -> SMatrix<f64, 1, 1> {
        SMatrix::from([[self.entry(i, i)]])
    }
}

impl Operator<1> for SegmentKernel {
    type Mass = Self;

    fn into_mass(self) -> Self {
        self
    }

    fn combination_with(terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) -> Self {
        let all = || terms.iter().copied().chain(mass);
        let first = all().next().map(|(_, term)| term);
        let mut sum = Self {
            terms: Vec::new(),
            diagonal: vec![0.0; first.map_or(0, |term| term.diagonal.len())],
            mesh: first.and_then(|term| term.mesh),
        };
        all().for_each(|(factor, term)| sum.add(factor, term));
        sum
    }

    fn set_combination_with(&mut self, terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) {
        self.diagonal.fill(0.0);
        self.terms.iter_mut().for_each(|(factor, _)| *factor = 0.0);
        let all = terms.iter().copied().chain(mass);
        all.for_each(|(factor, term)| self.add(factor, term));
    }

    fn add_to_diagonal(&mut self, i: usize, block: &SMatrix<f64, 1, 1>) {
        self.diagonal[i] += block[(0, 0)];
    }
}

impl From<&SegmentKernel> for DMatrix<f64> {
    fn from(kernel: &SegmentKernel) -> Self {
        let count = kernel.vertex_count();
        Self::from_fn(count, count, |i, j| kernel.entry(i, j))
    }
}
