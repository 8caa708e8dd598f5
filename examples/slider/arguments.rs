//! The command line of the slider.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::{Parser, ValueEnum};
use serde::Serialize;
use stickslip::problems::{FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS};

use crate::common::cli::{Problem, finite, fraction, non_negative, poisson_ratio, positive, share};
use crate::common::state_law::Law;

/// Stick and slip of an elastic body that is pulled over a rigid surface: the main experiment of
/// Pipping, Sander and Kornhuber. Writes history.csv, history.png and summary.json.
#[derive(Debug, Clone, Parser)]
#[command(name = "slider")]
pub(crate) struct Arguments {
    /// How the state evolves [default: dieterich; none with --friction tresca]
    #[arg(long)]
    law: Option<Law>,
    /// How friction depends on rate and state; tresca without --law is a constant coefficient
    /// [default: dieterich-ruina; tresca with --law none]
    #[arg(long)]
    friction: Option<Friction>,
    /// The discretisation in time
    #[arg(long, default_value = "newmark")]
    pub(crate) scheme: Scheme,
    /// The solver of the velocity problems; of no use with central-differences
    #[arg(long, default_value = "tnnmg")]
    pub(crate) solver: Solver,
    /// How rate and state meet in a step [default: fixed-point; staggered with central-differences]
    #[arg(long)]
    coupling: Option<Coupling>,
    /// The rate at which the state is advanced [default: backward-euler, as in the paper; midpoint
    /// with central-differences]
    #[arg(long)]
    state_update: Option<Update>,
    /// Uniform refinements of the mesh of ten triangles
    #[arg(long, value_name = "J", default_value_t = 4, value_parser = clap::value_parser!(u8).range(1..=10))]
    pub(crate) refinements: u8,
    /// The factor by which a step of generalised-alpha damps the fastest waves
    #[arg(long, default_value_t = 0.8, value_parser = share)]
    pub(crate) spectral_radius: f64,
    /// Time steps in the whole 15 s; a step is 15 s / N
    #[arg(long, value_name = "N", default_value = "10000")]
    pub(crate) steps: NonZeroUsize,
    /// Adapt the step to this local error of ln V and of the state; steps are 15 s / N at first, and
    /// 15 s / N times a power of two
    #[arg(long, value_name = "TOLERANCE", value_parser = positive)]
    pub(crate) adaptive: Option<f64>,
    /// The share of the 15 s after which to stop
    #[arg(long, value_name = "FRACTION", default_value_t = 1.0, value_parser = fraction)]
    pub(crate) until: f64,
    /// The tolerance of the coupling of rate and state
    #[arg(long, default_value = "1e-10", value_parser = positive)]
    pub(crate) tolerance: f64,
    /// Without the weight of the body
    #[arg(long)]
    pub(crate) no_gravity: bool,
    /// With the diagonals of the mesh the other way
    #[arg(long)]
    pub(crate) mirrored: bool,
    /// Write every K-th step to history.csv; the last one always is
    #[arg(long, value_name = "K", default_value = "1")]
    pub(crate) every: NonZeroUsize,
    /// The folder to write to
    #[arg(long, value_name = "DIR", default_value = "out/slider")]
    pub(crate) out: PathBuf,
    /// The density [kg/m^2]
    #[arg(long, default_value_t = 5e3, value_parser = positive)]
    pub(crate) density: f64,
    /// Young's modulus [N/m]
    #[arg(long, default_value_t = 5e7, value_parser = positive)]
    pub(crate) young_modulus: f64,
    /// Poisson's ratio
    #[arg(long, default_value_t = 0.3, value_parser = poisson_ratio)]
    pub(crate) poisson_ratio: f64,
    /// The normal stress on the frictional boundary [N/m]
    #[arg(long, default_value_t = NORMAL_STRESS, value_parser = non_negative)]
    pub(crate) normal_stress: f64,
    /// The weight of the rate in the coefficient of friction
    #[arg(long, default_value_t = FRICTION.a, value_parser = positive)]
    pub(crate) a: f64,
    /// The weight of the state in the coefficient of friction
    #[arg(long, default_value_t = FRICTION.b, value_parser = non_negative)]
    pub(crate) b: f64,
    /// The coefficient of friction at the reference velocity
    #[arg(long, default_value_t = FRICTION.reference_friction, value_parser = non_negative)]
    pub(crate) reference_friction: f64,
    /// The reference velocity [m/s]
    #[arg(long, default_value_t = FRICTION.reference_velocity, value_parser = positive)]
    pub(crate) reference_velocity: f64,
    /// The slip distance over which contacts are renewed [m]
    #[arg(long, default_value_t = FRICTION.slip_distance, value_parser = positive)]
    pub(crate) slip_distance: f64,
    /// The initial value of ln(theta / 1 s)
    #[arg(long, default_value_t = INITIAL_LOG_THETA, value_parser = finite)]
    pub(crate) initial_log_theta: f64,
}

impl Arguments {
    /// The state law and the friction law, each following from the other where it is not given.
    pub(crate) fn laws(&self) -> Result<(Law, Friction), Problem> {
        let friction = self.friction.unwrap_or(match self.law {
            Some(Law::None) => Friction::Tresca,
            _ => Friction::DieterichRuina,
        });
        let law = self.law.unwrap_or(match friction {
            Friction::Tresca => Law::None,
            Friction::DieterichRuina => Law::Dieterich,
        });
        if (law, friction) == (Law::None, Friction::DieterichRuina) {
            return Err("--friction dieterich-ruina needs a state, --law none has none".into());
        }
        Ok((law, friction))
    }

    /// How rate and state meet in a step.
    pub(crate) fn coupling(&self) -> Coupling {
        self.coupling.unwrap_or(match self.scheme {
            Scheme::CentralDifferences => Coupling::Staggered,
            _ => Coupling::FixedPoint,
        })
    }

    /// The rate at which the state is advanced.
    pub(crate) fn state_update(&self) -> Update {
        self.state_update.unwrap_or(match self.scheme {
            Scheme::CentralDifferences => Update::Midpoint,
            _ => Update::BackwardEuler,
        })
    }

    /// The number of steps to take.
    pub(crate) fn steps_to_take(&self) -> usize {
        ((self.until * self.steps.get() as f64).round() as usize).max(1)
    }
}

/// The coefficient of friction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Friction {
    /// By rate and state
    DieterichRuina,
    /// By state alone; constant without one
    Tresca,
}

/// The discretisation in time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Scheme {
    /// Of second order, conserves energy
    Newmark,
    /// Of first order, damps
    BackwardEuler,
    /// Of second order, damps what a step does not resolve; two stages a step
    Sdirk2,
    /// Of second order, damps what a step does not resolve by --spectral-radius a step
    #[value(alias = "generalised-alpha")]
    GeneralizedAlpha,
    /// Explicit, with a lumped mass; up to a step limit
    CentralDifferences,
}

/// The solver of the velocity problems.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Solver {
    /// Condensed up to 8 refinements, where a step takes a third of the time; TNNMG beyond
    Auto,
    /// A factorisation of the body and Newton's method on the frictional boundary
    Condensed,
    /// Truncated nonsmooth Newton multigrid
    Tnnmg,
    /// Block Gauss-Seidel; slow on fine meshes
    GaussSeidel,
}

/// How rate and state meet in a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Coupling {
    /// In turns, relaxed, as in the paper
    FixedPoint,
    /// In turns, accelerated by Aitken's rule
    Accelerated,
    /// At once, the state eliminated; in turns where that fails
    Monolithic,
    /// In turns, twice, for explicit schemes
    Staggered,
}

/// The rate at which the state is advanced.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Update {
    /// That of the end of the step, as in the paper: of first order
    BackwardEuler,
    /// The mean of both ends: of second order
    Midpoint,
}
