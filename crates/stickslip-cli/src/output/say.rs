//! Lines to standard output and standard error, which a reader may close before their end.

use std::fmt;
use std::io::{self, ErrorKind, Write};

use crate::cli::Problem;

/// Prints a line to standard output; a reader that has closed it has read enough.
///
/// # Errors
/// It cannot be written otherwise, such as to a disk without room.
pub fn print(line: fmt::Arguments<'_>) -> Result<(), Problem> {
    match writeln!(io::stdout(), "{line}") {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(format!("cannot write to standard output: {error}").into())
        }
        _ => Ok(()),
    }
}

/// Prints a line to standard error, if it can be written.
pub fn note(line: fmt::Arguments<'_>) {
    // There is nobody left to tell.
    let _ = writeln!(io::stderr(), "{line}");
}

/// Prints a line to standard output, and returns whether that failed otherwise than by a reader that closed it.
macro_rules! say {
    ($($line:tt)*) => { $crate::output::print(format_args!($($line)*)) };
}

/// Prints a line to standard error.
macro_rules! note {
    ($($line:tt)*) => { $crate::output::note(format_args!($($line)*)) };
}
