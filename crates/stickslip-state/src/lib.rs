//! State laws of rate- and state-dependent friction.
//!
//! A state law is a scalar differential equation `alpha' = g(alpha, V)` at a point of the
//! frictional boundary, driven by the slip rate `V` \[m/s\] there. Everything in this crate is a
//! function of `f64`; fields, meshes and time loops live elsewhere.
//!
//! | law | state | `g` |
//! | --- | --- | --- |
//! | [`Dieterich`] (aging) | [`LogTheta`] | `exp(-alpha) - V/L` |
//! | [`Ruina`] (slip) | [`LogTheta`] | `-(V/L) (alpha + ln(V/L))` |
//! | [`Discontinuous`] | [`Theta`] | `V` below, `-V` above `theta V = 1` |
//! | `()` (no state) | `()` | `0` |
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
//! [`wright`] holds the special function behind the closed forms, [`increasing_root`] the solver
//! behind the laws that have none, [`check_state_law`] the contract of a law as a function.

mod bracketed;
mod conformance;
mod dieterich;
mod discontinuous;
mod error;
mod forward;
mod generic;
mod law;
mod ruina;
mod variable;
pub mod wright;

pub use bracketed::increasing_root;
pub use conformance::{StateLawViolation, Step, check_state_law};
pub use dieterich::Dieterich;
pub use discontinuous::Discontinuous;
pub use error::{RootError, StateError};
pub use law::StateLaw;
pub use ruina::Ruina;
pub use variable::{LogTheta, Reads, StateVariable, Theta};
