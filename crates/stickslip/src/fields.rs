//! Fields that live on a fault and advance with it: pore pressure, temperature, porosity.
//!
//! A [`Contact`](crate::Contact) has any number of them ([`with_field`](crate::Contact::with_field)); their pressures add.
//! [`RungeKutta`](crate::RungeKutta) advances a field at every stage from the start of the step, with the source of the
//! stage from its tableau; a [`Simulation`](crate::Simulation) finds the pressure of the end of a step with the slip rates
//! there, by the iteration of [normal stresses from the deformation](crate::NormalStress::from_body), whose contraction is
//! [reported](crate::integrate::StepReport::contraction), and refused from 1 on. Both are of second order at least.
//!
//! A pressure that slip raises, and that drains:
//!
//! ```
//! use stickslip::fields::{FaultField, FaultRates, FieldError, FieldSizes};
//! use stickslip::friction::Tresca;
//! use stickslip::nalgebra::{Matrix1, Vector1};
//! use stickslip::{BoundaryPart, Contact, RungeKutta, Scene, Steps};
//!
//! /// `p' = C V - p/t_d` [Pa/s].
//! struct Drained {
//!     rise: f64,
//!     time: f64,
//! }
//!
//! impl FaultField for Drained {
//!     fn sizes(&self) -> FieldSizes {
//!         FieldSizes { vertices: 1, memory: vec![0.0], sources: 1 }
//!     }
//!
//!     fn source(&self, at: &FaultRates<'_>, _memory: &[f64], source: &mut [f64]) {
//!         source[0] = self.rise * at.slip_rate[0];
//!     }
//!
//!     fn advance(
//!         &self,
//!         from: &[f64],
//!         [begin, end]: [&[f64]; 2],
//!         dt: f64,
//!         to: &mut [f64],
//!     ) -> Result<(), FieldError> {
//!         let z = dt / self.time;
//!         // (1 - exp(-z))/z, and (1 - that)/z.
//!         let first = if z > 0.0 { -(-z).exp_m1() / z } else { 1.0 };
//!         let second = if z > 1e-3 { (1.0 - first) / z } else { 0.5 - z / 6.0 + z * z / 24.0 - z.powi(3) / 120.0 };
//!         to[0] = from[0] * (-z).exp() + dt * (first * begin[0] + second * (end[0] - begin[0]));
//!         Ok(())
//!     }
//!
//!     fn pressure(&self, memory: &[f64], pressure: &mut [f64]) {
//!         pressure[0] += memory[0];
//!     }
//! }
//!
//! // A dashpot under a constant load: V = (f - mu (sigma_n - p))/eta, and p = C t_d V in the end.
//! let (load, eta) = (0.61e6, 1e9);
//! let drained = Drained { rise: 1e10, time: 5.0 };
//! let contact = Contact::new(BoundaryPart::point(1.0), Tresca { coefficient: 0.01 }, 60e6)
//!     .with_field(drained);
//! let scene = Scene::new(Matrix1::new(0.0))
//!     .with_viscosity(Matrix1::new(eta))
//!     .with_load(vec![Vector1::new(load)])
//!     .with_contact(contact);
//! let mut block = RungeKutta::new(scene)?;
//! block.run(&Steps::adaptive(1e-8).until(200.0), |_| ())?;
//! let steady = (load - 0.01 * 60e6) / (eta - 0.01 * 1e10 * 5.0);
//! assert!((block.snapshot().velocity[0][0] / steady - 1.0).abs() < 1e-5);
//! assert!((block.snapshot().contact(0).pore_pressure(0) / (1e10 * 5.0 * steady) - 1.0).abs() < 1e-5);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub use stickslip_fields::*;
