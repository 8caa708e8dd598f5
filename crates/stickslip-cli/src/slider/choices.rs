//! What the slider's command line chooses from.

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
    /// Of second order, damps what a step does not resolve; two stages a step
    Sdirk2,
    /// Of second order, damps what a step does not resolve by --spectral-radius a step
    #[value(alias = "generalised-alpha")]
    GeneralizedAlpha,
    /// Explicit, with a lumped mass; up to a step limit
    CentralDifferences,
}

/// What of the body is simulated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Body {
    /// All of its vertices
    Full,
    /// Its contact, and its lowest modes
    Reduced,
}

/// Up to where a reduced body keeps modes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Frequency {
    /// As far as the step follows them.
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

/// How rate and state meet in a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Coupling {
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
pub enum Update {
    /// That of the end of the step, as in the paper: of first order
    BackwardEuler,
    /// The mean of both ends: of second order
    Midpoint,
}
