//! The state laws that a command line can name.

use clap::ValueEnum;
use serde::Serialize;

/// How the state evolves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Law {
    /// The aging law: contacts grow at rest
    Dieterich,
    /// The slip law: contacts change only by slip
    Ruina,
    /// A law whose right-hand side jumps
    Discontinuous,
    /// No state
    None,
}

impl Law {
    /// From the variable that the law integrates to `ln(theta / 1 s)`; not a number without a state.
    pub(crate) fn log_theta(self) -> fn(f64) -> f64 {
        match self {
            Law::Dieterich | Law::Ruina => |alpha| alpha,
            Law::Discontinuous => f64::ln,
            Law::None => |_| f64::NAN,
        }
    }
}
