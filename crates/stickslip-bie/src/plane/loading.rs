//! Plate loading of a planar fault.

use nalgebra::SVector;
use stickslip_solvers::Operator;

use super::PlaneFault;
use crate::KernelError;

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
        check_rates(rates, self.cells.count())?;
        Ok(loading(&self.stiffness(), rates))
    }
}

/// Refuses rates that are not finite, or not one per cell.
pub(super) fn check_rates<const C: usize>(
    rates: &[SVector<f64, C>],
    count: usize,
) -> Result<(), KernelError> {
    if rates.len() != count {
        let (what, requirement) = ("number of plate rates", "that of the cells,");
        let wrong = KernelError::new(what, requirement, rates.len() as f64);
        return Err(wrong.bound(count as f64));
    }
    for (cell, rate) in rates.iter().enumerate() {
        if let Some(&value) = rate.iter().find(|rate| !rate.is_finite()) {
            let wrong = KernelError::new("plate rate [m/s] of cell", "finite", value);
            return Err(wrong.of_cell(cell));
        }
    }
    Ok(())
}

/// The force that relieves cells that slip at their rates.
pub(super) fn loading<Op: Operator<C>, const C: usize>(
    stiffness: &Op,
    rates: &[SVector<f64, C>],
) -> impl Fn(f64, &mut [SVector<f64, C>]) + Send + Sync + 'static + use<Op, C> {
    let mut loading = vec![SVector::zeros(); rates.len()];
    stiffness.multiply_add(1.0, rates, &mut loading);
    move |time, load| {
        for (load, loading) in load.iter_mut().zip(&loading) {
            *load += loading * time;
        }
    }
}
