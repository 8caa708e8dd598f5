//! Geometry of one cell.

use nalgebra::{SMatrix, SVector};

/// Vertices of the largest simplex in use.
pub(crate) const MAX_CORNERS: usize = 4;

/// Volume over (longest edge)^D below which a cell is flat up to rounding.
const FLATNESS: f64 = 1e-14;

/// A cell with its signed volume and the gradients of its hat functions; entries from D + 1 on are zero.
pub(crate) struct Simplex<const D: usize> {
    pub(crate) corners: [SVector<f64, D>; MAX_CORNERS],
    pub(crate) gradients: [SVector<f64, D>; MAX_CORNERS],
    pub(crate) volume: f64,
}

impl<const D: usize> Simplex<D> {
    /// With edges e_j = x_j - x_0 as columns of J, the gradients are the rows of J^-1 = cof(J)^T / det J.
    pub(crate) fn new(vertices: &[SVector<f64, D>], cell: &[u32]) -> Self {
        let mut corners = [SVector::zeros(); MAX_CORNERS];
        for (corner, &p) in corners.iter_mut().zip(cell) {
            *corner = vertices[p as usize];
        }
        let edges = SMatrix::<f64, D, D>::from_fn(|i, j| corners[j + 1][i] - corners[0][i]);
        let cofactors = cofactors(&edges);
        let determinant = edges.column(0).dot(&cofactors.column(0));
        let mut gradients = [SVector::zeros(); MAX_CORNERS];
        for j in 0..D {
            gradients[j + 1] = cofactors.column(j) / determinant;
            gradients[0] -= gradients[j + 1];
        }
        let factorial = if D == 2 { 2.0 } else { 6.0 };
        Self {
            corners,
            gradients,
            volume: determinant / factorial,
        }
    }

    pub(crate) fn at(&self, barycentric: &[f64; MAX_CORNERS]) -> SVector<f64, D> {
        combine(&self.corners, barycentric)
    }

    pub(crate) fn midpoint(&self) -> SVector<f64, D> {
        self.corners[..=D].iter().sum::<SVector<f64, D>>() / (D + 1) as f64
    }

    /// Whether it is neither inverted nor flat up to rounding.
    pub(crate) fn is_solid(&self) -> bool {
        let flat = FLATNESS * self.longest_edge().powi(D as i32);
        self.volume.is_finite() && self.volume > flat
    }

    pub(crate) fn longest_edge(&self) -> f64 {
        let corners = &self.corners[..=D];
        let pairs = corners
            .iter()
            .flat_map(|a| corners.iter().map(move |b| (a - b).norm()));
        pairs.fold(0.0, f64::max)
    }
}

/// The point with the given barycentric coordinates.
pub(crate) fn combine<const C: usize>(
    corners: &[SVector<f64, C>],
    barycentric: &[f64],
) -> SVector<f64, C> {
    corners
        .iter()
        .zip(barycentric)
        .fold(SVector::zeros(), |sum, (x, &weight)| sum + x * weight)
}

/// Length (D = 2) or area (D = 3) of a face.
pub(crate) fn face_area<const D: usize>(corners: &[SVector<f64, D>; D]) -> f64 {
    let normal = face_normal(corners);
    // Without the third component where there is none.
    normal.iter().fold(0.0, |area: f64, &n| area.hypot(n))
}

/// The normal of a face, of the length of its area; outward for a face of [`Mesh::boundary`](crate::Mesh).
pub(crate) fn face_normal<const D: usize>(corners: &[SVector<f64, D>; D]) -> SVector<f64, D> {
    let a = corners[1] - corners[0];
    if D == 2 {
        return SVector::from_fn(|c, _| if c == 0 { a[1] } else { -a[0] });
    }
    let b = corners[2] - corners[0];
    let minor = |i: usize, j: usize| 0.5 * (a[i] * b[j] - a[j] * b[i]);
    SVector::from_fn(|c, _| minor((c + 1) % 3, (c + 2) % 3))
}

fn cofactors<const D: usize>(m: &SMatrix<f64, D, D>) -> SMatrix<f64, D, D> {
    SMatrix::from_fn(|i, j| {
        if D == 2 {
            let minor = m[(1 - i, 1 - j)];
            if i == j { minor } else { -minor }
        } else {
            // Cyclic rows and columns carry the sign.
            let (r, s, c, d) = ((i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3);
            m[(r, c)] * m[(s, d)] - m[(r, d)] * m[(s, c)]
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Vector2, Vector3};

    #[test]
    fn gradients_are_dual_to_the_edges() {
        let points = [
            Vector3::new(0.1, 0.2, -0.3),
            Vector3::new(1.4, 0.3, 0.0),
            Vector3::new(0.2, 0.9, 0.1),
            Vector3::new(-0.2, 0.1, 1.1),
        ];
        let simplex = Simplex::new(&points, &[0, 1, 2, 3]);
        for i in 0..4 {
            for j in 0..4 {
                let rise = simplex.gradients[i].dot(&(points[j] - points[0]));
                let expected = f64::from(i == j) - f64::from(i == 0);
                assert!((rise - expected).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn volumes_and_areas_of_unit_simplices() {
        let triangle = [Vector2::zeros(), Vector2::x(), Vector2::y()];
        assert_eq!(Simplex::new(&triangle, &[0, 1, 2]).volume, 0.5);
        assert_eq!(Simplex::new(&triangle, &[0, 2, 1]).volume, -0.5);
        assert_eq!(face_area(&[Vector2::zeros(), Vector2::new(3.0, 4.0)]), 5.0);
        assert_eq!(
            face_area(&[Vector3::zeros(), Vector3::x() * 2.0, Vector3::z()]),
            1.0
        );
    }
}
