//! The estimated error of a step.

use super::Diffusion;
use super::conjugate_gradients::ROUGH;
use super::exchange::Pressures;
use super::tr_bdf2::{FIRST, HALF, error_weights};
use super::work::{Stage, Work};
use crate::FieldError;

impl Diffusion {
    /// Writes the estimated error of the pressure into the second vector of the scratch.
    ///
    /// The three volume rates of the step come from its ends: with `d` the change of the step, the second stage gives
    /// `C d1 = (C d - q f_1)/w`, the first one `f_gamma = C d1/q - f_0`. Their weighted sum is a third derivative; one
    /// solution with the factors of the step damps what diffuses within it.
    pub(super) fn estimate(
        &self,
        from: &[f64],
        source: [&[f64]; 2],
        dt: f64,
        to: &[f64],
        work: &mut Work,
    ) -> Result<(), FieldError> {
        self.prepare(from, source, dt, work);
        let (q, weights) = (HALF * dt, error_weights());
        let own = std::mem::take(&mut work.own);
        let conductances = self.conductances_of(&own);
        let [begin, end] = [from, to].map(|memory| Pressures::of(&self.places, memory));
        // weights[1] f_gamma = share (C d/q - f_1) - weights[1] f_0.
        let share = weights[1] / FIRST;
        let mut factors = [dt * (weights[0] - weights[1]), dt * (weights[2] - share)];
        let change = dt * share / q;
        let mut total =
            factors[0] * self.flow(conductances, begin, &mut work.flow, &mut work.bores);
        for bore in &mut work.bores {
            bore.side = factors[0] * bore.flow;
        }
        for (side, flow) in work.second.iter_mut().zip(&work.flow) {
            *side = factors[0] * flow;
        }
        total += factors[1] * self.flow(conductances, end, &mut work.flow, &mut work.bores);
        for (cell, side) in work.second.iter_mut().enumerate() {
            let volume = change * self.capacity[cell] * (end.cells[cell] - begin.cells[cell]);
            *side += factors[1] * work.flow[cell] + volume;
            total += volume;
        }
        for (number, (bore, of)) in work.bores.iter_mut().zip(self.bores()).enumerate() {
            let volume = of.storage * (end.bores[number] - begin.bores[number]);
            bore.side += factors[1] * bore.flow + change * volume;
        }
        // The sources have the same weights as the rates of their ends.
        factors = factors.map(|factor| factor / dt);
        total += self.add_sources(source, dt, factors, work, Stage::Second);
        let solved = self.solve(conductances, total, work, Stage::Second, ROUGH);
        work.own = own;
        solved
    }
}
