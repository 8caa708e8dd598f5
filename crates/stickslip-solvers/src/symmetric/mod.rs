//! Dense symmetric operators in packed storage.

mod products;

use std::sync::Arc;

use nalgebra::{SMatrix, SVector};
use pulp::{Arch, Simd};

use crate::block::FIXED;
use crate::dense::Unknowns;
use crate::links::Elementary;
use crate::packed_symmetric::{PackedSymmetric, WIDTH};
use crate::{Basis, Link, Matrix, Operator};
use products::{Product, Products, Quadratic};

/// Rows whose values are gathered at a time, and whose products are computed if only some are needed.
const BLOCK: usize = 512;
const TILE: usize = 32;

/// A dense symmetric operator on some of the components of its vertices: those that move.
///
/// A statically condensed body has such an operator. A component without a row has neither stiffness nor mass and must
/// be fixed. Half of the matrix is stored: a product reads each entry once for both triangles.
///
/// ```
/// use nalgebra::Vector2;
/// use stickslip_solvers::{Matrix, Operator, Symmetric};
///
/// // Two vertices that move along x alone.
/// let moves = [[true, false]; 2];
/// let spring = Symmetric::new(&moves, |i, j| if i == j { 2.0 } else { -1.0 });
/// let mut force = [Vector2::zeros(); 2];
/// spring.multiply_add(1.0, &[Vector2::new(1.0, 7.0), Vector2::new(0.0, 7.0)], &mut force);
/// assert_eq!(force, [Vector2::new(2.0, 0.0), Vector2::new(-1.0, 0.0)]);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Symmetric<const C: usize> {
    unknowns: Arc<Unknowns<C>>,
    panels: PackedSymmetric,
}

impl<const C: usize> Symmetric<C> {
    /// From the components of each vertex that have a row, and the entry of each row and column, `column <= row`. Rows
    /// are counted vertex by vertex and component by component.
    pub fn new(moves: &[[bool; C]], mut entry: impl FnMut(usize, usize) -> f64) -> Self {
        let fixed: Vec<_> = moves
            .iter()
            .map(|moves| moves.map(|moves| !moves))
            .collect();
        let unknowns = Unknowns::of_free(&fixed);
        let mut panels = PackedSymmetric::new(unknowns.count());
        for row in 0..unknowns.count() {
            for column in 0..=row {
                panels.set(row, column, entry(row, column));
            }
        }
        Self {
            unknowns: Arc::new(unknowns),
            panels,
        }
    }

    /// The number of rows.
    pub fn count(&self) -> usize {
        self.unknowns.count()
    }

    /// The row of a component of a vertex, if it has one.
    pub fn row(&self, vertex: usize, component: usize) -> Option<usize> {
        let row = self.unknowns.row(vertex, component);
        (row != FIXED).then_some(row as usize)
    }

    /// The vertex and the component of a row.
    pub fn owner(&self, row: usize) -> (usize, usize) {
        self.unknowns.owner(row)
    }

    /// The entry of a row and a column.
    pub fn entry(&self, row: usize, column: usize) -> f64 {
        self.panels.entry(row, column)
    }

    /// Adds multiples of a row and a column to others.
    fn add_row(&mut self, from: usize, share: f64, to: usize) {
        let added = 2.0 * self.entry(from, to) + share * self.entry(from, from);
        let own = self.entry(to, to) + share * added;
        for column in (0..self.count()).filter(|&column| column != to) {
            let value = self.entry(to, column) + share * self.entry(from, column);
            self.panels.set(to, column, value);
        }
        self.panels.set(to, to, own);
    }

    /// Changes the sign of a row and a column.
    fn negate_row(&mut self, row: usize) {
        for column in (0..self.count()).filter(|&column| column != row) {
            let value = -self.entry(row, column);
            self.panels.set(row, column, value);
        }
    }

    /// The values of a field at some rows, whole chunks: zero after the last.
    #[inline(always)]
    fn gather<'a>(
        &self,
        begin: usize,
        x: &[SVector<f64, C>],
        values: &'a mut [f64; BLOCK],
    ) -> &'a [f64] {
        let values = &mut values[..BLOCK.min(self.panels.rows() - begin)];
        for (value, &(p, c)) in values.iter_mut().zip(&self.unknowns.owners()[begin..]) {
            *value = x[p as usize][c as usize];
        }
        values
    }

    /// Adds to a field, from some row on.
    #[inline(always)]
    fn scatter(&self, begin: usize, scale: f64, values: &[f64], y: &mut [SVector<f64, C>]) {
        for (value, &(p, c)) in values.iter().zip(&self.unknowns.owners()[begin..]) {
            y[p as usize][c as usize] += scale * value;
        }
    }

    /// The rows of a tile of the product with `x`.
    #[inline(always)]
    fn row_products<S: Simd>(&self, simd: S, tile: usize, x: &[SVector<f64, C>]) -> [f64; TILE] {
        let mut sums = [0.0; TILE];
        let begin = tile * TILE;
        let end = self.panels.rows().min(begin + TILE);
        for column in (0..self.panels.rows()).step_by(BLOCK) {
            let mut values = [0.0; BLOCK];
            let values = self.gather(column, x, &mut values);
            if column < end {
                // The columns up to the diagonal.
                let known = &values[..values.len().min(end - column)];
                let rows = &mut sums[..end - begin];
                (self.panels).add_columns(simd, (column, known), (begin, rows));
            }
            if column + BLOCK > begin {
                // The mirror images of those below.
                let panels = begin / WIDTH..end / WIDTH;
                for (sums, panel) in sums.chunks_exact_mut(WIDTH).zip(panels) {
                    let products = self.panels.products(simd, panel, (column, values));
                    for k in 0..WIDTH {
                        sums[k] += products[k];
                    }
                }
            }
        }
        sums
    }
}

impl<const C: usize> Matrix<C> for Symmetric<C> {
    fn vertex_count(&self) -> usize {
        self.unknowns.vertices()
    }

    fn product_at(&self, i: usize, x: &[SVector<f64, C>]) -> SVector<f64, C> {
        let mut product = [SVector::zeros()];
        self.products_at(&[i], x, &mut product);
        product[0]
    }

    fn products_at(
        &self,
        vertices: &[usize],
        x: &[SVector<f64, C>],
        products: &mut [SVector<f64, C>],
    ) {
        Arch::new().dispatch(Products {
            operator: self,
            vertices,
            x,
            products,
        });
    }

    fn diagonal_block(&self, i: usize) -> SMatrix<f64, C, C> {
        let mut block = SMatrix::zeros();
        for (r, row) in self.unknowns.free(i) {
            for (c, column) in self.unknowns.free(i) {
                block[(r, c)] = self.entry(row, column);
            }
        }
        block
    }

    fn multiply_add(&self, scale: f64, x: &[SVector<f64, C>], y: &mut [SVector<f64, C>]) {
        let operator = self;
        Arch::new().dispatch(Product {
            operator,
            scale,
            x,
            y,
        });
    }

    fn quadratic(&self, x: &[SVector<f64, C>]) -> f64 {
        Arch::new().dispatch(Quadratic { operator: self, x })
    }
}

impl<const C: usize> Operator<C> for Symmetric<C> {
    type Mass = Self;

    fn into_mass(self) -> Self {
        self
    }

    fn combination_with(terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) -> Self {
        let mut sum = match terms.first().copied().or(mass) {
            Some((_, first)) => first.clone(),
            None => Self::new(&[], |_, _| 0.0),
        };
        sum.set_combination_with(terms, mass);
        sum
    }

    fn set_combination_with(&mut self, terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) {
        let terms = terms.iter().copied().chain(mass);
        self.panels
            .set_combination(terms.map(|(factor, term)| (factor, &term.panels)));
    }

    fn add_to_diagonal(&mut self, i: usize, block: &SMatrix<f64, C, C>) {
        for (r, row) in self.unknowns.free(i) {
            for (c, column) in self.unknowns.free(i).filter(|&(c, _)| c <= r) {
                let value = self.entry(row, column) + block[(r, c)];
                self.panels.set(row, column, value);
            }
        }
    }

    /// False if a vertex with axes of its own, or one that is linked or a base, lacks a row.
    fn change_basis(&mut self, basis: &Basis<C>) -> bool {
        let whole = |vertex| self.unknowns.free(vertex).count() == C;
        let linked = |link: &Link| whole(link.vertex) && link.bases.iter().all(|&base| whole(base));
        if !basis.axes.iter().all(|(vertex, _)| whole(vertex)) || !basis.links.iter().all(linked) {
            return false;
        }
        let unknowns = self.unknowns.clone();
        basis.links.congruent(|step| {
            for c in 0..C {
                match step {
                    Elementary::Add { from, to, share } => {
                        let [from, to] = [from, to].map(|i| unknowns.row(i, c) as usize);
                        self.add_row(from, share, to);
                    }
                    Elementary::Negate(i) => self.negate_row(unknowns.row(i, c) as usize),
                }
            }
        });
        for (vertex, axes) in basis.axes.iter() {
            let first = unknowns.row(vertex, 0) as usize;
            for column in (0..self.count()).filter(|i| !(first..first + C).contains(i)) {
                let entries = SVector::<f64, C>::from_fn(|c, _| self.entry(first + c, column));
                let turned = axes.tr_mul(&entries);
                for c in 0..C {
                    self.panels.set(first + c, column, turned[c]);
                }
            }
            let block = axes.tr_mul(&(self.diagonal_block(vertex) * axes));
            for c in 0..C {
                for d in 0..=c {
                    self.panels.set(first + c, first + d, block[(c, d)]);
                }
            }
        }
        true
    }

    fn format() -> &'static str {
        "Symmetric"
    }
}
