//! Passes over the nodes of a fault, for one or two rows of modes.

use stickslip_core::lanes::{LANES, Parameter, Pass};

use super::block::{Block, Step, add_sum};
use super::modes::Modes;

/// Sets the memory at the end of a step.
pub(super) struct Advance<'a> {
    pub(super) step: Step<'a>,
    pub(super) from: &'a [f64],
    pub(super) to: &'a mut [f64],
}

impl Pass for Advance<'_> {
    #[inline(always)]
    fn block(&mut self, first: usize, count: usize) {
        (self.step).advance(Block { first, count }, self.from, self.to);
    }
}

/// A row of modes in a sum.
pub(super) struct Term<'a> {
    pub(super) modes: &'a Modes,
    pub(super) factor: &'a Parameter,
    pub(super) memory: &'a [f64],
    /// The step at whose end they are summed.
    pub(super) step: Option<Step<'a>>,
}

/// Adds multiples of sums of modes, all at once: they may cancel.
pub(super) struct Add<'a, const N: usize> {
    pub(super) terms: [Term<'a>; N],
    pub(super) to: &'a mut [f64],
}

impl<const N: usize> Pass for Add<'_, N> {
    #[inline(always)]
    fn block(&mut self, first: usize, count: usize) {
        let block = Block { first, count };
        let mut added = [0.0; LANES];
        for term in &self.terms {
            let mut sum = [0.0; LANES];
            match &term.step {
                Some(step) => step.add_sum(block, term.memory, &mut sum),
                None => {
                    let weight = |mode: usize| term.modes.weights[mode];
                    add_sum(term.modes, block, weight, term.memory, &mut sum);
                }
            }
            let mut spare = None;
            let factor = term.factor.load(first, &mut spare);
            for k in 0..LANES {
                added[k] += factor[k] * sum[k];
            }
        }
        for (to, added) in self.to[first..first + count].iter_mut().zip(added) {
            *to += added;
        }
    }
}

/// Sets the sources, the heat per heat capacity.
pub(super) struct Heat<'a> {
    pub(super) friction: &'a [f64],
    pub(super) slip_rate: &'a [f64],
    /// `1/(rho c)`.
    pub(super) per_heat: &'a Parameter,
    pub(super) to: &'a mut [f64],
}

impl Pass for Heat<'_> {
    #[inline(always)]
    fn block(&mut self, first: usize, count: usize) {
        let block = Block { first, count };
        let mut spare = None;
        let per_heat = self.per_heat.load(first, &mut spare);
        let (friction, slip_rate) = (block.of(self.friction), block.of(self.slip_rate));
        let to = &mut self.to[first..first + count];
        for k in 0..count.min(LANES) {
            to[k] = friction[k] * slip_rate[k] * per_heat[k];
        }
    }
}
