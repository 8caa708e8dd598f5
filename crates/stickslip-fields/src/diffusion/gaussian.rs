//! Sources spread as a Gaussian.

use std::f64::consts::FRAC_1_SQRT_2;

use super::error::positive;
use super::{Cells, Diffusion, DiffusionError, Place, RateHistory};

const SOURCE: &str = "Gaussian source";

/// A source whose rate is spread around a point as a Gaussian of a standard deviation `s`: on a plane
/// `q = Q/(2 pi s^2) exp(-r^2/(2 s^2))`, on a line `q = Q'/(s sqrt(2 pi)) exp(-x^2/(2 s^2))`.
///
/// Each cell takes its integral. What would lie beyond the cells is spread over them in proportion: they take all of the
/// rate.
#[derive(Debug, Clone, PartialEq)]
pub struct GaussianSource {
    center: Place,
    deviation: f64,
    rates: RateHistory,
}

impl GaussianSource {
    /// A source around a point, with a standard deviation \[m\] and rates `Q` [m^3/s], on a line `Q'` [m^2/s].
    pub fn new(center: impl Into<Place>, deviation: f64, rates: RateHistory) -> Self {
        Self {
            center: center.into(),
            deviation,
            rates,
        }
    }
}

impl Diffusion {
    /// Adds a Gaussian source; sealed cells take none of it.
    ///
    /// # Errors
    /// [`DiffusionError`] for a centre outside of the cells, one in a sealed cell, and a deviation that is not above 0.
    pub fn with_gaussian_source(mut self, source: GaussianSource) -> Result<Self, DiffusionError> {
        let GaussianSource {
            center,
            deviation,
            rates,
        } = source;
        positive(
            "standard deviation of a Gaussian source [m]",
            None,
            deviation,
        )?;
        let cell = self.cells.at(SOURCE, center)?;
        self.require_open(SOURCE, cell)?;
        let mut shares = self.cells.gaussian(center, deviation)?;
        shares.retain(|&(cell, share)| share > 0.0 && self.greatest_permeability(cell) > 0.0);
        let total: f64 = shares.iter().map(|&(_, share)| share).sum();
        if total > 0.0 {
            shares.iter_mut().for_each(|(_, share)| *share /= total);
        } else {
            // Narrower than what numbers hold: a point.
            shares = vec![(cell, 1.0)];
        }
        if let (true, Cells::Plane(plane)) = (self.fourth_order, &self.cells) {
            plane.sharpen(&mut shares);
        }
        self.add_injection(rates, shares, None);
        if let Some(injection) = self.injections.last_mut() {
            injection.spread = true;
        }
        Ok(self)
    }
}

impl Cells {
    /// The integral over each cell of a Gaussian of integral 1.
    fn gaussian(&self, center: Place, deviation: f64) -> Result<Vec<(usize, f64)>, DiffusionError> {
        let share = |[begin, end]: [f64; 2], center: f64| {
            let [begin, end] = [begin, end].map(|at| (at - center) * FRAC_1_SQRT_2 / deviation);
            // Beside the centre by the small function, whose digits are those of the tail.
            if begin > 0.0 {
                0.5 * (libm::erfc(begin) - libm::erfc(end))
            } else if end < 0.0 {
                0.5 * (libm::erfc(-end) - libm::erfc(-begin))
            } else {
                0.5 * (libm::erf(end) - libm::erf(begin))
            }
        };
        match (self, center) {
            (Self::Line(line), Place::Along(center)) => {
                let cells =
                    (0..line.count()).map(|cell| (cell, share(line.edges_of(cell), center)));
                Ok(cells.collect())
            }
            (Self::Plane(plane), Place::On(center)) => {
                let axes = [0, 1].map(|axis| -> Vec<f64> {
                    let (begin, length) = (plane.ends()[axis][0], plane.lengths()[axis]);
                    let edge = |i: usize| begin + i as f64 * length;
                    let cells = 0..plane.counts()[axis];
                    cells
                        .map(|i| share([edge(i), edge(i + 1)], center[axis]))
                        .collect()
                });
                let shares = axes[1]
                    .iter()
                    .flat_map(|down| axes[0].iter().map(move |x| x * down));
                Ok(shares.enumerate().collect())
            }
            _ => Err(self.misplaced(SOURCE, center.kind())),
        }
    }
}
