//! A step of TR-BDF2.

use super::Diffusion;
use super::conjugate_gradients::EXACT;
use super::exchange::Pressures;
use super::memory::{DRAINED, LEAKED, TIME};
use super::system::{Conductances, System};
use super::tr_bdf2::{FIRST, GAMMA, HALF, WEIGHTS};
use super::work::{BoreWork, Stage, Work};
use crate::FieldError;

impl Diffusion {
    /// Advances the memory with this scratch.
    pub(super) fn step(
        &self,
        from: &[f64],
        source: [&[f64]; 2],
        dt: f64,
        to: &mut [f64],
        work: &mut Work,
    ) -> Result<(), FieldError> {
        to.copy_from_slice(from);
        to[TIME] += dt;
        if dt <= 0.0 {
            return Ok(());
        }
        self.evolve(from, source, dt, to);
        self.prepare(from, source, dt, work);
        // Out of the scratch, which the stages change.
        let own = std::mem::take(&mut work.own);
        let stepped = self.stages(self.conductances_of(&own), from, source, work, to);
        work.own = own;
        stepped
    }

    fn stages(
        &self,
        conductances: &Conductances,
        from: &[f64],
        source: [&[f64]; 2],
        work: &mut Work,
        to: &mut [f64],
    ) -> Result<(), FieldError> {
        let (q, at) = (work.system.q, Pressures::of(&self.places, from));
        // Up to gamma dt.
        let exchanged = self.flow(conductances, at, &mut work.flow, &mut work.bores);
        for (side, flow) in work.first.iter_mut().zip(&work.flow) {
            *side = 2.0 * q * flow;
        }
        for bore in &mut work.bores {
            bore.side = 2.0 * q * bore.flow;
        }
        let sources = self.add_sources(source, q, [2.0 - GAMMA, GAMMA], work, Stage::First);
        let total = 2.0 * q * exchanged + sources;
        self.solve_stage(conductances, total, work, Stage::First)?;
        // Up to dt.
        let mut total = q * exchanged;
        for (cell, side) in work.second.iter_mut().enumerate() {
            let volume = FIRST * self.capacity[cell] * work.first[cell];
            *side = volume + q * work.flow[cell];
            total += volume;
        }
        for (bore, of) in work.bores.iter_mut().zip(self.bores()) {
            bore.side = FIRST * of.storage * bore.change + q * bore.flow;
        }
        total += self.add_sources(source, q, [0.0, 1.0], work, Stage::Second);
        self.solve_stage(conductances, total, work, Stage::Second)?;
        self.add_volumes(conductances, at.cells, q / HALF, work, to);
        let pressures = to[self.places.pressure.clone()].iter_mut();
        for (pressure, change) in pressures.zip(&work.second) {
            *pressure += change;
        }
        for (pressure, bore) in to[self.places.bores.clone()].iter_mut().zip(&work.bores) {
            *pressure += bore.change;
        }
        Ok(())
    }

    /// The conductances of the step: those of the field, or of the step where permeability changes.
    pub(super) fn conductances_of<'a>(&'a self, own: &'a Conductances) -> &'a Conductances {
        if self.evolution.is_some() {
            own
        } else {
            &self.conductances
        }
    }

    /// Writes the permeability and porosity of the end.
    fn evolve(&self, from: &[f64], source: [&[f64]; 2], dt: f64, to: &mut [f64]) {
        if let Some(evolution) = &self.evolution {
            let excess = self.places.excess.start;
            for cell in 0..self.cells.count() {
                let rate = self.mean_rate(source, cell, [0.5, 0.5]);
                to[excess + cell] = evolution.after(cell, from[excess + cell], rate, dt);
            }
        }
        if self.dilatancy.is_some() {
            let (start, porosity) = (self.first_porosity_source(), self.places.porosity.start);
            for (vertex, &cell) in self.cell_of.iter().enumerate() {
                let rates = [source[0][start + vertex], source[1][start + vertex]];
                to[porosity + cell] += 0.5 * dt * (rates[0] + rates[1]);
            }
        }
    }

    /// The slip rate of a cell, with weights of both ends of a step; 0 without a vertex.
    fn mean_rate(&self, source: [&[f64]; 2], cell: usize, weights: [f64; 2]) -> f64 {
        self.vertex_of[cell].map_or(0.0, |vertex| {
            weights[0] * source[0][vertex] + weights[1] * source[1][vertex]
        })
    }

    /// Prepares the rates, the conductances at the middle of the step, and the factors.
    pub(super) fn prepare(&self, from: &[f64], source: [&[f64]; 2], dt: f64, work: &mut Work) {
        let q = HALF * dt;
        self.rates(from, dt, &mut work.rates);
        if let Some(evolution) = &self.evolution {
            let excess = self.places.excess.start;
            for cell in 0..self.cells.count() {
                let rate = self.mean_rate(source, cell, [0.75, 0.25]);
                let middle = evolution.after(cell, from[excess + cell], rate, 0.5 * dt);
                work.own.mobility[cell] = self.mobility(cell, middle);
            }
            work.own.update(&self.cells);
        } else if work.system.q.to_bits() == q.to_bits() {
            return;
        }
        let conductances = self.conductances_of(&work.own);
        self.factor(conductances, q, &mut work.system, &mut work.bores);
    }

    /// The mobility of a cell with this excess of permeability.
    pub(super) fn mobility(&self, cell: usize, excess: f64) -> f64 {
        let permeability = self
            .evolution
            .as_ref()
            .map_or(self.properties.permeability[cell], |evolution| {
                evolution.permeability(cell, excess)
            });
        permeability * self.properties.per_permeability[cell]
    }

    fn factor(
        &self,
        conductances: &Conductances,
        q: f64,
        system: &mut System,
        bores: &mut [BoreWork],
    ) {
        system.diagonal.copy_from_slice(&self.capacity);
        for outlet in &self.outlets {
            let conductance = conductances.mobility[outlet.cell] * outlet.geometry;
            system.diagonal[outlet.cell] += q * conductance;
        }
        if let Some(leak) = &self.leak {
            for (diagonal, conductance) in system.diagonal.iter_mut().zip(&leak.conductance) {
                *diagonal += q * conductance;
            }
        }
        for (bore, work) in self.bores().zip(bores) {
            work.index = bore.index(&conductances.mobility);
            // Storage and index in series.
            let index = q * work.index;
            system.diagonal[bore.cell] += index * bore.storage / (bore.storage + index);
        }
        system.factor(conductances, q);
    }

    /// Solves a stage; with flow of fourth order again, with its part of the first solution.
    fn solve_stage(
        &self,
        conductances: &Conductances,
        total: f64,
        work: &mut Work,
        stage: Stage,
    ) -> Result<(), FieldError> {
        if !self.fourth_order {
            return self.solve(conductances, total, work, stage, EXACT);
        }
        let mut kept = std::mem::take(&mut work.kept);
        kept.copy_from_slice(work.side(stage));
        let mut solved = self.solve(conductances, total, work, stage, EXACT);
        if solved.is_ok() {
            let (q, side) = (work.system.q, work.side(stage));
            self.add_fourth_order(&conductances.faces, side, q, &mut kept);
            side.copy_from_slice(&kept);
            solved = self.solve(conductances, total, work, stage, EXACT);
        }
        work.kept = kept;
        solved
    }

    /// Solves a stage: bores are eliminated, and follow their cells.
    pub(super) fn solve(
        &self,
        conductances: &Conductances,
        mut total: f64,
        work: &mut Work,
        stage: Stage,
        tolerance: f64,
    ) -> Result<(), FieldError> {
        let q = work.system.q;
        let side = if stage == Stage::First {
            &mut work.first
        } else {
            &mut work.second
        };
        for (bore, of) in work.bores.iter().zip(self.bores()) {
            let index = q * bore.index;
            let volume = index / (of.storage + index) * bore.side;
            side[of.cell] += volume;
            total += volume;
        }
        work.system.solve(conductances, side, total, tolerance)?;
        for (bore, of) in work.bores.iter_mut().zip(self.bores()) {
            let index = q * bore.index;
            bore.change = (bore.side + index * side[of.cell]) / (of.storage + index);
        }
        Ok(())
    }

    /// Adds what left through the sides and by leak-off.
    fn add_volumes(
        &self,
        conductances: &Conductances,
        pressure: &[f64],
        dt: f64,
        work: &Work,
        to: &mut [f64],
    ) {
        let (first, second) = (&work.first, &work.second);
        if !(self.outlets.is_empty() && self.inflows.is_empty()) {
            let rates = [
                self.drain(conductances, |cell| pressure[cell]),
                self.drain(conductances, |cell| pressure[cell] + first[cell]),
                self.drain(conductances, |cell| pressure[cell] + second[cell]),
            ];
            to[DRAINED] += dt * (0..3).map(|i| WEIGHTS[i] * rates[i]).sum::<f64>();
        }
        if let Some(leak) = &self.leak {
            let with = |change: &[f64]| leak.rate(pressure.iter().zip(change).map(|(p, d)| p + d));
            let rates = [
                leak.rate(pressure.iter().copied()),
                with(first),
                with(second),
            ];
            to[LEAKED] += dt * (0..3).map(|i| WEIGHTS[i] * rates[i]).sum::<f64>();
        }
    }
}
