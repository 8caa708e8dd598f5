//! The losses of residuals: squares, or those of Huber.

/// Huber's bound of residuals that count by their squares, in standard deviations: 95 % of the efficiency of least squares
/// for normally distributed errors. Source: P. J. Huber, *Robust Statistics* (1981), Sec. 4.
const BOUND: f64 = 1.345;
/// The median of the magnitude of normally distributed errors is 0.6745 standard deviations.
pub(crate) const MEDIAN: f64 = 0.6745;

/// The weight of a residual in the sum that is minimised.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Loss {
    /// Its square: the best for normally distributed errors.
    #[default]
    Squares,
    /// Its square up to 1.345 standard deviations, beyond it a line that continues it: spikes have a bounded influence. The
    /// standard deviation is that by the median of the residuals. Standard errors of normally distributed errors are
    /// larger by 2.5 %.
    #[doc(alias = "robust")]
    Huber,
}

/// A loss at the scale of the residuals.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Scale {
    /// The largest residual that counts by its square.
    bound: f64,
}

impl Scale {
    /// The scale of weighted residuals; samples without weight do not count.
    pub(crate) fn of(loss: Loss, residuals: &[f64], weighted: &[bool]) -> Self {
        let bound = match loss {
            Loss::Squares => f64::INFINITY,
            Loss::Huber => {
                let kept = residuals
                    .iter()
                    .zip(weighted)
                    .filter(|(_, weighted)| **weighted);
                BOUND * deviation(kept.map(|(residual, _)| *residual))
            }
        };
        Self { bound }
    }

    /// The standard deviation by the median; none where all residuals count by their squares.
    pub(crate) fn deviation(self) -> Option<f64> {
        self.bound.is_finite().then_some(self.bound / BOUND)
    }

    /// Whether a residual counts by its square.
    pub(crate) fn is_inside(self, residual: f64) -> bool {
        residual.abs() <= self.bound
    }

    /// Half the derivative of the loss.
    pub(crate) fn slope(self, residual: f64) -> f64 {
        residual.clamp(-self.bound, self.bound)
    }

    /// The loss.
    pub(crate) fn loss(self, residual: f64) -> f64 {
        let size = residual.abs();
        if self.is_inside(residual) {
            size * size
        } else {
            (2.0 * size - self.bound) * self.bound
        }
    }

    /// The weight of a square with the slope of the loss: least squares with it have their minimum where the losses have it.
    pub(crate) fn weight(self, residual: f64) -> f64 {
        if self.is_inside(residual) {
            1.0
        } else {
            self.bound / residual.abs()
        }
    }
}

/// The standard deviation of normally distributed values, by their median magnitude; 0 of none.
pub(crate) fn deviation(values: impl Iterator<Item = f64>) -> f64 {
    let mut sizes: Vec<f64> = values.map(f64::abs).collect();
    if sizes.is_empty() {
        return 0.0;
    }
    let middle = sizes.len() / 2;
    *sizes.select_nth_unstable_by(middle, f64::total_cmp).1 / MEDIAN
}
