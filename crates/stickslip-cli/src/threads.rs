//! Commands in a given number of threads.

use std::num::NonZeroUsize;

use crate::cli::Problem;
use crate::interrupt::Interrupted;
use crate::words;

/// What a command in a thread of its own fails with.
enum Failure {
    Interrupted(Interrupted),
    Message(String),
}

/// Works in a pool of so many threads, which large bodies and faults share.
pub(crate) fn inside(
    threads: NonZeroUsize,
    work: impl FnOnce() -> Result<(), Problem> + Send,
) -> Result<(), Problem> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads.get())
        .build()?;
    let outcome = pool.install(|| {
        work().map_err(|problem| match problem.downcast_ref() {
            Some(interrupted) => Failure::Interrupted(*interrupted),
            None => Failure::Message(words::message(&*problem)),
        })
    });
    outcome.map_err(|failure| match failure {
        Failure::Interrupted(interrupted) => interrupted.into(),
        Failure::Message(message) => message.into(),
    })
}
