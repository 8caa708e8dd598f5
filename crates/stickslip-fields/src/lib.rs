//! Fields that live on a fault and advance with it: pore pressure, temperature, porosity.
//!
//! | item | meaning |
//! | --- | --- |
//! | [`FaultField`] | memory with a linear relaxation, fed by slip, that takes pressure from the normal stress |
//! | [`FieldSizes`], [`FaultRates`] | its numbers, and what the fault shows it |
//! | [`Reading`] | a quantity that a field shows, beside its pressure |
//! | [`Diffusion`] | a pore pressure that diffuses along the fault, with wells |
//! | [`GivenPressure`] | a pore pressure in closed form |
//! | [`ThermalPressurization`] | heat of friction across a fault, and the pore fluid that it pressurizes |
//! | [`ShearHeating`] | the heat alone |
//! | [`ShearZone`], [`PoreFluid`], [`PerVertex`] | their parameters |
//! | [`check_fault_field`] | the contract of a field, as a check of yours |
//!
//! A contact has any number of them; their pressures add.
#![cfg_attr(docsrs, feature(doc_cfg))]

mod conformance;
mod diffusion;
mod error;
mod field;
mod given;
mod per_vertex;
mod thermal;

pub use conformance::{FieldViolation, check_fault_field};
pub use diffusion::{
    Boundary, Cells, Diffusion, DiffusionError, Dilatancy, Edge, GaussianSource, Hydraulics,
    LeakOff, Line, Network, PermeabilityEvolution, Place, Plane, RateHistory, Side, Well,
};
pub use error::FieldError;
pub use field::{FaultField, FaultRates, FieldSizes, Reading};
pub use given::GivenPressure;
pub use per_vertex::PerVertex;
pub use thermal::{PoreFluid, ShearHeating, ShearZone, ThermalError, ThermalPressurization};
