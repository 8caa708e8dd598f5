//! Volume rates into cells: from one another, the sides, the surroundings, bores and sources.

use super::Diffusion;
use super::memory::{Places, TIME};
use super::system::Conductances;
use super::well::BoreOfCell;
use super::work::{BoreWork, Stage, Work};

/// A memory split into what its pressures are.
#[derive(Clone, Copy)]
pub(super) struct Pressures<'a> {
    pub cells: &'a [f64],
    pub bores: &'a [f64],
}

impl<'a> Pressures<'a> {
    pub(super) fn of(places: &Places, memory: &'a [f64]) -> Self {
        Self {
            cells: &memory[places.pressure.clone()],
            bores: &memory[places.bores.clone()],
        }
    }
}

impl Diffusion {
    /// The bores, in the order of their sources.
    pub(super) fn bores(&self) -> impl Iterator<Item = &BoreOfCell> {
        self.injections
            .iter()
            .filter_map(|injection| injection.bore.as_ref())
    }

    /// Writes the volume rates into cells and bores at these pressures, but those of sources. Returns the sum over cells of
    /// those that do not come from cells.
    pub(super) fn flow(
        &self,
        conductances: &Conductances,
        at: Pressures<'_>,
        into: &mut [f64],
        bores: &mut [BoreWork],
    ) -> f64 {
        into.fill(0.0);
        self.cells.add_flow(&conductances.faces, at.cells, into);
        self.add_fourth_order(&conductances.faces, at.cells, 1.0, into);
        let mut total = 0.0;
        let mut add = |cell: usize, rate: f64| {
            into[cell] += rate;
            total += rate;
        };
        for outlet in &self.outlets {
            let conductance = conductances.mobility[outlet.cell] * outlet.geometry;
            add(
                outlet.cell,
                conductance * (outlet.pressure - at.cells[outlet.cell]),
            );
        }
        for inflow in &self.inflows {
            add(inflow.cell, inflow.rate);
        }
        if let Some(leak) = &self.leak {
            for (cell, conductance) in leak.conductance.iter().enumerate() {
                add(cell, conductance * (leak.far[cell] - at.cells[cell]));
            }
        }
        for (number, (bore, work)) in self.bores().zip(bores).enumerate() {
            let rate = work.index * (at.bores[number] - at.cells[bore.cell]);
            work.flow = -rate;
            add(bore.cell, rate);
        }
        total
    }

    /// The volume rate that leaves through the sides, at the pressure of each cell.
    pub(super) fn drain(
        &self,
        conductances: &Conductances,
        pressure: impl Fn(usize) -> f64,
    ) -> f64 {
        let out = self.outlets.iter().map(|outlet| {
            let conductance = conductances.mobility[outlet.cell] * outlet.geometry;
            conductance * (pressure(outlet.cell) - outlet.pressure)
        });
        let inflow: f64 = self.inflows.iter().map(|inflow| inflow.rate).sum();
        out.sum::<f64>() - inflow
    }

    /// Adds `weight` times the rates of sources into cells and, to their right-hand sides, into bores. The rates are
    /// `ends[0]` times those at the start and `ends[1]` times those at the end of the step. Returns the sum over cells.
    pub(super) fn add_sources(
        &self,
        source: [&[f64]; 2],
        weight: f64,
        ends: [f64; 2],
        work: &mut Work,
        into: Stage,
    ) -> f64 {
        let (rates, bores, first) = (&work.rates, &mut work.bores, into == Stage::First);
        let side = if first {
            &mut work.first
        } else {
            &mut work.second
        };
        let (mut total, mut bores) = (0.0, bores.iter_mut());
        for (injection, rates) in self.injections.iter().zip(rates) {
            let volume = weight * (ends[0] * rates[0] + ends[1] * rates[1]);
            if injection.bore.is_some() {
                if let Some(bore) = bores.next() {
                    bore.side += volume;
                }
                continue;
            }
            for &(cell, share) in &injection.shares {
                side[cell] += share * volume;
                total += share * volume;
            }
        }
        if self.dilatancy.is_some() {
            let start = self.first_porosity_source();
            for (vertex, &cell) in self.cell_of.iter().enumerate() {
                let rate =
                    ends[0] * source[0][start + vertex] + ends[1] * source[1][start + vertex];
                let volume = weight * self.bulk(cell) * rate;
                side[cell] -= volume;
                total -= volume;
            }
        }
        total
    }

    /// The volume of the zone of a cell [m^3], on a line [m^2].
    pub(super) fn bulk(&self, cell: usize) -> f64 {
        self.properties.thickness[cell] * self.sizes[cell]
    }

    /// The place of the first source of porosity.
    pub(super) fn first_porosity_source(&self) -> usize {
        if self.evolution.is_some() {
            self.cell_of.len()
        } else {
            0
        }
    }

    /// Writes the rates of sources over a step.
    pub(super) fn rates(&self, from: &[f64], dt: f64, rates: &mut [[f64; 2]]) {
        for (injection, rates) in self.injections.iter().zip(rates) {
            *rates = injection.rates.over(from[TIME], dt);
        }
    }
}
