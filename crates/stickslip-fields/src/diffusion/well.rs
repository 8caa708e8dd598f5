//! Wells: points of injection or production.

use std::f64::consts::TAU;

use super::error::{not_negative, positive};
use super::{Cells, Diffusion, DiffusionError, Place, RateHistory};

const WELL: &str = "well";
/// The constant of Euler and Mascheroni.
const EULER: f64 = 0.577_215_664_901_532_9;

/// A well that injects (or produces, at negative rates) at a point.
///
/// Its rate enters the cell that holds the point, whose pressure is that of the homogeneous plane at a distance of
/// `.198506 h` from a point source, `h` the size of square cells: it grows as `ln(1/h)` with smaller cells. With a bore
/// of its own, the well keeps fluid at a pressure `p_w` ([`Diffusion::bore_pressures`]), which flows to its cell:
///
/// ```text
/// S_w p_w' = Q - WI (p_w - p),    WI = 2 pi k w_h/(eta_f ln(r_e/r_w)),    r_e = exp(-.5772157)/4 sqrt(h_x^2 + h_y^2)
/// ```
#[derive(Debug, Clone, PartialEq)]
#[doc(alias("injection", "point source", "Peaceman"))]
pub struct Well {
    place: Place,
    rates: RateHistory,
    bore: Option<Bore>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Bore {
    storage: f64,
    index: Index,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Index {
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
    index: f64,
    per_mobility: f64,
}

impl BoreOfCell {
    /// The well index with the mobilities of cells.
    pub(super) fn index(&self, mobility: &[f64]) -> f64 {
        self.index + self.per_mobility * mobility[self.cell]
    }
}

impl Diffusion {
    /// Adds a well. Set the permeability that slip raises before, if the cell is sealed without it.
    ///
    /// # Errors
    /// [`DiffusionError`] for a place outside of the cells, a sealed cell, a storage or an index that is not above 0, and
    /// a radius out of the range from 0 to that of its cell.
    pub fn with_well(mut self, well: Well) -> Result<Self, DiffusionError> {
        let cell = self.cells.at(WELL, well.place)?;
        self.require_open(WELL, cell)?;
        let bore = well
            .bore
            .map(|bore| self.bore_of_cell(cell, bore))
            .transpose()?;
        self.add_injection(well.rates, vec![(cell, 1.0)], bore);
        Ok(self)
    }

    fn bore_of_cell(&self, cell: usize, bore: Bore) -> Result<BoreOfCell, DiffusionError> {
        let storage = bore.storage;
        positive("storage of a wellbore [m^3/Pa]", None, storage)?;
        let [index, per_mobility] = match bore.index {
            Index::Given(index) => {
                positive("well index [m^3/(Pa s)]", None, index)?;
                [index, 0.0]
            }
            Index::Radius(radius) => {
                positive("radius of a wellbore [m]", None, radius)?;
                let Some(equivalent) = self.cells.equivalent_radius() else {
                    return Err(self.cells.no_radius());
                };
                if radius >= equivalent {
                    return Err(DiffusionError::Radius { radius, equivalent });
                }
                [0.0, TAU / (equivalent / radius).ln()]
            }
        };
        Ok(BoreOfCell {
            cell,
            storage,
            index,
            per_mobility,
        })
    }

    /// Requires that fluid can leave a cell.
    pub(super) fn require_open(
        &self,
        what: &'static str,
        cell: usize,
    ) -> Result<(), DiffusionError> {
        if self.greatest_permeability(cell) > 0.0 {
            return Ok(());
        }
        Err(DiffusionError::Sealed {
            what,
            cell: self.cells.vertices()[cell],
        })
    }

    /// Adds shares of rates in the order of the vertices: a source of any shape, such as on a network.
    ///
    /// # Errors
    /// [`DiffusionError`] for another number of shares, shares that are negative or not finite, and for sealed cells.
    pub fn with_source(
        mut self,
        shares: &[f64],
        rates: RateHistory,
    ) -> Result<Self, DiffusionError> {
        const WHAT: &str = "share of a source";
        let found = shares.len();
        if found != self.cells.count() {
            return Err(DiffusionError::Count {
                what: WHAT,
                expected: self.cells.count(),
                found,
            });
        }
        let mut of_cells = Vec::new();
        for (cell, &vertex) in self.cells.vertices().iter().enumerate() {
            not_negative(WHAT, Some(vertex), shares[vertex])?;
            if shares[vertex] > 0.0 {
                self.require_open("source", cell)?;
                of_cells.push((cell, shares[vertex]));
            }
        }
        self.add_injection(rates, of_cells, None);
        Ok(self)
    }

    pub(super) fn add_injection(
        &mut self,
        rates: RateHistory,
        shares: Vec<(usize, f64)>,
        bore: Option<BoreOfCell>,
    ) {
        let total = shares.iter().map(|&(_, share)| share).sum();
        self.injections.push(Injection {
            rates,
            shares,
            total,
            spread: false,
            bore,
        });
        self.changed();
    }
}

impl Cells {
    /// The radius at which the pressure in a homogeneous plane is that of the cell of a well \[m\].
    fn equivalent_radius(&self) -> Option<f64> {
        match self {
            Self::Line(_) | Self::Network(_) => None,
            // Peaceman, SPE J. 23 (1983), for equal mobilities along both sides.
            Self::Plane(plane) => {
                let [width, height] = plane.lengths();
                Some((-EULER).exp() / 4.0 * width.hypot(height))
            }
        }
    }

    fn no_radius(&self) -> DiffusionError {
        DiffusionError::Place {
            what: WELL,
            place: "a bore of a radius",
            cells: self.kind(),
            instead: "the index of the well (`with_bore_of_index`)",
        }
    }
}
