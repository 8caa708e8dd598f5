//! The noise of a measured displacement.

use super::gauge::LineError;
use super::line::Line;
use crate::loss::MEDIAN;

/// The variance of a gauge and the number of samples in a row that say the same.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Noise {
    /// [m^2].
    pub(super) variance: f64,
    /// At least 1: `n` samples determine a mean as well as `n/correlation` independent ones.
    pub(super) correlation: f64,
}

impl Noise {
    /// The noise by the deviation of samples from the line between their neighbours, which no velocity enters: by its median
    /// beside zeros, so that the corners do not count. It is at least the rounding.
    pub(super) fn between_neighbours(times: &[f64], displacements: &[f64]) -> Self {
        let deviations = (1..times.len().saturating_sub(1)).map(|n| {
            let share = (times[n] - times[n - 1]) / (times[n + 1] - times[n - 1]);
            let [before, at, behind] = [n - 1, n, n + 1].map(|n| displacements[n]);
            let between = before + share * (behind - before);
            (at - between).abs() / (1.0 + share * share + (1.0 - share).powi(2)).sqrt()
        });
        let mut deviations: Vec<f64> = deviations.filter(|x| *x > 0.0).collect();
        let deviation = quantile(&mut deviations, 0.5) / MEDIAN;
        let rounding = Self::of_rounding(times, displacements);
        Self {
            variance: rounding.variance.max(deviation * deviation),
            ..rounding
        }
    }

    /// The rounding of times and displacements, and of the sums of `n` samples: `n^(1/2)` times as much.
    pub(super) fn of_rounding(times: &[f64], displacements: &[f64]) -> Self {
        Self {
            variance: rounding(times, displacements).powi(2) * times.len() as f64,
            correlation: 1.0,
        }
    }

    /// The noise of a gauge with steps of `quantum`: the variance `q^2/4`, the largest of values that are one of two
    /// multiples, for as many samples in a row as repeat.
    pub(super) fn of_steps(self, quantum: f64, repeated: f64) -> Self {
        Self {
            variance: self.variance.max(0.25 * quantum * quantum),
            correlation: repeated,
        }
    }

    /// The noise by the residuals beside lines, at least this one: with the correlation `r` of neighbours that of a process
    /// of first order, `(1 + r)/(1 - r)` samples in a row, where `r` exceeds its two standard errors, `2/n^(1/2)`.
    pub(super) fn beside(
        self,
        lines: &[(Line, usize, usize)],
        times: &[f64],
        displacements: &[f64],
    ) -> Self {
        let (mut squares, mut products, mut pairs) = (0.0, 0.0, 0.0_f64);
        for &(line, from, to) in lines {
            let mut last = None;
            for n in from..to {
                let residual = displacements[n] - line.at(times[n]);
                squares += residual * residual;
                if let Some(last) = last {
                    products += last * residual;
                    pairs += 1.0;
                }
                last = Some(residual);
            }
        }
        let samples = times.len() as f64;
        let freedom = samples - 2.0 * lines.len() as f64;
        if squares <= 0.0 || freedom <= 0.0 {
            return self;
        }
        let together = products / pairs.max(1.0) / (squares / samples);
        let correlation = if together > 2.0 / samples.sqrt() {
            (1.0 + together) / (1.0 - together).max(samples.recip())
        } else {
            1.0
        };
        let found = Self {
            variance: squares / freedom,
            correlation,
        };
        // Rounding is correlated, too, and much smaller than a quantum.
        if found.of_means() > self.of_means() {
            found
        } else {
            self
        }
    }

    /// The variance of the mean of `n` samples times `n` [m^2].
    fn of_means(self) -> f64 {
        self.variance * self.correlation
    }

    /// Whether the velocity of a line in a record of so many samples differs from 0: by Schwarz's criterion, `ln n` for one
    /// parameter.
    pub(super) fn tells_from_rest(self, line: &Line, samples: usize) -> bool {
        let lower = line.spread * line.velocity * line.velocity;
        lower > (samples as f64).ln() * self.of_means()
    }

    /// The standard errors of a line; without one of the velocity of a load point at rest.
    pub(super) fn of_line(self, line: &Line) -> LineError {
        let slope = (self.of_means() / line.spread).sqrt();
        LineError {
            middle: line.time,
            displacement: (self.of_means() / line.count).sqrt(),
            velocity: if line.velocity == 0.0 { 0.0 } else { slope },
        }
    }

    /// The least decrease of the sum of squares [m^2] by which a piece of a record of so many samples is defended: by the
    /// modified criterion of Schwarz (BIC) `ln n` for its displacement, `ln n` for its velocity and `2 ln n` for the time of
    /// its begin, which is sought among all samples. Source: N. R. Zhang, D. O. Siegmund, "A modified Bayes information
    /// criterion with applications to the analysis of comparative genomic hybridization data", Biometrics 63 (2007).
    pub(super) fn penalty(self, samples: usize) -> f64 {
        4.0 * (samples as f64).ln() * self.of_means()
    }
}

/// The rounding of a sample \[m\], by that of its displacement and its time.
pub(super) fn rounding(times: &[f64], displacements: &[f64]) -> f64 {
    let largest = |values: &[f64]| values.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let velocities = (times.windows(2).zip(displacements.windows(2)))
        .map(|(t, x)| ((x[1] - x[0]) / (t[1] - t[0])).abs());
    let fastest = velocities.fold(0.0, f64::max);
    f64::EPSILON * (largest(displacements) + fastest * largest(times))
}

/// The value that a share of the values does not exceed; 0 of none.
pub(super) fn quantile(values: &mut [f64], share: f64) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    let place = (share * (values.len() - 1) as f64) as usize;
    *values.select_nth_unstable_by(place, f64::total_cmp).1
}
