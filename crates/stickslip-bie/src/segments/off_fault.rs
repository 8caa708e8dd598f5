//! Stress and displacement at points off the fault.

use nalgebra::{Matrix3, SVector, Vector3};

use super::{SegmentFault, SegmentsError};
use crate::off_fault::{Jump, Lines, Segment};
use crate::{KernelError, Mode};

/// The least distance of a receiver from the end of a cell, as a share of its length.
const LEAST: f64 = 1e-9;

impl SegmentFault {
    /// The displacement `[x, y, z]` \[m\] at points `[x, z]` \[m\] due to slip on the cells \[m\], zero far away. On a cell it
    /// is that of one of its sides.
    ///
    /// ```
    /// use nalgebra::Vector1;
    /// use stickslip_bie::{Medium, Mode, SegmentFault, Segments};
    ///
    /// // Below a locked fault: (D/pi) [atan(x/d) - atan(x/w)] of slip from d to w.
    /// let rock = Medium { shear_modulus: 32.04e9, shear_wave_speed: 3464.0 };
    /// let deep = Segments::polyline(&[[0.0, -15e3], [0.0, -500e3]])?;
    /// let fault = SegmentFault::half_space(deep, rock, Mode::Antiplane)?;
    /// let [[_, along, _]] = fault.displacement_at(&[[10e3, 0.0]], &[Vector1::new(2.0)])?[..] else { panic!() };
    /// let exact = 2.0 / std::f64::consts::PI * ((10.0_f64 / 15.0).atan() - (10.0_f64 / 500.0).atan());
    /// assert!((along - exact).abs() < 1e-12);
    /// # Ok::<(), stickslip_bie::SegmentsError>(())
    /// ```
    ///
    /// # Errors
    /// [`SegmentsError`] for another number of slips than cells, a point that is not finite, above the free surface, or at
    /// an end of a cell.
    #[doc(alias("surface displacement", "receiver", "geodesy"))]
    pub fn displacement_at(
        &self,
        points: &[[f64; 2]],
        slip: &[SVector<f64, 1>],
    ) -> Result<Vec<[f64; 3]>, SegmentsError> {
        self.check_receivers(points, slip)?;
        let (lines, _) = self.lines();
        let of_point = |&[x, z]: &[f64; 2]| {
            let (at, cells) = (Vector3::new(x, 0.0, z), slip.iter().enumerate());
            let moved = cells.map(|(cell, slip)| lines.displacement(cell, &at) * slip[0]);
            moved.sum::<Vector3<f64>>().into()
        };
        Ok(points.iter().map(of_point).collect())
    }

    /// The stress tensor \[Pa\], axes `x`, `y` and `z`, tension positive, at points `[x, z]` \[m\] due to slip on the cells
    /// \[m\].
    ///
    /// # Errors
    /// [`SegmentsError`] for another number of slips than cells, a point that is not finite, above the free surface, or at
    /// an end of a cell.
    #[doc(alias("Coulomb stress", "receiver"))]
    pub fn stress_at(
        &self,
        points: &[[f64; 2]],
        slip: &[SVector<f64, 1>],
    ) -> Result<Vec<Matrix3<f64>>, SegmentsError> {
        self.check_receivers(points, slip)?;
        let (lines, _) = self.lines();
        let of_point = |&[x, z]: &[f64; 2]| {
            let (at, cells) = (Vector3::new(x, 0.0, z), slip.iter().enumerate());
            let stress = cells.map(|(cell, slip)| lines.stress(cell, &at) * slip[0]);
            stress.sum::<Matrix3<f64>>()
        };
        Ok(points.iter().map(of_point).collect())
    }

    /// The cells as sources, and whether there is a free surface.
    pub(crate) fn lines(&self) -> (Lines, bool) {
        let influence = self.influence();
        let segments = influence.cells.iter().map(|cell| Segment {
            ends: cell.ends,
            jump: match self.mode {
                Mode::Antiplane => Jump::Antiplane(cell.side.antiplane_jump()),
                Mode::InPlane { .. } => {
                    Jump::InPlane(cell.side.in_plane_jump(cell.direction) * influence.sense)
                }
            },
        });
        let lines = Lines {
            space: influence.space,
            segments: segments.collect(),
        };
        (lines, self.free_surface)
    }

    fn check_receivers(
        &self,
        points: &[[f64; 2]],
        slip: &[SVector<f64, 1>],
    ) -> Result<(), SegmentsError> {
        let count = self.segments.count();
        if slip.len() != count {
            let (what, requirement) = ("number of slips", "that of the cells,");
            let error = KernelError::new(what, requirement, slip.len() as f64);
            return Err(error.bound(count as f64).into());
        }
        for (point, &position) in points.iter().enumerate() {
            let [x, z] = position;
            if !(x.is_finite() && z.is_finite()) || (self.free_surface && z > 0.0) {
                return Err(SegmentsError::Receiver { point, position });
            }
            for cell in 0..count {
                let ends = self.segments.ends(cell);
                let apart = ends.map(|end| (x - end[0]).hypot(z - end[1]));
                let distance = apart[0].min(apart[1]);
                if distance <= LEAST * self.segments.length(cell) {
                    return Err(SegmentsError::ReceiverAtEnd {
                        point,
                        cell,
                        distance,
                    });
                }
            }
        }
        Ok(())
    }
}
