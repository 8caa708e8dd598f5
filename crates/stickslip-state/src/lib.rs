//! State laws of rate- and state-dependent friction.
//!
//! ```
//! use stickslip_state::{Dieterich, LogTheta, StateLaw};
//!
//! let law = Dieterich { slip_distance: 1e-5 };
//! let LogTheta(alpha) = law.advance(LogTheta(-10.0), 1e-6, 1e9)?;
//! assert!((alpha - 10f64.ln()).abs() < 1e-4); // steady sliding: theta = L/V
//! # Ok::<(), stickslip_state::StateError>(())
//! ```
//!
//! A state law is a scalar differential equation `alpha' = g(alpha, V)` at a point of the frictional boundary, driven
//! by the slip rate `V` \[m/s\] there. This crate consists of functions of `f64`; fields, meshes and time loops live
//! elsewhere.
//!
//! | law | state | `g` |
//! | --- | --- | --- |
//! | [`Dieterich`] (aging) | [`LogTheta`] | `exp(-alpha) - V/L` |
//! | [`Ruina`] (slip) | [`LogTheta`] | `-(V/L) (alpha + ln(V/L))` |
//! | [`PerrinRiceZheng`] | [`LogTheta`] | `exp(-alpha) - (V/2L)^2 exp(alpha)` |
//! | [`KatoTullis`] (composite) | [`LogTheta`] | `exp(-alpha - V/Vc) - (V/L) (alpha + ln(V/L))` |
//! | [`Sato`] (composite) | [`LogTheta`] | `exp(-alpha - W/beta) - (V/L) (alpha + ln(V/L))` with `W = V exp(alpha)/L` |
//! | [`Nagata`] (stress weakening) | [`LogTheta`] | `(1/theta - V/L)/(1 + c)` with `theta = exp(alpha) (V/V0)^-p` |
//! | [`StrongWeakening`] (flash heating) | [`Psi`] | `-(V/L) (psi - psi_ss(V))` |
//! | [`InPsi`] (any law of `ln theta`) | [`Psi`] | `b alpha'` with `psi = mu0 + b ln(V0 theta/L)` |
//! | [`Discontinuous`] | [`Theta`] | `V` below, `-V` above `theta V = 1` |
//! | [`SlipWeakening`] (accumulated slip) | [`Weakening`] | `V/D_c` |
//! | [`HealingSlipWeakening`] (with healing) | [`Weakening`] | `V/D_c - w/t_h` |
//! | [`TimeWeakening`] (forced rupture) | [`Weakening`] | `1/t_0` |
//! | `()` (no state) | `()` | `0` |
//!
//! [`wright`] holds the special function of the closed forms, [`increasing_root`] the solver for laws without them.
//! [`check_state_law`] checks the contract of a law, [`sample_state_law`] checks it quickly.

#![cfg_attr(docsrs, feature(doc_cfg))]

// The program of the page of the package is compiled here.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod bracketed;
mod conformance;
mod dieterich;
mod discontinuous;
mod error;
mod evolutions;
mod forward;
mod generic;
mod healing_slip_weakening;
mod in_psi;
mod kato_tullis;
mod law;
mod many_nodes;
mod nagata;
mod number;
mod perrin_rice_zheng;
mod psi;
mod ruina;
mod sato;
mod slip_weakening;
mod strong_weakening;
mod time_weakening;
mod variable;
mod weakening;
pub mod wright;

pub use bracketed::increasing_root;
pub use conformance::{
    StateLawViolation, Step, check_evolutions, check_state_law, sample_state_law,
};
pub use dieterich::Dieterich;
pub use discontinuous::Discontinuous;
pub use error::StateError;
pub use evolutions::Evolutions;
pub use healing_slip_weakening::HealingSlipWeakening;
pub use in_psi::InPsi;
pub use kato_tullis::KatoTullis;
pub use law::StateLaw;
pub use nagata::Nagata;
pub use number::Number;
pub use perrin_rice_zheng::PerrinRiceZheng;
pub use psi::Psi;
pub use ruina::Ruina;
pub use sato::Sato;
pub use slip_weakening::SlipWeakening;
pub use strong_weakening::StrongWeakening;
pub use time_weakening::TimeWeakening;
pub use variable::{LogScale, LogTheta, Reads, StateVariable, Theta};
pub use weakening::Weakening;
