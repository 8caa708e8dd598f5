//! Fluid that enters the cells.

use std::f64::consts::TAU;

use super::error::{not_negative, positive};
use super::well::{Bore, BoreOfCell, Index, Injection};
use super::{Cells, Diffusion, DiffusionError, RateHistory, Well};

const WELL: &str = "well";
/// The constant of Euler and Mascheroni.
const EULER: f64 = 0.577_215_664_901_532_9;

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
