//! The choices on the slider's command line.

use clap::ValueEnum;
use serde::Serialize;

use crate::cli::positive;

/// The discretisation in time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Scheme {
    /// Of second order, conserves energy
    Newmark,
    /// Of first order, damps
    BackwardEuler,
    /// Of second order, damps unresolved vibrations; two stages per step
    Sdirk2,
    /// Of second order, damps unresolved vibrations by --spectral-radius per step
    #[value(alias = "generalised-alpha")]
    GeneralizedAlpha,
    /// Explicit, with a lumped mass; up to a step limit
    CentralDifferences,
}

/// The simulated body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Body {
    /// All of its vertices
    Full,
    /// Its contact, and its lowest modes
    Reduced,
}

/// The largest frequency of kept modes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Frequency {
    /// As far as the step resolves them.
    Auto,
    /// To this frequency [Hz].
    Hertz(f64),
}

pub(super) fn frequency(text: &str) -> Result<Frequency, String> {
    match text {
        "auto" => Ok(Frequency::Auto),
        _ => positive(text).map(Frequency::Hertz),
    }
}

/// The solver of the velocity problems.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Solver {
    /// Condensed up to 8 refinements, where a step takes a third of the time; TNNMG beyond
    Auto,
    /// A factorisation of the body and Newton's method on the frictional boundary
    Condensed,
    /// Truncated nonsmooth Newton multigrid
    Tnnmg,
    /// Block Gauss-Seidel; slow on fine meshes
    GaussSeidel,
}

/// The coupling of rate and state in a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Coupling {
    /// Fixed point, relaxed, as in the paper
    FixedPoint,
    /// Fixed point, accelerated by Aitken's rule
    Accelerated,
    /// Rate and state simultaneously, the state eliminated; fixed point where that fails
    Monolithic,
    /// Two fixed-point passes, for explicit schemes
    Staggered,
}

/// The rate at which the state is advanced.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Update {
    /// The rate at the end of the step, as in the paper: of first order
    BackwardEuler,
    /// The mean of both ends: of second order
    Midpoint,
}
