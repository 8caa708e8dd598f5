//! Surfaces along which a mesh cannot be split.

use nalgebra::Vector3;
use stickslip_fem::{FemError, GridDiagonal, Mesh};

use super::refusal;

fn plane() -> Mesh<2> {
    Mesh::<2>::grid([4.0, 4.0], [4, 4], GridDiagonal::Rising).unwrap()
}

#[test]
fn names_are_known_and_new() {
    let mesh = plane().with_surface_where("a", |x| x[1] == 2.0).unwrap();
    let again = mesh.clone().with_surface_where("a", |x| x[1] == 1.0);
    assert!(matches!(again, Err(FemError::RepeatedName { name }) if name == "a"));
    let part = mesh.clone().with_part("a", &[[0, 1]]);
    assert!(matches!(part, Err(FemError::RepeatedName { name }) if name == "a"));
    let unknown = mesh.clone().split("b");
    assert!(
        matches!(unknown, Err(FemError::Unknown { name, known, .. }) if name == "b" && known == ["a"])
    );
    let taken = mesh.clone().with_part("a-", &[[0, 1]]).unwrap().split("a");
    assert!(matches!(taken, Err(FemError::RepeatedName { name }) if name == "a-"));
    let twice = mesh.split_all(["a", "a"]);
    assert!(matches!(twice, Err(FemError::Unknown { known, .. }) if known.is_empty()));
}

#[test]
fn faces_lie_inside() {
    let cases = [
        (vec![[6, 7], [0, 1]], 1, 1),
        (vec![[6, 9]], 0, 0),
        (vec![[6, 6]], 0, 0),
        (vec![[6, 99]], 0, 0),
    ];
    for (faces, at, count) in cases {
        let error = refusal(plane().with_surface("a", &faces));
        let expected = FemError::NotInside {
            surface: "a".into(),
            index: at,
            face: faces[at].to_vec(),
            cells: count,
        };
        assert_eq!(error, expected);
    }
    let repeated = plane().with_surface("a", &[[6, 7], [7, 6]]);
    assert!(matches!(
        repeated,
        Err(FemError::Repeated { places: [0, 1], .. })
    ));
    let none = plane().with_surface("a", &[]);
    assert!(matches!(none, Err(FemError::Empty { name, .. }) if name == "a"));
    for nowhere in [0.0, 1.5] {
        let none = plane().with_surface_where("a", |x| x[1] == nowhere);
        assert!(matches!(none, Err(FemError::Empty { name, .. }) if name == "a"));
    }
}

#[test]
fn surfaces_open_somewhere() {
    let mesh = plane()
        .with_surface("a", &[[6, 7], [16, 17], [17, 18]])
        .unwrap();
    let error = refusal(mesh.split("a"));
    assert_eq!(
        error,
        FemError::OpensNowhere {
            surface: "a".into(),
            faces: 1,
            at: vec![1.0, 1.5],
        }
    );
    assert!(error.to_string().contains("\"a\"") && error.to_string().contains("refine"));
}

#[test]
fn surfaces_are_manifolds() {
    // It touches the boundary in its middle.
    let mesh = Mesh::<2>::grid([4.0, 4.0], [4, 4], GridDiagonal::Falling).unwrap();
    let mesh = mesh.with_surface("a", &[[6, 2], [2, 7]]).unwrap();
    let error = refusal(mesh.split("a"));
    assert!(matches!(error, FemError::NotManifold { faces: 2, vertices, .. } if vertices == [2]));
}

/// A ring of bricks around an axis, with a strip that turns by 180 degrees inside.
#[test]
fn surfaces_have_two_sides() {
    // Bricks (u, v, w): u around, v and w across; the twist identifies (v, w) with (-v, -w) behind the last.
    const N: usize = 12;
    const M: usize = 4;
    let number = |u: usize, v: usize, w: usize| {
        let (v, w) = if u == N { (M - v, M - w) } else { (v, w) };
        (((u % N) * (M + 1) + v) * (M + 1) + w) as u32
    };
    let mut points = Vec::new();
    for u in 0..N {
        let angle = std::f64::consts::TAU * u as f64 / N as f64;
        for v in 0..=M {
            for w in 0..=M {
                let [v, w] = [v, w].map(|c| c as f64 / M as f64 - 0.5);
                let (sin, cos) = (0.5 * angle).sin_cos();
                let (r, z) = (3.0 + cos * v - sin * w, sin * v + cos * w);
                points.push(Vector3::new(r * angle.cos(), r * angle.sin(), z));
            }
        }
    }
    // Twelve tetrahedra a brick around its centre: faces are cut by diagonals from their lowest vertex.
    let mut cells: Vec<u32> = Vec::new();
    for u in 0..N {
        for v in 0..M {
            for w in 0..M {
                let corner = |k: usize| number(u + (k & 1), v + (k >> 1 & 1), w + (k >> 2 & 1));
                let centre = points.len() as u32;
                let mean = (0..8)
                    .map(|k| points[corner(k) as usize])
                    .sum::<Vector3<f64>>()
                    / 8.0;
                points.push(mean);
                for quad in [
                    [0, 1, 3, 2],
                    [4, 6, 7, 5],
                    [0, 4, 5, 1],
                    [2, 3, 7, 6],
                    [0, 2, 6, 4],
                    [1, 5, 7, 3],
                ] {
                    let mut quad = quad.map(corner);
                    let lowest = (0..4).min_by_key(|&k| quad[k]).unwrap();
                    quad.rotate_left(lowest);
                    for triangle in [[quad[0], quad[1], quad[2]], [quad[0], quad[2], quad[3]]] {
                        let mut cell = [centre, triangle[0], triangle[1], triangle[2]];
                        let x = |k: usize| points[cell[k] as usize];
                        let volume = (x(1) - x(0)).cross(&(x(2) - x(0))).dot(&(x(3) - x(0)));
                        if volume < 0.0 {
                            cell.swap(2, 3);
                        }
                        cells.extend(cell);
                    }
                }
            }
        }
    }
    let layer = (0..N).flat_map(|u| (0..=M).map(move |v| number(u, v, M / 2)));
    let layer: std::collections::BTreeSet<u32> = layer.collect();
    let place = |p: u32| points[p as usize];
    let middle: Vec<Vector3<f64>> = layer.iter().map(|&p| place(p)).collect();
    let mesh = Mesh::new(points.clone(), cells).unwrap();
    let strip = mesh
        .with_surface_where("strip", |x| middle.contains(x))
        .unwrap();
    assert_eq!(strip.surfaces().next().unwrap().1.len(), 2 * N * M);
    let error = refusal(strip.split("strip"));
    assert!(matches!(&error, FemError::OneSided { vertices, .. } if vertices.len() == 2));
    assert!(error.to_string().contains("strip"));
}
