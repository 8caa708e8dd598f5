//! Numbering, boundary and names of a mesh of children.

use nalgebra::SVector;

use crate::bisection::Cell;
use crate::boundary::face;
use crate::fingerprint::fingerprint;
use crate::marks::Marks;
use crate::numbering::{ranks, sweep_order};
use crate::surfaces::{Surface, Surfaces, sorted};
use crate::twin_edges::TwinEdges;
use crate::weights::Weights;
use crate::{FemError, Mesh, Prolongation};

/// Vertices, the coarse ones first, and bisected cells with their coarse parents.
pub(crate) struct Children<'a, const D: usize> {
    pub(crate) points: &'a [SVector<f64, D>],
    pub(crate) weights: &'a Weights,
    pub(crate) cells: &'a [Cell],
    pub(crate) parents: &'a [usize],
    pub(crate) twins: &'a TwinEdges<D>,
}

impl<const D: usize> Children<'_, D> {
    /// The mesh of these cells, in the order of their parents, and the interpolation to it.
    pub(crate) fn mesh(&self, coarse: &Mesh<D>) -> Result<(Mesh<D>, Prolongation), FemError> {
        let order = sweep_order(self.points);
        let ranks = ranks(&order);
        let prolongation = self.weights.prolongation(&order)?;

        let mut in_order: Vec<usize> = (0..self.cells.len()).collect();
        in_order.sort_by_key(|&k| self.parents[k]);
        let mut cells = Vec::with_capacity(in_order.len() * (D + 1));
        let mut tags = Vec::with_capacity(in_order.len());
        for &k in &in_order {
            let cell = &self.cells[k];
            cells.extend(cell.corners[..=D].iter().map(|&p| ranks[p as usize]));
            tags.push(cell.tag);
        }
        let parents = (in_order.iter()).map(|&k| self.parents[k]);

        let known = (0..)
            .zip(&coarse.boundary)
            .map(|(place, &face)| (face, place));
        let mut faces = self.faces(coarse, &in_order, known);
        faces.sort_by_key(|&(_, parent)| parent);
        let boundary: Vec<[u32; D]> = (faces.iter())
            .map(|(face, _)| face.map(|p| ranks[p as usize]))
            .collect();
        let faces = faces.iter().map(|&(_, parent)| parent);
        let surfaces = Surfaces {
            inner: self.surfaces(coarse, &in_order, &ranks),
            cuts: (coarse.surfaces.cuts.iter().zip(self.twins.pairs()))
                .map(|(cut, pairs)| {
                    let pairs = pairs.iter().map(|pair| pair.map(|p| ranks[p as usize]));
                    cut.inherited(&boundary, faces.clone(), pairs.collect())
                })
                .collect(),
        };

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
            surfaces,
        };
        Ok((mesh, prolongation))
    }

    /// The inner surfaces of the coarse mesh.
    fn surfaces(&self, coarse: &Mesh<D>, order: &[usize], ranks: &[u32]) -> Vec<Surface<D>> {
        let surfaces = coarse.surfaces.inner.iter();
        let inherited = surfaces.map(|surface| {
            let known = surface.faces.iter().map(|&face| (face, 0));
            let found = self.faces(coarse, order, known);
            // Each is found from both of its cells.
            let mut faces: Vec<[u32; D]> = (found.iter())
                .map(|(face, _)| sorted(face.map(|p| ranks[p as usize])))
                .collect();
            faces.sort_unstable();
            faces.dedup();
            let name = surface.name.clone();
            Surface { name, faces }
        });
        inherited.collect()
    }

    /// The faces of cells that lie in a known coarse face, with its position. A face of full dimension lies in another
    /// one if and only if its vertices lie between all vertices of that one, and no others.
    fn faces(
        &self,
        coarse: &Mesh<D>,
        order: &[usize],
        known: impl Iterator<Item = ([u32; D], usize)>,
    ) -> Vec<([u32; D], usize)> {
        let mut known: Vec<([u32; D], usize)> =
            known.map(|(face, place)| (sorted(face), place)).collect();
        known.sort_unstable();
        // A vertex between vertices of these faces may still lie elsewhere.
        let mut near = vec![false; coarse.vertex_count()];
        for &p in known.iter().flat_map(|(face, _)| face) {
            near[p as usize] = true;
        }
        for new in coarse.vertex_count()..self.points.len() {
            let between = self.weights.between::<D>(&[new as u32]);
            near.push(between.is_some_and(|ends| {
                (ends.iter().filter(|&&p| p != u32::MAX)).all(|&p| near[p as usize])
            }));
        }
        let mut found = Vec::new();
        for &k in order {
            let corners = &self.cells[k].corners[..=D];
            if corners.iter().filter(|&&p| near[p as usize]).count() < D {
                continue;
            }
            for opposite in 0..=D {
                let face = face::<D>(corners, opposite);
                let all_near = face.iter().all(|&p| near[p as usize]);
                if all_near
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
