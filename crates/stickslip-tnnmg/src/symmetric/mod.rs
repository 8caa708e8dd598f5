//! Dense symmetric operators, half of which is stored.

mod tile;

use std::sync::Arc;

use nalgebra::{SMatrix, SVector};
use pulp::{Arch, Simd, WithSimd};

use crate::block::FIXED;
use crate::dense::Unknowns;
use crate::{Frames, Operator};

use tile::{TILE, add_product, add_products, add_transposed_product, place};

/// A dense symmetric operator on some of the components of its vertices: those that move.
///
/// What is left of a body when its interior is eliminated. A component without a row has neither stiffness nor mass and
/// is to be held. Half of the matrix is stored, in tiles, so that a product reads each entry once for both triangles.
///
/// ```
/// use nalgebra::Vector2;
/// use stickslip_tnnmg::{Operator, Symmetric};
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
    /// Tile `(I, J)`, `J <= I`, by columns, at the place `I (I + 1)/2 + J`; zero beyond the last row.
    tiles: Vec<f64>,
    /// Tiles with an entry that is not zero; the others are passed over.
    filled: Vec<bool>,
}

impl<const C: usize> Symmetric<C> {
    /// By the components of each vertex that have a row, and the entry of each row and column, `column <= row`; rows
    /// are counted vertex by vertex and component by component.
    pub fn new(moves: &[[bool; C]], mut entry: impl FnMut(usize, usize) -> f64) -> Self {
        let fixed: Vec<_> = moves
            .iter()
            .map(|moves| moves.map(|moves| !moves))
            .collect();
        let unknowns = Unknowns::of_free(&fixed);
        let count = unknowns.count();
        let tiles = count.div_ceil(TILE);
        let mut operator = Self {
            unknowns: Arc::new(unknowns),
            tiles: vec![0.0; tiles * (tiles + 1) / 2 * TILE * TILE],
            filled: vec![false; tiles * (tiles + 1) / 2],
        };
        for row in 0..count {
            for column in 0..=row {
                operator.set(row, column, entry(row, column));
            }
        }
        operator
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
        self.tiles[place(row.max(column), row.min(column))]
    }

    fn set(&mut self, row: usize, column: usize, value: f64) {
        let (row, column) = (row.max(column), row.min(column));
        self.tiles[place(row, column)] = value;
        self.filled[place(row, column) / (TILE * TILE)] |= value != 0.0;
        if row / TILE == column / TILE {
            self.tiles[place(column, row)] = value;
        }
    }

    /// The values of a field at the rows of a tile, zero behind the last.
    #[inline(always)]
    fn gather(&self, tile: usize, x: &[SVector<f64, C>]) -> [f64; TILE] {
        let owners = self.unknowns.owners();
        let begin = tile * TILE;
        let mut values = [0.0; TILE];
        for (value, &(p, c)) in values.iter_mut().zip(&owners[begin..]) {
            *value = x[p as usize][c as usize];
        }
        values
    }

    #[inline(always)]
    fn scatter(&self, tile: usize, scale: f64, values: &[f64; TILE], y: &mut [SVector<f64, C>]) {
        let owners = self.unknowns.owners();
        for (value, &(p, c)) in values.iter().zip(&owners[tile * TILE..]) {
            y[p as usize][c as usize] += scale * value;
        }
    }

    /// A tile on or below the diagonal, if it has entries.
    #[inline(always)]
    fn tile(&self, row: usize, column: usize) -> Option<&[f64]> {
        let place = row * (row + 1) / 2 + column;
        self.filled[place].then(|| &self.tiles[place * TILE * TILE..][..TILE * TILE])
    }

    /// The rows of a tile of the product with `x`.
    #[inline(always)]
    fn row_products<S: Simd>(&self, simd: S, tile: usize, x: &[SVector<f64, C>]) -> [f64; TILE] {
        let mut sums = [0.0; TILE];
        for j in 0..self.height() {
            let entries = self.tile(tile.max(j), tile.min(j));
            let Some(entries) = entries else { continue };
            let values = self.gather(j, x);
            if j <= tile {
                add_product(simd, entries, &values, &mut sums);
            } else {
                add_transposed_product(simd, entries, &values, &mut sums);
            }
        }
        sums
    }

    /// The number of tiles in a column.
    fn height(&self) -> usize {
        self.count().div_ceil(TILE)
    }
}

struct Product<'a, const C: usize> {
    operator: &'a Symmetric<C>,
    scale: f64,
    x: &'a [SVector<f64, C>],
    y: &'a mut [SVector<f64, C>],
}

impl<const C: usize> WithSimd for Product<'_, C> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self {
            operator,
            scale,
            x,
            y,
        } = self;
        for i in 0..operator.height() {
            let (own, mut sums) = (operator.gather(i, x), [0.0; TILE]);
            for j in 0..i {
                let Some(tile) = operator.tile(i, j) else {
                    continue;
                };
                let other = operator.gather(j, x);
                let transposed = add_products(simd, tile, &other, &mut sums, &own);
                operator.scatter(j, scale, &transposed, y);
            }
            if let Some(tile) = operator.tile(i, i) {
                add_product(simd, tile, &own, &mut sums);
            }
            operator.scatter(i, scale, &sums, y);
        }
    }
}

struct Products<'a, const C: usize> {
    operator: &'a Symmetric<C>,
    vertices: &'a [usize],
    x: &'a [SVector<f64, C>],
    products: &'a mut [SVector<f64, C>],
}

impl<const C: usize> WithSimd for Products<'_, C> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self {
            operator,
            vertices,
            x,
            products,
        } = self;
        // Rows increase with vertices: a tile is multiplied once.
        let (mut known, mut sums) = (usize::MAX, [0.0; TILE]);
        for (product, &vertex) in products.iter_mut().zip(vertices) {
            *product = SVector::zeros();
            for (c, row) in operator.unknowns.free(vertex) {
                if row / TILE != known {
                    known = row / TILE;
                    sums = operator.row_products(simd, known, x);
                }
                product[c] = sums[row % TILE];
            }
        }
    }
}

struct Quadratic<'a, const C: usize> {
    operator: &'a Symmetric<C>,
    x: &'a [SVector<f64, C>],
}

impl<const C: usize> WithSimd for Quadratic<'_, C> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let Self { operator, x } = self;
        let mut square = 0.0;
        for i in 0..operator.height() {
            let (own, mut beside, mut sums) = (operator.gather(i, x), [0.0; TILE], [0.0; TILE]);
            for j in 0..i {
                if let Some(tile) = operator.tile(i, j) {
                    add_product(simd, tile, &operator.gather(j, x), &mut beside);
                }
            }
            if let Some(tile) = operator.tile(i, i) {
                add_product(simd, tile, &own, &mut sums);
            }
            for ((own, beside), sum) in own.iter().zip(&beside).zip(&sums) {
                square += own * (2.0 * beside + sum);
            }
        }
        square
    }
}

impl<const C: usize> Operator<C> for Symmetric<C> {
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

    fn combination(terms: &[(f64, &Self)]) -> Self {
        let mut sum = match terms.first() {
            Some((_, first)) => (*first).clone(),
            None => Self::new(&[], |_, _| 0.0),
        };
        sum.set_combination(terms);
        sum
    }

    fn set_combination(&mut self, terms: &[(f64, &Self)]) {
        self.tiles.fill(0.0);
        self.filled.fill(false);
        for (factor, term) in terms {
            for (filled, term) in self.filled.iter_mut().zip(&term.filled) {
                *filled |= term;
            }
            for (sum, entry) in self.tiles.iter_mut().zip(&term.tiles) {
                *sum += factor * entry;
            }
        }
    }

    fn add_to_diagonal(&mut self, i: usize, block: &SMatrix<f64, C, C>) {
        for (r, row) in self.unknowns.free(i) {
            for (c, column) in self.unknowns.free(i).filter(|&(c, _)| c <= r) {
                let value = self.entry(row, column) + block[(r, c)];
                self.set(row, column, value);
            }
        }
    }

    /// False where a vertex with axes of its own lacks a row.
    fn turn(&mut self, frames: &Frames<C>) -> bool {
        let whole = |vertex| self.unknowns.free(vertex).count() == C;
        if !frames.iter().all(|(vertex, _)| whole(vertex)) {
            return false;
        }
        let unknowns = self.unknowns.clone();
        for (vertex, axes) in frames.iter() {
            let first = unknowns.row(vertex, 0) as usize;
            for column in (0..self.count()).filter(|i| !(first..first + C).contains(i)) {
                let entries = SVector::<f64, C>::from_fn(|c, _| self.entry(first + c, column));
                let turned = axes.tr_mul(&entries);
                for c in 0..C {
                    self.set(first + c, column, turned[c]);
                }
            }
            let block = axes.tr_mul(&(self.diagonal_block(vertex) * axes));
            for c in 0..C {
                for d in 0..=c {
                    self.set(first + c, first + d, block[(c, d)]);
                }
            }
        }
        true
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
