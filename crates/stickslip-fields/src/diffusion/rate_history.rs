//! Rates in time, integrated exactly over steps.

use super::DiffusionError;

/// How a rate goes from a row of its table to the next.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Between {
    /// It keeps the value of the row before.
    Constant,
    /// It changes linearly.
    Linear,
}

/// An injection rate in time: piecewise constant or linear.
///
/// It is 0 before the first row of its table, and keeps the last rate after the last one. On a plane rates are volumes
/// per time, `Q` [m^3/s]; on a line volumes per time and per length out of the plane, `Q'` [m^2/s]. Negative rates
/// produce fluid.
///
/// Over a step it acts as the linear function of time that is closest in the mean square: the injected volume is exact,
/// also where a step crosses a jump.
///
/// ```
/// use stickslip_fields::RateHistory;
///
/// // 3 litres per second for a day, half of it for another day.
/// let rates = RateHistory::constant_between(&[(0.0, 3e-3), (86_400.0, 1.5e-3), (172_800.0, 0.0)])?;
/// assert_eq!((rates.at(1e5), rates.knots().len()), (1.5e-3, 3));
/// assert!((rates.volume([0.0, 1e9]) - 388.8).abs() < 1e-9);
/// // A rate that grows within an hour; two rows of one time are a jump.
/// let rates = RateHistory::linear_between(&[(0.0, 0.0), (3600.0, 3e-3), (7200.0, 3e-3), (7200.0, 0.0)])?;
/// assert_eq!((rates.at(1800.0), rates.at(7200.0)), (1.5e-3, 0.0));
/// # Ok::<(), stickslip_fields::DiffusionError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[doc(alias("injection rate", "schedule", "shut-in"))]
pub struct RateHistory {
    between: Between,
    times: Vec<f64>,
    rates: Vec<f64>,
}

impl RateHistory {
    /// A rate that never changes.
    ///
    /// # Errors
    /// [`DiffusionError::Value`] for a rate that is not finite.
    pub fn constant(rate: f64) -> Result<Self, DiffusionError> {
        super::error::finite("rate", None, rate)?;
        Ok(Self {
            between: Between::Constant,
            times: vec![f64::NEG_INFINITY],
            rates: vec![rate],
        })
    }

    /// Rows of time \[s\] and rate; each rate holds up to the next time.
    ///
    /// # Errors
    /// [`DiffusionError::Rates`] for times that decrease and numbers that are not finite, [`DiffusionError::Count`] for
    /// no rows.
    pub fn constant_between(rows: &[(f64, f64)]) -> Result<Self, DiffusionError> {
        Self::new(rows, Between::Constant)
    }

    /// Rows of time \[s\] and rate; the rate is linear between them. Two rows of one time are a jump.
    ///
    /// # Errors
    /// As for [`constant_between`](Self::constant_between).
    pub fn linear_between(rows: &[(f64, f64)]) -> Result<Self, DiffusionError> {
        Self::new(rows, Between::Linear)
    }

    fn new(rows: &[(f64, f64)], between: Between) -> Result<Self, DiffusionError> {
        if rows.is_empty() {
            return Err(DiffusionError::Count {
                what: "rows of rates",
                expected: 1,
                found: 0,
            });
        }
        let mut before = f64::NEG_INFINITY;
        for (row, &(time, rate)) in rows.iter().enumerate() {
            if !(time.is_finite() && rate.is_finite() && time >= before) {
                return Err(DiffusionError::Rates {
                    row,
                    time,
                    rate,
                    before,
                });
            }
            before = time;
        }
        let (times, rates) = rows.iter().copied().unzip();
        Ok(Self {
            between,
            times,
            rates,
        })
    }

    /// The times at which it jumps or bends \[s\].
    pub fn knots(&self) -> &[f64] {
        if self.times[0].is_finite() {
            &self.times
        } else {
            &[]
        }
    }

    /// The rate at a time, after a jump there.
    pub fn at(&self, time: f64) -> f64 {
        self.in_piece(self.piece(time), time)
    }

    /// The piece of a time: the number of rows not after it.
    fn piece(&self, time: f64) -> usize {
        self.times.partition_point(|&row| row <= time)
    }

    /// The rate of a piece at a time of it.
    fn in_piece(&self, piece: usize, time: f64) -> f64 {
        let Some(row) = piece.checked_sub(1) else {
            return 0.0;
        };
        let rate = self.rates[row];
        match (self.between, self.times.get(piece)) {
            (Between::Linear, Some(&next)) => {
                let share = (time - self.times[row]) / (next - self.times[row]);
                rate + share.clamp(0.0, 1.0) * (self.rates[piece] - rate)
            }
            _ => rate,
        }
    }

    /// The volume between two times \[s\]: the integral of the rate.
    pub fn volume(&self, [begin, end]: [f64; 2]) -> f64 {
        let [first, last] = self.over(begin, end - begin);
        0.5 * (end - begin) * (first + last)
    }

    /// The rates at the ends of the linear function that is closest to it over a step: with the mean `m` and the moment
    /// `n = int f(t) (2 t - 1) dt` over the step's unit interval, `m -+ 3 n`.
    pub(super) fn over(&self, time: f64, dt: f64) -> [f64; 2] {
        let (end, mut piece) = (time + dt, self.piece(time));
        if self.times.get(piece).is_none_or(|&knot| knot >= end) {
            return [self.in_piece(piece, time), self.in_piece(piece, end)];
        }
        let (mut mean, mut moment, mut left) = (0.0, 0.0, 0.0);
        loop {
            let knot = self.times.get(piece).copied().filter(|&knot| knot < end);
            let right = knot.map_or(1.0, |knot| (knot - time) / dt);
            // Simpson's rule is exact for the product of both linear functions. A jump takes no time.
            let simpson = [(left, 1.0), (0.5 * (left + right), 4.0), (right, 1.0)];
            for (place, weight) in simpson.into_iter().filter(|_| right > left) {
                let rate = self.in_piece(piece, time + place * dt);
                let part = weight * (right - left) / 6.0 * rate;
                mean += part;
                moment += part * (2.0 * place - 1.0);
            }
            if knot.is_none() {
                return [mean - 3.0 * moment, mean + 3.0 * moment];
            }
            (left, piece) = (right, piece + 1);
        }
    }
}
