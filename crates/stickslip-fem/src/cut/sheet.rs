//! A surface to be split: its oriented faces, and its edge.

use std::collections::HashSet;

use nalgebra::SVector;

use super::pairs::coinciding;
use crate::boundary::face;
use crate::simplex::face_normal;
use crate::surfaces::{Surface, sorted};
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

/// A vertex (D = 2) or edge (D = 3) of a face.
struct Rim {
    /// The vertices at the place, by their smallest copy; a vertex twice.
    key: [u32; 2],
    /// The vertices of the face itself.
    ends: [u32; 2],
    face: usize,
    /// The orientation that the face gives it.
    positive: bool,
}

/// The vertex (D = 2) or edge (D = 3) of a face opposite to its corner k, in the orientation of the face.
fn rim_of<const D: usize>(face: &[u32; D], k: usize) -> [u32; 2] {
    [face[(k + 1) % D], face[(k + D - 1) % D]]
}

impl Sheet {
    pub(super) fn new<const D: usize>(
        mesh: &Mesh<D>,
        surface: &Surface<D>,
    ) -> Result<Self, FemError> {
        let copies = coinciding(&mesh.surfaces.cuts, mesh.vertex_count());
        let sides = mesh.sides(&surface.faces);
        // Seen from the first cell of each face for now: its outward normal is that of the face.
        let faces: Vec<[u32; D]> = (sides.iter())
            .map(|side| face(&mesh.cells, side.places[0]))
            .collect();
        let mut rims: Vec<Rim> = Vec::with_capacity(D * faces.len());
        for (index, face) in faces.iter().enumerate() {
            for k in 0..D {
                let ends = rim_of(face, k);
                let [p, q] = ends.map(|p| copies[p as usize]);
                rims.push(Rim {
                    key: [p.min(q), p.max(q)],
                    ends,
                    face: index,
                    positive: if D == 2 { k == 0 } else { p < q },
                });
            }
        }
        rims.sort_unstable_by_key(|rim| (rim.key, rim.face));
        let place = |ends: [u32; 2]| {
            let mut vertices = ends.to_vec();
            vertices.dedup();
            let [a, b] = ends.map(|p| mesh.vertices[p as usize]);
            let at = (0.5 * (a + b)).iter().copied().collect();
            (vertices, at)
        };
        let mut neighbours = vec![Vec::new(); faces.len()];
        let mut edge = Vec::new();
        for meeting in rims.chunk_by(|a, b| a.key == b.key) {
            match meeting {
                [alone] => edge.push(alone),
                [a, b] => {
                    let alike = a.positive != b.positive;
                    neighbours[a.face].push((b.face, alike, a.ends));
                    neighbours[b.face].push((a.face, alike, a.ends));
                }
                _ => {
                    let (vertices, at) = place(meeting[0].ends);
                    return Err(FemError::NotManifold {
                        surface: surface.name.clone(),
                        faces: meeting.len(),
                        vertices,
                        at,
                    });
                }
            }
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
                        let (vertices, at) = place(ends);
                        return Err(FemError::OneSided {
                            surface: surface.name.clone(),
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
    let mut outer = vec![true; mesh.boundary.len()];
    for &place in mesh
        .surfaces
        .cuts
        .iter()
        .flat_map(|cut| cut.twins.iter().flatten())
    {
        outer[place] = false;
    }
    let wanted: HashSet<[u32; 2]> = edge.iter().map(|rim| sorted(rim.ends)).collect();
    let mut open = HashSet::new();
    let faces = mesh.boundary.iter().zip(&outer);
    for (face, _) in faces.filter(|(_, outer)| **outer) {
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
