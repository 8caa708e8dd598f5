//! The command line of the published problems.

use std::path::PathBuf;

use clap::{Parser, ValueEnum};
use stickslip::Steps;
use stickslip::bie::{Cells, Sense};

use super::{FaultFile, Fluid, OffFault, Problem, Source, YEAR};
use crate::cli::{Problem as Failed, positive};
use crate::output::Files;

/// The largest number of cells in a row.
const MOST: f64 = 1e6;

/// Earthquake cycles and fluid injection: benchmark problems of the community (SEAS)
#[derive(Debug, Parser)]
pub struct Arguments {
    /// The published problem
    #[arg(long, value_enum, default_value_t = Problem::Bp1)]
    pub problem: Problem,
    /// The length of a cell [m], a whole part of the fault; 100 for bp1 and bp2, 50 for bp3, 500 for bp4, 1000 for bp5,
    /// 10 for bp6, bp6s, bp7 and bp8 by default
    #[arg(long, value_name = "METRES", value_parser = positive)]
    pub cell: Option<f64>,
    /// The end of the run [years]; 300 for bp1, 1200 for bp2, 1500 for bp3, 1000 for bp4, 1800 for bp5, 2 for bp6,
    /// bp6s and bp7, 30 days for bp8 by default
    #[arg(long, value_name = "YEARS", value_parser = positive)]
    pub years: Option<f64>,
    /// The error tolerance of ln V and ln theta per step
    #[arg(long, value_name = "TOLERANCE", default_value_t = 1e-4, value_parser = positive)]
    pub adaptive: f64,
    /// The time discretisation; runge-kutta alone for bp3, bp4, bp5, bp7 and bp8
    #[arg(long, value_enum, default_value_t = Method::RungeKutta)]
    pub method: Method,
    /// bp3: the dip [degrees], 60 by default; published are 30, 60 and 90
    #[arg(long, value_name = "DEGREES", value_parser = dip)]
    pub dip: Option<f64>,
    /// bp3, --faults: the hanging wall moves up dip; the default
    #[arg(long, conflicts_with = "normal")]
    pub thrust: bool,
    /// bp3, --faults: the hanging wall moves down dip
    #[arg(long)]
    pub normal: bool,
    /// bp4, bp5, bp7, bp8: components of slip, 1 along strike or 2; 1 by default, 2 for bp8
    #[arg(long, value_name = "NUMBER", value_parser = clap::value_parser!(u8).range(1..=2))]
    pub components: Option<u8>,
    /// bp7: steady slip, without the overstress of the first second
    #[arg(long)]
    pub no_perturbation: bool,
    /// The settings of problems with fluid injection.
    #[command(flatten)]
    pub fluid: Fluid,
    /// Faults of a file.
    #[command(flatten)]
    pub fault_file: FaultFile,
    /// Displacement off the fault.
    #[command(flatten)]
    pub off_fault: OffFault,
    /// A folder for files in the format of the SEAS benchmarks
    #[arg(long, value_name = "DIR")]
    pub seas: Option<PathBuf>,
    /// The folder and the digits of the files.
    #[command(flatten)]
    pub files: Files,
}

/// Reads a dip \[degrees\].
fn dip(text: &str) -> Result<f64, String> {
    let dip = positive(text)?;
    let steepest = (dip <= 90.0).then_some(dip);
    steepest.ok_or_else(|| "must be above 0 and at most 90".into())
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
    /// Refuses settings of another problem.
    pub(super) fn check(&self) -> Result<(), Failed> {
        let (problem, bp3) = (self.problem, self.problem == Problem::Bp3);
        let bp6 = matches!(problem, Problem::Bp6 | Problem::Bp6s);
        let (bp8, fluid) = (problem == Problem::Bp8, &self.fluid);
        let dense = self.method == Method::Implicit;
        let of_file = self.fault_file.faults.is_some();
        let name = if of_file { "--faults" } else { problem.name() };
        for (flag, given, known) in [
            ("--dip", self.dip.is_some(), bp3),
            ("--thrust", self.thrust, bp3 || of_file),
            ("--normal", self.normal, bp3 || of_file),
            ("--seas", self.seas.is_some(), !of_file),
            (
                "--surface-grid",
                self.off_fault.surface_grid.is_some(),
                of_file || problem == Problem::Bp5,
            ),
            (
                "--components",
                self.components.is_some(),
                problem.is_plane(),
            ),
            (
                "--no-perturbation",
                self.no_perturbation,
                problem == Problem::Bp7,
            ),
            ("--pressure", fluid.pressure.is_some(), bp6),
            ("--source", fluid.source.is_some(), bp8),
            ("--refine", fluid.refine.is_some(), bp8),
            (
                "--least-normal-stress",
                fluid.least_normal_stress.is_some(),
                bp8,
            ),
            ("--allow-opening", fluid.allow_opening, bp8),
            (
                "--method implicit",
                dense,
                !(bp3 || problem.is_plane() || of_file),
            ),
        ] {
            if given && !known {
                return Err(format!("{flag} is not a setting of {name}").into());
            }
        }
        Ok(())
    }

    /// The name of the benchmark.
    pub(super) fn published(&self) -> String {
        let kind = match (self.problem, self.fluid.source()) {
            (Problem::Bp6 | Problem::Bp7, _) => "-A",
            (Problem::Bp6s, _) => return "BP6-QD-S".into(),
            (Problem::Bp8, Source::Gaussian) => "-GS",
            (Problem::Bp8, Source::Well) => "-PW",
            _ => "",
        };
        format!("{}-QD{kind}", self.problem.name().to_uppercase())
    }

    /// The requested cell length \[m\].
    pub(super) fn cell(&self) -> f64 {
        self.cell.unwrap_or(self.problem.defaults()[0])
    }

    /// Cells of the requested length from one end to the other \[m\].
    pub(super) fn cells(&self, ends: [f64; 2]) -> Result<Cells, Failed> {
        let (cell, length) = (self.cell(), ends[1] - ends[0]);
        let count = (length / cell).round();
        if count < 1.0 || (count * cell / length - 1.0).abs() > 1e-9 {
            return Err(format!(
                "--cell {cell}: the fault is {length} m long, not a whole number of cells"
            )
            .into());
        }
        if count > MOST {
            return Err(format!("--cell {cell}: more than {MOST} cells along {length} m").into());
        }
        Ok(Cells::new(ends, count as usize)?)
    }

    /// The dip in degrees.
    pub(super) fn dip(&self) -> f64 {
        self.dip.unwrap_or(60.0)
    }

    /// The sense of slip of a dipping fault.
    pub(super) fn sense(&self) -> Sense {
        if self.normal {
            Sense::Normal
        } else {
            Sense::Thrust
        }
    }

    /// The end of the run \[s\].
    pub(super) fn end(&self) -> f64 {
        self.years.unwrap_or(self.problem.defaults()[1]) * YEAR
    }

    /// Adaptive steps to the end; those of an implicit method differ by powers of two.
    pub(super) fn steps(&self) -> Steps {
        let steps = Steps::adaptive(self.adaptive)
            .with_max_steps(usize::MAX)
            .until(self.end());
        match self.method {
            Method::RungeKutta => steps,
            Method::Implicit => steps.in_powers_of_two(),
        }
    }

    /// Whether the time discretisation is accurate enough for checks of the results.
    pub(super) fn is_accurate(&self) -> bool {
        self.method == Method::RungeKutta && self.adaptive <= 1e-4
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(line: &str) -> Arguments {
        Arguments::parse_from(["earthquakes"].into_iter().chain(line.split_whitespace()))
    }

    #[test]
    fn settings_of_other_problems_are_refused() {
        for line in [
            "--problem bp1 --dip 60",
            "--problem bp5 --thrust",
            "--problem bp4 --normal",
            "--problem bp3 --components 1",
            "--problem bp5 --no-perturbation",
            "--problem bp7 --method implicit",
            "--problem bp8 --pressure solver",
            "--problem bp6 --source well",
            "--problem bp7 --least-normal-stress 1e6",
            "--problem bp6 --allow-opening",
            "--problem bp6 --refine 3",
            "--faults ramp.csv --seas files",
            "--problem bp3 --surface-grid 1000",
            "--problem bp8 --surface-grid 1000",
            "--faults ramp.csv --method implicit",
            "--faults ramp.csv --dip 30",
        ] {
            let refused = read(line).check().map_err(|error| error.to_string());
            assert!(
                refused.is_err_and(|error| error.contains("is not a setting of ")),
                "{line}"
            );
        }
        for line in [
            "--problem bp3 --dip 30 --normal",
            "--problem bp7 --no-perturbation --components 2",
            "--problem bp5 --surface-grid 1000 --receivers gps.csv",
            "--problem bp6s --pressure closed-form --seas files",
            "--problem bp6 --receivers gps.csv",
            "--problem bp8 --source well --allow-opening --refine 1",
        ] {
            assert!(read(line).check().is_ok(), "{line}");
        }
    }

    #[test]
    fn cells_divide_the_fault() {
        assert!(read("--cell 300").cells([0.0, 40e3]).is_err());
        assert!(read("--cell 50e3").cells([0.0, 40e3]).is_err());
        assert!(read("--cell 0.01").cells([0.0, 40e3]).is_err());
        let cells = read("--cell 0.1")
            .cells([0.0, 40e3])
            .map(|cells| cells.count());
        assert!(cells.is_ok_and(|count| count == 400_000));
    }
}
