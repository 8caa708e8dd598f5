//! Elimination of frictionless unknowns: vertices without friction, modes.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{cholesky_in_place, cholesky_in_place_scratch};
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::reborrow::{Reborrow, ReborrowMut};
use faer::{Accum, MatMut, MatRef, Par, Spec};
use nalgebra::SVector;

use super::kernels::{dot, subtract};
use super::{DenseOperator, Unknowns};

/// `B_II = L L^T`, `W = L^-1 B_IF`, and the load that is being condensed.
pub(super) struct Elimination<const C: usize> {
    /// Vertex and component of each eliminated unknown.
    owners: Vec<(usize, usize)>,
    /// `L`, by columns.
    factor: Vec<f64>,
    /// `W`, by columns, one per frictional unknown.
    coupling: Vec<f64>,
    /// `L^-1 r_I` of the condensed load.
    load: Vec<f64>,
    x: Vec<f64>,
    memory: MemBuffer,
}

impl<const C: usize> std::fmt::Debug for Elimination<C> {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter
            .debug_struct("Elimination")
            .field("unknowns", &self.owners.len())
            .finish_non_exhaustive()
    }
}

impl<const C: usize> Elimination<C> {
    /// Allocates for these unknowns, coupled to `frictional` others; `None` without the memory.
    pub(super) fn new(owners: Vec<(usize, usize)>, frictional: usize) -> Option<Self> {
        let count = owners.len();
        let request = cholesky_in_place_scratch::<f64>(count, Par::Seq, Spec::default());
        Some(Self {
            factor: vec![0.0; count * count],
            coupling: vec![0.0; count * frictional],
            load: vec![0.0; count],
            x: vec![0.0; count],
            memory: MemBuffer::try_new(request).ok()?,
            owners,
        })
    }

    /// Factorises, and subtracts `W^T W` from `schur`; false if the operator is not definite on the eliminated
    /// unknowns.
    pub(super) fn eliminate<Op: DenseOperator<C>>(
        &mut self,
        operator: &Op,
        frictional: &[(usize, usize)],
        schur: &mut [f64],
    ) -> bool {
        let (count, left) = (self.owners.len(), frictional.len());
        for (j, &column) in self.owners.iter().enumerate() {
            for (i, &row) in self.owners.iter().enumerate().skip(j) {
                self.factor[j * count + i] = operator.at(row, column);
            }
        }
        for (j, &column) in frictional.iter().enumerate() {
            for (i, &row) in self.owners.iter().enumerate() {
                self.coupling[j * count + i] = operator.at(row, column);
            }
        }
        let (factor, coupling) = (&mut self.factor, &mut self.coupling);
        eliminate([count, left], factor, coupling, schur, &mut self.memory)
    }

    /// `L^-1 r_I`, and the remaining forces on the frictional vertices.
    pub(super) fn forward(&mut self, load: impl Fn((usize, usize)) -> f64, force: &mut [f64]) {
        let count = self.owners.len();
        for (x, &owner) in self.load.iter_mut().zip(&self.owners) {
            *x = load(owner);
        }
        for j in 0..count {
            let (known, rest) = self.load.split_at_mut(j + 1);
            let column = &self.factor[j * count..][..count];
            known[j] /= column[j];
            subtract(&column[j + 1..], known[j], rest);
        }
        for (force, column) in force
            .iter_mut()
            .zip(self.coupling.chunks_exact(count.max(1)))
        {
            *force -= dot(column, &self.load);
        }
    }

    /// The eliminated components of `v` for the frictional ones `y`; without the load the response to a change.
    pub(super) fn backward(
        &mut self,
        loaded: bool,
        y: impl Fn(usize) -> f64,
        v: &mut [SVector<f64, C>],
    ) {
        let count = self.owners.len();
        if loaded {
            self.x.copy_from_slice(&self.load);
        } else {
            self.x.fill(0.0);
        }
        for (j, column) in self.coupling.chunks_exact(count.max(1)).enumerate() {
            subtract(column, y(j), &mut self.x);
        }
        for j in (0..count).rev() {
            let column = &self.factor[j * count..][..count];
            let sum = dot(&column[j + 1..], &self.x[j + 1..]);
            self.x[j] = (self.x[j] - sum) / column[j];
        }
        for (x, &(p, c)) in self.x.iter().zip(&self.owners) {
            v[p][c] = *x;
        }
    }
}

impl<const C: usize> Elimination<C> {
    /// `E^T N E` for the changes `E y` by the frictional unknowns: with `Z = -L^-T W`,
    /// `N_FF + N_FI Z + Z^T N_IF + Z^T N_II Z`.
    pub(super) fn congruence<Op: DenseOperator<C>>(
        &self,
        norm: &Op,
        frictional: &[(usize, usize)],
        into: &mut [f64],
    ) {
        let (count, left) = (self.owners.len(), frictional.len());
        let mut image = vec![0.0; count * left];
        for (j, &column) in frictional.iter().enumerate() {
            for (i, &row) in self.owners.iter().enumerate() {
                image[j * count + i] = norm.at(row, column);
            }
        }
        let mut inner = vec![0.0; count * count];
        for (j, &column) in self.owners.iter().enumerate() {
            for (i, &row) in self.owners.iter().enumerate() {
                inner[j * count + i] = norm.at(row, column);
            }
        }
        condense(
            [count, left],
            (&self.factor, &self.coupling),
            (&inner, &mut image),
            into,
        );
    }
}

// What neither dimension nor operator changes is compiled once.

/// `L` and `W` in place of `B_II` and `B_IF`, of `count` rows and `left` columns, and `schur` minus `W^T W`; false if
/// `B_II` is not definite.
fn eliminate(
    [count, left]: [usize; 2],
    factor: &mut [f64],
    coupling: &mut [f64],
    schur: &mut [f64],
    memory: &mut MemBuffer,
) -> bool {
    let mut factor = MatMut::from_column_major_slice_mut(factor, count, count);
    let (stack, spec) = (MemStack::new(memory), Spec::default());
    if cholesky_in_place(factor.rb_mut(), Default::default(), Par::Seq, stack, spec).is_err() {
        return false;
    }
    let mut coupling = MatMut::from_column_major_slice_mut(coupling, count, left);
    solve_lower_triangular_in_place(factor.rb(), coupling.rb_mut(), Par::Seq);
    matmul(
        MatMut::from_column_major_slice_mut(schur, left, left),
        Accum::Add,
        coupling.rb().transpose(),
        coupling.rb(),
        -1.0,
        Par::Seq,
    );
    // Symmetric up to rounding; both triangles are read.
    for i in 0..left {
        for j in 0..i {
            schur[i * left + j] = schur[j * left + i];
        }
    }
    true
}

/// Adds `N_FI Z + Z^T N_IF + Z^T N_II Z`, from `N_II` and, in `image`, `N_IF`.
fn condense(
    [count, left]: [usize; 2],
    (factor, coupling): (&[f64], &[f64]),
    (inner, image): (&[f64], &mut [f64]),
    into: &mut [f64],
) {
    let mut z = coupling.to_vec();
    z.iter_mut().for_each(|z| *z = -*z);
    let factor = MatRef::from_column_major_slice(factor, count, count);
    let mut z = MatMut::from_column_major_slice_mut(&mut z, count, left);
    solve_upper_triangular_in_place(factor.transpose(), z.rb_mut(), Par::Seq);
    let (z, inner) = (z.rb(), MatRef::from_column_major_slice(inner, count, count));
    // N_II Z / 2 + N_IF
    let mut image = MatMut::from_column_major_slice_mut(image, count, left);
    matmul(image.rb_mut(), Accum::Add, inner, z, 0.5, Par::Seq);
    let image = image.rb();
    for (a, b) in [(z, image), (image, z)] {
        let into = MatMut::from_column_major_slice_mut(into, left, left);
        matmul(into, Accum::Add, a.transpose(), b, 1.0, Par::Seq);
    }
}

/// The frictional unknowns, and those of vertices without friction.
pub(super) fn split<const C: usize>(
    fixed: &[[bool; C]],
    vertices: &[usize],
) -> (Unknowns<C>, Vec<(usize, usize)>) {
    let of_frictional: Vec<_> = vertices.iter().map(|&vertex| fixed[vertex]).collect();
    let mut is_frictional = vec![false; fixed.len()];
    vertices
        .iter()
        .for_each(|&vertex| is_frictional[vertex] = true);
    let interior = (0..fixed.len()).filter(|&p| !is_frictional[p]);
    let owners = interior.flat_map(|p| (0..C).map(move |c| (p, c)));
    let owners = owners.filter(|&(p, c)| !fixed[p][c]).collect();
    (Unknowns::of_free(&of_frictional), owners)
}
