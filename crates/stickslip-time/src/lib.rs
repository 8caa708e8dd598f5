//! Rate schemes: time discretisations with one unknown per step, the velocity.
//!
//! ```
//! use stickslip_time::{Motion, Newmark, RateScheme};
//!
//! // An undamped oscillator, u'' = -u, over one period: 2 pi in 1000 steps.
//! let dt = std::f64::consts::TAU / 1000.0;
//! let formula = Newmark::AVERAGE_ACCELERATION.update_formula(dt);
//! let (c_u, c_a) = (formula.displacement.new_velocity, formula.acceleration.new_velocity);
//! let mut state = Motion { displacement: 1.0, acceleration: -1.0, ..Motion::default() };
//! for _ in 0..1000 {
//!     let (u, a) = (formula.displacement.of_old(state), formula.acceleration.of_old(state));
//!     state = formula.motion(state, (-a - u) / (c_a + c_u));
//! }
//! assert!((state.displacement - 1.0).abs() < 1e-9);
//! ```
//!
//! Every scheme here turns `M a + A u = l - friction(v)` at the new time into
//! `(c_a M + c_u A) v + friction(v) = l - M a^ - A u^`. A scheme is a value: an [`UpdateFormula`] of weights for each
//! step size, and [`SchemeProperties`].
//!
//! | scheme | order | character |
//! | --- | --- | --- |
//! | [`Newmark`] | 2 | conserves the energy of undamped waves |
//! | [`GeneralizedAlpha`] | 2 | damps unresolved vibrations, by an adjustable factor |
//! | [`BackwardEuler`] | 1 | damps waves within a few steps |
//! | [`CentralDifferences`] | 2 | explicit, stable up to a step limit; no matrix to solve with if the mass is lumped |
//! | [`Sdirk2`] | 2 | two stages per step; damps unresolved vibrations |
//! | [`FirstOrderAlpha`] | 2 | without inertia: damps unresolved motion, by an adjustable factor |
//! | [`QuasiStatic`] of any | as the scheme | no inertia: no mass matrix, no acceleration |
//!
//! [`check_rate_scheme`] checks the contract of any scheme, also of your own.

#![cfg_attr(docsrs, feature(doc_cfg))]

// The program of the page of the package is compiled here.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod backward_euler;
mod central_differences;
mod conformance;
mod error;
mod first_order_alpha;
mod generalized_alpha;
mod newmark;
mod quasi_static;
mod scheme;
mod scheme_properties;
mod sdirk2;
mod update_formula;

pub use backward_euler::BackwardEuler;
pub use central_differences::CentralDifferences;
pub use conformance::{RateSchemeViolation, check_rate_scheme};
pub use error::TimeError;
pub use first_order_alpha::FirstOrderAlpha;
pub use generalized_alpha::GeneralizedAlpha;
pub use newmark::Newmark;
pub use quasi_static::QuasiStatic;
pub use scheme::RateScheme;
pub use scheme_properties::{SchemeProperties, Stage};
pub use sdirk2::Sdirk2;
pub use update_formula::{Motion, UpdateFormula, Weights};
