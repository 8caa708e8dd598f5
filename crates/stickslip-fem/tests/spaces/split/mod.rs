//! Meshes that are split along surfaces inside the body: both sides of a fault.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::SVector;
use stickslip_fem::{FemError, Mesh, P1};

use super::common::volume;

mod branches;
mod files;
mod joints;
mod levels;
mod plane;
mod random;
mod refused;
mod restricted;
mod segments;
mod solid;

fn bits<const D: usize>(x: &SVector<f64, D>) -> Vec<u64> {
    x.iter().map(|c| (c + 0.0).to_bits()).collect()
}

/// Vertices - edges + faces - cells.
fn euler<const D: usize>(mesh: &Mesh<D>) -> i64 {
    let mut simplices = BTreeSet::new();
    for cell in mesh.cells() {
        for chosen in 1..1_usize << (D + 1) {
            let mut simplex: Vec<u32> = (0..=D)
                .filter(|k| chosen >> k & 1 == 1)
                .map(|k| cell[k])
                .collect();
            simplex.sort_unstable();
            simplices.insert(simplex);
        }
    }
    let sign = |simplex: &Vec<u32>| if simplex.len() % 2 == 1 { 1 } else { -1 };
    simplices.iter().map(sign).sum()
}

/// What holds of both sides of a fault.
fn check_sides<const D: usize>(space: &P1<D>, name: &str) {
    let [plus, minus] = ["+", "-"].map(|side| space.part(&format!("{name}{side}")).unwrap());
    let mesh = space.mesh();
    let (above, below) = (plus.opposite().unwrap(), minus.opposite().unwrap());
    assert_eq!(above.len(), plus.vertices().len());
    assert_eq!(plus.faces().len(), minus.faces().len());
    assert_eq!(plus.vertices().len(), minus.vertices().len());
    assert!((plus.measure() / minus.measure() - 1.0).abs() < 1e-13);
    for (k, (&p, &q)) in plus.vertices().iter().zip(above).enumerate() {
        let at = minus.vertices().binary_search(&q).unwrap();
        assert_eq!(below[at], p);
        assert_eq!(bits(&mesh.vertices()[p]), bits(&mesh.vertices()[q]));
        assert_eq!(plus.weights()[k].to_bits(), minus.weights()[at].to_bits());
        assert_eq!(plus.normals()[k], -minus.normals()[at]);
        assert!((plus.normals()[k].norm() - 1.0).abs() < 1e-14 || plus.normals()[k].norm() == 0.0);
    }
    // Twin faces: those of opposite vertices.
    let faces = |trace: &stickslip_fem::Trace<D>, of: &dyn Fn(usize) -> usize| {
        let faces = trace.faces().iter().map(|face| {
            let mut face = face.map(of);
            face.sort_unstable();
            face
        });
        faces.collect::<BTreeSet<_>>()
    };
    assert_eq!(
        faces(&plus, &|k| above[k]),
        faces(&minus, &|k| minus.vertices()[k])
    );
}

/// A split mesh is the former one when coinciding vertices of its faults are merged, and has its boundary twice at the
/// faults.
fn check<const D: usize>(before: &Mesh<D>, after: &Mesh<D>, names: &[&str]) {
    assert!((volume(before) - volume(after)).abs() <= 1e-13 * volume(before));
    assert_eq!(before.cell_count(), after.cell_count());
    // Copies are behind the vertices, which keep their numbers.
    let count = before.vertex_count();
    assert_eq!(before.vertices(), &after.vertices()[..count]);
    let mut origin: Vec<usize> = (0..after.vertex_count()).collect();
    for (old, new) in before.cells().zip(after.cells()) {
        for (&p, &q) in old.iter().zip(new) {
            if (q as usize) < count {
                assert_eq!(p, q);
            } else {
                assert!(origin[q as usize] >= count || origin[q as usize] == p as usize);
                origin[q as usize] = p as usize;
            }
        }
    }
    assert!(origin.iter().all(|&p| p < count));
    for (p, &old) in origin.iter().enumerate() {
        assert_eq!(bits(&after.vertices()[p]), bits(&before.vertices()[old]));
    }
    // The boundary is that of the cells.
    let sorted = |mut face: [u32; D]| {
        face.sort_unstable();
        face
    };
    let cells = after.cells().flatten().copied().collect();
    let fresh = Mesh::new(after.vertices().to_vec(), cells).unwrap();
    let faces = |mesh: &Mesh<D>| {
        mesh.boundary()
            .iter()
            .map(|f| sorted(*f))
            .collect::<BTreeSet<_>>()
    };
    assert_eq!(faces(&fresh), faces(after));
    assert_eq!(fresh.fingerprint(), after.fingerprint());
    let outward: BTreeMap<_, _> = fresh.boundary().iter().map(|f| (sorted(*f), *f)).collect();
    for face in after.boundary() {
        let turns = |f: &[u32; D]| {
            (0..D)
                .map(|k| f[k..].iter().filter(|&&q| q < f[k]).count())
                .sum::<usize>()
        };
        assert_eq!(turns(face) % 2, turns(&outward[&sorted(*face)]) % 2);
    }
    let space = P1::new(after.clone());
    let mut split = 0;
    for name in names {
        check_sides(&space, name);
        split += space.part(&format!("{name}+")).unwrap().faces().len();
    }
    assert_eq!(after.boundary().len(), before.boundary().len() + 2 * split);
    // The former parts have the former faces.
    for (name, places) in before.parts() {
        assert!(after.parts().any(|part| part == (name, places)));
        for &place in places {
            let face = after.boundary()[place].map(|p| origin[p as usize] as u32);
            assert_eq!(face, before.boundary()[place]);
        }
    }
    assert!(after.materials().eq(before.materials()));
}

fn refusal<const D: usize>(result: Result<Mesh<D>, FemError>) -> FemError {
    match result {
        Err(error) => error,
        other => unreachable!("{other:?}"),
    }
}
