//! Where surfaces continue one another: which of the faces that meet at a rim are neighbours on one surface.

use std::collections::{HashMap, HashSet};

use super::pairs::coinciding;
use super::rims::{Rim, angles, located, rim_of};
use crate::forest::Forest;
use crate::surfaces::{Surface, sorted};
use crate::{FemError, Mesh};

/// The neighbours among the faces of several surfaces. Places and faces are known by the smallest copies of their
/// vertices, which no cut changes.
pub(super) struct Joints<const D: usize> {
    pairs: HashMap<[u32; 2], Vec<[[u32; D]; 2]>>,
    /// The surfaces that continue one another, each by increasing position, by that of their first ones.
    pub(super) groups: Vec<Vec<usize>>,
}

impl<const D: usize> Joints<D> {
    /// Two faces of one surface at a rim are neighbours: it passes through. Of those of surfaces that end there each
    /// continues the one opposite to it; of an odd number the last surface ends there, as all do at the outer boundary
    /// of the body and where no two lie on different sides of those that pass through.
    pub(super) fn new(mesh: &Mesh<D>, surfaces: &[&Surface<D>]) -> Result<Self, FemError> {
        let cuts = &mesh.surfaces.cuts;
        let copies = coinciding(cuts, mesh.vertex_count());
        // Those of earlier cuts, which are joined to no other, and those of the surfaces.
        let (mut faces, mut owners) = (Vec::new(), Vec::new());
        for (owner, cut) in cuts.iter().enumerate() {
            faces.extend(cut.twins.iter().map(|twin| mesh.boundary[twin[0]]));
            owners.resize(faces.len(), owner);
        }
        for (k, surface) in surfaces.iter().enumerate() {
            faces.extend(&surface.faces);
            owners.resize(faces.len(), cuts.len() + k);
        }
        let rims = Rim::all(&faces, &copies);
        let at_rims: Vec<&[Rim]> = (rims.chunk_by(|a, b| a.key == b.key))
            .filter(|meeting| meeting.len() > 1)
            .collect();
        let keys: HashSet<[u32; 2]> = (at_rims.iter().map(|meeting| &meeting[0]))
            .map(|rim| rim.key)
            .collect();
        let leaves = leaving(mesh, &copies, &keys);

        let mut forest = Forest::new(surfaces.len());
        let mut pairs: HashMap<[u32; 2], Vec<[[u32; D]; 2]>> = HashMap::new();
        for at_rim in at_rims {
            let (mut joined, mut ends) = (Vec::new(), Vec::new());
            for own in at_rim.chunk_by(|a, b| owners[a.face] == owners[b.face]) {
                let surface = owners[own[0].face];
                if own.len() > 2 && surface >= cuts.len() {
                    let (vertices, at) = located(mesh, own[0].ends);
                    return Err(FemError::NotManifold {
                        surface: surfaces[surface - cuts.len()].name.clone(),
                        faces: own.len(),
                        vertices,
                        at,
                    });
                }
                match own {
                    [alone] => ends.push(alone.face),
                    _ => joined.push([own[0].face, own[own.len() - 1].face]),
                }
            }
            let key = at_rim[0].key;
            if ends.len() > 1 && !leaves.contains(&key) {
                let of_each = at_rim.iter().map(|rim| (faces[rim.face], rim.ends));
                let angles = angles(mesh, of_each);
                let place = |face: usize| at_rim.partition_point(|rim| rim.face < face);
                joined.extend(opposite(&ends, &joined, |face| angles[place(face)]));
            }
            for pair in joined.iter().map(|pair| pair.map(|face| owners[face])) {
                match pair.map(|owner| owner.checked_sub(cuts.len())) {
                    [Some(a), Some(b)] => forest.join(a as u32, b as u32),
                    [None, Some(surface)] => {
                        let (vertices, at) = located(mesh, at_rim[0].ends);
                        return Err(FemError::Continues {
                            surface: surfaces[surface].name.clone(),
                            earlier: cuts[pair[0]].name.clone(),
                            vertices,
                            at,
                        });
                    }
                    _ => {}
                }
            }
            let known = |face: usize| sorted(faces[face].map(|p| copies[p as usize]));
            pairs.insert(
                key,
                joined.into_iter().map(|pair| pair.map(known)).collect(),
            );
        }
        let mut groups: Vec<Vec<usize>> = vec![Vec::new(); surfaces.len()];
        for k in 0..surfaces.len() {
            groups[forest.root(k as u32) as usize].push(k);
        }
        groups.retain(|members| !members.is_empty());
        Ok(Self { pairs, groups })
    }

    /// The pairs of neighbours at a rim where faces meet.
    pub(super) fn at(&self, key: [u32; 2]) -> &[[[u32; D]; 2]] {
        self.pairs.get(&key).map_or(&[], Vec::as_slice)
    }
}

/// The rims that lie on the outer boundary of the body.
pub(super) fn leaving<const D: usize>(
    mesh: &Mesh<D>,
    copies: &[u32],
    keys: &HashSet<[u32; 2]>,
) -> HashSet<[u32; 2]> {
    let outer = mesh.outer_faces();
    let rims = outer.flat_map(|face| (0..D).map(move |k| rim_of(face, k)));
    let known = rims.map(|ends| sorted(ends.map(|p| copies[p as usize])));
    known.filter(|key| keys.contains(key)).collect()
}

/// The pairs of faces that end at a rim and continue one another, by the angles at which faces leave it: as many as
/// possible of the first ones, each with the one opposite to it, on the other side of all that pass through.
fn opposite(
    ends: &[usize],
    passing: &[[usize; 2]],
    angle: impl Fn(usize) -> f64,
) -> Vec<[usize; 2]> {
    let crosses = |[a, b]: [usize; 2]| {
        passing.iter().all(|pair| {
            let [low, high] = pair.map(&angle);
            let between = |face: usize| {
                let angle = angle(face);
                low.min(high) < angle && angle < low.max(high)
            };
            between(a) != between(b)
        })
    };
    for half in (1..=ends.len() / 2).rev() {
        let mut around = ends[..2 * half].to_vec();
        around.sort_unstable_by(|&a, &b| angle(a).total_cmp(&angle(b)));
        let pairs = (0..half).map(|k| [around[k], around[k + half]]);
        // Those of earlier cuts come first.
        let pairs: Vec<_> = pairs.map(sorted).collect();
        if pairs.iter().all(|&pair| crosses(pair)) {
            return pairs;
        }
    }
    Vec::new()
}
