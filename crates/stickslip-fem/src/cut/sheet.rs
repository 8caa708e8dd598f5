//! Surfaces to be split as one: their oriented faces, and their edge.

use std::collections::HashSet;

use nalgebra::SVector;

use super::joints::Joints;
use super::pairs::coinciding;
use super::rims::{Rim, located, rim_of};
use super::union::Union;
use crate::boundary::face;
use crate::simplex::face_normal;
use crate::surfaces::sorted;
use crate::{FemError, Mesh};

/// A component of a mean normal over the area below which it counts as zero.
const ZERO: f64 = 1e-9;

/// An oriented surface.
pub(super) struct Sheet {
    /// For each face the places, in the list of cells, of the vertices opposite to it: on its plus and minus side.
    pub(super) sides: Vec<[usize; 2]>,
    /// The connected part of each face, known by one of its faces.
    pub(super) components: Vec<usize>,
    /// Faces at the edge of the surface that do not open there, each with a vertex of that edge: inside the body, or
    /// where the surface ends on an earlier fault.
    pub(super) tips: Vec<(usize, u32)>,
}

impl Sheet {
    pub(super) fn new<const D: usize>(
        mesh: &Mesh<D>,
        union: &Union<D>,
        joints: &Joints<D>,
    ) -> Result<Self, FemError> {
        let copies = coinciding(&mesh.surfaces.cuts, mesh.vertex_count());
        let sides = mesh.sides(&union.faces);
        // Seen from the first cell of each face for now: its outward normal is that of the face.
        let faces: Vec<[u32; D]> = (sides.iter())
            .map(|side| face(&mesh.cells, side.places[0]))
            .collect();
        let known = |face: usize| sorted(faces[face].map(|p| copies[p as usize]));
        let mut neighbours = vec![Vec::new(); faces.len()];
        let rims = Rim::all(&faces, &copies);
        let mut edge = Vec::new();
        for meeting in rims.chunk_by(|a, b| a.key == b.key) {
            let mut joined = vec![false; meeting.len()];
            for pair in joints.at(meeting[0].key) {
                let at = pair.map(|own| meeting.iter().position(|rim| known(rim.face) == own));
                if let [Some(i), Some(j)] = at {
                    let [a, b] = [&meeting[i], &meeting[j]];
                    let alike = a.positive != b.positive;
                    neighbours[a.face].push((b.face, alike, a.ends));
                    neighbours[b.face].push((a.face, alike, a.ends));
                    (joined[i], joined[j]) = (true, true);
                }
            }
            let alone = meeting.iter().zip(joined).filter(|(_, joined)| !joined);
            edge.extend(alone.map(|(rim, _)| rim));
        }

        const UNSEEN: usize = usize::MAX;
        let mut components = vec![UNSEEN; faces.len()];
        let mut turned = vec![false; faces.len()];
        for first in 0..faces.len() {
            if components[first] != UNSEEN {
                continue;
            }
            components[first] = first;
            let mut members = vec![first];
            let mut next = 0;
            while next < members.len() {
                let from = members[next];
                next += 1;
                for &(to, alike, ends) in &neighbours[from] {
                    let turn = turned[from] == alike;
                    if components[to] == UNSEEN {
                        components[to] = first;
                        turned[to] = turn;
                        members.push(to);
                    } else if turned[to] != turn {
                        let (vertices, at) = located(mesh, ends);
                        return Err(FemError::OneSided {
                            surface: union.names.join(", "),
                            vertices,
                            at,
                        });
                    }
                }
            }
            if !points_to_plus(mesh, &members, &faces, &turned) {
                members.iter().for_each(|&k| turned[k] = !turned[k]);
            }
        }
        Ok(Self {
            // The face as seen from its first cell has that on the minus side.
            sides: (sides.iter().zip(&turned))
                .map(|(side, &turned)| {
                    let [first, second] = side.places;
                    if turned {
                        [first, second]
                    } else {
                        [second, first]
                    }
                })
                .collect(),
            components,
            tips: tips(mesh, &edge),
        })
    }
}

/// Whether the normals of a connected part point to its plus side: the last component of their mean that does not
/// vanish is positive. Without a mean, as of a closed surface, they point outside: away from the middle.
fn points_to_plus<const D: usize>(
    mesh: &Mesh<D>,
    members: &[usize],
    faces: &[[u32; D]],
    turned: &[bool],
) -> bool {
    let corners = |k: usize| faces[k].map(|p| mesh.vertices[p as usize]);
    let normal = |k: usize| {
        let normal = face_normal(&corners(k));
        if turned[k] { -normal } else { normal }
    };
    let middle = |k: usize| corners(k).iter().sum::<SVector<f64, D>>() / D as f64;
    let area: f64 = members.iter().map(|&k| normal(k).norm()).sum();
    let sum: SVector<f64, D> = members.iter().map(|&k| normal(k)).sum();
    if let Some(last) = (0..D).rev().find(|&c| sum[c].abs() > ZERO * area) {
        return sum[last] > 0.0;
    }
    let weighted = |k: &usize| middle(*k) * normal(*k).norm();
    let centre = members.iter().map(weighted).sum::<SVector<f64, D>>() / area;
    let outward: f64 = members
        .iter()
        .map(|&k| (middle(k) - centre).dot(&normal(k)))
        .sum();
    outward > 0.0
}

/// The faces and vertices of an edge that does not leave the body through its outer boundary.
fn tips<const D: usize>(mesh: &Mesh<D>, edge: &[&Rim]) -> Vec<(usize, u32)> {
    let wanted: HashSet<[u32; 2]> = edge.iter().map(|rim| sorted(rim.ends)).collect();
    let mut open = HashSet::new();
    for face in mesh.outer_faces() {
        let rims = (0..D).map(|k| sorted(rim_of(face, k)));
        open.extend(rims.filter(|rim| wanted.contains(rim)));
    }
    let closed = (edge.iter()).filter(|rim| !open.contains(&sorted(rim.ends)));
    let mut tips: Vec<(usize, u32)> = closed
        .flat_map(|rim| rim.ends.map(|p| (rim.face, p)))
        .collect();
    tips.sort_unstable();
    tips.dedup();
    tips
}
