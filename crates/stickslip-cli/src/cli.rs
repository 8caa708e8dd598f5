//! From the command line to an exit status: every failure is one line.

use std::any::TypeId;
use std::error::Error;
use std::ffi::OsString;
use std::num::NonZeroUsize;
use std::process::ExitCode;

use clap::error::ErrorKind;
use clap::{Arg, Command, Parser};

use crate::interrupt::{self, Interrupted};
use crate::{unused, words};

/// Any error that ends a program.
pub type Problem = Box<dyn Error>;

/// A program that does not do what is asked: its exit status, and a message of one line.
#[derive(Clone, Debug)]
pub struct Refusal {
    /// 2 for an invalid command line, 1 for a program that failed, 130 for one that was interrupted.
    pub status: u8,
    /// Why, in one line.
    pub message: String,
}

/// Runs `program` on the command line.
///
/// An invalid command line ends with status 2, a failed program with status 1.
pub fn run<A: Parser>(program: impl FnOnce(&A) -> Result<(), Problem>) -> ExitCode {
    match answer(std::env::args_os(), program) {
        Ok(()) => ExitCode::SUCCESS,
        Err(refusal) => {
            note!("{}", refusal.message);
            ExitCode::from(refusal.status)
        }
    }
}

/// Runs `program` on the words of a command line, the first of which names it, as [`run`] does, within this process.
///
/// # Errors
/// The words are no command line of the program, or it fails.
pub fn answer<A: Parser>(
    words: impl IntoIterator<Item = OsString>,
    program: impl FnOnce(&A) -> Result<(), Problem>,
) -> Result<(), Refusal> {
    program(&arguments(words)?).map_err(|problem| Refusal {
        status: if problem.is::<Interrupted>() {
            interrupt::STATUS
        } else {
            1
        },
        message: format!("error: {}", one_line(words::message(&*problem).lines())),
    })
}

/// Fails unless `value` is `expected` to `tolerance`.
pub fn expect(what: &str, value: f64, expected: f64, tolerance: f64) -> Result<(), Problem> {
    if (value - expected).abs() <= tolerance {
        return Ok(());
    }
    Err(format!("{what}: {value:.10e} is not {expected:.10e} to {tolerance:e}").into())
}

/// The command line. If it is invalid, prints a message in one line and returns the exit status.
pub fn read<A: Parser>() -> Result<A, ExitCode> {
    arguments(std::env::args_os()).map_err(|refusal| {
        note!("{}", refusal.message);
        ExitCode::from(refusal.status)
    })
}

/// Reads a command line, or prints the help that it asks for and ends.
fn arguments<A: Parser>(words: impl IntoIterator<Item = OsString>) -> Result<A, Refusal> {
    parse(words).map_err(|error| {
        if !error.use_stderr() {
            error.exit(); // --help
        }
        Refusal {
            status: 2,
            message: first_paragraph(&error.to_string()),
        }
    })
}

fn parse<A: Parser>(words: impl IntoIterator<Item = OsString>) -> Result<A, clap::Error> {
    // "-1e-2" is a number, not a flag.
    let signed = |arg: Arg| {
        let real = arg.get_value_parser().type_id() == TypeId::of::<f64>();
        if real {
            arg.allow_hyphen_values(true)
        } else {
            arg
        }
    };
    let subcommand = |command: Command| command.args_override_self(true).mut_args(signed);
    let command = subcommand(A::command()).mut_subcommands(subcommand);
    let matches = command.clone().try_get_matches_from(words)?;
    unused::check(&matches)
        .map_err(|message| clap::Error::raw(ErrorKind::ArgumentConflict, message))?;
    A::from_arg_matches(&matches)
}

/// The message of an error, without the usage that follows after an empty line.
fn first_paragraph(message: &str) -> String {
    one_line(message.lines().take_while(|line| !line.trim().is_empty()))
}

fn one_line<'a>(lines: impl Iterator<Item = &'a str>) -> String {
    lines.map(str::trim).collect::<Vec<_>>().join(" ")
}

/// Reads a finite number.
pub fn finite(text: &str) -> Result<f64, String> {
    number(text, f64::is_finite, "finite")
}

/// Reads an integer above zero.
pub fn count(text: &str) -> Result<NonZeroUsize, String> {
    let legal = "must be an integer of at least 1";
    text.trim().parse().map_err(|_| legal.to_owned())
}

/// Reads a number above zero.
pub fn positive(text: &str) -> Result<f64, String> {
    number(text, |x| x > 0.0 && x.is_finite(), "positive and finite")
}

/// Reads a number from 0 to 1.
pub fn share(text: &str) -> Result<f64, String> {
    number(text, |x| (0.0..=1.0).contains(&x), "from 0 to 1")
}

/// Reads a number that is zero or above.
pub fn non_negative(text: &str) -> Result<f64, String> {
    number(
        text,
        |x| x >= 0.0 && x.is_finite(),
        "non-negative and finite",
    )
}

/// Reads a share of a whole, in (0, 1].
pub fn fraction(text: &str) -> Result<f64, String> {
    number(text, |x| x > 0.0 && x <= 1.0, "above 0 and at most 1")
}

/// Reads Poisson's ratio.
pub fn poisson_ratio(text: &str) -> Result<f64, String> {
    number(text, |x| x > -1.0 && x < 0.5, "above -1 and below 1/2")
}

fn number(text: &str, holds: impl Fn(f64) -> bool, requirement: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(value) if holds(value) => Ok(value),
        Ok(_) => Err(format!("must be {requirement}")),
        Err(_) => Err("not a number".into()),
    }
}
