//! The surface of triangles below a free surface.

use super::super::SurfaceError;
use super::Triangles;
use super::vertices::{COINCIDENT, diagonal};

/// The share of a side below which a vertex is hardly below the free surface.
const GAP: f64 = 1e-3;

impl Triangles {
    /// The same triangles in a half space `z <= 0`: vertices above by less than 1e-9 of the box are put on its surface.
    ///
    /// # Errors
    /// [`SurfaceError`] for vertices above the surface, and for those below it by less than a thousandth of a side from a
    /// vertex on it.
    pub fn below_surface(mut self) -> Result<Self, SurfaceError> {
        let near = COINCIDENT * diagonal(self.points.iter());
        let heights = || self.points.iter().map(|point| point[2]);
        let highest = heights().fold(f64::NEG_INFINITY, f64::max);
        if heights().all(|z| z >= -near) {
            return Err(SurfaceError::DepthPositive { highest });
        }
        for point in &mut self.points {
            if point[2] > near {
                return Err(SurfaceError::AboveSurface { at: *point });
            }
            if point[2].abs() <= near {
                point[2] = 0.0;
            }
        }
        for corners in &self.corners {
            for k in 0..3 {
                for [from, to] in [[k, (k + 1) % 3], [(k + 1) % 3, k]] {
                    let [on, at] = [from, to].map(|k| self.points[corners[k]]);
                    let side = diagonal([on, at].iter());
                    if on[2] == 0.0 && at[2] < 0.0 && -at[2] < GAP * side {
                        return Err(SurfaceError::Gap { at });
                    }
                }
            }
        }
        Ok(self)
    }
}
