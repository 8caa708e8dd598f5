//! The modes that a reduction omits.

use std::f64::consts::TAU;

use nalgebra::SVector;
use stickslip_solvers::Matrix;

use super::ReducedBody;
use super::projector::inner;
use crate::SceneError;

impl<const C: usize> ReducedBody<C> {
    /// The frequency of the first omitted mode \[Hz\]; `None` if all are retained.
    pub fn first_left_out(&self) -> Option<f64> {
        self.next
    }

    /// The omitted share of the surface's inertia at a frequency \[Hz\], for a uniform motion of the retained vertices
    /// in each direction; the largest of these.
    ///
    /// With the static response `E y` to such a motion and the omitted modes `phi` of frequencies `omega`, it is
    ///
    /// ```text
    /// sum of (phi . M E y)^2 Omega^2/(omega^2 - Omega^2)  over  E y . M E y
    /// ```
    ///
    /// bounded by the first omitted `omega`. It is infinite from that frequency on, and zero if no mode is omitted.
    ///
    /// # Errors
    /// [`SceneError`] where the body's fields contain NaN or infinity.
    pub fn left_out(&self, frequency: f64) -> Result<f64, SceneError> {
        let (Some(mass), Some(next)) = (&self.inertia, self.next) else {
            return Ok(0.0);
        };
        let (projector, size) = (&self.projector, self.support.fixed.len());
        let ratio = (frequency / next).powi(2);
        if ratio >= 1.0 {
            return Ok(f64::INFINITY);
        }
        let owners = &projector.owners;
        let mut largest = 0.0_f64;
        for direction in 0..C {
            let mut coordinates = vec![0.0; projector.size()];
            for (coordinate, &(_, c)) in coordinates.iter_mut().zip(owners) {
                *coordinate = f64::from(u8::from(c == direction));
            }
            let field = projector.combine(&coordinates)?;
            let mut momentum = vec![SVector::zeros(); size];
            mass.multiply_add(1.0, &field, &mut momentum);
            let square = inner(&field, &momentum);
            // The sum over all modes of (phi . M E y)^2/omega^2, less those that are kept.
            let missing = projector.offset(&momentum)?;
            let missing = inner(&missing, &momentum).max(0.0);
            if square > 0.0 {
                largest = largest.max((TAU * frequency).powi(2) * missing / square);
            }
        }
        Ok(largest / (1.0 - ratio))
    }
}
