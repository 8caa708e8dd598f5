//! Bisection of one cell: newest-vertex bisection of triangles, and of tetrahedra with marked faces.
//!
//! The first two corners of a cell are the ends of the edge that is halved next. In a triangle that edge is opposite to
//! the newest vertex. In a tetrahedron every face has a marked edge, and is itself cut as by newest-vertex bisection.
//! The two faces at the halved edge have it as their mark; the marks of the other two are in the [`Tag`]. Two cells
//! agree on the mark of their common face: further bisections always remove hanging nodes, and their number is finite.
//! Source: D. Arnold, A. Mukherjee, L. Pouly, "Locally adapted tetrahedral meshes
//! using bisection", SIAM J. Sci. Comput. 22 (2000), 431-448; in the plane E. Sewell (1972), W. Mitchell (1991).

use std::cmp::Ordering;

use nalgebra::SVector;

use crate::Mesh;
use crate::cut::coinciding;
use crate::marks::{Marks, Tag};
use crate::simplex::MAX_CORNERS;

/// A positively ordered cell; corners from D + 1 on are zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cell {
    pub(crate) corners: [u32; MAX_CORNERS],
    pub(crate) tag: Tag,
}

impl Cell {
    /// The cells of a mesh: as bisection left them, or marked by their longest edges.
    pub(crate) fn all<const D: usize>(mesh: &Mesh<D>) -> Vec<Self> {
        match &mesh.marks {
            Marks::Reflected(_) => {
                // Both sides of a fault are marked alike.
                let copies = coinciding(&mesh.surfaces.cuts, mesh.vertex_count());
                (mesh.cells())
                    .map(|cell| Self::by_longest_edge(&mesh.vertices, &copies, cell))
                    .collect()
            }
            Marks::Bisected(tags) => (mesh.cells().zip(tags))
                .map(|(cell, &tag)| {
                    let mut corners = [0; MAX_CORNERS];
                    corners[..=D].copy_from_slice(cell);
                    Self { corners, tag }
                })
                .collect(),
        }
    }

    /// Marks the longest edge of the cell and of each face, among equals the one of higher vertices. All edges have one
    /// order, by which faces are marked alike from both sides. Vertices that coincide count as one of them.
    fn by_longest_edge<const D: usize>(
        points: &[SVector<f64, D>],
        copies: &[u32],
        cell: &[u32],
    ) -> Self {
        let edge = |p: u32, q: u32| {
            let (p, q) = (copies[p as usize], copies[q as usize]);
            let (low, high) = (p.min(q), p.max(q));
            let length = (points[high as usize] - points[low as usize]).norm_squared();
            (length, high, low)
        };
        let longer = |a: &(f64, u32, u32), b: &(f64, u32, u32)| {
            let length = a.0.total_cmp(&b.0);
            length.then_with(|| (a.1, a.2).cmp(&(b.1, b.2))) == Ordering::Greater
        };
        let mut ends = (0, 1);
        for i in 0..=D {
            for j in i + 1..=D {
                if longer(&edge(cell[i], cell[j]), &edge(cell[ends.0], cell[ends.1])) {
                    ends = (i, j);
                }
            }
        }
        let mut corners = [0; MAX_CORNERS];
        let others = (0..=D).filter(|&k| k != ends.0 && k != ends.1);
        for (corner, k) in corners
            .iter_mut()
            .zip([ends.0, ends.1].into_iter().chain(others))
        {
            *corner = cell[k];
        }
        // It takes as many exchanges of neighbours to bring both to the front.
        if (ends.0 + ends.1 - 1) % 2 == 1 {
            corners.swap(0, 1);
        }
        let mut tag = Tag::default();
        if D == 3 {
            for own in 0..2 {
                let mut marked = own;
                let across = |k: usize| match k {
                    2 => edge(corners[own], corners[3]),
                    3 => edge(corners[own], corners[2]),
                    _ => edge(corners[2], corners[3]),
                };
                for k in [2, 3] {
                    if longer(&across(k), &across(marked)) {
                        marked = k;
                    }
                }
                tag.opposite[own] = marked as u8;
            }
        }
        Self { corners, tag }
    }

    /// The two halves, `middle` the midpoint of the first two corners.
    pub(crate) fn halves<const D: usize>(&self, middle: u32) -> [Self; 2] {
        [0, 1].map(|kept| self.half::<D>(kept, middle))
    }

    /// The half with one end of the halved edge. Its faces:
    ///
    /// - the one from its parent keeps its marked edge, which is halved next,
    /// - the cut ones are marked opposite to the new vertex,
    /// - the new one is, too, unless the parent was flagged: then the mark joins the new vertex to the edge that is
    ///   halved next.
    fn half<const D: usize>(&self, kept: usize, middle: u32) -> Self {
        let v = self.corners;
        let planar = self.tag.opposite[0] == self.tag.opposite[1];
        let mut tag = Tag {
            opposite: [3, 3],
            flagged: planar && !self.tag.flagged,
        };
        // The parity is that of the order beside (middle in place of the end that is left out).
        let (mut corners, odd) = if D == 2 {
            ([v[kept], v[2], middle, 0], kept == 0)
        } else {
            match self.tag.opposite[kept] {
                2 => ([v[kept], v[3], v[2], middle], kept == 0),
                3 => ([v[kept], v[2], v[3], middle], kept == 1),
                _ => ([v[2], v[3], v[kept], middle], kept == 1),
            }
        };
        if D == 2 {
            tag = Tag::default();
        } else if self.tag.flagged {
            tag.opposite[1] = 2;
        }
        if odd {
            corners.swap(0, 1);
            // Marks opposite to corners 2 or 3 alone occur here.
            tag.opposite.swap(0, 1);
        }
        Self { corners, tag }
    }
}
