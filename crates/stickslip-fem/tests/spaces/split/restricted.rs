//! Split meshes restricted to some of their cells.

use stickslip_fem::{FemError, GridDiagonal, Mesh, P1};

use super::check_sides;

fn kept(cell: usize, seed: u64) -> bool {
    (cell as u64 + 1)
        .wrapping_mul(seed | 1)
        .wrapping_mul(0x9e37_79b9_7f4a_7c15)
        >> 62
        != 0
}

/// The twin faces of random cells stay sides of the fault, before refinement and after it; lost ones are in no part.
fn check<const D: usize>(mesh: &Mesh<D>, names: &[&str], seed: u64) {
    let part = mesh.restricted(|cell| kept(cell, seed)).unwrap();
    let refined = P1::new(part.clone()).refined(1).unwrap();
    let whole = P1::new(mesh.clone());
    for name in names {
        match P1::new(part.clone()).part(&format!("{name}+")) {
            Ok(plus) => {
                check_sides(&P1::new(part.clone()), name);
                check_sides(&refined, name);
                let all = whole.part(&format!("{name}+")).unwrap();
                assert!(plus.measure() <= all.measure() * (1.0 + 1e-13));
                let finer = refined.part(&format!("{name}+")).unwrap();
                assert!((finer.measure() / plus.measure() - 1.0).abs() < 1e-13);
            }
            Err(error) => assert!(matches!(error, FemError::Empty { .. }), "{error}"),
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
