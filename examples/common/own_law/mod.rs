//! A law of one's own in two experiments, next to one of the library's: a velocity step of a spring
//! slider, and the paper's 2D slider through its first slip.

mod comparison;
mod runs;

use std::num::NonZeroUsize;

use clap::Args;
use stickslip::Monolithic;
use stickslip::friction::FrictionLaw;
use stickslip::state::StateLaw;

use crate::common::cli::Problem;

pub(crate) use comparison::{Comparison, SUMMARY};
use runs::{Sliding, VelocityStep};

// No documentation comment: it would take the place of the example's in --help.
#[derive(Debug, Clone, Args)]
pub(crate) struct Resolution {
    /// Uniform refinements of the 2D slider's mesh of ten triangles
    #[arg(long, value_name = "J", default_value_t = 3, value_parser = clap::value_parser!(u8).range(1..=8))]
    refinements: u8,
    /// Time steps in the 2D slider's whole 15 s, of which it runs through 10.5 s
    #[arg(long, value_name = "N", default_value = "10000")]
    steps: NonZeroUsize,
}

/// Both experiments by the same laws.
pub(crate) struct Trial {
    /// The law in question.
    name: &'static str,
    velocity_step: VelocityStep,
    slider: Sliding,
}

impl Trial {
    /// Runs both with the laws `(friction, law)`, the 2D slider from the state `initial`.
    pub(crate) fn run<L, S>(
        name: &'static str,
        (friction, law, initial): (L, S, S::State),
        resolution: &Resolution,
    ) -> Result<Self, Problem>
    where
        L: FrictionLaw + Clone + 'static,
        S: StateLaw + Clone + 'static,
        L::State: From<S::State>,
    {
        Ok(Self {
            name,
            velocity_step: runs::velocity_step(friction.clone(), law.clone(), 1e-8)?,
            slider: runs::slide(
                resolution.refinements.into(),
                resolution.steps.get(),
                (friction, law, initial),
                Monolithic::default(),
            )?,
        })
    }
}
