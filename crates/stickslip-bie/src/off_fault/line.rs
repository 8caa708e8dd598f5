//! Cells along lines as sources of displacement and stress.

use nalgebra::{Complex, Matrix3, Vector3};

use crate::segments::Space;

/// Segments in a space, in the plane `y = 0`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Lines {
    pub(crate) space: Space,
    pub(crate) segments: Vec<Segment>,
}

/// A segment with the jump across it of slip by 1, left minus right.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Segment {
    pub(crate) ends: [Complex<f64>; 2],
    pub(crate) jump: Jump,
}

/// A jump of displacement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Jump {
    /// Along `y`.
    Antiplane(f64),
    /// `x + i z`.
    InPlane(Complex<f64>),
}

impl Lines {
    /// The length of a cell, and the distance of a point from its nearer end.
    pub(super) fn length_and_distance(&self, cell: usize, at: &Vector3<f64>) -> [f64; 2] {
        let ([begin, end], z) = (self.segments[cell].ends, Complex::new(at.x, at.z));
        let distance = (z - begin).norm().min((z - end).norm());
        [(end - begin).norm(), distance]
    }

    pub(crate) fn displacement(&self, cell: usize, at: &Vector3<f64>) -> Vector3<f64> {
        let (Segment { ends, jump }, z) = (self.segments[cell], Complex::new(at.x, at.z));
        match jump {
            Jump::Antiplane(jump) => {
                Vector3::new(0.0, self.space.antiplane_displacement(ends, jump, z), 0.0)
            }
            Jump::InPlane(jump) => {
                let moved = self.space.in_plane_displacement(ends, jump, z);
                Vector3::new(moved.re, 0.0, moved.im)
            }
        }
    }

    pub(crate) fn stress(&self, cell: usize, at: &Vector3<f64>) -> Matrix3<f64> {
        let (Segment { ends, jump }, z) = (self.segments[cell], Complex::new(at.x, at.z));
        match jump {
            Jump::Antiplane(jump) => {
                let stress = self.space.antiplane(ends, jump, z);
                let (xy, zy) = (stress.re, -stress.im);
                Matrix3::new(0.0, xy, 0.0, xy, 0.0, zy, 0.0, zy, 0.0)
            }
            Jump::InPlane(jump) => {
                let stress = self.space.in_plane(ends, jump, z);
                let xx = 0.5 * (stress.trace - stress.deviator.re);
                let zz = 0.5 * (stress.trace + stress.deviator.re);
                let xz = 0.5 * stress.deviator.im;
                let yy = self.space.poisson_ratio() * stress.trace;
                Matrix3::new(xx, 0.0, xz, 0.0, yy, 0.0, xz, 0.0, zz)
            }
        }
    }
}
