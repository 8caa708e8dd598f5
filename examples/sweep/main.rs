//! One body, many laws: how often and how fast does the slider slip, for which `a`, `b` and `L`?
//!
//! Reducing the body to its bottom takes its time once. Each run is then one on the bottom alone; all of them share the
//! reduced body, in as many threads as there are processors.
//!
//! ```text
//! cargo run --release --example sweep -- --sets 200
//! ```

mod runs;

use std::num::NonZeroUsize;
use std::process::ExitCode;
use std::thread;

use runs::Runs;
use support::cli;
use support::sweep::{Arguments, in_threads};

fn main() -> ExitCode {
    cli::run(|arguments: &Arguments| {
        let (output, laws) = (arguments.output()?, arguments.laws());
        let processors = thread::available_parallelism().map_or(1, NonZeroUsize::get);
        let runs = Runs::new(arguments)?;
        let seen = in_threads(arguments.threads(processors), &laws, |law| runs.take(law))?;
        output.write(laws.into_iter().zip(seen).collect())
    })
}
