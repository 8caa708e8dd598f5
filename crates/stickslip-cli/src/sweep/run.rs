//! One body, many laws: how often and how fast does the slider slip, for which `a`, `b` and `L`?
//!
//! Reducing the body to its bottom takes its time once. Each run is then one on the bottom alone; all of them share the
//! reduced body, in as many threads as there are processors.
//!
//! ```text
//! stickslip sweep --sets 200
//! ```

use std::num::NonZeroUsize;
use std::thread;

use super::runs::Runs;
use super::{Arguments, in_threads};
use crate::cli::Problem;

/// Recurrence and peak slip rate over the parameters of friction.
///
/// # Errors
/// In one line: a wrong setting, a failed step, a file that cannot be written.
pub fn run(arguments: &Arguments) -> Result<(), Problem> {
    let (output, laws) = (arguments.output()?, arguments.laws());
    let processors = thread::available_parallelism().map_or(1, NonZeroUsize::get);
    let runs = Runs::new(arguments)?;
    let seen = in_threads(arguments.threads(processors), &laws, |law| runs.take(law))?;
    output.write(laws.into_iter().zip(seen).collect())
}
