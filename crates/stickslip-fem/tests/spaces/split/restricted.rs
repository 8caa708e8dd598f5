//! Split meshes restricted to some of their cells.

use stickslip_fem::{GridDiagonal, Mesh, P1};

use super::check_sides;

/// Three cells of four.
fn kept(cell: usize, seed: u64) -> bool {
    let mut x = (cell as u64) << 32 ^ seed;
    for _ in 0..3 {
        x = (x ^ (x >> 30))
            .wrapping_mul(0xbf58_476d_1ce4_e5b9)
            .wrapping_add(1);
    }
    x >> 62 != 0
}

/// The number of faces of a fault with a kept cell on both sides.
fn twins<const D: usize>(space: &P1<D>, name: &str, seed: u64) -> usize {
    let plus = space.part(&format!("{name}+")).unwrap();
    let opposite = plus.opposite().unwrap();
    let has = |face: [usize; D]| {
        let mut cells = space.mesh().cells().enumerate();
        cells.any(|(cell, corners)| {
            kept(cell, seed) && face.iter().all(|&p| corners.contains(&(p as u32)))
        })
    };
    let faces = plus.faces().iter();
    faces
        .filter(|face| has(face.map(|k| plus.vertices()[k])) && has(face.map(|k| opposite[k])))
        .count()
}

/// The faces of a fault with both sides in random cells stay sides of the fault, before refinement and after it, and
/// no others.
fn check<const D: usize>(mesh: &Mesh<D>, names: &[&str], seed: u64) {
    let part = P1::new(mesh.restricted(|cell| kept(cell, seed)).unwrap());
    let refined = part.clone().refined(1).unwrap();
    let whole = P1::new(mesh.clone());
    for name in names {
        let expected = twins(&whole, name, seed);
        assert!(expected > 0);
        for (space, children) in [(&part, 1), (&refined, 1 << (D - 1))] {
            check_sides(space, name);
            let plus = space.part(&format!("{name}+")).unwrap();
            assert_eq!(plus.faces().len(), children * expected);
        }
    }
}

#[test]
fn sides_of_a_restricted_mesh_have_twins() {
    let plane = Mesh::<2>::grid([4.0, 4.0], [8, 8], GridDiagonal::Rising)
        .and_then(|mesh| mesh.with_surface_where("level", |x| x[1] == 2.0 && x[0] <= 3.0))
        .and_then(|mesh| mesh.with_surface_where("oblique", |x| x[0] == x[1]))
        .and_then(|mesh| mesh.split_all(["oblique", "level"]))
        .unwrap();
    let solid = Mesh::<3>::grid([4.0; 3], [4; 3])
        .and_then(|mesh| mesh.with_surface_where("level", |x| x[2] == 2.0 && x[0] <= 3.0))
        .and_then(|mesh| mesh.with_surface_where("upright", |x| x[0] == 2.0 && x[1] >= 1.0))
        .and_then(|mesh| mesh.split_all(["level", "upright"]))
        .unwrap();
    for seed in 0..48 {
        check(&plane, &["oblique", "level"], seed);
        check(&solid, &["level", "upright"], seed);
    }
}

#[test]
fn all_cells_keep_all_names() {
    let mesh = Mesh::<2>::grid([4.0, 2.0], [4, 2], GridDiagonal::Rising)
        .and_then(|mesh| mesh.with_part("base", &[[0, 3], [6, 3]]))
        .and_then(|mesh| mesh.with_material("rock", &[0, 1, 7]))
        .and_then(|mesh| {
            mesh.with_surface_where("fault", |x| x[1] == 1.0)?
                .split("fault")
        })
        .unwrap();
    let whole = P1::new(mesh.restricted(|_| true).unwrap());
    for name in ["base", "fault+", "fault-"] {
        let [old, new] = [&P1::new(mesh.clone()), &whole].map(|space| space.part(name).unwrap());
        assert_eq!(old.vertices(), new.vertices());
        assert_eq!(old.opposite(), new.opposite());
        assert_eq!(old.weights(), new.weights());
    }
    let few = mesh.restricted(|cell| cell == 7).unwrap();
    let materials: Vec<_> = few.materials().collect();
    assert_eq!(materials, [("rock", &[0][..])]);
    assert!(few.parts().all(|(_, faces)| faces.is_empty()) && few.parts().count() == 3);
}
