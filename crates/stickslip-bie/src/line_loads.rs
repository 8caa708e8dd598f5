//! Loads and sections of faults along lines, whatever their kernel.

use nalgebra::SVector;
use stickslip_solvers::Operator;

use crate::error::check_factor;
use crate::loading::{PLATE_RATES, STRESS_RATES, check_rates, growing, relieving};
use crate::{DippingFault, DippingKernel, Fault, Kernel, KernelError, Section};

/// The functions that a kind of fault has by its cells, its stiffness and its radiation damping.
macro_rules! line_loads {
    ($fault:ty, $kernel:ty) => {
        impl $fault {
            /// Plate loading by back slip, a load history: the force that relieves cells that slip at their `rates`
            /// [m/s].
            ///
            /// # Errors
            /// [`KernelError`] for another number of rates than cells, and for a rate that is not finite.
            #[doc(alias = "backslip")]
            pub fn back_slip(
                &self,
                rates: &[SVector<f64, 1>],
            ) -> Result<
                impl Fn(f64, &mut [SVector<f64, 1>]) + Send + Sync + 'static + use<>,
                KernelError,
            > {
                check_rates(self.cells().count(), PLATE_RATES, rates)?;
                Ok(relieving(&self.stiffness(), rates))
            }

            /// A load history of shear stresses that grow at `rates` [Pa/s], one per cell.
            ///
            /// # Errors
            /// [`KernelError`] for another number of rates than cells, and for a rate that is not finite.
            pub fn stress_rates(
                &self,
                rates: &[SVector<f64, 1>],
            ) -> Result<
                impl Fn(f64, &mut [SVector<f64, 1>]) + Send + Sync + 'static + use<>,
                KernelError,
            > {
                check_rates(self.cells().count(), STRESS_RATES, rates)?;
                let length = self.cells().length();
                Ok(growing(rates.iter().map(|rate| rate * length).collect()))
            }

            /// [`radiation_damping`](Self::radiation_damping) times a factor, finite and not negative.
            ///
            /// # Errors
            /// [`KernelError`] for a factor out of its range.
            pub fn radiation_damping_times(&self, factor: f64) -> Result<$kernel, KernelError> {
                check_factor(factor)?;
                let mut damping = self.radiation_damping();
                damping.set_combination(&[(factor, &self.radiation_damping())]);
                Ok(damping)
            }

            /// The cells whose centres lie from one position to another \[m\], see
            /// [`Cells::section`](crate::Cells::section).
            ///
            /// # Errors
            /// [`KernelError`] if no cell has its centre there.
            pub fn section(&self, range: [f64; 2]) -> Result<Section, KernelError> {
                self.cells().section(range)
            }
        }
    };
}

line_loads!(Fault, Kernel);
line_loads!(DippingFault, DippingKernel);
