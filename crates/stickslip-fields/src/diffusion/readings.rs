//! The readings and volumes of diffusion.

use super::Diffusion;
use super::exchange::Pressures;
use super::memory::{DRAINED, LEAKED, TIME};
use super::system::Conductances;
use crate::Reading;

/// A quantity per vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Quantity {
    /// The Darcy velocity along a direction.
    Velocity(usize),
    Permeability,
    Porosity,
}

impl Diffusion {
    /// The change of pore pressure of every cell in a memory of the field \[Pa\], along a line or in the order of cells: also
    /// of those that the contact does not cover.
    pub fn cell_pressures<'a>(&self, memory: &'a [f64]) -> &'a [f64] {
        Pressures::of(&self.places, memory).cells
    }

    /// The pressure of the wells that have a bore, in the order in which they were added \[Pa\].
    pub fn bore_pressures<'a>(&self, memory: &'a [f64]) -> &'a [f64] {
        Pressures::of(&self.places, memory).bores
    }
}

impl Diffusion {
    /// The quantities per vertex with their names.
    pub(super) fn quantities(&self) -> Vec<(Quantity, Reading)> {
        let velocity = |name| Reading { name, unit: "m/s" };
        let mut quantities = match self.cells.directions() {
            0 => vec![],
            1 => vec![(Quantity::Velocity(0), velocity("darcy_velocity"))],
            _ => vec![
                (
                    Quantity::Velocity(0),
                    velocity("darcy_velocity_along_strike"),
                ),
                (Quantity::Velocity(1), velocity("darcy_velocity_down_dip")),
            ],
        };
        quantities.push((
            Quantity::Permeability,
            Reading {
                name: "permeability",
                unit: "m^2",
            },
        ));
        if self.dilatancy.is_some() {
            quantities.push((
                Quantity::Porosity,
                Reading {
                    name: "porosity_change",
                    unit: "1",
                },
            ));
        }
        quantities
    }

    /// The totals with their unit.
    pub(super) fn volumes(&self) -> Vec<Reading> {
        let unit = if self.cells.directions() == 1 {
            "m^2"
        } else {
            "m^3"
        };
        [
            "injected_volume",
            "stored_volume",
            "leaked_volume",
            "drained_volume",
            "pore_volume",
        ]
        .map(|name| Reading { name, unit })
        .to_vec()
    }

    /// Writes a quantity at each vertex.
    pub(super) fn write(&self, quantity: Quantity, memory: &[f64], values: &mut [f64]) {
        let excess = |cell| {
            let evolving = self.evolution.is_some();
            if evolving {
                memory[self.places.excess.start + cell]
            } else {
                0.0
            }
        };
        match quantity {
            Quantity::Velocity(direction) => self.write_velocity(direction, memory, values),
            Quantity::Permeability => self.per_vertex(values, |cell| {
                let mobility = self.mobility(cell, excess(cell));
                mobility / self.properties.per_permeability[cell]
            }),
            Quantity::Porosity => {
                self.per_vertex(values, |cell| memory[self.places.porosity.start + cell]);
            }
        }
    }

    fn per_vertex(&self, values: &mut [f64], of: impl Fn(usize) -> f64) {
        for (value, &cell) in values.iter_mut().zip(&self.cell_of) {
            *value = of(cell);
        }
    }

    /// The Darcy velocity: the mean over both faces of a cell.
    fn write_velocity(&self, direction: usize, memory: &[f64], values: &mut [f64]) {
        let mut work = self.pool.take(|| self.work());
        let now = self.current(memory, &mut work.own);
        let at = Pressures::of(&self.places, memory).cells;
        let rates = &mut work.flow;
        rates.fill(0.0);
        self.cells.add_half_flow(direction, &now.faces, at, rates);
        let mut add_side = |cell: usize, rate: f64, sign: f64| rates[cell] += 0.5 * sign * rate;
        for outlet in &self.outlets {
            if let Some(sign) = outlet.side.and_then(|side| side.outward(direction)) {
                let conductance = now.mobility[outlet.cell] * outlet.geometry;
                add_side(
                    outlet.cell,
                    conductance * (at[outlet.cell] - outlet.pressure),
                    sign,
                );
            }
        }
        for inflow in &self.inflows {
            if let Some(sign) = inflow.side.outward(direction) {
                add_side(inflow.cell, -inflow.rate, sign);
            }
        }
        self.per_vertex(values, |cell| {
            rates[cell] / (self.properties.thickness[cell] * self.cells.width(direction))
        });
        self.pool.give_back(work);
    }

    /// The conductances at a moment.
    fn current<'a>(&'a self, memory: &[f64], own: &'a mut Conductances) -> &'a Conductances {
        if self.evolution.is_some() {
            for cell in 0..self.cells.count() {
                own.mobility[cell] = self.mobility(cell, memory[self.places.excess.start + cell]);
            }
            own.update(&self.cells);
        }
        self.conductances_of(own)
    }

    /// A total.
    pub(super) fn volume(&self, number: usize, memory: &[f64]) -> f64 {
        match number {
            0 => {
                let span = [self.begin, memory[TIME]];
                let injections = self.injections.iter();
                injections
                    .map(|injection| injection.total * injection.rates.volume(span))
                    .sum()
            }
            1 => {
                let at = Pressures::of(&self.places, memory);
                let cells = self.capacity.iter().zip(at.cells).map(|(c, p)| c * p);
                let bores = self.bores().zip(at.bores).map(|(bore, p)| bore.storage * p);
                cells.sum::<f64>() + bores.sum::<f64>() - self.stored_at_start
            }
            2 => memory[LEAKED],
            3 => memory[DRAINED],
            _ => {
                let Some(dilatancy) = &self.dilatancy else {
                    return 0.0;
                };
                let changes = memory[self.places.porosity.clone()].iter().enumerate();
                let change = |(cell, change): (usize, &f64)| {
                    self.bulk(cell) * (change - dilatancy.initial_change)
                };
                changes.map(change).sum()
            }
        }
    }
}
