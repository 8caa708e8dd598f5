//! Boxes of equal bricks, cut into simplices.

use nalgebra::SVector;

use crate::numbering::sweep_axes;
use crate::{FemError, Mesh};

/// The diagonal that cuts the rectangles of a two-dimensional grid into triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum GridDiagonal {
    /// From the lower left to the upper right corner.
    Rising,
    /// From the upper left to the lower right corner.
    Falling,
}

impl Mesh<2> {
    /// The rectangle [0, size_0] x [0, size_1] \[m\] of cells_0 x cells_1 equal rectangles, two triangles each.
    ///
    /// Vertices are numbered along the shorter side first. Coordinates on the boundary are exact: 0 or the size.
    ///
    /// # Errors
    ///
    /// [`FemError::Value`] unless sizes are positive and finite and there are cells along each axis,
    /// [`FemError::TooMany`] from 2^32 vertices on.
    ///
    /// ```
    /// use stickslip_fem::{GridDiagonal, Mesh};
    ///
    /// let mesh = Mesh::<2>::grid([5.0, 1.0], [5, 1], GridDiagonal::Rising)?;
    /// assert_eq!((mesh.vertex_count(), mesh.cell_count()), (12, 10));
    /// # Ok::<(), stickslip_fem::FemError>(())
    /// ```
    pub fn grid(
        size: [f64; 2],
        cells: [usize; 2],
        diagonal: GridDiagonal,
    ) -> Result<Self, FemError> {
        kuhn(size, cells, diagonal == GridDiagonal::Falling)
    }
}

impl Mesh<3> {
    /// The box [0, size_0] x [0, size_1] x [0, size_2] \[m\] of equal bricks, six tetrahedra each (Kuhn's).
    ///
    /// The three pairs of opposite faces carry equal triangulations, and the tetrahedra refine into
    /// tetrahedra of their own shape. Numbering, exactness and errors are those of [`Mesh::<2>::grid`].
    ///
    /// ```
    /// use stickslip_fem::Mesh;
    ///
    /// let mesh = Mesh::<3>::grid([2.0, 1.0, 1.0], [2, 1, 1])?;
    /// assert_eq!((mesh.vertex_count(), mesh.cell_count()), (12, 12));
    /// # Ok::<(), stickslip_fem::FemError>(())
    /// ```
    pub fn grid(size: [f64; 3], cells: [usize; 3]) -> Result<Self, FemError> {
        kuhn(size, cells, false)
    }
}

/// Paths along the edges of a brick from one corner to the opposite one, and whether their order is odd.
const PATHS_2: &[(&[usize], bool)] = &[(&[0, 1], false), (&[1, 0], true)];
const PATHS_3: &[(&[usize], bool)] = &[
    (&[0, 1, 2], false),
    (&[1, 2, 0], false),
    (&[2, 0, 1], false),
    (&[0, 2, 1], true),
    (&[2, 1, 0], true),
    (&[1, 0, 2], true),
];

/// Kuhn's triangulation: one simplex per path. `reflect` starts the paths at the far end of axis 0.
pub(crate) fn kuhn<const D: usize>(
    size: [f64; D],
    cells: [usize; D],
    reflect: bool,
) -> Result<Mesh<D>, FemError> {
    let layout = Layout::new(size, cells)?;
    let vertices = (0..layout.vertices)
        .map(|index| layout.point(index))
        .collect();
    let paths = if D == 2 { PATHS_2 } else { PATHS_3 };
    let mut corners = Vec::new();
    let mut mirrored = Vec::new();
    for brick in layout.bricks() {
        for &(path, odd) in paths {
            let first = corners.len();
            let mut at = brick;
            at[0] += usize::from(reflect);
            corners.push(layout.index(at));
            for &axis in path {
                at[axis] = if reflect && axis == 0 {
                    brick[0]
                } else {
                    brick[axis] + 1
                };
                corners.push(layout.index(at));
            }
            if odd != reflect {
                corners.swap(first, first + 1);
            }
            mirrored.push(odd != reflect);
        }
    }
    Mesh::checked(vertices, corners, mirrored)
}

struct Layout<const D: usize> {
    size: [f64; D],
    cells: [usize; D],
    /// Slowest first.
    axes: [usize; D],
    strides: [usize; D],
    vertices: usize,
}

/// The names of the sizes by axis.
const SIZES: [&str; 3] = [
    "size [m] along axis 0",
    "size [m] along axis 1",
    "size [m] along axis 2",
];
const COUNTS: [&str; 3] = [
    "number of cells along axis 0",
    "number of cells along axis 1",
    "number of cells along axis 2",
];

impl<const D: usize> Layout<D> {
    fn new(size: [f64; D], cells: [usize; D]) -> Result<Self, FemError> {
        let axes = sweep_axes(&size);
        for axis in 0..D {
            FemError::positive(SIZES[axis], size[axis])?;
            let count = cells[axis];
            FemError::check(COUNTS[axis], "at least 1", count as f64, count > 0)?;
        }
        let count = cells.iter().fold(1_u64, |count, &n| {
            count.saturating_mul((n as u64).saturating_add(1))
        });
        if count > u64::from(u32::MAX) {
            return Err(FemError::too_many("vertices", count));
        }
        let mut strides = [0; D];
        let mut vertices = 1;
        for &axis in axes.iter().rev() {
            strides[axis] = vertices;
            vertices *= cells[axis] + 1;
        }
        Ok(Self {
            size,
            cells,
            axes,
            strides,
            vertices,
        })
    }

    fn index(&self, at: [usize; D]) -> u32 {
        at.iter()
            .zip(self.strides)
            .map(|(&i, stride)| i * stride)
            .sum::<usize>() as u32
    }

    /// The far end is the size itself: size * n / n can differ from it by rounding.
    fn point(&self, index: usize) -> SVector<f64, D> {
        SVector::from_fn(|axis, _| {
            let (n, size) = (self.cells[axis], self.size[axis]);
            let i = index / self.strides[axis] % (n + 1);
            if i == n {
                size
            } else {
                size * i as f64 / n as f64
            }
        })
    }

    fn bricks(&self) -> impl Iterator<Item = [usize; D]> {
        let count: usize = self.cells.iter().product();
        (0..count).map(move |mut index| {
            let mut brick = [0; D];
            for &axis in self.axes.iter().rev() {
                brick[axis] = index % self.cells[axis];
                index /= self.cells[axis];
            }
            brick
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbering::sweep_order;

    #[test]
    fn grids_are_numbered_like_their_refinements() {
        for (size, cells) in [
            ([5.0, 1.0], [7, 3]),
            ([0.3, 0.7], [3, 11]),
            ([1.0, 1.0], [6, 2]),
        ] {
            let mesh = Mesh::<2>::grid(size, cells, GridDiagonal::Falling).expect("valid grid");
            assert!(
                sweep_order(mesh.vertices())
                    .into_iter()
                    .eq(0..mesh.vertex_count() as u32)
            );
        }
        let mesh = Mesh::<3>::grid([0.1, 0.7, 0.3], [3, 5, 7]).expect("valid grid");
        assert!(
            sweep_order(mesh.vertices())
                .into_iter()
                .eq(0..mesh.vertex_count() as u32)
        );
    }
}
