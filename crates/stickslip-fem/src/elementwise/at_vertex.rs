//! Rows of the stiffness, cell by cell.

use nalgebra::{SMatrix, SVector};

use super::ElementStiffness;
use super::lanes::numbers;
use crate::simplex::{MAX_CORNERS, Simplex};

/// A cell with its place and its material.
struct Cell<const D: usize> {
    simplex: Simplex<D>,
    /// Its vertices.
    corners: [usize; MAX_CORNERS],
    lambda: f64,
    mu: f64,
}

impl<const D: usize> ElementStiffness<D> {
    /// The cells of a vertex.
    fn cells_of(&self, vertex: usize) -> impl Iterator<Item = Cell<D>> {
        let groups = &self.elements.groups;
        self.elements.copies.cells(vertex).map(move |(row, cell)| {
            let group = groups.group_of(row);
            let begin = groups.starts[group];
            let corners = groups.corners(group, row);
            let place = |k: usize| begin + usize::from(corners[k.min(D)][cell]);
            let positions: [SVector<f64, D>; MAX_CORNERS] = std::array::from_fn(|k| {
                let x = numbers(groups.positions[place(k)]);
                SVector::from_fn(|c, _| x[c])
            });
            let (lambda, mu) = self.lame.of_cell(row, cell);
            let mut simplex = Simplex::new(&positions, &[0, 1, 2, 3][..=D]);
            // Chains number the corners of a cell in either orientation.
            simplex.volume = simplex.volume.abs();
            Cell {
                simplex,
                corners: std::array::from_fn(|k| groups.vertices[place(k)] as usize),
                lambda: self.factor * lambda,
                mu: self.factor * mu,
            }
        })
    }

    /// `(A x)_i` \[N\]; with D = 2 \[N/m\].
    ///
    /// # Panics
    /// Unless `i` is below [`vertex_count`](Self::vertex_count), and `x` has a vector for each vertex.
    pub fn product_at(&self, i: usize, x: &[SVector<f64, D>]) -> SVector<f64, D> {
        self.product_with(i, |p| x[p])
    }

    /// [`product_at`](Self::product_at) for a field by a function of the vertex, which is called for those that share a cell
    /// with `i`.
    ///
    /// # Panics
    /// Unless `i` is below [`vertex_count`](Self::vertex_count).
    pub fn product_with(&self, i: usize, x: impl Fn(usize) -> SVector<f64, D>) -> SVector<f64, D> {
        let mut force = SVector::zeros();
        for cell in self.cells_of(i) {
            let (simplex, corners) = (&cell.simplex, &cell.corners[..=D]);
            let mut h = SMatrix::<f64, D, D>::zeros();
            for (gradient, &p) in simplex.gradients.iter().zip(corners).skip(1) {
                h += (x(p) - x(corners[0])) * gradient.transpose();
            }
            let pressure = SMatrix::from_diagonal_element(cell.lambda * h.trace());
            let stress = (h + h.transpose()) * cell.mu + pressure;
            for (gradient, _) in simplex
                .gradients
                .iter()
                .zip(corners)
                .filter(|(_, p)| **p == i)
            {
                force += stress * gradient * simplex.volume;
            }
        }
        force
    }

    /// The diagonal block of a vertex [N/m]; with D = 2 \[Pa\].
    ///
    /// # Panics
    /// Unless `i` is below [`vertex_count`](Self::vertex_count).
    pub fn diagonal_block(&self, i: usize) -> SMatrix<f64, D, D> {
        let mut block = SMatrix::zeros();
        for cell in self.cells_of(i) {
            let simplex = &cell.simplex;
            let own = simplex.gradients.iter().zip(&cell.corners[..=D]);
            for (g, _) in own.filter(|(_, p)| **p == i) {
                let along = g * g.transpose() * (cell.lambda + cell.mu);
                let shear = SMatrix::from_diagonal_element(cell.mu * g.norm_squared());
                block += (along + shear) * simplex.volume;
            }
        }
        block
    }
}
