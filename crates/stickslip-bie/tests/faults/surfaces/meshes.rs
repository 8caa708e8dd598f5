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

/// A sphere of radius 1: an icosahedron whose faces are divided into `parts^2` triangles; corners come more than once.
pub(crate) fn sphere(parts: usize) -> Mesh {
    let g = 0.5 * (1.0 + 5f64.sqrt());
    let mut corners = Vec::new();
    for (a, b) in [(1.0, g), (-1.0, g), (1.0, -g), (-1.0, -g)] {
        corners.extend([[0.0, a, b], [a, b, 0.0], [b, 0.0, a]]);
    }
    let apart = |i: usize, j: usize| -> f64 {
        let (p, q): (&[f64; 3], &[f64; 3]) = (&corners[i], &corners[j]);
        (0..3).map(|c| (p[c] - q[c]).powi(2)).sum()
    };
    let mut mesh: Mesh = (Vec::new(), Vec::new());
    for (i, j, k) in (0..12)
        .flat_map(|i| (i + 1..12).flat_map(move |j| (j + 1..12).map(move |k| (i, j, k))))
        .filter(|&(i, j, k)| {
            [apart(i, j), apart(j, k), apart(i, k)]
                .iter()
                .all(|&d| d < 5.0)
        })
    {
        let first = mesh.0.len();
        let number = |u: usize, v: usize| first + u * (2 * parts + 3 - u) / 2 + v;
        for u in 0..=parts {
            for v in 0..=parts - u {
                let weights = [parts - u - v, u, v].map(|n| n as f64);
                let at = [0, 1, 2].map(|c| {
                    let [p, q, r] = [i, j, k].map(|corner| corners[corner][c]);
                    weights[0] * p + weights[1] * q + weights[2] * r
                });
                let r = at.iter().map(|x: &f64| x * x).sum::<f64>().sqrt();
                mesh.0.push(at.map(|x| x / r));
            }
        }
        for u in 0..parts {
            for v in 0..parts - u {
                mesh.1
                    .push([number(u, v), number(u + 1, v), number(u, v + 1)]);
                if u + v + 1 < parts {
                    mesh.1
                        .push([number(u + 1, v), number(u + 1, v + 1), number(u, v + 1)]);
                }
            }
        }
    }
    mesh
}

/// A disc of radius 1 in `z = 0`: rings of 6, 12, 18 .. vertices about the centre, `6 rings^2` triangles.
pub(crate) fn disc(rings: usize) -> Mesh {
    let mut mesh: Mesh = (vec![[0.0; 3]], Vec::new());
    // The first vertex of ring k.
    let first = |k: usize| if k == 0 { 0 } else { 1 + 3 * k * (k - 1) };
    for k in 1..=rings {
        let radius = k as f64 / rings as f64;
        for n in 0..6 * k {
            let (sin, cos) = (n as f64 / (6 * k) as f64 * std::f64::consts::TAU).sin_cos();
            mesh.0.push([radius * cos, radius * sin, 0.0]);
        }
        for sector in 0..6 {
            let outer = |n: usize| first(k) + (sector * k + n) % (6 * k);
            let inner = |n: usize| match k {
                1 => 0,
                _ => first(k - 1) + (sector * (k - 1) + n) % (6 * (k - 1)),
            };
            for n in 0..k {
                mesh.1.push([inner(n), outer(n), outer(n + 1)]);
                if n + 1 < k {
                    mesh.1.push([inner(n), outer(n + 1), inner(n + 1)]);
                }
            }
        }
    }
    mesh
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
