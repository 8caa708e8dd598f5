//! The geometry of one side of a fault: both sides have the same, with opposite normals.

use nalgebra::SVector;

use super::Cut;
use crate::simplex::{face_area, face_normal};
use crate::{Mesh, SMOOTH};

/// Areas of faces, and weights, normals and opposites of the vertices of one side.
pub(crate) struct Side<const D: usize> {
    pub(crate) areas: Vec<f64>,
    pub(crate) weights: Vec<f64>,
    /// Not normalised.
    pub(crate) normals: Vec<SVector<f64, D>>,
    /// The sum of the lengths of the parts of each normal.
    pub(crate) lengths: Vec<f64>,
    pub(crate) opposite: Vec<usize>,
}

impl<const D: usize> Side<D> {
    /// The side that some faces of the boundary are, given by increasing position, with their vertices; `None` unless
    /// they are exactly one.
    pub(crate) fn of(mesh: &Mesh<D>, places: &[usize], vertices: &[usize]) -> Option<Self> {
        mesh.surfaces.cuts.iter().find_map(|cut| {
            if cut.twins.len() != places.len() {
                return None;
            }
            (0..2).find_map(|own| {
                let mut side: Vec<usize> = cut.twins.iter().map(|twin| twin[own]).collect();
                side.sort_unstable();
                (side == places).then(|| Self::new(mesh, cut, own, places, vertices))
            })
        })
    }

    /// All sums are over the faces of the plus side in their order: those of the minus side have the same bits.
    ///
    /// A face contributes n/(l_1^2 l_2^2) to the normal of a vertex, n its normal of the length of twice its area and
    /// l_1, l_2 its edges at the vertex; n/l^2 in the plane, n of the length l. Both are exact where the vertices lie
    /// on a sphere or circle. Source: N. Max, "Weights for computing vertex normals from facet normals", J. Graphics
    /// Tools 4 (1999).
    fn new(mesh: &Mesh<D>, cut: &Cut, own: usize, places: &[usize], vertices: &[usize]) -> Self {
        let count = vertices.len();
        let mut side = Self {
            areas: vec![0.0; places.len()],
            weights: vec![0.0; count],
            normals: vec![SVector::zeros(); count],
            lengths: vec![0.0; count],
            opposite: vertices.to_vec(),
        };
        for twin in &cut.twins {
            let plus = mesh.boundary[twin[0]];
            let corners = plus.map(|p| mesh.vertices[p as usize]);
            let area = face_area(&corners);
            side.areas[places.partition_point(|&place| place < twin[own])] = area;
            for (c, p) in plus.into_iter().enumerate() {
                let pair = [p, cut.minus(p)];
                let k = vertices.partition_point(|&q| q < pair[own] as usize);
                let part = share(&corners, area, c, own);
                side.weights[k] += area / D as f64;
                side.normals[k] += part;
                side.lengths[k] += part.norm();
                side.opposite[k] = pair[1 - own] as usize;
            }
        }
        side.continue_normals(mesh, cut, own, vertices);
        side
    }

    /// Replaces the normals of the pairs that other surfaces share by those of all their faces, where these are smooth.
    fn continue_normals(&mut self, mesh: &Mesh<D>, cut: &Cut, own: usize, vertices: &[usize]) {
        let shared = shared_pairs(&mesh.surfaces.cuts, cut);
        if shared.is_empty() {
            return;
        }
        let mut around: Vec<([u32; 2], usize, SVector<f64, D>)> = Vec::new();
        for other in &mesh.surfaces.cuts {
            for twin in &other.twins {
                let plus = mesh.boundary[twin[0]];
                let corners = plus.map(|p| mesh.vertices[p as usize]);
                for (c, p) in plus.into_iter().enumerate() {
                    let pair = [p, other.minus(p)];
                    if shared.binary_search(&pair).is_ok() {
                        let part = share(&corners, face_area(&corners), c, own);
                        around.push((pair, twin[0], part));
                    }
                }
            }
        }
        around.sort_unstable_by_key(|&(pair, place, _)| (pair, place));
        for faces in around.chunk_by(|a, b| a.0 == b.0) {
            let sum: SVector<f64, D> = faces.iter().map(|(_, _, part)| part).sum();
            let smooth = |(_, _, part): &(_, _, SVector<f64, D>)| {
                part.dot(&sum) >= SMOOTH * part.norm() * sum.norm()
            };
            if faces.iter().all(smooth) {
                let k = vertices.partition_point(|&q| q < faces[0].0[own] as usize);
                self.normals[k] = sum;
                self.lengths[k] = faces.iter().map(|(_, _, part)| part.norm()).sum();
            }
        }
    }
}

/// The pairs of two vertices that a cut shares with others, increasing: those of a rim at which they continue one another.
fn shared_pairs(cuts: &[Cut], cut: &Cut) -> Vec<[u32; 2]> {
    let others = cuts.iter().filter(|other| other.name != cut.name);
    let mut shared: Vec<[u32; 2]> = others
        .flat_map(|other| &other.pairs)
        .filter(|pair| pair[0] != pair[1] && cut.pairs.binary_search(pair).is_ok())
        .copied()
        .collect();
    shared.sort_unstable();
    shared.dedup();
    shared
}

/// The contribution of a face of the plus side to the normal at a corner of one of the two sides.
fn share<const D: usize>(
    corners: &[SVector<f64, D>; D],
    area: f64,
    c: usize,
    own: usize,
) -> SVector<f64, D> {
    let normal = face_normal(corners);
    // Outward: that of the plus side points to the minus side.
    let normal = if own == 0 { normal } else { -normal };
    // Divided by one edge after the other: squares of squares of small lengths may vanish.
    let part = (1..D).fold(normal / area, |part, next| {
        part / (corners[(c + next) % D] - corners[c]).norm()
    });
    if D == 2 {
        return part;
    }
    // sin(angle)/(l_1 l_2) = 2 area/(l_1 l_2)^2.
    let edges = (1..D).map(|next| (corners[(c + next) % D] - corners[c]).norm());
    part * edges.fold(2.0 * area, |sine, edge| sine / edge)
}
