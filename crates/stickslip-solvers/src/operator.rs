//! Block operators: the interface of the solvers and the time loop.

use nalgebra::{DMatrix, SMatrix, SVector};

use crate::links::Elementary;
use crate::{Basis, MatrixDefect, MeshId, Ranks};

/// An operator on fields of `C` components per vertex: `A` in `y = A x`. Solvers take symmetric ones.
///
/// Implemented for one vertex (`SMatrix<f64, C, C>`, a spring slider), for dense matrices (`DMatrix<f64>`, `C` rows and
/// columns per vertex) and, with the feature `sparse`, for compressed block rows ([`BlockMatrix`](crate::BlockMatrix)).
/// Implement it for a format of your own. Override the products if the whole is cheaper than row by row. The solvers
/// are written for these formats.
///
/// ```
/// use nalgebra::{SMatrix, SVector};
/// use stickslip_solvers::Operator;
///
/// let stiffness = SMatrix::<f64, 1, 1>::new(3.0);
/// let mut force = [SVector::<f64, 1>::new(1.0)];
/// stiffness.multiply_add(2.0, &[SVector::<f64, 1>::new(0.5)], &mut force);
/// assert_eq!(force[0][0], 4.0);
/// ```
pub trait Operator<const C: usize>: Sized + Send + Sync {
    /// The format of a mass beside this operator: `Self`, with [`into_mass`](Operator::into_mass) as the identity, or a
    /// smaller one for a mass with one number per block.
    type Mass: Operator<C>;

    /// The mass in its format.
    fn into_mass(self) -> Self::Mass;

    /// The number of vertices: the number of block rows.
    fn vertex_count(&self) -> usize;

    /// `(A x)_i`, of one vertex.
    fn product_at(&self, i: usize, x: &[SVector<f64, C>]) -> SVector<f64, C>;

    /// `(A x)_i` of some vertices, increasing, one after the other into `products`.
    fn products_at(
        &self,
        vertices: &[usize],
        x: &[SVector<f64, C>],
        products: &mut [SVector<f64, C>],
    ) {
        for (product, &i) in products.iter_mut().zip(vertices) {
            *product = self.product_at(i, x);
        }
    }

    /// The defect of the matrix as an operator, if any; `None` by default, for formats without defects.
    fn defect(&self) -> Option<MatrixDefect> {
        None
    }

    /// `(A + A^T)/2`; `None`, as by default, for formats of symmetric matrices, and those without it. Implicit steps take a
    /// stiffness matrix that is not symmetric by this part and the rest.
    fn symmetric_part(&self) -> Option<Self> {
        None
    }

    /// The mesh or the cells that the operator belongs to; `None` by default, if unknown. A scene refuses parts and
    /// matrices of another one.
    fn mesh(&self) -> Option<MeshId> {
        None
    }

    /// The diagonal block of a vertex.
    fn diagonal_block(&self, i: usize) -> SMatrix<f64, C, C>;

    /// The sum of `factor * operator` over `terms` and of `factor * mass`, on the union of their patterns.
    fn combination_with(terms: &[(f64, &Self)], mass: Option<(f64, &Self::Mass)>) -> Self;

    /// Overwrites `self`, made by [`combination_with`](Operator::combination_with) of operators with the
    /// same patterns, by another combination of them. Allocates nothing.
    fn set_combination_with(&mut self, terms: &[(f64, &Self)], mass: Option<(f64, &Self::Mass)>);

    /// The sum of `factor * operator` over `terms`, on the union of their patterns.
    fn combination(terms: &[(f64, &Self)]) -> Self {
        Self::combination_with(terms, None)
    }

    /// [`set_combination_with`](Operator::set_combination_with) without a mass.
    fn set_combination(&mut self, terms: &[(f64, &Self)]) {
        self.set_combination_with(terms, None);
    }

    /// Adds a symmetric block to the diagonal block of a vertex.
    fn add_to_diagonal(&mut self, i: usize, block: &SMatrix<f64, C, C>);

    /// Changes the operator to other unknowns, `T^T A T`. False, as by default, if its format has no local axes or no
    /// links; the operator then stays as it is.
    fn change_basis(&mut self, basis: &Basis<C>) -> bool {
        basis.is_empty()
    }

    /// `y += scale A x`; both fields have one entry per vertex.
    fn multiply_add(&self, scale: f64, x: &[SVector<f64, C>], y: &mut [SVector<f64, C>]) {
        for (i, y) in y.iter_mut().enumerate() {
            *y += self.product_at(i, x) * scale;
        }
    }

    /// `x . A x`.
    fn quadratic(&self, x: &[SVector<f64, C>]) -> f64 {
        let terms = x.iter().enumerate();
        terms.map(|(i, x_i)| x_i.dot(&self.product_at(i, x))).sum()
    }

    /// The processes that share the vertices; one by default.
    ///
    /// An operator on several processes overrides [`multiply_add`](Operator::multiply_add),
    /// [`products_at`](Operator::products_at) and [`quadratic`](Operator::quadratic), too, which all processes call
    /// together.
    fn ranks(&self) -> Ranks {
        Ranks::default()
    }

    /// `sqrt(x . A x)`: zero for a square that rounding made negative, NaN for a NaN.
    fn norm(&self, x: &[SVector<f64, C>]) -> f64 {
        let square = self.quadratic(x);
        if square < 0.0 { 0.0 } else { square.sqrt() }
    }
}

impl<const C: usize> Operator<C> for SMatrix<f64, C, C> {
    type Mass = Self;

    fn into_mass(self) -> Self {
        self
    }

    fn vertex_count(&self) -> usize {
        1
    }

    fn product_at(&self, _: usize, x: &[SVector<f64, C>]) -> SVector<f64, C> {
        self * x[0]
    }

    fn diagonal_block(&self, _: usize) -> SMatrix<f64, C, C> {
        *self
    }

    fn add_to_diagonal(&mut self, _: usize, block: &SMatrix<f64, C, C>) {
        *self += block;
    }

    fn combination_with(terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) -> Self {
        let terms = terms.iter().copied().chain(mass);
        terms.fold(Self::zeros(), |sum, (factor, term)| sum + *term * factor)
    }

    fn set_combination_with(&mut self, terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) {
        *self = Self::combination_with(terms, mass);
    }

    fn change_basis(&mut self, basis: &Basis<C>) -> bool {
        *self = basis.axes.block_to_frames((0, 0), *self);
        basis.links.is_empty()
    }
}

/// Row and column `C i + c` belong to component `c` of vertex `i`.
impl<const C: usize> Operator<C> for DMatrix<f64> {
    type Mass = Self;

    fn into_mass(self) -> Self {
        self
    }

    fn vertex_count(&self) -> usize {
        self.nrows() / C
    }

    fn defect(&self) -> Option<MatrixDefect> {
        let (rows, columns) = self.shape();
        if rows != columns {
            Some(MatrixDefect::NotSquare { rows, columns })
        } else if !rows.is_multiple_of(C) {
            let components = C;
            Some(MatrixDefect::NoBlocks { rows, components })
        } else {
            None
        }
    }

    fn product_at(&self, i: usize, x: &[SVector<f64, C>]) -> SVector<f64, C> {
        SVector::from_fn(|c, _| {
            let entry = |j: usize, r: usize| self[(C * i + c, C * j + r)];
            (x.iter().enumerate())
                .map(|(j, x)| (0..C).map(|r| entry(j, r) * x[r]).sum::<f64>())
                .sum()
        })
    }

    /// The products of some rows at a time: by columns, which are contiguous, in the order of
    /// [`product_at`](Operator::product_at).
    fn multiply_add(&self, scale: f64, x: &[SVector<f64, C>], y: &mut [SVector<f64, C>]) {
        const ROWS: usize = 8;
        let rows = self.nrows();
        for first in (0..rows).step_by(ROWS) {
            let count = ROWS.min(rows - first);
            let mut sums = [0.0; ROWS];
            for (j, x) in x.iter().enumerate() {
                let mut parts = [0.0; ROWS];
                for r in 0..C {
                    let column = &self.as_slice()[(C * j + r) * rows + first..][..count];
                    for (part, entry) in parts.iter_mut().zip(column) {
                        *part += entry * x[r];
                    }
                }
                for (sum, part) in sums.iter_mut().zip(parts) {
                    *sum += part;
                }
            }
            for (row, sum) in (first..).zip(&sums[..count]) {
                y[row / C][row % C] += sum * scale;
            }
        }
    }

    fn symmetric_part(&self) -> Option<Self> {
        Some((self + self.transpose()) * 0.5)
    }

    fn diagonal_block(&self, i: usize) -> SMatrix<f64, C, C> {
        self.fixed_view::<C, C>(C * i, C * i).into_owned()
    }

    fn add_to_diagonal(&mut self, i: usize, block: &SMatrix<f64, C, C>) {
        let mut own = self.fixed_view_mut::<C, C>(C * i, C * i);
        own += block;
    }

    fn change_basis(&mut self, basis: &Basis<C>) -> bool {
        basis.links.congruent(|step| match step {
            Elementary::Add { from, to, share } => {
                let rows = self.fixed_rows::<C>(C * from) * share;
                let mut target = self.fixed_rows_mut::<C>(C * to);
                target += rows;
                let columns = self.fixed_columns::<C>(C * from) * share;
                let mut target = self.fixed_columns_mut::<C>(C * to);
                target += columns;
            }
            Elementary::Negate(i) => {
                self.fixed_rows_mut::<C>(C * i).neg_mut();
                self.fixed_columns_mut::<C>(C * i).neg_mut();
            }
        });
        for (i, axes) in basis.axes.iter() {
            let rows = axes.tr_mul(&self.fixed_rows::<C>(C * i));
            self.fixed_rows_mut::<C>(C * i).copy_from(&rows);
            let columns = self.fixed_columns::<C>(C * i) * axes;
            self.fixed_columns_mut::<C>(C * i).copy_from(&columns);
        }
        true
    }

    fn combination_with(terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) -> Self {
        let first = terms.first().copied().or(mass);
        let size = first.map_or(0, |(_, term)| term.nrows());
        let mut sum = Self::zeros(size, size);
        Operator::<C>::set_combination_with(&mut sum, terms, mass);
        sum
    }

    fn set_combination_with(&mut self, terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) {
        self.fill(0.0);
        for (factor, term) in terms.iter().copied().chain(mass) {
            for (sum, value) in self.iter_mut().zip(term.iter()) {
                *sum += factor * value;
            }
        }
    }
}
