//! Groups of Gmsh inside the body.
#![cfg(feature = "gmsh")]

use std::fmt::Write;

use stickslip_fem::{FemError, GridDiagonal, Mesh, P1, ReadError, gmsh};

use super::check_sides;
use crate::common::Numbers;

/// A square of 4 x 4 with a named fault, an unnamed group 103 that ends on it, and the top.
fn text() -> String {
    let grid = Mesh::<2>::grid([4.0, 4.0], [4, 4], GridDiagonal::Rising).unwrap();
    let mut text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n1 101 \"fault\"\n1 1 \"top\"\n2 2 \"rock\"\n\
        $EndPhysicalNames\n$Nodes\n25\n"
        .to_owned();
    for (p, x) in (1..).zip(grid.vertices()) {
        writeln!(text, "{p} {} {} 0", x[0], x[1]).unwrap();
    }
    let mut elements = Vec::new();
    // Columns of five vertices each.
    let node = |i: usize, j: usize| 5 * i + j + 1;
    let mut line =
        |group: usize, a: usize, b: usize| elements.push(format!("1 2 {group} {group} {a} {b}"));
    (0..4).for_each(|i| line(101, node(i, 2), node(i + 1, 2)));
    (2..4).for_each(|j| line(103, node(2, j), node(2, j + 1)));
    (0..4).for_each(|i| line(1, node(i, 4), node(i + 1, 4)));
    for cell in grid.cells() {
        let [a, b, c] = [0, 1, 2].map(|k| cell[k] + 1);
        elements.push(format!("2 2 2 2 {a} {b} {c}"));
    }
    write!(text, "$EndNodes\n$Elements\n{}\n", elements.len()).unwrap();
    for (k, element) in (1..).zip(&elements) {
        writeln!(text, "{k} {element}").unwrap();
    }
    text + "$EndElements\n"
}

#[test]
fn inner_groups_are_surfaces() {
    let mesh = gmsh::parse::<2>(text().as_bytes()).unwrap();
    let names: Vec<_> = mesh
        .surfaces()
        .map(|(name, faces)| (name, faces.len()))
        .collect();
    assert_eq!(names, [("fault", 4), ("103", 2)]);
    assert_eq!(
        mesh.parts().map(|(name, _)| name).collect::<Vec<_>>(),
        ["top"]
    );
    let split = mesh.clone().split_all(["fault", "103"]).unwrap();
    assert_eq!(split.vertex_count(), 25 + 5 + 2);
    let space = P1::new(split).refined(2).unwrap();
    check_sides(&space, "fault");
    check_sides(&space, "103");
    assert_eq!(space.part("103+").unwrap().measure(), 2.0);
    // The top is that of both sides of 103.
    assert_eq!(space.part("top").unwrap().measure(), 4.0);
}

#[test]
fn groups_are_inside_and_on_the_boundary() {
    // The upper half of the fault that ends on the other one belongs to the top.
    let mixed = text().replace("1 2 103 103 14 15", "1 2 1 1 14 15");
    let mesh = gmsh::parse::<2>(mixed.as_bytes()).unwrap();
    let names: Vec<_> = (mesh.surfaces())
        .map(|(name, faces)| (name, faces.len()))
        .collect();
    assert_eq!(names, [("top", 1), ("fault", 4), ("103", 1)]);
    let split = mesh.split_all(["fault", "103", "top"]).unwrap();
    assert_eq!(split.vertex_count(), 25 + 5 + 2);
    let space = P1::new(split).refined(1).unwrap();
    for name in ["fault", "103", "top"] {
        check_sides(&space, name);
    }
    let length = |name: &str| space.part(name).unwrap().measure();
    assert_eq!(["top", "top+", "103+"].map(length), [4.0, 1.0, 1.0]);
    // Two groups have two names.
    let same = mixed.replace("1 101 \"fault\"", "1 101 \"top\"");
    let error = gmsh::parse::<2>(same.as_bytes()).unwrap_err();
    let expected = ReadError::Fem(FemError::RepeatedName { name: "top".into() });
    assert_eq!(error.to_string(), expected.to_string());
    let twice = text().replace("1 2 103 103 14 15", "1 2 103 103 14 13");
    assert!(matches!(
        gmsh::parse::<2>(twice.as_bytes()),
        Err(ReadError::Same {
            numbers: [5, 6],
            ..
        })
    ));
    let nowhere = text().replace("1 2 103 103 14 15", "1 2 103 103 14 23");
    assert!(matches!(
        gmsh::parse::<2>(nowhere.as_bytes()),
        Err(ReadError::NotOnBoundary {
            element: 6,
            cells: 0,
            ..
        })
    ));
}

/// Nodes and groups of lines at random.
#[test]
fn damaged_groups_do_no_harm() {
    let good = text();
    let mut random = Numbers(7);
    let (mut split, mut refused) = (0, 0);
    for _ in 0..400 {
        let mut lines: Vec<String> = good.lines().map(str::to_owned).collect();
        let starts: Vec<usize> = (0..lines.len())
            .filter(|&k| {
                lines[k].split(' ').nth(1) == Some("1") && lines[k].split(' ').count() == 7
            })
            .collect();
        assert_eq!(starts.len(), 10);
        for _ in 0..1 + (random.next() * 4.0) as usize {
            let k = starts[(random.next() * 10.0) as usize];
            let mut words: Vec<String> = lines[k].split(' ').map(str::to_owned).collect();
            let at = [3, 5, 6][(random.next() * 3.0) as usize];
            let groups = [1, 101, 103];
            words[at] = if at == 3 {
                groups[(random.next() * 3.0) as usize].to_string()
            } else {
                let offsets = [1.0, 5.0, 6.0];
                let by = offsets[(random.next() * 3.0) as usize];
                let node: f64 = words[11 - at].parse().unwrap();
                (if random.next() < 0.5 {
                    node + by
                } else {
                    node - by
                })
                .to_string()
            };
            lines[k] = words.join(" ");
        }
        let text = lines.join("\n");
        match gmsh::parse::<2>(text.as_bytes()) {
            Ok(mesh) => {
                let names: Vec<String> = mesh.surfaces().map(|(name, _)| name.to_owned()).collect();
                match mesh.split_all(&names) {
                    Ok(after) => {
                        split += 1;
                        let space = P1::new(after);
                        names.iter().for_each(|name| check_sides(&space, name));
                    }
                    Err(error) => {
                        refused += 1;
                        assert!(!error.to_string().is_empty());
                    }
                }
            }
            Err(error) => {
                refused += 1;
                assert!(!error.to_string().is_empty());
            }
        }
    }
    assert!(split > 20 && refused > 20, "{split} {refused}");
}
