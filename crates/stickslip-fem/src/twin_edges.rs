//! Edges on the sides of faults: both are halved together.

use std::collections::{HashMap, HashSet};

use crate::Mesh;
use crate::cut::{Cut, Opposite};
use crate::surfaces::sorted;
use crate::weights::Weights;

/// The faults of a mesh that is being cut.
pub(crate) struct TwinEdges<const D: usize> {
    faults: Vec<Fault<D>>,
}

/// The sides of one fault.
struct Fault<const D: usize> {
    /// The faces of both sides and, in space, their edges, padded with `u32::MAX`, on the last level.
    faces: HashSet<[u32; D]>,
    /// The opposites of all present vertices.
    opposites: HashMap<u32, Opposite>,
    pairs: Vec<[u32; 2]>,
}

impl<const D: usize> TwinEdges<D> {
    /// Without faults.
    pub(crate) fn none() -> Self {
        Self { faults: Vec::new() }
    }

    pub(crate) fn of(mesh: &Mesh<D>) -> Self {
        let fault = |cut: &Cut| {
            let mut faces = HashSet::new();
            for &place in cut.twins.iter().flatten() {
                let face = sorted(mesh.boundary[place]);
                faces.insert(face);
                if D == 3 {
                    faces.extend((0..D).map(|left_out| {
                        let mut edge = face;
                        edge[left_out..].rotate_left(1);
                        edge[D - 1] = u32::MAX;
                        edge
                    }));
                }
            }
            Fault {
                faces,
                opposites: cut.opposites(),
                pairs: cut.pairs.clone(),
            }
        };
        Self {
            faults: mesh.surfaces.cuts.iter().map(fault).collect(),
        }
    }

    /// Whether there are no faults.
    pub(crate) fn is_empty(&self) -> bool {
        self.faults.is_empty()
    }

    /// An edge and those that coincide with it on other sides of faults.
    pub(crate) fn coinciding(&self, weights: &Weights, edge: (u32, u32)) -> Vec<(u32, u32)> {
        let mut edges = vec![edge];
        let mut next = 0;
        while next < edges.len() {
            let (p, q) = edges[next];
            next += 1;
            let twins = self
                .faults
                .iter()
                .filter_map(|fault| fault.twin(weights, p, q));
            for (twin, _) in twins.collect::<Vec<_>>() {
                if !edges.contains(&twin) {
                    edges.push(twin);
                }
            }
        }
        edges
    }

    /// Enters the midpoints of edges that coincide.
    pub(crate) fn halved(&mut self, weights: &Weights, edges: &[(u32, u32)], middles: &[u32]) {
        for fault in &mut self.faults {
            for (&(p, q), &middle) in edges.iter().zip(middles) {
                let Some((twin, plus)) = fault.twin(weights, p, q) else {
                    continue;
                };
                let Some(at) = edges.iter().position(|&edge| edge == twin) else {
                    continue;
                };
                let vertex = middles[at];
                fault.opposites.insert(middle, Opposite { vertex, plus });
                if plus {
                    fault.pairs.push([middle, vertex]);
                }
            }
        }
    }

    /// The pairs of vertices of each fault, in its order.
    pub(crate) fn pairs(&self) -> impl Iterator<Item = &[[u32; 2]]> {
        self.faults.iter().map(|fault| fault.pairs.as_slice())
    }
}

impl<const D: usize> Fault<D> {
    /// The edge opposite to one on a side, itself at the edge of the fault, and whether that side is the plus side.
    fn twin(&self, weights: &Weights, p: u32, q: u32) -> Option<((u32, u32), bool)> {
        let [a, b] = [self.opposites.get(&p)?, self.opposites.get(&q)?];
        let face = weights.between::<D>(&[p, q])?;
        if !self.faces.contains(&face) {
            return None;
        }
        let twin = (a.vertex.min(b.vertex), a.vertex.max(b.vertex));
        // A vertex at the edge of the fault is on both sides.
        let plus = if a.vertex == p { b.plus } else { a.plus };
        Some((twin, plus))
    }
}
