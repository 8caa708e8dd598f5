//! Which of the faces that meet at a branching rim are one sheet.

use std::collections::BTreeMap;

use crate::Mesh;
use crate::cut::rims::{Rim, angles};
use crate::forest::Forest;

/// The rims at which the same pieces of a surface meet; pieces are connected across rims of two faces.
pub(super) struct Junction {
    /// Increasing; a piece that goes on around an end of the rims is there twice.
    pieces: Vec<u32>,
    /// For each rim its length, and the angles at which the pieces leave it.
    rims: Vec<(f64, Vec<f64>)>,
    /// The error of an angle by that of coordinates that are exact to one unit in the last place.
    rounding: f64,
}

impl Junction {
    /// The junctions at some rims, in the order of their pieces.
    pub(super) fn all<'a, const D: usize>(
        mesh: &Mesh<D>,
        faces: &[[u32; D]],
        meetings: impl Iterator<Item = &'a [Rim]>,
        pieces: &mut Forest,
    ) -> Vec<Self> {
        let mut junctions: BTreeMap<Vec<u32>, Self> = BTreeMap::new();
        for meeting in meetings {
            let mut of_faces: Vec<(u32, usize)> = (meeting.iter().enumerate())
                .map(|(k, rim)| (pieces.root(rim.face as u32), k))
                .collect();
            of_faces.sort_unstable();
            let place = |p: u32| mesh.vertices[p as usize];
            let [p, q] = meeting[0].ends.map(place);
            let length = if D == 2 { 1.0 } else { (q - p).norm() };
            let at_rim = of_faces.iter().map(|&(_, k)| &meeting[k]);
            let leaving = at_rim.clone().map(|rim| (faces[rim.face], rim.ends));
            let angles = angles(mesh, leaving);
            // The height of a face over the rim is the least distance over which its angle is measured.
            let height = |face: [u32; D]| {
                let area = crate::simplex::face_area(&face.map(place));
                if D == 2 { area } else { 2.0 * area / length }
            };
            let reach = |face: [u32; D]| {
                face.map(|p| place(p).amax())
                    .into_iter()
                    .fold(0.0, f64::max)
            };
            let rounding = at_rim.map(|rim| reach(faces[rim.face]) / height(faces[rim.face]));
            let rounding = rounding.fold(0.0, f64::max) * f64::EPSILON;
            let pieces: Vec<u32> = of_faces.iter().map(|&(piece, _)| piece).collect();
            let junction = junctions.entry(pieces.clone()).or_insert_with(|| Self {
                pieces,
                rims: Vec::new(),
                rounding: 0.0,
            });
            junction.rims.push((length, angles));
            junction.rounding = junction.rounding.max(rounding);
        }
        junctions.into_values().collect()
    }

    /// The mean angle by which a surface of two of the pieces turns at the rims; zero if it goes straight on.
    fn turn(&self, [i, j]: [usize; 2]) -> f64 {
        let length: f64 = self.rims.iter().map(|(length, _)| length).sum();
        let turns = self.rims.iter().map(|(length, angles)| {
            let between = (angles[i] - angles[j]).abs();
            length * (between - std::f64::consts::PI).abs()
        });
        turns.sum::<f64>() / length
    }

    /// Whether two pieces are on different sides of two others, at all rims.
    fn cross(&self, [i, j]: [usize; 2], [k, l]: [usize; 2]) -> bool {
        self.rims.iter().all(|(_, angles)| {
            let (low, high) = (angles[k].min(angles[l]), angles[k].max(angles[l]));
            let between = |m: usize| low < angles[m] && angles[m] < high;
            between(i) != between(j)
        })
    }
}

/// Joins the pieces that continue one another most straightly, those first that do so best: two at a junction, further
/// ones if they are on different sides of these. Pieces that are connected elsewhere are joined already. No sheet has
/// three faces at a rim. Angles that differ by rounding are equal, and pairs of lower faces come first then.
pub(super) fn join(mut junctions: Vec<Junction>, sheets: &mut Forest) {
    let pairs = |junction: &Junction| {
        let count = junction.pieces.len();
        (0..count).flat_map(move |i| (i + 1..count).map(move |j| [i, j]))
    };
    let straightest = |junction: &Junction| {
        let turns = pairs(junction).map(|pair| junction.turn(pair));
        turns.fold(f64::INFINITY, f64::min)
    };
    junctions.sort_by(|a, b| straightest(a).total_cmp(&straightest(b)));
    for junction in &junctions {
        let mut joined: Vec<[usize; 2]> = Vec::new();
        loop {
            let mut open: Vec<([usize; 2], f64)> = Vec::new();
            for pair in pairs(junction) {
                let free = joined.iter().flatten().all(|k| !pair.contains(k));
                let [a, b] = pair.map(|k| sheets.root(junction.pieces[k]));
                if free && a == b {
                    open.push((pair, f64::NEG_INFINITY));
                } else if free
                    && joined.iter().all(|&other| junction.cross(pair, other))
                    && junctions
                        .iter()
                        .all(|other| other.stays_manifold([a, b], sheets))
                {
                    open.push((pair, junction.turn(pair)));
                }
            }
            let least = open
                .iter()
                .map(|(_, turn)| *turn)
                .fold(f64::INFINITY, f64::min);
            let bound = least + 4.0 * junction.rounding;
            let Some((pair, _)) = open.into_iter().find(|(_, turn)| *turn <= bound) else {
                break;
            };
            let [a, b] = pair.map(|k| junction.pieces[k]);
            sheets.join(a, b);
            joined.push(pair);
        }
    }
}

impl Junction {
    /// Whether no more than two faces of two sheets together meet here.
    fn stays_manifold(&self, both: [u32; 2], sheets: &mut Forest) -> bool {
        let here = self
            .pieces
            .iter()
            .filter(|&&piece| both.contains(&sheets.root(piece)));
        here.count() <= 2
    }
}
