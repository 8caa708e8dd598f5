//! Block operators: matrices with the algebra of a time step.

use std::any::type_name;

use nalgebra::{SMatrix, SVector};

use crate::{Basis, Matrix};

/// A [`Matrix`] of which sums are formed: the format of the matrices of a scene.
///
/// Implemented for one vertex (`SMatrix<f64, C, C>`, a spring slider), for dense matrices (`DMatrix<f64>`, `C` rows and
/// columns per vertex) and, with the feature `sparse`, for compressed block rows ([`BlockMatrix`](crate::BlockMatrix)).
/// Implement both traits for a format of your own. Override the products if the whole is cheaper than row by row. The
/// solvers are written for these formats.
///
/// ```
/// use nalgebra::SMatrix;
/// use stickslip_solvers::{Matrix, Operator};
///
/// let (stiffness, viscosity) = (SMatrix::<f64, 1, 1>::new(3.0), SMatrix::<f64, 1, 1>::new(0.5));
/// let step = Operator::<1>::combination(&[(2.0, &stiffness), (1.0, &viscosity)]);
/// assert_eq!(step[0], 6.5);
/// ```
pub trait Operator<const C: usize>: Matrix<C> + Sized + 'static {
    /// The format of a mass beside this operator: `Self`, with [`into_mass`](Operator::into_mass) as the identity, or a
    /// smaller one for a mass with one number per block.
    type Mass: Operator<C>;

    /// The mass in its format.
    fn into_mass(self) -> Self::Mass;

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

    /// `(A + A^T)/2`; `None`, as by default, for formats of symmetric matrices, and those without it. Implicit steps take a
    /// stiffness matrix that is not symmetric by this part and the rest.
    fn symmetric_part(&self) -> Option<Self> {
        None
    }

    /// Whether operators of this format have rows, as solvers of implicit steps need them; true by default. Without, as with a
    /// stiffness by elements, a scene takes explicit schemes alone.
    fn has_rows() -> bool {
        true
    }

    /// The name of the format in messages; that of its type by default.
    fn format() -> &'static str {
        type_name::<Self>()
    }

    /// The factor of an operator that is a multiple of another one by its construction, `self = factor other`. None, as by
    /// default, unless the format knows. A body whose viscosity is a multiple of its stiffness has the forces of both by one
    /// product in explicit steps.
    fn multiple_of(&self, _other: &Self) -> Option<f64> {
        None
    }

    /// Changes the operator to other unknowns, `T^T A T`. False, as by default, if its format has no local axes or no
    /// links; the operator then stays as it is.
    fn change_basis(&mut self, basis: &Basis<C>) -> bool {
        basis.is_empty()
    }
}

impl<const C: usize> Matrix<C> for SMatrix<f64, C, C> {
    fn vertex_count(&self) -> usize {
        1
    }

    fn product_at(&self, _: usize, x: &[SVector<f64, C>]) -> SVector<f64, C> {
        self * x[0]
    }

    fn diagonal_block(&self, _: usize) -> SMatrix<f64, C, C> {
        *self
    }
}

impl<const C: usize> Operator<C> for SMatrix<f64, C, C> {
    type Mass = Self;

    fn into_mass(self) -> Self {
        self
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

    fn format() -> &'static str {
        "SMatrix"
    }
}
