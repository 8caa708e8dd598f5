//! Loading of several planes.

use std::ops::Range;

use nalgebra::SVector;

use super::FaultSystem;
use crate::KernelError;
use crate::loading::{PLATE_RATES, STRESS_RATES, check_rates, growing, relieving};

impl<const C: usize> FaultSystem<C> {
    /// Plate loading, a load history: beyond its cells, on all sides up to the surface, each plane creeps at its rate
    /// [m/s]. Planes that creep at their rates stress neither themselves nor others.
    ///
    /// The normal stress changes by [`normal_stiffness`](Self::normal_stiffness) times slip less plate motion.
    ///
    /// # Errors
    /// [`KernelError`] for another number of rates than planes, a rate that is not finite, and a system with a surface, which
    /// takes rates by cell: [`back_slip`](Self::back_slip).
    pub fn plate_loading(
        &self,
        rates: &[SVector<f64, C>],
    ) -> Result<impl Fn(f64, &mut [SVector<f64, C>]) + Send + Sync + 'static + use<C>, KernelError>
    {
        if self.surface.is_some() {
            let what = "number of surfaces beside planes that creep each at one rate";
            return Err(KernelError::new(what, "at most", 1.0).bound(0.0));
        }
        if rates.len() != self.planes.len() {
            let (what, requirement) = ("number of plate rates", "that of the planes,");
            let error = KernelError::new(what, requirement, rates.len() as f64);
            return Err(error.bound(self.planes.len() as f64));
        }
        let of_cells = |(rate, plane): (&SVector<f64, C>, &Range<usize>)| vec![*rate; plane.len()];
        let rates: Vec<_> = rates.iter().zip(&self.ranges).flat_map(of_cells).collect();
        self.back_slip(&rates)
    }

    /// Plate loading by back slip, a load history: the force that relieves all cells, those of planes first, that slip
    /// at their `rates` [m/s]; of one plate velocity, those of [`along`](Self::along).
    ///
    /// # Errors
    /// [`KernelError`] for another number of rates than cells, and for a rate that is not finite.
    #[doc(alias = "backslip")]
    pub fn back_slip(
        &self,
        rates: &[SVector<f64, C>],
    ) -> Result<impl Fn(f64, &mut [SVector<f64, C>]) + Send + Sync + 'static + use<C>, KernelError>
    {
        check_rates(self.vertex_count(), PLATE_RATES, rates)?;
        Ok(relieving(&self.stiffness(), rates))
    }

    /// A load history of shear stresses that grow at `rates` [Pa/s], one per cell.
    ///
    /// # Errors
    /// [`KernelError`] for another number of rates than cells, and for a rate that is not finite.
    pub fn stress_rates(
        &self,
        rates: &[SVector<f64, C>],
    ) -> Result<impl Fn(f64, &mut [SVector<f64, C>]) + Send + Sync + 'static + use<C>, KernelError>
    {
        check_rates(self.vertex_count(), STRESS_RATES, rates)?;
        let forces = rates.iter().enumerate();
        Ok(growing(
            forces.map(|(i, rate)| rate * self.area(i)).collect(),
        ))
    }
}
