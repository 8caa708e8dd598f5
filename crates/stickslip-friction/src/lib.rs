//! Friction laws of rate- and state-dependent friction, and the convex potentials they generate.
//!
//! ```
//! use nalgebra::{SMatrix, SVector};
//! use stickslip_friction::{ConvexPotential, Radial, Tresca};
//!
//! let potential = Radial { law: Tresca { coefficient: 0.5 }, force: 2.0, state: () };
//! let block = SMatrix::<f64, 2, 2>::new(4.0, 0.0, 0.0, 4.0);
//! assert_eq!(potential.minimize(&block, &SVector::from([0.6, 0.8])), SVector::from([0.0, 0.0]));
//! let v = potential.minimize(&block, &SVector::from([3.0, 4.0]));
//! assert!((v - SVector::from([0.6, 0.8])).norm() < 1e-15); // (5 - 1)/4 along the force
//! ```
//!
//! A [`FrictionLaw`] is a coefficient of friction `mu(V, alpha)`, a few functions of `f64`:
//!
//! | law | state | `mu` |
//! | --- | --- | --- |
//! | [`Tresca`] | `()` | a constant |
//! | [`StateDependentTresca`] | `LogTheta` | `max(0, mu0 + b (alpha + ln(V0/L)))` |
//! | [`LinearWeakening`] | `Weakening` | `mu_s - (mu_s - mu_d) min(max(w, 0), 1)`, by slip or time |
//! | [`DieterichRuina`] | `LogTheta` | `a max(0, ln(V/Vm(alpha)))` |
//! | [`RegularizedDieterichRuina`] | `LogTheta` | `a asinh(V/(2 Vm(alpha)))` |
//! | [`RegularizedInPsi`], [`StrongRateWeakening`] | `Psi` | `a asinh(V/(2 V0) exp(psi/a))` |
//!
//! [`ForcedRupture`] is the larger of slip and time weakening, for a contact that knows the time; [`ForcedCap`] a cap that
//! falls with time, for any law, and [`Capped`] a law below a cap.
//! [`TwoStates`] has the parameters of friction with two state variables. It is no law itself: its two
//! [`parts`](TwoStates::parts) are, one for each of two contacts on the same part of the boundary. [`Radial`] turns any
//! law, with a nodal normal force, into a [`ConvexPotential`] of a velocity vector. A solver evaluates it, linearises
//! it and minimises it exactly against a quadratic function. [`Sliding`] makes a potential of some components of a
//! vector, the others free or prescribed. [`SlipRates`] has the slip rates of many nodes at a time, several per
//! instruction where a law overrides [`FrictionLaw::slip_rates`]. [`check_friction_law`] and [`check_convex_potential`] check the contracts,
//! [`sample_friction_law`] checks the first quickly.

#![cfg_attr(docsrs, feature(doc_cfg))]

// The program of the page of the package is compiled here.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod capped;
mod conformance;
mod dieterich_ruina;
mod difference;
mod error;
mod forced_cap;
mod forced_rupture;
mod jacobi;
mod law;
mod linear_weakening;
mod local_problem;
mod modulus;
mod nodal;
mod potential;
mod radial;
mod regularized;
mod sliding;
mod slip_rates;
mod state_dependent_tresca;
mod strong_rate_weakening;
mod tresca;
mod two_states;
mod unilateral;

pub use capped::Capped;
pub use conformance::{
    FrictionViolation, check_convex_potential, check_friction_law, check_slip_rates,
    sample_friction_law,
};
pub use dieterich_ruina::DieterichRuina;
pub use error::FrictionError;
pub use forced_cap::ForcedCap;
pub use forced_rupture::ForcedRupture;
pub use law::{FrictionLaw, Response};
pub use linear_weakening::LinearWeakening;
pub use modulus::modulus;
pub use nodal::Nodal;
pub use potential::{ConvexPotential, Interval, LocalModel};
pub use radial::Radial;
pub use regularized::{RegularizedDieterichRuina, RegularizedInPsi};
pub use sliding::Sliding;
pub use slip_rates::SlipRates;
pub use state_dependent_tresca::StateDependentTresca;
pub use strong_rate_weakening::StrongRateWeakening;
pub use tresca::Tresca;
pub use two_states::TwoStates;
pub use unilateral::Unilateral;
