//! Fields on faults: heat and fluids that live on cells and take pressure from the normal stress.

mod any;
mod cell_values;
mod diffusion;
mod dilatancy;
mod gaussian;
mod ground;
mod heating;
mod leak_off;
mod on_planes;
mod permeability;
mod position;
mod rates;
mod sides;
mod thermal;
mod well;

pub(crate) use any::{AnyField, Fields};
pub(crate) use diffusion::Diffusion;
pub(crate) use dilatancy::Dilatancy;
pub(crate) use gaussian::GaussianSource;
pub(crate) use ground::{Cells, Ground};
pub(crate) use heating::ShearHeating;
pub(crate) use leak_off::LeakOff;
pub(crate) use permeability::PermeabilityEvolution;
pub(crate) use thermal::ThermalPressurization;
pub(crate) use well::Well;
