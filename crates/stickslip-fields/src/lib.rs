//! Fields that live on a fault and advance with it: pore pressure, temperature, porosity.
//!
//! | item | meaning |
//! | --- | --- |
//! | [`FaultField`] | memory with a linear relaxation, fed by slip, that takes pressure from the normal stress |
//! | [`FieldSizes`], [`FaultRates`] | its numbers, and what the fault shows it |
//! | [`Reading`] | a quantity that a field shows, beside its pressure |
//! | [`Diffusion`] | a pore pressure that diffuses along the fault, with wells |
//! | [`GivenPressure`] | a pore pressure in closed form |
//!
//! A contact has any number of them; their pressures add.
#![cfg_attr(docsrs, feature(doc_cfg))]

mod diffusion;
mod error;
mod field;
mod given;

pub use diffusion::{
    Boundary, Cells, Diffusion, DiffusionError, Dilatancy, Edge, GaussianSource, Hydraulics,
    LeakOff, Line, Network, PerCell, PermeabilityEvolution, Place, Plane, RateHistory, Side, Well,
};
pub use error::FieldError;
pub use field::{FaultField, FaultRates, FieldSizes, Reading};
pub use given::GivenPressure;
