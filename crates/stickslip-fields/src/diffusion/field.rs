//! Diffusion as a field.

use super::Diffusion;
use super::memory::TIME;
use super::system::{Conductances, System};
use super::tr_bdf2::GAMMA;
use super::work::{BoreWork, Work};
use crate::{FaultField, FaultRates, FieldError, FieldSizes, Reading};

impl Diffusion {
    /// Scratch of the size of its cells.
    pub(super) fn work(&self) -> Work {
        let count = self.cells.count();
        let vector = || vec![0.0; count];
        Work {
            own: Conductances {
                mobility: vector(),
                faces: vec![0.0; self.cells.faces()],
                connected: false,
            },
            system: System::new(&self.cells, &self.sides),
            flow: vector(),
            first: vector(),
            second: vector(),
            kept: vec![0.0; if self.fourth_order { count } else { 0 }],
            rates: vec![[0.0; 2]; self.injections.len()],
            bores: vec![BoreWork::default(); self.bores().count()],
        }
    }
}

impl FaultField for Diffusion {
    fn sizes(&self) -> FieldSizes {
        let mut memory = vec![0.0; self.places.count()];
        memory[TIME] = self.begin;
        memory[self.places.pressure.clone()].copy_from_slice(&self.initial);
        for (bore, at) in self.bores().zip(self.places.bores.clone()) {
            memory[at] = self.initial[bore.cell];
        }
        if let Some(evolution) = &self.evolution {
            memory[self.places.excess.clone()].copy_from_slice(&evolution.initial);
        }
        if let Some(dilatancy) = &self.dilatancy {
            memory[self.places.porosity.clone()].fill(dilatancy.initial_change);
        }
        let fed = usize::from(self.evolution.is_some()) + usize::from(self.dilatancy.is_some());
        let vertices = self.cell_of.len();
        FieldSizes {
            vertices,
            memory,
            sources: fed * vertices,
        }
    }

    fn source(&self, at: &FaultRates<'_>, memory: &[f64], source: &mut [f64]) {
        if self.evolution.is_some() {
            source[..self.cell_of.len()].copy_from_slice(at.slip_rate);
        }
        if let Some(dilatancy) = &self.dilatancy {
            let source = source[self.first_porosity_source()..].iter_mut();
            for ((source, &cell), &rate) in source.zip(&self.cell_of).zip(at.slip_rate) {
                *source = dilatancy.rate(memory[self.places.porosity.start + cell], rate);
            }
        }
    }

    fn advance(
        &self,
        from: &[f64],
        source: [&[f64]; 2],
        dt: f64,
        to: &mut [f64],
    ) -> Result<(), FieldError> {
        let mut work = self.pool.take(|| self.work());
        let stepped = self.step(from, source, dt, to, &mut work);
        self.pool.give_back(work);
        stepped
    }

    fn pressure(&self, memory: &[f64], pressure: &mut [f64]) {
        let cells = &memory[self.places.pressure.clone()];
        for (pressure, &cell) in pressure.iter_mut().zip(&self.cell_of) {
            *pressure += cells[cell];
        }
    }

    /// One step, and the parabola through its pressures at the start, at `gamma dt` and at the end: an error of third
    /// order in `dt`, as that of the step.
    fn pressures_within(
        &self,
        from: &[f64],
        dt: f64,
        shares: &[f64],
        pressures: &mut [Vec<f64>],
        to: &mut [f64],
    ) -> Result<(), FieldError> {
        let mut work = self.pool.take(|| self.work());
        let stepped = self.step(from, [&[], &[]], dt, to, &mut work);
        let cells = &from[self.places.pressure.clone()];
        let moves = dt > 0.0;
        for (&share, pressures) in shares.iter().zip(pressures) {
            let first = share * (share - 1.0) / (GAMMA * (GAMMA - 1.0));
            let second = share * (share - GAMMA) / (1.0 - GAMMA);
            let [first, second] = [first, second].map(|weight| if moves { weight } else { 0.0 });
            for (pressure, &cell) in pressures.iter_mut().zip(&self.cell_of) {
                let change = first * work.first[cell] + second * work.second[cell];
                *pressure += cells[cell] + change;
            }
        }
        self.pool.give_back(work);
        stepped
    }

    fn error(
        &self,
        from: &[f64],
        source: [&[f64]; 2],
        dt: f64,
        to: &[f64],
        pressure_error: &mut [f64],
    ) {
        if dt <= 0.0 {
            return;
        }
        let mut work = self.pool.take(|| self.work());
        // An estimate that is not finite belongs to a step that `advance` refuses.
        let estimated = self.estimate(from, source, dt, to, &mut work);
        for (error, &cell) in pressure_error.iter_mut().zip(&self.cell_of) {
            *error += if estimated.is_ok() {
                work.second[cell]
            } else {
                f64::INFINITY
            };
        }
        self.pool.give_back(work);
    }

    fn stops(&self) -> Vec<f64> {
        let knots = self
            .injections
            .iter()
            .flat_map(|injection| injection.rates.knots());
        let mut stops: Vec<f64> = knots.copied().filter(|&knot| knot > self.begin).collect();
        stops.sort_by(f64::total_cmp);
        stops.dedup();
        stops
    }

    fn readings(&self) -> &[Reading] {
        &self.readings
    }

    fn read(&self, number: usize, memory: &[f64], values: &mut [f64]) {
        if let Some((quantity, _)) = self.quantities().get(number) {
            self.write(*quantity, memory, values);
        }
    }

    fn totals(&self) -> &[Reading] {
        &self.totals
    }

    fn total(&self, number: usize, memory: &[f64]) -> f64 {
        self.volume(number, memory)
    }
}
