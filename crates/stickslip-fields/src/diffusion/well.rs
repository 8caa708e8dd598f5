//! Wells: points of injection or production.

use super::{Place, RateHistory};

/// A well that injects (or produces, at negative rates) at a point.
///
/// Its rate enters the cell that holds the point, whose pressure is that of the homogeneous plane at a distance of
/// `.198506 h` from a point source, `h` the size of square cells: it grows as `ln(1/h)` with smaller cells. With a bore
/// of its own, the well keeps fluid at a pressure `p_w` ([`Diffusion::bore_pressures`](super::Diffusion::bore_pressures)), which flows to its cell:
///
/// ```text
/// S_w p_w' = Q - WI (p_w - p),    WI = 2 pi k w_h/(eta_f ln(r_e/r_w)),    r_e = exp(-.5772157)/4 sqrt(h_x^2 + h_y^2)
/// ```
#[derive(Debug, Clone, PartialEq)]
#[doc(alias("injection", "point source", "Peaceman"))]
pub struct Well {
    pub(super) place: Place,
    pub(super) rates: RateHistory,
    pub(super) bore: Option<Bore>,
}

/// A bore of a well.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Bore {
    pub storage: f64,
    pub index: Index,
}

/// The radius of a well, or its index.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Index {
    Radius(f64),
    Given(f64),
}

impl Well {
    /// A well at a position or in a cell, with rates `Q` [m^3/s], on a line `Q'` [m^2/s].
    pub fn new(place: impl Into<Place>, rates: RateHistory) -> Self {
        Self {
            place: place.into(),
            rates,
            bore: None,
        }
    }

    /// Gives it a bore of a storage `S_w` [m^3/Pa] and a radius `r_w` \[m\]; on planes.
    #[must_use]
    pub fn with_bore(mut self, storage: f64, radius: f64) -> Self {
        self.bore = Some(Bore {
            storage,
            index: Index::Radius(radius),
        });
        self
    }

    /// Gives it a bore of a storage `S_w` [m^3/Pa] (on lines [m^2/Pa]) and a well index `WI` [m^3/(Pa s)] (on lines
    /// [m^2/(Pa s)]).
    #[must_use]
    pub fn with_bore_of_index(mut self, storage: f64, index: f64) -> Self {
        self.bore = Some(Bore {
            storage,
            index: Index::Given(index),
        });
        self
    }
}

/// A source of fluid: its rates, the cells that take it, and its bore.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Injection {
    pub rates: RateHistory,
    /// The cells with their shares.
    pub shares: Vec<(usize, f64)>,
    /// The sum of the shares.
    pub total: f64,
    /// Whether the shares are means over cells of a smooth source.
    pub spread: bool,
    /// The storage and index of a bore.
    pub bore: Option<BoreOfCell>,
}

/// A bore in a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct BoreOfCell {
    pub cell: usize,
    pub storage: f64,
    /// The index, and the index per mobility of the cell.
    pub index: f64,
    pub per_mobility: f64,
}

impl BoreOfCell {
    /// The well index with the mobilities of cells.
    pub(super) fn index(&self, mobility: &[f64]) -> f64 {
        self.index + self.per_mobility * mobility[self.cell]
    }
}
