//! A smooth overstress, for nucleation at a given place and time.

use crate::KernelError;
use crate::error::positive;

/// A shear stress that rises smoothly in time on a smooth patch, by which benchmarks force a rupture to nucleate:
///
/// ```text
/// tau = amplitude F(r) G(t),   F = exp(r^2/(r^2 - R^2)) for r < R, 0 beyond,
/// G = exp((t - T)^2/(t (t - 2 T))) for 0 < t < T, 0 before, 1 from T on
/// ```
///
/// All derivatives are continuous (R. Harris et al., Seismol. Res. Lett. 80 (2009), problem TPV101).
///
/// ```
/// use nalgebra::Vector2;
/// use stickslip_bie::{Cells, Overstress, Rectangles};
///
/// // BP7: 1.75 MPa within 150 m of (-50, -50) m, in 1 s.
/// let patch = Overstress::new(1.75e6, 150.0, 1.0)?;
/// let cells = Rectangles::new(Cells::new([-400.0, 400.0], 80)?, Cells::new([-400.0, 400.0], 80)?);
/// let distances = cells.map(|[x, y]| (x + 50.0).hypot(y + 50.0));
/// let load = patch.load(&distances, Vector2::new(cells.area(), 0.0));
/// let mut forces = vec![Vector2::zeros(); cells.count()];
/// load(2.0, &mut forces);
/// let largest = forces.iter().map(|force| force[0]).fold(0.0, f64::max);
/// assert!((largest / cells.area() / 1.75e6 - 1.0).abs() < 3e-3);
/// # Ok::<(), stickslip_bie::KernelError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(alias("perturbation", "forced nucleation"))]
pub struct Overstress {
    amplitude: f64,
    radius: f64,
    rise_time: f64,
}

impl Overstress {
    /// `amplitude` \[Pa\], finite; `radius` `R` \[m\] and `rise_time` `T` \[s\], positive and finite.
    ///
    /// # Errors
    /// [`KernelError`] for a value out of its range.
    pub fn new(amplitude: f64, radius: f64, rise_time: f64) -> Result<Self, KernelError> {
        if !amplitude.is_finite() {
            let what = "amplitude of the overstress [Pa]";
            return Err(KernelError::new(what, "finite", amplitude));
        }
        positive("radius of the overstress [m]", radius)?;
        positive("rise time of the overstress [s]", rise_time)?;
        Ok(Self {
            amplitude,
            radius,
            rise_time,
        })
    }

    /// The stress \[Pa\] at a distance \[m\] from its centre and a time \[s\].
    pub fn stress(&self, distance: f64, time: f64) -> f64 {
        self.amplitude * self.in_space(distance) * self.in_time(time)
    }

    /// `F(r)`.
    fn in_space(&self, distance: f64) -> f64 {
        let square = (distance / self.radius).powi(2);
        if square < 1.0 {
            (square / (square - 1.0)).exp()
        } else {
            0.0
        }
    }

    /// `G(t)`.
    fn in_time(&self, time: f64) -> f64 {
        let share = time / self.rise_time;
        if share <= 0.0 {
            0.0
        } else if share < 1.0 {
            ((share - 1.0).powi(2) / (share * (share - 2.0))).exp()
        } else {
            1.0
        }
    }

    /// A load history: the overstress on cells at `distances` \[m\] from its centre, along `direction` times the area of
    /// a cell [m^2; m on a line].
    pub fn load<const C: usize>(
        &self,
        distances: &[f64],
        direction: nalgebra::SVector<f64, C>,
    ) -> impl Fn(f64, &mut [nalgebra::SVector<f64, C>]) + Send + Sync + 'static + use<C> {
        let overstress = *self;
        let weights = distances.iter().map(|&distance| self.in_space(distance));
        let weights: Vec<f64> = weights.collect();
        move |time, load| {
            let stress = overstress.amplitude * overstress.in_time(time);
            if stress == 0.0 {
                return;
            }
            for (load, weight) in load.iter_mut().zip(&weights) {
                *load += direction * (stress * weight);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values of the formulas: F(R/2) = exp(-1/3), G(T/2) = exp(-1/3).
    #[test]
    fn the_overstress_is_smooth() -> Result<(), KernelError> {
        let patch = Overstress::new(2.0, 10.0, 4.0)?;
        let third = (-1.0_f64 / 3.0).exp();
        assert!((patch.stress(5.0, 4.0) - 2.0 * third).abs() < 1e-15);
        assert!((patch.stress(0.0, 2.0) - 2.0 * third).abs() < 1e-15);
        assert_eq!(patch.stress(0.0, 1e9), 2.0);
        for outside in [
            patch.stress(10.0, 9.0),
            patch.stress(0.0, 0.0),
            patch.stress(0.0, -1.0),
        ] {
            assert_eq!(outside, 0.0);
        }
        for near in [patch.stress(9.999, 9.0), patch.stress(0.0, 1e-3)] {
            assert!(near < 1e-100, "{near}");
        }
        assert!((patch.stress(0.0, 3.9999) - 2.0).abs() < 1e-8);
        for wrong in [f64::NAN, f64::INFINITY] {
            assert!(Overstress::new(wrong, 1.0, 1.0).is_err());
            assert!(Overstress::new(1.0, wrong, 1.0).is_err());
            assert!(Overstress::new(1.0, 1.0, -wrong).is_err());
        }
        Ok(())
    }
}
