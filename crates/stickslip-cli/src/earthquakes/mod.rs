//! Two published problems, earthquake cycles and fluid injection: parameters, command line and reports.

pub mod bp1;
pub mod bp6;

mod run;

pub use run::run;
use std::path::PathBuf;

use clap::{Parser, ValueEnum};
use stickslip::bie::{Cells, Fault};
use stickslip::friction::RegularizedDieterichRuina;
use stickslip::integrate::Stepper;
use stickslip::{ContactView, Steps};

use crate::cli::{Problem as Failed, positive};

/// A year of 365.25 days \[s\], and a day.
pub const YEAR: f64 = 31_557_600.0;
/// A day \[s\].
pub const DAY: f64 = 86_400.0;

/// Earthquake cycles on a fault in a half space, or creep due to fluid injection
#[derive(Debug, Parser)]
pub struct Arguments {
    /// The published problem
    #[arg(long, value_enum, default_value_t = Problem::Bp1)]
    pub problem: Problem,
    /// The length of a cell [m]; 100 for bp1, 10 for bp6 by default
    #[arg(long, value_name = "METRES", value_parser = positive)]
    pub cell: Option<f64>,
    /// The end of the run [years]; 300 for bp1, 2 for bp6 by default
    #[arg(long, value_name = "YEARS", value_parser = positive)]
    pub years: Option<f64>,
    /// The error tolerance of ln V and ln theta per step
    #[arg(long, value_name = "TOLERANCE", default_value_t = 1e-4, value_parser = positive)]
    pub adaptive: f64,
    /// The time discretisation
    #[arg(long, value_enum, default_value_t = Method::RungeKutta)]
    pub method: Method,
    /// The folder to write to
    #[arg(long, value_name = "DIR", default_value = "out/earthquakes")]
    pub out: PathBuf,
}

/// Problems by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Problem {
    /// Earthquake cycles, antiplane, in a half space
    Bp1,
    /// Fluid injection into a fault, antiplane, in a whole space
    Bp6,
}

/// Methods by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Method {
    /// Explicit, by products with the kernel
    RungeKutta,
    /// Sdirk2, by the dense matrix of the kernel
    Implicit,
}

impl Arguments {
    /// The requested cell length \[m\].
    fn cell(&self) -> f64 {
        self.cell.unwrap_or(match self.problem {
            Problem::Bp1 => 100.0,
            Problem::Bp6 => 10.0,
        })
    }

    /// The ends of the fault \[m\].
    pub fn ends(&self) -> [f64; 2] {
        match self.problem {
            Problem::Bp1 => [0.0, 40e3],
            Problem::Bp6 => [-20e3, 20e3],
        }
    }

    /// The number of its cells, of at most the requested length.
    pub fn count(&self) -> usize {
        (40e3 / self.cell() * (1.0 - 1e-12)).ceil() as usize
    }

    /// The end of the run \[s\].
    fn end(&self) -> f64 {
        let years = self.years.unwrap_or(match self.problem {
            Problem::Bp1 => 300.0,
            Problem::Bp6 => 2.0,
        });
        years * YEAR
    }

    /// Adaptive steps to the end; those of an implicit method differ by powers of two.
    fn steps(&self) -> Steps {
        let steps = Steps::adaptive(self.adaptive)
            .with_max_steps(usize::MAX)
            .until(self.end());
        match self.method {
            Method::RungeKutta => steps,
            Method::Implicit => steps.in_powers_of_two(),
        }
    }

    /// Whether the time discretisation is accurate enough for checks of the results.
    fn is_accurate(&self) -> bool {
        self.method == Method::RungeKutta && self.adaptive <= 1e-4
    }
}

/// Takes the steps, and writes and prints the results.
///
/// # Errors
/// The failure of the run, files that cannot be written, and results that differ from the published ones where they
/// should agree.
fn follow(arguments: &Arguments, fault: &Fault, motion: &mut dyn Stepper<1>) -> Result<(), Failed> {
    match arguments.problem {
        Problem::Bp1 => bp1::run(arguments, fault, motion),
        Problem::Bp6 => bp6::run(arguments, fault, motion),
    }
}

/// The state, `ln(theta / 1 s)`, for which friction at a slip rate balances a ratio of shear to normal stress.
fn state_for(law: &RegularizedDieterichRuina, ratio: f64, rate: f64) -> f64 {
    // ln(2 sinh y) without overflow, y = f/a.
    let y = ratio / law.a;
    let log_sinh = y + (-(-2.0 * y).exp()).ln_1p();
    let friction = law.a * (log_sinh + (law.reference_velocity / rate).ln());
    (friction - law.reference_friction) / law.b + (law.slip_distance / law.reference_velocity).ln()
}

/// A position between two cells, or at the end of all.
struct Station {
    /// \[m\]
    z: f64,
    cells: [usize; 2],
    /// The weight of the second cell.
    share: f64,
}

impl Station {
    fn new(cells: &Cells, z: f64) -> Self {
        let last = cells.count() - 1;
        let place = ((z - cells.center(0)) / cells.length()).clamp(0.0, last as f64);
        let first = (place as usize).min(last.saturating_sub(1));
        Self {
            z,
            cells: [first, (first + 1).min(last)],
            share: place - first as f64,
        }
    }

    fn between(&self, value: impl Fn(usize) -> f64) -> f64 {
        let [first, second] = self.cells.map(value);
        first + self.share * (second - first)
    }

    /// Slip \[m\].
    fn slip(&self, contact: &ContactView<'_, 1>) -> f64 {
        self.between(|k| contact.slip(k))
    }

    /// `log10(V / 1 m/s)`.
    fn log_rate(&self, contact: &ContactView<'_, 1>) -> f64 {
        self.between(|k| contact.slip_rate(k).log10())
    }

    /// The shear stress \[Pa\].
    fn stress(&self, contact: &ContactView<'_, 1>) -> f64 {
        self.between(|k| contact.traction(k)[0])
    }
}
