//! The published problems by name.

use clap::ValueEnum;

use super::{DAY, YEAR};

/// Problems by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Problem {
    /// Earthquake cycles, antiplane, in a half space
    Bp1,
    /// bp1 with half its slip distance: small and large events
    Bp2,
    /// Earthquake cycles on a dipping fault in plane strain, with a normal stress that follows slip
    Bp3,
    /// Earthquake cycles on a plane in a whole space
    Bp4,
    /// Earthquake cycles on a vertical plane in a half space
    Bp5,
    /// Fluid injection into a fault, antiplane, in a whole space
    Bp6,
    /// bp6 with the slip law in the place of the aging law
    Bp6s,
    /// Small repeating earthquakes of a circular patch on a plane in a whole space
    Bp7,
    /// Fluid injection into a plane in a whole space
    Bp8,
}

impl Problem {
    /// Its name on the command line.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Bp1 => "bp1",
            Self::Bp2 => "bp2",
            Self::Bp3 => "bp3",
            Self::Bp4 => "bp4",
            Self::Bp5 => "bp5",
            Self::Bp6 => "bp6",
            Self::Bp6s => "bp6s",
            Self::Bp7 => "bp7",
            Self::Bp8 => "bp8",
        }
    }

    /// The length of a cell \[m\] and the end \[years\] by default.
    pub(super) fn defaults(self) -> [f64; 2] {
        match self {
            Self::Bp1 => [100.0, 300.0],
            Self::Bp2 => [100.0, 1200.0],
            // At 100 m events after the first are decades off those of resolved cells.
            Self::Bp3 => [50.0, 1500.0],
            Self::Bp4 => [500.0, 1000.0],
            Self::Bp5 => [1000.0, 1800.0],
            Self::Bp6 | Self::Bp6s | Self::Bp7 => [10.0, 2.0],
            Self::Bp8 => [10.0, 30.0 * DAY / YEAR],
        }
    }

    /// Whether its fault is a plane in space.
    pub(super) fn is_plane(self) -> bool {
        matches!(self, Self::Bp4 | Self::Bp5 | Self::Bp7 | Self::Bp8)
    }
}
