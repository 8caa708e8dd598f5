//! Triangles in space: of a body's groups, and of a file without a body.

use stickslip_fem::gmsh::{self, Surface};
use stickslip_fem::{FemError, ReadError};

use super::{VARIANTS, file};

fn area(surface: &Surface, members: impl Iterator<Item = usize>) -> f64 {
    let areas = members.map(|member| {
        let [a, b, c] =
            surface.triangles[member].map(|vertex| nalgebra::Vector3::from(surface.points[vertex]));
        0.5 * (b - a).cross(&(c - a)).norm()
    });
    areas.sum()
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-12
}

#[test]
fn groups_of_a_body_are_surfaces() {
    for variant in VARIANTS {
        let all = gmsh::read_surface(file("block", variant)).unwrap();
        for (name, expected) in [("fault", 1.0), ("top", 1.0), ("9", 1.5)] {
            let (_, members) = all.groups.iter().find(|(own, _)| own == name).unwrap();
            assert!(near(area(&all, members.iter().copied()), expected));
            let own = all.of_groups(&[name]).unwrap();
            assert!(near(area(&own, 0..own.triangles.len()), expected));
            // Every vertex belongs to a triangle.
            let mut used = vec![false; own.points.len()];
            own.triangles
                .iter()
                .flatten()
                .for_each(|&vertex| used[vertex] = true);
            assert!(used.iter().all(|&used| used));
        }
        let fault = all.of_groups(&["fault"]).unwrap();
        assert!(fault.points.iter().all(|point| near(point[2], 0.0)));
        // The fault is part of the third group, too: each triangle is there once.
        let both = all.of_groups(&["fault", "9"]).unwrap();
        assert!(near(area(&both, 0..both.triangles.len()), 1.5));
        let unknown = all.of_groups(&["flat"]).unwrap_err();
        assert!(
            matches!(&unknown, FemError::Unknown { known, .. } if known.len() == 3),
            "{unknown}"
        );
    }
}

#[test]
fn a_file_without_a_body_is_a_surface_as_a_whole() {
    for variant in VARIANTS {
        let path = file("plane", variant);
        let mesh = gmsh::read::<2>(&path).unwrap();
        let surface = gmsh::read_surface(&path).unwrap();
        let count = mesh.cell_count();
        assert_eq!(surface.triangles.len(), count);
        let exact: f64 = (0..count).map(|cell| mesh.volume(cell)).sum();
        assert!(near(area(&surface, 0..count), exact));
    }
}

#[test]
fn files_without_triangles_are_refused() {
    let head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n";
    for (elements, text) in [
        ("2\n1 1 2 1 1 1 2\n2 1 2 1 1 3 4", "lines only"),
        (
            "1\n1 4 2 1 1 1 2 3 4",
            "put the surface into a physical group",
        ),
    ] {
        let file = format!("{head}$Elements\n{elements}\n$EndElements\n");
        let error = gmsh::parse_surface(file.as_bytes()).unwrap_err();
        assert!(error.to_string().contains(text), "{error}");
    }
    let error = gmsh::read_surface("no/such/file.msh").unwrap_err();
    assert!(matches!(error, ReadError::Read { .. }));
}
