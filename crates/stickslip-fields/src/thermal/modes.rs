//! The modes of diffusion across a fault.

use std::f64::consts::{LN_2, PI};

use stickslip_core::lanes::Parameter;

use super::ThermalError;
use super::parameters::{ShearZone, parameter};
use super::relaxation::Relaxation;

/// The largest number of modes.
pub(super) const LARGEST: usize = 64;

/// The number of modes by default.
pub(super) const DEFAULT: usize = 24;

/// The largest `lambda = (k w)^2/2`: the weights of the row below it sum to 1 to rounding. That of other rows of ratio 2 is
/// wrong by up to 2e-6.
const FASTEST: f64 = 11.222_546_036_554_15;

/// The modes of the row that the tail below the last one has; those further down have weights below 1e-18.
const TAIL: i32 = 120;

/// The factors of one step, of memory and sources, mode by mode.
pub(super) type Factors = [[f64; 3]; LARGEST];

/// A row of modes, from the slowest on: the tail in one mode, then rates of ratio 2.
///
/// The modes of a block of nodes are one behind the other in memory, and those of the next block follow.
#[derive(Debug, Clone)]
pub(super) struct Modes {
    /// Of sum 1.
    pub(super) weights: Vec<f64>,
    /// `lambda` of the tail and of the slowest of the row.
    pub(super) slowest: [f64; 2],
    /// `2 alpha/w^2` [1/s].
    pub(super) scale: Parameter,
    pub(super) is_uniform: bool,
}

impl Modes {
    pub(super) fn new(
        (vertices, modes): (usize, usize),
        zone: &ShearZone,
        diffusivity: impl Fn(usize) -> f64,
    ) -> Result<Self, ThermalError> {
        if !(2..=LARGEST).contains(&modes) {
            let largest = LARGEST;
            return Err(ThermalError::Modes { modes, largest });
        }
        let lambda = |k: i32| FASTEST * 0.5_f64.powi(k);
        let weight = |k| LN_2 * (lambda(k) / PI).sqrt() * (-lambda(k)).exp();
        let row = modes as i32 - 1;
        let tail = || (row..row + TAIL).rev();
        let tail_weight: f64 = tail().map(weight).sum();
        let tail_rate: f64 = tail().map(|k| weight(k) * lambda(k)).sum();
        let weights = std::iter::once(tail_weight).chain((0..row).rev().map(weight));
        let scale = |k| {
            let half_width = zone.half_width.at(k);
            2.0 * (diffusivity(k) / half_width) / half_width
        };
        let (scale, is_uniform) = parameter(vertices, scale);
        Ok(Self {
            weights: weights.collect(),
            slowest: [tail_rate / tail_weight, lambda(row - 1)],
            scale,
            is_uniform,
        })
    }

    /// The number of modes.
    pub(super) fn count(&self) -> usize {
        self.weights.len()
    }

    /// The factors of a step, if they are those of all nodes.
    pub(super) fn factors(&self, dt: f64) -> Option<Factors> {
        if !self.is_uniform {
            return None;
        }
        let mut spare = None;
        let [scale, ..] = *self.scale.load(0, &mut spare);
        let [tail, row] = self
            .slowest
            .map(|slowest| Relaxation::new(slowest * scale, dt));
        let mut factors = [[0.0; 3]; LARGEST];
        factors[0] = tail.factors();
        let mut relaxation = row;
        for factors in &mut factors[1..self.count()] {
            *factors = relaxation.factors();
            relaxation = relaxation.twice();
        }
        Some(factors)
    }
}
