//! Plate loading of a planar fault.

use nalgebra::SVector;

use super::PlaneFault;
use crate::KernelError;
use crate::loading::{PLATE_RATES, STRESS_RATES, check_rates, growing, relieving};

impl<const C: usize> PlaneFault<C> {
    /// Plate loading, a load history: beyond its cells, on all sides up to the surface, the fault creeps at `rate`
    /// [m/s]. Cells that creep at this rate are not stressed. A plane that is periodic in both directions has nothing
    /// beyond it, and no load.
    ///
    /// The normal stress changes by [`normal_stiffness`](Self::normal_stiffness) times slip less plate motion.
    ///
    /// # Errors
    /// [`KernelError`] for a rate that is not finite.
    pub fn plate_loading(
        &self,
        rate: SVector<f64, C>,
    ) -> Result<impl Fn(f64, &mut [SVector<f64, C>]) + Send + Sync + 'static + use<C>, KernelError>
    {
        self.back_slip(&vec![rate; self.cells.count()])
    }

    /// Plate loading by back slip, a load history: the force that relieves cells that slip at their `rates` [m/s].
    ///
    /// # Errors
    /// [`KernelError`] for another number of rates than cells, and for a rate that is not finite.
    #[doc(alias = "backslip")]
    pub fn back_slip(
        &self,
        rates: &[SVector<f64, C>],
    ) -> Result<impl Fn(f64, &mut [SVector<f64, C>]) + Send + Sync + 'static + use<C>, KernelError>
    {
        check_rates(self.cells.count(), PLATE_RATES, rates)?;
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
        check_rates(self.cells.count(), STRESS_RATES, rates)?;
        let area = self.cells.area();
        Ok(growing(rates.iter().map(|rate| rate * area).collect()))
    }
}
