//! Numbering, boundary and names of a mesh of children.

use nalgebra::SVector;

use crate::bisection::{Cell, Marks};
use crate::boundary::face;
use crate::fingerprint::fingerprint;
use crate::numbering::{ranks, sweep_order};
use crate::weights::Weights;
use crate::{FemError, Mesh, Prolongation};

/// Vertices, the coarse ones first, and bisected cells with their coarse parents.
pub(crate) struct Children<'a, const D: usize> {
    pub(crate) points: &'a [SVector<f64, D>],
    pub(crate) weights: &'a Weights,
    pub(crate) cells: &'a [Cell],
    pub(crate) parents: &'a [usize],
}

impl<const D: usize> Children<'_, D> {
    /// The mesh of these cells, in the order of their parents, and the interpolation to it.
    pub(crate) fn mesh(&self, coarse: &Mesh<D>) -> Result<(Mesh<D>, Prolongation), FemError> {
        let order = sweep_order(self.points);
        let ranks = ranks(&order);
        let prolongation = self.weights.prolongation(&order)?;

        let mut sorted: Vec<usize> = (0..self.cells.len()).collect();
        sorted.sort_by_key(|&k| self.parents[k]);
        let mut cells = Vec::with_capacity(sorted.len() * (D + 1));
        let mut tags = Vec::with_capacity(sorted.len());
        for &k in &sorted {
            let cell = &self.cells[k];
            cells.extend(cell.corners[..=D].iter().map(|&p| ranks[p as usize]));
            tags.push(cell.tag);
        }
        let parents = (sorted.iter()).map(|&k| self.parents[k]);

        let mut faces = self.boundary(coarse, &sorted);
        faces.sort_by_key(|&(_, parent)| parent);
        let boundary = (faces.iter())
            .map(|(face, _)| face.map(|p| ranks[p as usize]))
            .collect();
        let faces = faces.iter().map(|&(_, parent)| parent);

        let vertices: Vec<_> = (order.iter())
            .map(|&old| self.points[old as usize])
            .collect();
        let mesh = Mesh {
            fingerprint: fingerprint(&vertices, &cells),
            vertices,
            cells,
            marks: Marks::Bisected(tags),
            boundary,
            groups: coarse.groups.inherited(faces, parents),
        };
        Ok((mesh, prolongation))
    }

    /// The faces of cells that lie in a face of the coarse boundary, with the position of that face. A face of full
    /// dimension lies in another one if and only if its vertices lie between all vertices of that one, and no others.
    fn boundary(&self, coarse: &Mesh<D>, sorted: &[usize]) -> Vec<([u32; D], usize)> {
        let mut known: Vec<([u32; D], usize)> = (coarse.boundary.iter().enumerate())
            .map(|(place, &(mut face))| {
                face.sort_unstable();
                (face, place)
            })
            .collect();
        known.sort_unstable();
        // A vertex between vertices of the boundary may still be inside of the body.
        let mut outer = vec![false; coarse.vertex_count()];
        for &p in coarse.boundary.iter().flatten() {
            outer[p as usize] = true;
        }
        for new in coarse.vertex_count()..self.points.len() {
            let between = self.weights.between::<D>(&[new as u32]);
            outer.push(between.is_some_and(|ends| {
                (ends.iter().filter(|&&p| p != u32::MAX)).all(|&p| outer[p as usize])
            }));
        }
        let mut found = Vec::new();
        for &k in sorted {
            let corners = &self.cells[k].corners[..=D];
            if corners.iter().filter(|&&p| outer[p as usize]).count() < D {
                continue;
            }
            for opposite in 0..=D {
                let face = face::<D>(corners, opposite);
                let all_outer = face.iter().all(|&p| outer[p as usize]);
                if all_outer
                    && let Some(between) = self.weights.between::<D>(&face)
                    && let Ok(at) = known.binary_search_by_key(&between, |&(face, _)| face)
                {
                    found.push((face, known[at].1));
                }
            }
        }
        found
    }
}
