//! The change of basis of a body: local axes, and jumps across faults.

use nalgebra::SVector;

use crate::{Frames, Links, Matrix};

/// The unknowns of a body: along local axes at some vertices, and jumps at the copies of others.
///
/// With `R` the [axes](Frames) and `L` the [links](Links) between copies of a vertex, vectors `x`, forces `r` and
/// operators `A` of the body become
///
/// ```text
/// x = T x',    r' = T^T r,    A' = T^T A T,    T = L R
/// ```
///
/// The jump of a pair is along the axes of its linked vertex: its normal component is one to fix, and friction acts on
/// the others as on the velocity of a body on a rigid surface.
///
/// ```
/// use nalgebra::{DMatrix, SVector};
/// use stickslip_solvers::{Basis, Link, Links, Matrix, Operator};
///
/// // Vertex 1 is the copy of vertex 0 on the plus side of a fault, and vertex 2 is connected to it by a spring.
/// let mut basis = Basis::<1>::none(3);
/// basis.links = Links::new([Link::new(1, vec![0])]);
/// let mut spring = DMatrix::from_row_slice(3, 3, &[0.0, 0.0, 0.0, 0.0, 5.0, -5.0, 0.0, -5.0, 5.0]);
/// assert!(Operator::<1>::change_basis(&mut spring, &basis));
/// // Both the minus side and the jump move the end of the spring.
/// assert_eq!(spring, DMatrix::from_row_slice(3, 3, &[5.0, 5.0, -5.0, 5.0, 5.0, -5.0, -5.0, -5.0, 5.0]));
/// let mut field = [2.0, 3.0, 0.0].map(|x| SVector::from([x]));
/// basis.field_to_coordinates(&mut field);
/// assert_eq!(field[1][0], 5.0);
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Basis<const C: usize> {
    /// `R`.
    pub axes: Frames<C>,
    /// `L`.
    pub links: Links,
}

impl<const C: usize> Basis<C> {
    /// The coordinates of so many vertices, without links.
    pub fn none(vertices: usize) -> Self {
        Self {
            axes: Frames::none(vertices),
            links: Links::none(),
        }
    }

    /// Whether all vertices keep the coordinates, and none is linked.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.axes.is_empty() && self.links.is_empty()
    }

    /// `x' = T^-1 x` of a field, one vector per vertex, in place.
    pub fn field_to_basis(&self, field: &mut [SVector<f64, C>]) {
        self.links.part(field);
        self.axes.field_to_frames(field);
    }

    /// `x = T x'` of a field, one vector per vertex, in place.
    pub fn field_to_coordinates(&self, field: &mut [SVector<f64, C>]) {
        self.axes.field_to_coordinates(field);
        self.links.join(field);
    }

    /// `r' = T^T r` of forces, one vector per vertex, in place.
    pub fn forces_to_basis(&self, forces: &mut [SVector<f64, C>]) {
        self.links.gather(forces);
        self.axes.field_to_frames(forces);
    }

    /// `r = T^-T r'` of forces, one vector per vertex, in place.
    pub fn forces_to_coordinates(&self, forces: &mut [SVector<f64, C>]) {
        self.axes.field_to_coordinates(forces);
        self.links.scatter(forces);
    }

    /// Orthonormal directions, in coordinates, in which a translation of the body moves no `fixed` component:
    /// coordinate axes, as far as these are among them. Returns the directions and their number. Jumps do not move.
    pub fn free_translations(&self, fixed: &[[bool; C]]) -> ([SVector<f64, C>; C], usize) {
        if self.links.is_empty() {
            return self.axes.free_translations(fixed);
        }
        let mut fixed = fixed.to_vec();
        for link in self.links.iter() {
            fixed[link.vertex] = [false; C];
        }
        self.axes.free_translations(&fixed)
    }

    /// Whether an operator has no resistance to a translation of the whole body in a direction in coordinates; `shift`,
    /// one vector per vertex, becomes that translation.
    pub fn moves_freely(
        &self,
        operator: &dyn Matrix<C>,
        direction: &SVector<f64, C>,
        shift: &mut [SVector<f64, C>],
    ) -> bool {
        const ROUNDING: f64 = 1e-10;
        shift.fill(*direction);
        self.field_to_basis(shift);
        (0..shift.len()).all(|i| {
            let block = operator.diagonal_block(i);
            // That of a jump, which does not move, is the scale of its row.
            let own = shift[i].dot(&(block * shift[i]));
            let scale = if own > 0.0 {
                own
            } else {
                block.diagonal().max() * direction.norm_squared()
            };
            operator.product_at(i, shift).amax() <= ROUNDING * scale
        })
    }
}

impl<const C: usize> From<Frames<C>> for Basis<C> {
    fn from(axes: Frames<C>) -> Self {
        Self {
            axes,
            links: Links::none(),
        }
    }
}
