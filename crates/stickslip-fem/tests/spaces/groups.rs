//! Names of faces and cells: what they mean on refined meshes, what is refused.

use nalgebra::{SVector, Vector2};
use stickslip_fem::{
    Elastic, FemError, GridDiagonal, Mesh, P1, antiplane_by_cell, elasticity, elasticity_by_cell,
};

fn strip() -> Mesh<2> {
    Mesh::<2>::grid([2.0, 1.0], [2, 1], GridDiagonal::Rising).unwrap()
}

fn midpoint<const D: usize>(mesh: &Mesh<D>, corners: &[u32]) -> SVector<f64, D> {
    let sum: SVector<f64, D> = corners.iter().map(|&p| mesh.vertices()[p as usize]).sum();
    sum / corners.len() as f64
}

/// Names cells and faces by position on the coarsest mesh, and compares with positions on each finer one.
fn refined_by_position<const D: usize>(mesh: Mesh<D>, split: f64) {
    let left = |x: &SVector<f64, D>| x[0] < split;
    let cells: Vec<usize> = (0..mesh.cell_count())
        .filter(|&k| left(&midpoint(&mesh, mesh.cell(k))))
        .collect();
    // Listed backwards, the vertices of each face turned round.
    let faces: Vec<[u32; D]> = (mesh.boundary().iter().rev())
        .filter(|face| left(&midpoint(&mesh, *face)))
        .map(|&(mut face)| {
            face.reverse();
            face
        })
        .collect();
    let mesh = mesh
        .with_part("left", &faces)
        .unwrap()
        .with_material("left", &cells)
        .unwrap();
    let space = P1::new(mesh).refined(3).unwrap();
    for level in 0..4 {
        let mesh = space.hierarchy().mesh(level).unwrap();
        let (_, places) = mesh.parts().next().unwrap();
        let (_, cells) = mesh.materials().next().unwrap();
        assert!(places.is_sorted() && cells.is_sorted());
        assert_eq!(places.len(), faces.len() << ((D - 1) * level));
        for (k, face) in mesh.boundary().iter().enumerate() {
            assert_eq!(places.contains(&k), left(&midpoint(mesh, face)));
        }
        for (k, cell) in mesh.cells().enumerate() {
            assert_eq!(cells.binary_search(&k).is_ok(), left(&midpoint(mesh, cell)));
        }
    }
}

#[test]
fn refinement_hands_names_on() {
    refined_by_position(
        Mesh::<2>::grid([2.0, 1.0], [4, 2], GridDiagonal::Falling).unwrap(),
        1.0,
    );
    refined_by_position(Mesh::<3>::grid([2.0, 1.0, 1.0], [2, 1, 2]).unwrap(), 1.0);
}

#[test]
fn parts_are_traces() {
    let mesh = Mesh::<3>::grid([1.0, 2.0, 0.5], [1, 2, 1]).unwrap();
    let bottom: Vec<[u32; 3]> = (mesh.boundary().iter())
        .filter(|face| face.iter().all(|&p| mesh.vertices()[p as usize][2] == 0.0))
        .copied()
        .collect();
    let space = P1::new(mesh.with_part("fault", &bottom).unwrap())
        .refined(2)
        .unwrap();
    assert_eq!(space.part("fault"), space.trace(|x| x[2] == 0.0));
    assert_eq!(
        space.part("top"),
        Err(FemError::Unknown {
            what: "part of the boundary",
            name: "top".into(),
            known: vec!["fault".into()]
        })
    );
}

#[test]
fn parts_leave_the_fingerprint() {
    let named = strip()
        .with_part("a", &[[0, 2]])
        .unwrap()
        .with_material("b", &[1])
        .unwrap();
    assert_eq!(named.fingerprint(), strip().fingerprint());
    assert_ne!(named, strip());
}

#[test]
fn bad_parts_are_refused() {
    // Vertices are 0 and 1, 2 and 3, 4 and 5 along the columns; the diagonals are 0 3 and 2 5.
    let part = |faces: &[[u32; 2]]| strip().with_part("p", faces).map(|_| ());
    assert_eq!(part(&[[2, 0], [2, 4]]), Ok(()));
    let off = |index, face: [u32; 2], cells| FemError::NotOnBoundary {
        part: "p".into(),
        index,
        face: face.to_vec(),
        cells,
    };
    assert_eq!(part(&[[0, 2], [3, 2]]), Err(off(1, [3, 2], 2)));
    assert_eq!(part(&[[0, 2], [4, 0], [3, 0]]), Err(off(1, [4, 0], 0)));
    assert_eq!(part(&[[7, 0]]), Err(off(0, [7, 0], 0)));
    assert_eq!(part(&[[2, 2]]), Err(off(0, [2, 2], 3)));
    assert_eq!(
        part(&[[0, 2], [4, 2], [2, 0]]),
        Err(FemError::Repeated {
            what: "faces of the part",
            places: [0, 2],
            name: "p".into()
        })
    );
    assert_eq!(
        part(&[]),
        Err(FemError::Empty {
            what: "members of the group",
            name: "p".into()
        })
    );
    let twice = strip()
        .with_part("p", &[[0, 2]])
        .and_then(|mesh| mesh.with_part("p", &[[4, 2]]));
    assert_eq!(twice, Err(FemError::RepeatedName { name: "p".into() }));
}

#[test]
fn bad_materials_are_refused() {
    let material = |cells: &[usize]| strip().with_material("m", cells).map(|_| ());
    assert_eq!(material(&[3, 0]), Ok(()));
    let material_name = || "m".to_owned();
    assert_eq!(
        material(&[0, 4]),
        Err(FemError::OutOfRange {
            what: "cell",
            index: 4,
            count: 4,
            by: "material \"m\"".into()
        })
    );
    assert_eq!(
        material(&[2, 0, 2]),
        Err(FemError::Repeated {
            what: "cells of the material",
            places: [0, 2],
            name: material_name()
        })
    );
    assert_eq!(
        material(&[]),
        Err(FemError::Empty {
            what: "members of the group",
            name: material_name()
        })
    );
    let twice = strip()
        .with_material("m", &[0])
        .and_then(|mesh| mesh.with_material("m", &[1]));
    assert_eq!(
        twice,
        Err(FemError::RepeatedName {
            name: material_name()
        })
    );
    // A part may have the name of a material.
    assert!(
        strip()
            .with_material("m", &[0])
            .and_then(|mesh| mesh.with_part("m", &[[0, 2]]))
            .is_ok()
    );
}

#[test]
fn values_by_name_are_values_by_cell() {
    let mesh = strip()
        .with_material("a", &[1, 2])
        .unwrap()
        .with_material("b", &[0, 3])
        .unwrap();
    let space = P1::new(mesh).refined(2).unwrap();
    let named = space.by_material(&[("b", 3.0), ("a", 7.0)]).unwrap();
    let by_name = antiplane_by_cell(&space, &named).unwrap();
    // The children of a cell follow each other.
    let by_cell = antiplane_by_cell(&space, |_, cell| {
        if [1, 2].contains(&(cell / 16)) {
            7.0
        } else {
            3.0
        }
    });
    assert_eq!(by_name, by_cell.unwrap());
    assert_eq!(
        (named(&Vector2::zeros(), 0), named(&Vector2::zeros(), 17)),
        (3.0, 7.0)
    );

    let elastic = Elastic {
        young_modulus: 2.0,
        poisson_ratio: 0.2,
    };
    let everywhere = space
        .by_material(&[("a", elastic), ("b", elastic)])
        .unwrap();
    assert_eq!(
        elasticity_by_cell(&space, everywhere).unwrap(),
        elasticity(&space, &elastic).unwrap()
    );
}

#[test]
fn every_cell_needs_one_value() {
    let space = |mesh: Mesh<2>| P1::new(mesh);
    let mesh = strip().with_material("a", &[1, 2]).unwrap();
    let value = |mesh: &Mesh<2>, values: &[(&str, f64)]| {
        space(mesh.clone()).by_material(values).map(|_| ())
    };
    assert_eq!(
        value(&mesh, &[("a", 1.0)]),
        Err(FemError::CellValues {
            cell: 0,
            values: 0,
            materials: vec![]
        })
    );
    let mesh = mesh.with_material("b", &[0, 3]).unwrap();
    assert_eq!(value(&mesh, &[("b", 2.0), ("a", 1.0)]), Ok(()));
    assert_eq!(
        value(&mesh, &[("b", 1.0)]),
        Err(FemError::CellValues {
            cell: 1,
            values: 0,
            materials: vec!["a".into()]
        })
    );
    assert_eq!(
        value(&mesh, &[("a", 1.0), ("a", 2.0)]),
        Err(FemError::RepeatedName { name: "a".into() })
    );
    assert_eq!(
        value(&mesh, &[("a", 1.0), ("c", 2.0)]),
        Err(FemError::Unknown {
            what: "material",
            name: "c".into(),
            known: vec!["a".into(), "b".into()]
        })
    );
    let mesh = mesh.with_material("all", &[0, 1, 2, 3]).unwrap();
    assert_eq!(value(&mesh, &[("all", 1.0)]), Ok(()));
    assert_eq!(
        value(&mesh, &[("b", 1.0), ("all", 1.0)]),
        Err(FemError::CellValues {
            cell: 0,
            values: 2,
            materials: vec!["b".into(), "all".into()]
        })
    );
}
