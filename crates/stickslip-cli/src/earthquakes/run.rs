//! Earthquake cycles and fluid-driven creep: the benchmark problems BP1-QD to BP5-QD, BP6-QD-A and -S,
//! BP7-QD-A and BP8-QD.
//!
//! `--faults` takes faults of a file in their place: bent, branched or several.
//!
//! Planar faults by boundary integrals: the rock around them acts by its kernel, and its waves by radiation damping.
//! Displacements are slip across the fault, as published. `-- --problem bp6` and `bp8` are the injections.
//!
//! Parameters: B. Erickson et al., Seismol. Res. Lett. 91 (2020), and the descriptions of these SEAS benchmarks.

use super::{Arguments, Problem, bp1, bp2, bp3, bp4, bp5, bp6, bp7, bp8, faults};
use crate::cli;

/// Earthquake cycles and injection on faults by boundary integrals.
///
/// # Errors
/// In one line: a wrong setting, a failed step, a file that cannot be written, and results that differ from the published
/// ones where they should agree.
pub fn run(arguments: &Arguments) -> Result<(), cli::Problem> {
    arguments.check()?;
    if let Some(path) = &arguments.fault_file.faults {
        return faults::run(arguments, path);
    }
    match arguments.problem {
        Problem::Bp1 => bp1::run(arguments),
        Problem::Bp2 => bp2::run(arguments),
        Problem::Bp3 => bp3::run(arguments),
        Problem::Bp4 => bp4::run(arguments),
        Problem::Bp5 => bp5::run(arguments),
        Problem::Bp6 | Problem::Bp6s => bp6::run(arguments),
        Problem::Bp7 => bp7::run(arguments),
        Problem::Bp8 => bp8::run(arguments),
    }
}
