//! Stiffnesses without a matrix beside block matrices.

mod changed;
mod diagonal;
mod operator;

use std::sync::{Arc, Mutex};

use nalgebra::SVector;
use stickslip_fem::ElementStiffness;

use crate::{Basis, BeginPart, BlockMatrix, EndPart, IntoOperator, MeshId, ProductByParts, Walls};
use changed::Changed;

/// The format of a scene for explicit steps of large bodies: the sum of stiffnesses
/// [by elements](stickslip_fem::ElementStiffness) and of a block matrix,
///
/// ```text
/// A = sum of s_k A_k + B
/// ```
///
/// Its solver is [`Diagonal`](crate::Diagonal), beside which a scene has a lumped mass. Masses, dashpots and other matrices of
/// finite elements are converted. Implicit steps need rows of the stiffness, which it has not: assemble it by
/// [`elasticity`](stickslip_fem::elasticity) for these.
///
/// ```
/// use nalgebra::Vector2;
/// use stickslip_fem::{Elastic, P1, element_stiffness};
/// use stickslip_solvers::{ElementOperator, IntoOperator, Matrix};
///
/// let space = P1::grid([2.0, 1.0], [4, 2])?;
/// let rock = Elastic { young_modulus: 2.5, poisson_ratio: 0.25 };
/// let operator: ElementOperator<2> = element_stiffness(&space, &rock)?.into_operator();
/// let shift = vec![Vector2::new(1.0, 2.0); space.vertex_count()];
/// assert!(operator.product_at(3, &shift).norm() < 1e-14);
/// # Ok::<(), stickslip_fem::FemError>(())
/// ```
#[derive(Debug)]
#[doc(alias = "matrix-free")]
pub struct ElementOperator<const C: usize> {
    /// The stiffnesses by elements with their factors.
    elements: Vec<(f64, ElementStiffness<C>)>,
    /// Their change to other unknowns; none for those of the mesh.
    basis: Option<Arc<Changed<C>>>,
    /// `B`; none for zero.
    matrix: Option<BlockMatrix<C>>,
    /// A field in the unknowns of the mesh, and some forces; empty before the first product in others.
    memory: Mutex<[Vec<SVector<f64, C>>; 2]>,
}

impl<const C: usize> ElementOperator<C> {
    fn of(elements: Vec<(f64, ElementStiffness<C>)>, matrix: Option<BlockMatrix<C>>) -> Self {
        Self {
            elements,
            basis: None,
            matrix,
            memory: Mutex::default(),
        }
    }

    /// The number of stiffnesses by elements.
    pub fn element_terms(&self) -> usize {
        self.elements.len()
    }

    /// The sum as a block matrix, if there is no term by elements.
    pub(crate) fn matrix(&self) -> Option<&BlockMatrix<C>> {
        self.matrix.as_ref().filter(|_| self.elements.is_empty())
    }

    fn set_basis(&mut self, basis: &Basis<C>) {
        if !self.elements.is_empty() && !basis.is_empty() {
            self.basis = Some(Arc::new(Changed::of(basis)));
        }
    }
}

impl<const C: usize> From<BlockMatrix<C>> for ElementOperator<C> {
    fn from(matrix: BlockMatrix<C>) -> Self {
        Self::of(Vec::new(), Some(matrix))
    }
}

impl<const C: usize> IntoOperator<C> for ElementStiffness<C> {
    type Operator = ElementOperator<C>;

    fn mesh(&self) -> Option<MeshId> {
        Some(Self::mesh(self).into())
    }

    fn walls(&self) -> Vec<Walls> {
        self.split_surfaces().iter().map(Walls::from).collect()
    }

    fn into_operator(self) -> ElementOperator<C> {
        ElementOperator::of(vec![(1.0, self)], None)
    }
}

impl<const C: usize> ProductByParts<C> for ElementStiffness<C> {
    fn lowest_levels(&self) -> &[u8] {
        Self::lowest_levels(self)
    }

    fn multiply_add_by_parts(
        &self,
        weights: &[f64],
        scale: f64,
        x: &[SVector<f64, C>],
        fields: [&mut [SVector<f64, C>]; 3],
        begin: BeginPart<'_, C>,
        end: EndPart<'_, C>,
    ) {
        Self::multiply_add_by_parts(self, weights, scale, x, fields, begin, end);
    }
}
