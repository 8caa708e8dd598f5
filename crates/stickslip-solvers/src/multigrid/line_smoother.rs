//! Line smoother: vertices that stretched cells couple strongly are smoothed together.
//!
//! On cells much longer in one direction than in another, sweeps over single vertices leave errors that the coarse
//! meshes do not resolve, either. Strong couplings then connect vertices to lines, or to planes, and sweeps over these
//! do what sweeps over vertices do on well-shaped cells. On a mesh of well-shaped cells strong couplings connect all
//! vertices to one set, and the smoother treats single vertices.

use nalgebra::{SMatrix, SVector};

use super::entries::Entries;
use crate::block::inverse;
use crate::block_matrix::Rows;

/// The share of the largest coupling of one of two vertices from which theirs is strong. Couplings along and across
/// cells differ by the square of their aspect ratio; from 2.5 : 1 on lines were measured to pay.
const STRONG: f64 = 1.0 / 6.0;
/// The largest share of all coupled vertices in one set: beyond it cells are not stretched.
const LARGEST: f64 = 0.5;
/// The largest ratio of the blocks of the factors to those of the matrix that is worth the time.
const FILL: usize = 8;

/// The sets of the line smoother, each with a factor `L D L^T` of its part of the matrix, stored by the envelopes of
/// the rows of `L`.
#[derive(Debug, Default)]
pub(super) struct Sets<const C: usize> {
    /// The vertices, set by set; within a set by their distance from one end of it.
    order: Vec<u32>,
    /// The start of each set in `order`, and the end; empty if cells are not stretched.
    begins: Vec<u32>,
    /// The position of every vertex in `order`, or [`NONE`] before it has one.
    places: Vec<u32>,
    /// The set of every vertex.
    owners: Vec<u32>,
    /// The first column, a position, of the row of every position.
    first: Vec<u32>,
    /// The start of that row in `factor`, and the end.
    starts: Vec<usize>,
    /// Rows of `L` without their diagonal.
    factor: Vec<SMatrix<f64, C, C>>,
    /// Inverses of `D` on the kept components, zero on the others.
    inverses: Vec<SMatrix<f64, C, C>>,
    /// The largest coupling of every vertex.
    largest: Vec<f64>,
    /// The sets with rows that friction can change, increasing.
    touched: Vec<u32>,
}

const NONE: u32 = u32::MAX;

impl<const C: usize> Sets<C> {
    /// Whether there are no sets.
    pub(super) fn is_empty(&self) -> bool {
        self.begins.is_empty()
    }

    /// The number of sets.
    pub(super) fn len(&self) -> usize {
        self.begins.len().saturating_sub(1)
    }

    /// Finds the lines of a matrix; false if it has none.
    pub(super) fn find_all(&mut self, matrix: Entries<'_, C>) -> bool {
        self.begins.clear();
        let found = self.find(&matrix) && self.reserve(&matrix.rows);
        if !found {
            self.begins.clear();
        }
        found
    }

    /// Factorises all sets; `strip` are the rows that friction can change.
    pub(super) fn factorize_all(
        &mut self,
        rows: &Rows<'_, SMatrix<f64, C, C>>,
        dropped: &[[bool; C]],
        strip: &[u32],
    ) {
        self.touched.clear();
        self.touched
            .extend(strip.iter().map(|&vertex| self.owners[vertex as usize]));
        self.touched.sort_unstable();
        self.touched.dedup();
        for set in 0..self.len() {
            self.factorize(set, rows, dropped);
        }
    }

    /// Factorises the sets that friction can change again.
    pub(super) fn refresh(&mut self, rows: &Rows<'_, SMatrix<f64, C, C>>, dropped: &[[bool; C]]) {
        if self.is_empty() {
            return;
        }
        for touched in 0..self.touched.len() {
            self.factorize(self.touched[touched] as usize, rows, dropped);
        }
    }

    /// Solves for the corrections of a set, given the residual of its rows; both in `rest`, by vertices.
    pub(super) fn solve(&self, set: usize, rest: &mut [SVector<f64, C>]) {
        let range = self.range(set);
        for place in range.clone() {
            let mut sum = rest[self.order[place] as usize];
            for (column, block) in self.row(place) {
                sum -= block * rest[self.order[column] as usize];
            }
            rest[self.order[place] as usize] = sum;
        }
        for place in range.clone() {
            let vertex = self.order[place] as usize;
            rest[vertex] = self.inverses[place] * rest[vertex];
        }
        for place in range.rev() {
            let known = rest[self.order[place] as usize];
            for (column, block) in self.row(place) {
                rest[self.order[column] as usize] -= block.tr_mul(&known);
            }
        }
    }

    /// The vertices of a set.
    pub(super) fn vertices(&self, set: usize) -> impl Iterator<Item = usize> + '_ {
        self.order[self.range(set)]
            .iter()
            .map(|&vertex| vertex as usize)
    }

    fn range(&self, set: usize) -> std::ops::Range<usize> {
        self.begins[set] as usize..self.begins[set + 1] as usize
    }

    /// The row of `L` at a position, with the positions of its columns.
    fn row(&self, place: usize) -> impl Iterator<Item = (usize, &SMatrix<f64, C, C>)> {
        (self.first[place] as usize..).zip(&self.factor[self.starts[place]..self.starts[place + 1]])
    }

    /// Finds the sets; false if cells are not stretched.
    fn find(&mut self, rows: &Entries<'_, C>) -> bool {
        let size = rows.dropped.len();
        let others = |i: usize| rows.row(i).filter(move |&(j, _)| j != i);
        self.largest.clear();
        self.largest.extend((0..size).map(|i| {
            others(i).fold(0.0, |largest: f64, (_, block)| {
                largest.max(coupling(&block))
            })
        }));
        let coupled = self
            .largest
            .iter()
            .filter(|&&largest| largest > 0.0)
            .count();
        let limit = (LARGEST * coupled as f64) as usize;
        self.places.clear();
        self.places.resize(size, NONE);
        self.owners.resize(size, 0);
        self.order.clear();
        self.order.reserve(size);
        for start in 0..size {
            if self.places[start] != NONE {
                continue;
            }
            let begin = self.order.len();
            self.begins.push(begin as u32);
            self.walk(rows, start);
            if self.order.len() - begin > limit.max(1) {
                return false;
            }
            // Once more from the end that is farthest, for narrow envelopes.
            let farthest = self.order[self.order.len() - 1] as usize;
            for &vertex in &self.order[begin..] {
                self.places[vertex as usize] = NONE;
            }
            self.order.truncate(begin);
            self.walk(rows, farthest);
            let set = self.begins.len() as u32 - 1;
            for &vertex in &self.order[begin..] {
                self.owners[vertex as usize] = set;
            }
        }
        self.begins.push(size as u32);
        // Vertices that are all on their own are swept as such.
        self.len() < size
    }

    /// Appends all vertices connected to a vertex, by increasing distance.
    fn walk(&mut self, rows: &Entries<'_, C>, start: usize) {
        let mut next = self.order.len();
        self.places[start] = next as u32;
        self.order.push(start as u32);
        while let Some(&vertex) = self.order.get(next) {
            next += 1;
            for (j, block) in rows.row(vertex as usize) {
                let largest = self.largest[vertex as usize].min(self.largest[j]);
                let strength = coupling(&block);
                if self.places[j] == NONE && strength > 0.0 && strength >= STRONG * largest {
                    self.places[j] = self.order.len() as u32;
                    self.order.push(j as u32);
                }
            }
        }
    }

    /// Allocates the factors; false if they are too large.
    fn reserve(&mut self, rows: &Rows<'_, SMatrix<f64, C, C>>) -> bool {
        let size = self.order.len();
        self.first.clear();
        self.starts.clear();
        let mut entries = 0;
        for place in 0..size {
            let vertex = self.order[place] as usize;
            let own = rows.columns[rows.range(vertex)].iter().map(|&j| j as usize);
            let tied = own.filter(|&j| self.owners[j] == self.owners[vertex]);
            let first = tied.fold(place, |first, j| first.min(self.places[j] as usize));
            self.first.push(first as u32);
            self.starts.push(entries);
            entries += place - first;
        }
        self.starts.push(entries);
        if entries > FILL * rows.columns.len() {
            return false;
        }
        self.factor.resize(entries, SMatrix::zeros());
        self.inverses.resize(size, SMatrix::zeros());
        true
    }

    /// Factorises the part of a set; a vertex whose pivot is not positive is not smoothed.
    fn factorize(
        &mut self,
        set: usize,
        rows: &Rows<'_, SMatrix<f64, C, C>>,
        dropped: &[[bool; C]],
    ) {
        for place in self.range(set) {
            let vertex = self.order[place] as usize;
            let (first, start) = (self.first[place] as usize, self.starts[place]);
            self.factor[start..self.starts[place + 1]].fill(SMatrix::zeros());
            let mut pivot = SMatrix::zeros();
            for (j, block) in rows.row(vertex) {
                let column = self.places[j] as usize;
                if j == vertex {
                    pivot = *block;
                } else if self.owners[j] == self.owners[vertex] && column < place {
                    self.factor[start + column - first] = *block;
                }
            }
            // Row by row: `W = A - L D L^T` of the columns before, then `L = W D^-1`.
            for column in first..place {
                let begin = first.max(self.first[column] as usize);
                let mut value = self.factor[start + column - first];
                for k in begin..column {
                    let other = &self.factor[self.starts[column] + k - self.first[column] as usize];
                    value -= self.factor[start + k - first] * other.transpose();
                }
                self.factor[start + column - first] = value;
            }
            for column in first..place {
                let value = self.factor[start + column - first];
                let scaled = value * self.inverses[column];
                pivot -= scaled * value.transpose();
                self.factor[start + column - first] = scaled;
            }
            self.inverses[place] = inverse(&pivot, &dropped[vertex]).unwrap_or_else(SMatrix::zeros);
        }
    }
}

/// The coupling strength of two vertices. Couplings of different components are left out: they are as large between
/// vertices on the two sides of a cell's long edges as between those on its short ones.
fn coupling<const C: usize>(block: &SMatrix<f64, C, C>) -> f64 {
    (0..C).fold(0.0, |largest: f64, c| largest.max(block[(c, c)].abs()))
}
