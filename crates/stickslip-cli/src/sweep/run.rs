//! Parameter sweep: recurrence and slip rate of the slider for many `a`, `b` and `L`.
//!
//! The reduction of the body to its bottom is computed once. Each run then needs the bottom alone. All runs share the
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
