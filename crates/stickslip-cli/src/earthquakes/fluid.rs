//! The command line of problems with fluid injection.

use clap::{Args, ValueEnum};

use crate::cli::positive;

/// The settings of bp6, bp6s and bp8.
#[derive(Debug, Args)]
pub struct Fluid {
    /// bp6, bp6s: the pore pressure, by diffusion along the fault or in closed form; solver by default
    #[arg(long, value_enum)]
    pub pressure: Option<Pressure>,
    /// bp8: the injection, spread as a Gaussian (BP8-GS) or by a well (BP8-PW); gaussian by default
    #[arg(long, value_enum)]
    pub source: Option<Source>,
    /// bp8: the least effective normal stress that friction sees, where the pressure of a well passes the normal stress
    /// [Pa]; the run says for how many cells
    #[arg(long, value_name = "PA", value_parser = positive, conflicts_with = "allow_opening")]
    pub least_normal_stress: Option<f64>,
    /// bp8: the fault opens where the pressure of a well passes the normal stress: no friction is there
    #[arg(long, alias = "open")]
    pub allow_opening: bool,
    /// bp8: hydraulic cells along the side of a cell of the fault, an odd number; 1 by default
    #[arg(long, value_name = "NUMBER", value_parser = odd)]
    pub refine: Option<usize>,
}

/// Pore pressures by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Pressure {
    /// By diffusion on the cells of the fault
    Solver,
    /// In closed form
    ClosedForm,
}

/// Sources by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Source {
    /// Spread as a Gaussian
    Gaussian,
    /// A well with a bore
    Well,
}

/// Reads an odd number.
fn odd(text: &str) -> Result<usize, String> {
    let requirement = "must be an odd number, so that a cell has a centre";
    let number: usize = text.trim().parse().map_err(|_| requirement.to_owned())?;
    let legal = (number % 2 == 1 && number < 100).then_some(number);
    legal.ok_or_else(|| requirement.into())
}

impl Fluid {
    /// The pore pressure.
    pub(super) fn pressure(&self) -> Pressure {
        self.pressure.unwrap_or(Pressure::Solver)
    }

    /// The source of fluid.
    pub(super) fn source(&self) -> Source {
        self.source.unwrap_or(Source::Gaussian)
    }

    /// The hydraulic cells along the side of a cell.
    pub(super) fn refinement(&self) -> usize {
        self.refine.unwrap_or(1)
    }
}

impl Pressure {
    /// Its name on the command line.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Solver => "solver",
            Self::ClosedForm => "closed-form",
        }
    }
}
