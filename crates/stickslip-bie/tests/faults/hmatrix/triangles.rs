//! Tractions of triangles on a rough surface.

use nalgebra::Vector3;
use stickslip_bie::TriangularDislocation;
use stickslip_bie::hmatrix::{Approximation, Entries, Extent, HMatrix};

use super::{error, exact, far_error, noise, product};
use crate::Outcome;

/// Slip along strike and dip of each triangle, and tractions along strike, dip and the compression.
struct Surface {
    corners: Vec<[[f64; 3]; 3]>,
    triangles: Vec<TriangularDislocation>,
    /// Strike, up dip and normal.
    axes: Vec<[Vector3<f64>; 3]>,
}

impl Entries for Surface {
    fn shape(&self) -> [usize; 2] {
        [3, 2]
    }

    fn block(&self, receiver: usize, source: usize, block: &mut [f64]) {
        let corners = self.corners[receiver].map(Vector3::from);
        let center = (corners[0] + corners[1] + corners[2]) / 3.0;
        let axes = &self.axes[receiver];
        for (column, slip) in self.axes[source][..2].iter().enumerate() {
            let traction = self.triangles[source].stress((*slip).into(), center.into()) * axes[2];
            for (row, sign) in [1.0, 1.0, -1.0].into_iter().enumerate() {
                block[2 * row + column] = sign * traction.dot(&axes[row]);
            }
        }
    }
}

/// A vertical surface that is rough by some of its depth.
fn surface([columns, rows]: [usize; 2], roughness: f64) -> Outcome<Surface> {
    let point = |i: usize, j: usize| {
        let [x, z] = [i, j].map(|k| k as f64 / rows as f64);
        let wave = (11.0 * x + 3.0 * z).sin() + 0.5 * (23.0 * z - 17.0 * x).cos();
        [x, roughness * wave, -z]
    };
    let cells = (0..columns).flat_map(|i| (0..rows).map(move |j| (i, j)));
    let corners: Vec<_> = cells
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[m, n]| point(i + m, j + n));
            [[a, c, b], [a, d, c]]
        })
        .collect();
    let triangle =
        |&corners: &[[f64; 3]; 3]| TriangularDislocation::whole_space(corners, 1.0, 0.25);
    let axes = |&corners: &[[f64; 3]; 3]| {
        let [a, b, c] = corners.map(Vector3::from);
        let normal = (b - a).cross(&(c - a)).normalize();
        let strike = Vector3::z().cross(&normal).normalize();
        [strike, normal.cross(&strike), normal]
    };
    Ok(Surface {
        triangles: corners.iter().map(triangle).collect::<Result<_, _>>()?,
        axes: corners.iter().map(axes).collect(),
        corners,
    })
}

#[test]
fn tractions_on_a_rough_surface() -> Outcome {
    let surface = surface([24, 16], 0.02)?;
    let cells: Vec<_> = (surface.corners.iter().copied())
        .map(Extent::of_points)
        .collect();
    let mut matrix = HMatrix::new(&surface, &cells, &Approximation::default())?;
    let x = noise(1536);
    let dense = exact(&surface, [768; 2], &x);
    let found = product(&matrix, &x);
    assert!(error(&found, &dense) < 1e-6, "{:e}", error(&found, &dense));
    assert!(far_error(&mut matrix, &surface) < 2e-4);
    let compression = matrix.compression();
    assert!(
        compression.stored_share() < 0.75 && compression.evaluated_share() < 0.9,
        "{compression}"
    );
    Ok(())
}

#[test]
fn a_plane_has_no_normal_stress() -> Outcome {
    let surface = surface([16, 12], 0.0)?;
    let cells: Vec<_> = (surface.corners.iter().copied())
        .map(Extent::of_points)
        .collect();
    let mut matrix = HMatrix::new(&surface, &cells, &Approximation::default())?;
    assert!(far_error(&mut matrix, &surface) < 2e-4);
    let found = product(&matrix, &noise(768));
    let shear = found.chunks_exact(3).map(|rows| rows[0].abs());
    let largest = shear.fold(0.0, f64::max);
    assert!(
        found
            .chunks_exact(3)
            .all(|rows| rows[2].abs() < 1e-12 * largest)
    );
    Ok(())
}
