//! Problems of published experiments and benchmarks, each a module with its parameters and their source.
//!
//! | problem | model | reference |
//! | --- | --- | --- |
//! | [`pipping_slider`] | an elastic body of 5 m x 1 m on a rigid surface, pulled at its top | Pipping, Sander and Kornhuber (2015), Figs. 6.1 to 6.5 |
//! | [`antiplane_layer`] | a layer in antiplane shear | an exact solution by waves |
//! | [`two_layers`] | two layers in antiplane shear, one on the other | an exact solution by waves |
//! | [`spring_slider`] | a block on a spring: one point | linear stability, published velocity steps |
//! | [`velocity_step`] | a velocity step of its load point at a displacement | the parameters that fit a measured step |
#![cfg_attr(
    feature = "bie",
    doc = "| [`bp1`] | earthquake cycles on a planar fault, BP1-QD | Erickson et al. (2020) |"
)]

#[cfg(feature = "fem")]
pub mod antiplane_layer;
#[cfg(feature = "bie")]
pub mod bp1;
#[cfg(feature = "fem")]
mod constant_rate;
#[cfg(feature = "fem")]
pub mod pipping_slider;
pub mod spring_slider;
#[cfg(feature = "fem")]
pub mod two_layers;
pub mod velocity_step;
