//! One case: what is tried, what came of it, and how that is found out without trusting it.

use std::sync::Mutex;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

use serde::Serialize;

/// The time that a case may take.
const LIMIT: Duration = Duration::from_secs(30);

/// An error on the way to the first step, whatever its type.
pub(crate) type Refusal = Box<dyn std::error::Error>;

/// The outcome of a case.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Outcome {
    /// All numbers finite, all residuals within what is allowed.
    Solved,
    /// A typed error before the first step.
    Refused,
    /// A typed error of a step, which left no trace; the same simulation then went on, or reported
    /// again, with smaller steps.
    Reported,
    /// Anything else.
    Defect,
}

/// The result of a case.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct IntoControlFlow {
    pub(crate) outcome: Outcome,
    /// The most velocity problems, and the most iterations of the solver, that one step took.
    pub(crate) iterations: (usize, usize),
    /// The largest residual, as a share of what is allowed.
    pub(crate) residual: f64,
    /// The error, or what is wrong.
    pub(crate) text: String,
    /// The size of step, over that of the failed one, with which a simulation went on.
    pub(crate) resumed: Option<f64>,
    /// The steps that were split into substeps.
    pub(crate) split: usize,
    pub(crate) seconds: f64,
}

impl IntoControlFlow {
    pub(crate) fn new(outcome: Outcome, text: impl ToString) -> Self {
        Self {
            outcome,
            iterations: (0, 0),
            residual: 0.0,
            text: text.to_string(),
            resumed: None,
            split: 0,
            seconds: 0.0,
        }
    }

    /// Of one computation whose largest residual, as a share of what is allowed, is known.
    pub(crate) fn of_residual(residual: f64) -> Self {
        let mut verdict = if residual <= 1.0 {
            Self::new(Outcome::Solved, "")
        } else {
            Self::new(
                Outcome::Defect,
                format!("residual {residual:.2e} times what is allowed"),
            )
        };
        verdict.residual = residual;
        verdict
    }

    /// The same with another outcome and its text.
    pub(crate) fn with(self, outcome: Outcome, text: String) -> Self {
        Self {
            outcome,
            text,
            ..self
        }
    }

    /// A scene, mesh or law that was not accepted.
    pub(crate) fn refused(error: impl ToString) -> Self {
        let text = error.to_string();
        if text.is_empty() || text.contains('\n') {
            return Self::new(Outcome::Defect, format!("not one line: {text}"));
        }
        Self::new(Outcome::Refused, text)
    }
}

/// A case to be tried.
pub(crate) struct Case {
    /// The part of the report it belongs to.
    pub(crate) section: &'static str,
    /// The extreme quantity.
    pub(crate) extreme: String,
    /// By which method.
    pub(crate) method: String,
    /// Which laws, which draw: cases that differ in this alone share a line.
    pub(crate) member: String,
    run: Box<dyn FnOnce() -> IntoControlFlow + Send>,
}

impl Case {
    pub(crate) fn new(
        section: &'static str,
        extreme: impl ToString,
        method: impl ToString,
        member: impl ToString,
        run: impl FnOnce() -> IntoControlFlow + Send + 'static,
    ) -> Self {
        Self {
            section,
            extreme: extreme.to_string(),
            method: method.to_string(),
            member: member.to_string(),
            run: Box::new(run),
        }
    }

    /// Runs the case beside this thread; one that does not come to an end is left behind.
    pub(crate) fn run(self) -> (Label, IntoControlFlow) {
        let Self {
            section,
            extreme,
            method,
            member,
            run,
        } = self;
        let label = Label {
            section,
            extreme,
            method,
            member,
        };
        let (sender, receiver) = channel();
        let begin = Instant::now();
        let worker = thread::spawn(move || {
            // Nobody listens any more after the time limit.
            let _ = sender.send(run());
        });
        let mut verdict = match receiver.recv_timeout(LIMIT) {
            Ok(verdict) => verdict,
            Err(RecvTimeoutError::Timeout) => IntoControlFlow::new(
                Outcome::Defect,
                format!("no end after {} s", LIMIT.as_secs()),
            ),
            Err(RecvTimeoutError::Disconnected) => {
                let _ = worker.join();
                let place = PANIC
                    .lock()
                    .map_or(String::new(), |mut text| std::mem::take(&mut *text));
                IntoControlFlow::new(Outcome::Defect, format!("panic: {place}"))
            }
        };
        verdict.seconds = begin.elapsed().as_secs_f64();
        (label, verdict)
    }
}

/// The names of a case.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Label {
    pub(crate) section: &'static str,
    pub(crate) extreme: String,
    pub(crate) method: String,
    pub(crate) member: String,
}

/// The last panic.
static PANIC: Mutex<String> = Mutex::new(String::new());

/// Keeps panics off the terminal: they become verdicts.
pub(crate) fn catch_panics() {
    std::panic::set_hook(Box::new(|info| {
        if let Ok(mut text) = PANIC.lock() {
            *text = info.to_string().lines().collect::<Vec<_>>().join(" ");
        }
    }));
}
