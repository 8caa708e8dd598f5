//! Fits rate- and state-dependent friction to laboratory experiments: velocity steps, holds, slide-hold-slide.
//!
//! The model is a quasi-static spring slider, with one or two states:
//!
//! ```text
//! mu = mu0 + a ln(V/V0) + sum b_i ln(V0 theta_i/L_i),   dmu/dt = k (V_lp - V),   k = K/sigma_n [1/m]
//! ```
//!
//! The velocity `V_lp` of the load point is constant between any number of velocity steps and holds, or follows from
//! its measured displacement. The equations are integrated with their sensitivities by a Rosenbrock method of order 4
//! with a dense output, which is stable on stiff machines and in holds; the sum of squares is minimised by the method of
//! Levenberg and Marquardt from starts that are computed from the curve.
//!
//! | item | content |
//! | --- | --- |
//! | [`LoadHistory`] | the velocity of the load point over time |
//! | [`Record`] | measured friction, with weights and windows |
//! | [`Fit`] | laws, fixed and bounded parameters, trend, initial state, time of the steps, [loss](Loss); [`run`](Fit::run), and [`run_joint`](Fit::run_joint) of several records |
//! | [`Fitted`] | parameters, standard errors of independent or correlated [errors](Errors), AIC, curve, [spikes](Spike), [warnings](Warning) |
//! | [`Parameters`] | parameters of friction and machine, and their [curve](Parameters::curve) |
//! | [`Healing`] | peaks of slide-hold-slide and the healing rate |
//!
//! ```
//! use stickslip_lab::{Evolution, Fit, Healing, LoadHistory, Parameters, Record};
//! # use stickslip_friction::DieterichRuina;
//! # let friction = DieterichRuina {
//! #     a: 0.008, b: 0.012, reference_friction: 0.6, reference_velocity: 1e-5, slip_distance: 1.5e-5,
//! # };
//!
//! let load = LoadHistory::slide_hold_slide(1e-5, &[10.0, 100.0, 1000.0], 3e-4)?;
//! let times = load.samples(200);
//! let synthetic = Parameters::one_state(&friction, 1500.0).curve(&[Evolution::Slip], &load, &times)?;
//! let record = Record::new(times, synthetic)?;
//!
//! let slip = Fit::new(&[Evolution::Slip]).with_stiffness(1500.0).run(&record, &load)?;
//! let aging = Fit::new(&[Evolution::Aging]).with_stiffness(1500.0).run(&record, &load)?;
//! assert!(slip.aic < aging.aic);
//! println!("{slip}\nhealing {:.4} per decade", Healing::of(&record, &load)?.rate);
//! # Ok::<(), stickslip_lab::LabError>(())
//! ```

#![cfg_attr(docsrs, feature(doc_cfg))]

// The program of the page of the package is compiled here.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod beginning;
mod candidates;
mod checks;
mod course;
mod curve;
mod differences;
mod doubts;
mod end;
mod error;
mod evolution;
mod experiment;
mod features;
mod fit;
mod fitted;
mod gauge;
mod healing;
mod joint;
mod law;
mod least_squares;
mod levels;
mod load;
mod loss;
mod model;
mod normal;
mod offset;
mod parameter;
mod parameters;
mod part;
mod point;
mod ranges;
mod record;
mod robust;
mod rosenbrock;
mod rounded;
mod score;
mod search;
mod setup;
mod spikes;
mod spread;
mod start;
mod synthetic;
mod system;
mod table;
mod told;
mod trend;
mod warning;

pub use curve::Work;
pub use error::LabError;
pub use evolution::{BoxedLaw, Evolution};
pub use experiment::Experiment;
pub use fit::Fit;
pub use fitted::{Errors, Estimate, Fitted};
pub use healing::{Healing, Hold};
pub use joint::{JointEstimate, JointFit};
pub use load::LoadHistory;
pub use loss::Loss;
pub use parameter::Parameter;
pub use parameters::{Parameters, StateParameters};
pub use record::Record;
pub use spikes::Spike;
pub use trend::Trend;
pub use warning::Warning;
