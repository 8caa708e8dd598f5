//! Heat and fluid across a fault.

mod block;
mod error;
mod heating;
mod modes;
mod parameters;
mod passes;
mod pressurization;
mod relaxation;

pub use error::ThermalError;
pub use heating::ShearHeating;
pub use parameters::{PoreFluid, ShearZone};
pub use pressurization::ThermalPressurization;
