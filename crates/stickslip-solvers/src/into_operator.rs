use crate::{Matrix, MeshId, Operator, Walls};

/// Anything that a scene accepts as an operator: any [`Operator`], and with the feature `fem` a matrix assembled on a
/// mesh, with the identity of that mesh.
///
#[cfg_attr(feature = "fem", doc = "```")]
#[cfg_attr(not(feature = "fem"), doc = "```ignore")]
/// use stickslip_fem::{P1, antiplane};
/// use stickslip_solvers::{BlockMatrix, IntoOperator};
///
/// let space = P1::grid([2.0, 1.0], [2, 1])?;
/// let assembled = antiplane(&space, 1.0)?;
/// assert_eq!(IntoOperator::<1>::mesh(&assembled), Some(space.mesh().identity().into()));
/// let matrix: BlockMatrix<1> = assembled.into_operator();
/// assert_eq!(IntoOperator::<1>::mesh(&matrix), None);
/// # Ok::<(), stickslip_fem::FemError>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no operator on fields of {C} components",
    note = "a scene takes matrices by value: without `&`, and no `Result` of one: `?`",
    note = "what finite elements assemble is `Assembled<{C}>`, with as many components as the scene; for a format of your own implement `stickslip::Operator<{C}>`"
)]
pub trait IntoOperator<const C: usize> {
    /// The resulting operator.
    type Operator: Operator<C>;

    /// The mesh it was assembled on; `None` if unknown.
    fn mesh(&self) -> Option<MeshId>;

    /// The walls of the surfaces along which that mesh was split; none if unknown.
    fn walls(&self) -> Vec<Walls> {
        Vec::new()
    }

    /// The operator alone.
    fn into_operator(self) -> Self::Operator;
}

impl<const C: usize, Op: Operator<C>> IntoOperator<C> for Op {
    type Operator = Self;

    fn mesh(&self) -> Option<MeshId> {
        Matrix::mesh(self)
    }

    fn into_operator(self) -> Self {
        self
    }
}

#[cfg(feature = "fem")]
impl<const C: usize> IntoOperator<C> for stickslip_fem::Assembled<C> {
    type Operator = crate::BlockMatrix<C>;

    fn mesh(&self) -> Option<MeshId> {
        Some(Self::mesh(self).into())
    }

    fn walls(&self) -> Vec<Walls> {
        self.split_surfaces().iter().map(Walls::from).collect()
    }

    fn into_operator(self) -> crate::BlockMatrix<C> {
        self.into_matrix()
    }
}
