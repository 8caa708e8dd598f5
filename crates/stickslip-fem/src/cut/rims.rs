//! Rims of faces, at which the faces of surfaces meet: their vertices in the plane, their edges in space.

use nalgebra::{SVector, Vector3};

use crate::Mesh;

/// A vertex (D = 2) or edge (D = 3) of a face.
pub(super) struct Rim {
    /// The vertices at the place, by their smallest copy; a vertex twice.
    pub(super) key: [u32; 2],
    /// The vertices of the face itself.
    pub(super) ends: [u32; 2],
    /// The place of the face in its list.
    pub(super) face: usize,
    /// The orientation that the face gives it.
    pub(super) positive: bool,
}

impl Rim {
    /// The rims of faces by increasing place and face; `copies` are the smallest copies of all vertices.
    pub(super) fn all<const D: usize>(faces: &[[u32; D]], copies: &[u32]) -> Vec<Self> {
        let mut rims: Vec<Self> = Vec::with_capacity(D * faces.len());
        for (index, face) in faces.iter().enumerate() {
            for k in 0..D {
                let ends = rim_of(face, k);
                let [p, q] = ends.map(|p| copies[p as usize]);
                rims.push(Self {
                    key: [p.min(q), p.max(q)],
                    ends,
                    face: index,
                    positive: if D == 2 { k == 0 } else { p < q },
                });
            }
        }
        rims.sort_unstable_by_key(|rim| (rim.key, rim.face));
        rims
    }
}

/// The vertex (D = 2) or edge (D = 3) of a face opposite to its corner k, in the orientation of the face.
pub(super) fn rim_of<const D: usize>(face: &[u32; D], k: usize) -> [u32; 2] {
    [face[(k + 1) % D], face[(k + D - 1) % D]]
}

/// The vertices of a rim, and its position.
pub(super) fn located<const D: usize>(mesh: &Mesh<D>, ends: [u32; 2]) -> (Vec<u32>, Vec<f64>) {
    let mut vertices = ends.to_vec();
    vertices.dedup();
    let [a, b] = ends.map(|p| mesh.vertices[p as usize]);
    let at = (0.5 * (a + b)).iter().copied().collect();
    (vertices, at)
}

/// The angles at which faces leave a common rim, in the plane across it.
pub(super) fn angles<const D: usize>(
    mesh: &Mesh<D>,
    faces: impl Iterator<Item = ([u32; D], [u32; 2])>,
) -> Vec<f64> {
    let padded = |x: SVector<f64, D>| Vector3::from_fn(|c, _| x.get(c).copied().unwrap_or(0.0));
    let place = |p: u32| padded(mesh.vertices[p as usize]);
    let mut frame: Option<[Vector3<f64>; 2]> = None;
    let leaves = |(face, [p, q]): ([u32; D], [u32; 2])| {
        let other = face.iter().find(|corner| ![p, q].contains(corner));
        let away = place(*other.unwrap_or(&p)) - place(p);
        let [first, second] = *frame.get_or_insert_with(|| {
            let axis = match p == q {
                true => Vector3::z(),
                false => (place(p.max(q)) - place(p.min(q))).normalize(),
            };
            let first = away - axis * axis.dot(&away);
            [first, axis.cross(&first)]
        });
        second.dot(&away).atan2(first.dot(&away))
    };
    faces.map(leaves).collect()
}
