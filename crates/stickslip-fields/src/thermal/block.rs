//! Modes of the nodes of a block.

use stickslip_core::lanes::{LANES, Numbers};

use super::modes::{Factors, Modes};
use super::relaxation::{Row, end};

/// The modes that are summed at once.
const ABREAST: usize = 4;

/// The nodes of a block.
#[derive(Clone, Copy)]
pub(super) struct Block {
    pub(super) first: usize,
    pub(super) count: usize,
}

impl Block {
    /// Its part of a number per node.
    #[inline(always)]
    pub(super) fn of<'a>(&self, numbers: &'a [f64]) -> &'a [f64] {
        &numbers[self.first..self.first + self.count]
    }

    /// Its part of the memory of modes.
    #[inline(always)]
    fn memory<'a>(&self, modes: &Modes, memory: &'a [f64]) -> &'a [f64] {
        let modes = modes.count();
        &memory[self.first * modes..(self.first + self.count) * modes]
    }
}

/// Adds several modes of a block, by their weights.
#[inline(always)]
fn add<const N: usize>(weights: [f64; N], values: &[f64], count: usize, sum: &mut Numbers) {
    let values: [&[f64]; N] = std::array::from_fn(|mode| &values[mode * count..(mode + 1) * count]);
    for k in 0..count.min(LANES) {
        let mut added = 0.0;
        for mode in 0..N {
            added += weights[mode] * values[mode][k];
        }
        sum[k] += added;
    }
}

/// The sum of the modes of a block by these weights, added.
#[inline(always)]
pub(super) fn add_sum(
    modes: &Modes,
    block: Block,
    weight: impl Fn(usize) -> f64,
    memory: &[f64],
    sum: &mut Numbers,
) {
    let (memory, count) = (block.memory(modes, memory), block.count);
    let mut mode = 0;
    while mode + ABREAST <= modes.count() {
        let weights: [f64; ABREAST] = std::array::from_fn(|k| weight(mode + k));
        add(weights, &memory[mode * count..], count, sum);
        mode += ABREAST;
    }
    for mode in mode..modes.count() {
        add([weight(mode)], &memory[mode * count..], count, sum);
    }
}

/// One step of modes: the factors of all nodes, or the length of the step.
pub(super) struct Step<'a> {
    modes: &'a Modes,
    sources: [&'a [f64]; 2],
    dt: f64,
    factors: Option<Factors>,
    /// The weighted sums of the factors of both sources.
    sums: [f64; 2],
}

impl<'a> Step<'a> {
    pub(super) fn new(modes: &'a Modes, sources: [&'a [f64]; 2], dt: f64) -> Self {
        let factors = modes.factors(dt);
        let mut sums = [0.0; 2];
        for (weight, [_, first, last]) in modes.weights.iter().zip(factors.iter().flatten()) {
            sums[0] += weight * first;
            sums[1] += weight * last;
        }
        Self {
            modes,
            sources,
            dt,
            factors,
            sums,
        }
    }

    /// Sets the memory of a block at the end of the step.
    #[inline(always)]
    pub(super) fn advance(&self, block: Block, from: &[f64], to: &mut [f64]) {
        let (modes, count) = (self.modes.count(), block.count);
        let [s0, s1] = self.sources.map(|source| block.of(source));
        let from = block.memory(self.modes, from).chunks_exact(count);
        let to = &mut to[block.first * modes..(block.first + count) * modes];
        let each = from.zip(to.chunks_exact_mut(count));
        if let Some(factors) = &self.factors {
            for ((from, to), factors) in each.zip(factors) {
                for k in 0..count {
                    to[k] = end(*factors, from[k], [s0[k], s1[k]]);
                }
            }
            return;
        }
        let (mut row, mut spare) = (Row::new(), None);
        let rates = self.modes.scale.load(block.first, &mut spare);
        for (mode, (from, to)) in each.enumerate() {
            if let Some(factor) = self.modes.slowest.get(mode) {
                row.start(count, *factor, rates, self.dt);
            }
            for k in 0..count.min(LANES) {
                let relaxation = row.at(k);
                to[k] = relaxation.end(from[k], [s0[k], s1[k]]);
                row.set(k, relaxation.twice());
            }
        }
    }

    /// Adds the sum of the modes of a block at the end of the step.
    #[inline(always)]
    pub(super) fn add_sum(&self, block: Block, from: &[f64], sum: &mut Numbers) {
        let count = block.count.min(LANES);
        let [s0, s1] = self.sources.map(|source| block.of(source));
        let weights = &self.modes.weights;
        if let Some(factors) = &self.factors {
            for k in 0..count {
                sum[k] += self.sums[0] * s0[k] + self.sums[1] * s1[k];
            }
            let weight = |mode: usize| weights[mode] * factors[mode][0];
            add_sum(self.modes, block, weight, from, sum);
            return;
        }
        let (mut row, mut spare) = (Row::new(), None);
        let rates = self.modes.scale.load(block.first, &mut spare);
        let from = block.memory(self.modes, from).chunks_exact(block.count);
        for (mode, (from, weight)) in from.zip(weights).enumerate() {
            if let Some(factor) = self.modes.slowest.get(mode) {
                row.start(count, *factor, rates, self.dt);
            }
            for k in 0..count {
                let relaxation = row.at(k);
                sum[k] += weight * relaxation.end(from[k], [s0[k], s1[k]]);
                row.set(k, relaxation.twice());
            }
        }
    }
}
