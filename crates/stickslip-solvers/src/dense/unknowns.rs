//! The numbering of free components in a dense matrix.

use nalgebra::{SMatrix, SVector};

use crate::block::{FIXED, decouple};

use super::matrix::DenseMatrix;

/// The map between the rows of the matrix and the components of the vertices.
#[derive(Debug, PartialEq)]
pub(crate) struct Unknowns<const C: usize> {
    /// The unknown of each component of each vertex, or [`FIXED`].
    rows: Vec<[u32; C]>,
    /// The vertex and the component of each unknown.
    owners: Vec<(u32, u8)>,
}

impl<const C: usize> Unknowns<C> {
    /// The numbering given by the row of each component of each vertex.
    pub(crate) fn new(rows: Vec<[u32; C]>) -> Self {
        let owners = (rows.iter().enumerate())
            .flat_map(|(p, rows)| {
                let free = (0..C).filter(|&c| rows[c] != FIXED);
                free.map(move |c| (p as u32, c as u8))
            })
            .collect();
        Self { rows, owners }
    }

    /// Numbers the free components vertex by vertex.
    pub(crate) fn of_free(fixed: &[[bool; C]]) -> Self {
        let mut count = 0;
        let mut number = |fixed: bool| {
            if fixed {
                return FIXED;
            }
            count += 1;
            count - 1
        };
        let rows = fixed.iter().map(|fixed| fixed.map(&mut number)).collect();
        Self::new(rows)
    }

    /// The number of unknowns.
    pub(crate) fn count(&self) -> usize {
        self.owners.len()
    }

    /// The number of vertices.
    pub(crate) fn vertices(&self) -> usize {
        self.rows.len()
    }

    /// The vertex and the component of an unknown.
    pub(crate) fn owner(&self, unknown: usize) -> (usize, usize) {
        let (p, c) = self.owners[unknown];
        (p as usize, c as usize)
    }

    /// The vertex and the component of every unknown.
    #[inline]
    pub(crate) fn owners(&self) -> &[(u32, u8)] {
        &self.owners
    }

    /// The unknown of a component of a vertex, or [`FIXED`].
    pub(crate) fn row(&self, vertex: usize, component: usize) -> u32 {
        self.rows[vertex][component]
    }

    /// The free components of a vertex, with their unknowns.
    pub(crate) fn free(&self, p: usize) -> impl Iterator<Item = (usize, usize)> + use<C> {
        let rows = self.rows[p];
        (0..C).filter_map(move |c| (rows[c] != FIXED).then_some((c, rows[c] as usize)))
    }

    /// Whether a component of a vertex is fixed.
    pub(crate) fn is_fixed(&self, p: usize, c: usize) -> bool {
        self.rows[p][c] == FIXED
    }

    /// The value of a field at an unknown.
    pub(crate) fn value(&self, field: &[SVector<f64, C>], unknown: usize) -> f64 {
        let (p, c) = self.owner(unknown);
        field[p][c]
    }

    /// The largest diagonal entry of the block of a vertex.
    pub(crate) fn scale(&self, matrix: &DenseMatrix, p: usize) -> f64 {
        let diagonal = |i: usize| matrix.column(i)[i];
        self.free(p)
            .fold(0.0, |largest: f64, (_, i)| largest.max(diagonal(i)))
    }

    /// The diagonal block of a vertex, with the identity where components are fixed.
    pub(crate) fn block(&self, matrix: &DenseMatrix, p: usize) -> SMatrix<f64, C, C> {
        let mut block = SMatrix::zeros();
        for (r, i) in self.free(p) {
            for (c, j) in self.free(p) {
                block[(r, c)] = matrix.column(j)[i];
            }
        }
        decouple(&block, &self.rows[p].map(|row| row == FIXED))
    }
}
