//! Sides of the cells: sealed, or with a given pressure or flux.

/// A side of a line or a plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// The begin of a line, or of a plane along strike.
    Begin,
    /// The end of a line, or of a plane along strike.
    End,
    /// The begin of a plane down dip.
    Top,
    /// The end of a plane down dip.
    Bottom,
}

/// The condition at a side.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[doc(alias("Dirichlet", "Neumann", "no flux"))]
pub enum Boundary {
    /// No fluid passes.
    #[default]
    Sealed,
    /// A pressure \[Pa\].
    Pressure(f64),
    /// A Darcy velocity into the cells [m/s].
    Flux(f64),
}

/// The exchange of a cell with a side of given pressure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Outlet {
    pub cell: usize,
    /// Conductance over mobility.
    pub geometry: f64,
    pub pressure: f64,
    /// The side, none for another face.
    pub side: Option<Side>,
}

/// The volume rate into a cell through a side of given flux.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Inflow {
    pub cell: usize,
    pub rate: f64,
    pub side: Side,
}

impl Side {
    pub(super) const ALL: [Self; 4] = [Self::Begin, Self::End, Self::Top, Self::Bottom];

    /// The direction of its outward normal among the directions of the cells.
    pub(super) fn outward(self, direction: usize) -> Option<f64> {
        match (self, direction) {
            (Self::Begin, 0) | (Self::Top, 1) => Some(-1.0),
            (Self::End, 0) | (Self::Bottom, 1) => Some(1.0),
            _ => None,
        }
    }

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Begin => "the begin",
            Self::End => "the end",
            Self::Top => "the top",
            Self::Bottom => "the bottom",
        }
    }
}
