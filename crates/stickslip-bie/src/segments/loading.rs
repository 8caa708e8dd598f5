//! Loading of faults of segments.

use nalgebra::{Complex, SVector};

use super::SegmentFault;
use crate::loading::{PLATE_RATES, STRESS_RATES, check_rates, growing, relieving};
use crate::{KernelError, Mode};

impl SegmentFault {
    /// Plate loading, a load history: beyond its cells each fault creeps at `rate` [m/s]. Cells that creep at this rate along
    /// the fault are not stressed, apart from what bends cause; the stress rate is `-K (V - V_p)`.
    ///
    /// Normal stress is loaded likewise, at the rate `N (V - V_p)`.
    ///
    /// # Errors
    /// [`KernelError`] for a rate that is not finite.
    pub fn plate_loading(
        &self,
        rate: f64,
    ) -> Result<impl Fn(f64, &mut [SVector<f64, 1>]) + Send + Sync + 'static + use<>, KernelError>
    {
        self.back_slip(&vec![SVector::from([rate]); self.segments.count()])
    }

    /// Plate loading by back slip, a load history: the force that relieves cells that slip at their `rates` [m/s].
    ///
    /// # Errors
    /// [`KernelError`] for another number of rates than cells, and for a rate that is not finite.
    #[doc(alias = "backslip")]
    pub fn back_slip(
        &self,
        rates: &[SVector<f64, 1>],
    ) -> Result<impl Fn(f64, &mut [SVector<f64, 1>]) + Send + Sync + 'static + use<>, KernelError>
    {
        check_rates(self.segments.count(), PLATE_RATES, rates)?;
        Ok(relieving(&self.stiffness(), rates))
    }

    /// A load history of shear stresses that grow at `rates` [Pa/s], one per cell.
    ///
    /// # Errors
    /// [`KernelError`] for another number of rates than cells, and for a rate that is not finite.
    pub fn stress_rates(
        &self,
        rates: &[SVector<f64, 1>],
    ) -> Result<impl Fn(f64, &mut [SVector<f64, 1>]) + Send + Sync + 'static + use<>, KernelError>
    {
        check_rates(self.segments.count(), STRESS_RATES, rates)?;
        let rates = rates.iter().zip(self.lengths());
        Ok(growing(rates.map(|(rate, length)| rate * length).collect()))
    }

    /// The slip rate of each cell [m/s] of one plate velocity `[x, y, z]` [m/s], of the side towards `x` relative to the other
    /// one: its projection onto the direction of slip of each cell. On a level fault the side towards `x` is the upper one.
    ///
    /// Shortening, `[-V, 0, 0]`, is thrust on a fault of either direction of dip. What the projection leaves would open the
    /// fault, and is left out: at a bend, rates of neighbours differ, and slip stresses it even if it follows the plate.
    /// The rates are those of [`back_slip`](Self::back_slip) and of a scene's normal stress change.
    ///
    /// ```
    /// use stickslip_bie::{Medium, Mode, SegmentFault, Segments};
    ///
    /// let rock = Medium { shear_modulus: 32.04e9, shear_wave_speed: 3464.0 };
    /// let mode = Mode::InPlane { poisson_ratio: 0.25 };
    /// let bent = Segments::down([(60.0, 20e3), (30.0, 20e3)], 1e3)?;
    /// let fault = SegmentFault::half_space(bent, rock, mode)?;
    /// let rates = fault.along([-1e-9, 0.0, 0.0])?;
    /// assert!((rates[0][0] - 0.5e-9).abs() < 1e-22 && rates[39][0] > 0.86e-9);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`KernelError`] for a velocity that is not finite.
    pub fn along(&self, velocity: [f64; 3]) -> Result<Vec<SVector<f64, 1>>, KernelError> {
        if let Some(&value) = velocity.iter().find(|value| !value.is_finite()) {
            return Err(KernelError::new("plate velocity [m/s]", "finite", value));
        }
        let [x, y, z] = velocity;
        let rates = self.influence().cells.into_iter().map(|cell| {
            let [_, up] = cell.side.axes(cell.direction);
            match self.mode {
                Mode::Antiplane => y,
                Mode::InPlane { .. } => {
                    let along = (Complex::new(x, -z) * up).re;
                    self.sign() * cell.side.right() * along
                }
            }
        });
        Ok(rates.map(|rate| SVector::from([rate])).collect())
    }
}
