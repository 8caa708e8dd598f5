//! Loads on a surface.

use nalgebra::{Matrix3, SVector, Vector3};

use super::SurfaceFault;
use crate::KernelError;
use crate::loading::{PLATE_RATES, STRESS_RATES, check_rates, growing, relieving};

/// A stress tensor on the cells of a surface.
///
/// [`SurfaceFault::resolve`] makes it.
#[derive(Debug, Clone, PartialEq)]
pub struct ResolvedStress<const C: usize> {
    /// The shear stress of each cell along its directions of slip \[Pa\].
    pub shear: Vec<SVector<f64, C>>,
    /// The normal stress of each cell, compression positive \[Pa\].
    pub normal: Vec<f64>,
}

impl<const C: usize> SurfaceFault<C> {
    /// The parts of a vector along the directions of slip of each cell: of a plate velocity [m/s] the rates that
    /// [`back_slip`](Self::back_slip) takes. The part along the normal is left out.
    ///
    /// A surface that turns is torn by one rake for all; the projection of one vector does not tear it.
    pub fn along(&self, vector: [f64; 3]) -> Vec<SVector<f64, C>> {
        let vector = Vector3::from(vector);
        let cells = 0..self.cells.count();
        cells
            .map(|cell| SVector::from_fn(|c, _| self.direction(cell, c).dot(&vector)))
            .collect()
    }

    /// The rake of the projection of a vector onto each cell \[degrees\], for [`with_rakes`](SurfaceFault::with_rakes).
    /// It is 0 where the vector is along the normal.
    pub fn rakes_along(&self, vector: [f64; 3]) -> Vec<f64> {
        let vector = Vector3::from(vector);
        let cells = 0..self.cells.count();
        cells
            .map(|cell| {
                let axes = self.cells.axes(cell);
                let part = |axis: [f64; 3]| Vector3::from(axis).dot(&vector);
                part(axes.up_dip).atan2(part(axes.strike)).to_degrees()
            })
            .collect()
    }

    /// A stress tensor \[Pa\], or its rate [Pa/s], tension positive, on each cell.
    ///
    /// A load of remote stress rates lets slip grow past bends without bound, and normal stress with it: for a few events
    /// only. Back slip does not.
    pub fn resolve(&self, stress: &Matrix3<f64>) -> ResolvedStress<C> {
        let cells = 0..self.cells.count();
        let (shear, normal) = cells
            .map(|cell| {
                let normal = Vector3::from(self.cells.axes(cell).normal);
                let traction = stress * normal;
                let shear = SVector::from_fn(|c, _| self.direction(cell, c).dot(&traction));
                (shear, -normal.dot(&traction))
            })
            .unzip();
        ResolvedStress { shear, normal }
    }

    fn direction(&self, cell: usize, component: usize) -> Vector3<f64> {
        let (axes, [strike, up_dip]) = (self.cells.axes(cell), self.directions[cell][component]);
        Vector3::from(axes.strike) * strike + Vector3::from(axes.up_dip) * up_dip
    }

    /// Plate loading by back slip, a load history: the force that relieves cells that slip at their `rates` [m/s].
    ///
    /// The normal stress changes by [`normal_stiffness`](Self::normal_stiffness) times slip less plate motion.
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
        let forces = rates.iter().enumerate();
        Ok(growing(
            forces
                .map(|(cell, rate)| rate * self.cells.area(cell))
                .collect(),
        ))
    }
}
