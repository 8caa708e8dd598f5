//! Meshes of surfaces.

use std::collections::HashMap;

pub(crate) type Mesh = (Vec<[f64; 3]>, Vec<[usize; 3]>);

/// A grid of right triangles, mapped from `[0, columns] x [0, rows]`.
pub(crate) fn grid(counts: [usize; 2], place: impl Fn([f64; 2]) -> [f64; 3]) -> Mesh {
    let [columns, rows] = counts;
    let number = |i: usize, j: usize| j * (columns + 1) + i;
    let mut mesh: Mesh = (Vec::new(), Vec::new());
    for j in 0..=rows {
        for i in 0..=columns {
            mesh.0.push(place([i as f64, j as f64]));
        }
    }
    for j in 0..rows {
        for i in 0..columns {
            let (a, b) = (number(i, j), number(i + 1, j));
            let (c, d) = (number(i + 1, j + 1), number(i, j + 1));
            mesh.1.extend([[a, b, c], [a, c, d]]);
        }
    }
    mesh
}

/// Equilateral triangles of a plane `z = 0` in a square about the origin, of the half width `half`.
pub(crate) fn equilateral(half: f64, side: f64) -> Mesh {
    let height = side * 0.75_f64.sqrt();
    let (columns, rows) = ((half / side) as i32 + 1, (half / height) as i32);
    let mut numbers = HashMap::new();
    let mut mesh: Mesh = (Vec::new(), Vec::new());
    for j in -rows..=rows {
        for i in -columns..=columns {
            let shift = 0.5 * f64::from(j.rem_euclid(2));
            numbers.insert((i, j), mesh.0.len());
            mesh.0
                .push([(f64::from(i) + shift) * side, f64::from(j) * height, 0.0]);
        }
    }
    for j in -rows..rows {
        for i in -columns..columns {
            let odd = j.rem_euclid(2);
            let (a, b) = (numbers[&(i, j)], numbers[&(i + 1, j)]);
            let (c, d) = (numbers[&(i, j + 1)], numbers[&(i + 1, j + 1)]);
            mesh.1.extend(if odd == 0 {
                [[a, b, c], [b, d, c]]
            } else {
                [[a, b, d], [a, d, c]]
            });
        }
    }
    mesh
}

/// A sphere of radius 1: an icosahedron whose faces are divided `times` times.
pub(crate) fn sphere(times: usize) -> Mesh {
    let g = 0.5 * (1.0 + 5f64.sqrt());
    let mut points = Vec::new();
    for (a, b) in [(1.0, g), (-1.0, g), (1.0, -g), (-1.0, -g)] {
        points.extend([[0.0, a, b], [a, b, 0.0], [b, 0.0, a]]);
    }
    let apart = |i: usize, j: usize| -> f64 {
        let (p, q): (&[f64; 3], &[f64; 3]) = (&points[i], &points[j]);
        (0..3).map(|c| (p[c] - q[c]).powi(2)).sum()
    };
    let mut triangles = Vec::new();
    for i in 0..12 {
        for j in i + 1..12 {
            for k in j + 1..12 {
                if [apart(i, j), apart(j, k), apart(i, k)]
                    .iter()
                    .all(|&d| d < 5.0)
                {
                    triangles.push([i, j, k]);
                }
            }
        }
    }
    for _ in 0..times {
        let mut middles = HashMap::new();
        let mut finer = Vec::new();
        for [a, b, c] in triangles {
            let [ab, bc, ca] = [(a, b), (b, c), (c, a)].map(|(i, j): (usize, usize)| {
                *middles.entry((i.min(j), i.max(j))).or_insert_with(|| {
                    points.push([0, 1, 2].map(|c| 0.5 * (points[i][c] + points[j][c])));
                    points.len() - 1
                })
            });
            finer.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        triangles = finer;
        for point in &mut points {
            let r = point.iter().map(|x| x * x).sum::<f64>().sqrt();
            *point = point.map(|x| x / r);
        }
    }
    (points, triangles)
}

/// Both meshes as one.
pub(crate) fn both(a: Mesh, b: Mesh) -> Mesh {
    let first = a.0.len();
    let moved =
        b.1.into_iter()
            .map(|corners| corners.map(|corner| corner + first));
    (
        a.0.into_iter().chain(b.0).collect(),
        a.1.into_iter().chain(moved).collect(),
    )
}
