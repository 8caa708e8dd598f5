//! Sources and memories to check a field at.

use super::FieldViolation;
use crate::{FaultField, FaultRates, FieldSizes};

/// Slip rates \[m/s\], frictional strengths and effective normal stresses \[Pa\] of the samples.
const RATES: [[f64; 3]; 8] = [
    [1.0, 3e7, 5e7],
    [1e-9, 3e7, 5e7],
    [1e-3, 1e6, 2e6],
    [0.0, 3e7, 5e7],
    [1e-30, 1e5, 1e5],
    [1e2, 1e8, 2e8],
    [1e-16, 6e7, 1e8],
    [1e-6, 0.0, 0.0],
];

/// The longest time for which sources are held \[s\]: longer than most relaxations.
pub(super) const HELD: f64 = 1e9;

/// The steps of the checks, by decades \[s\].
pub(super) fn steps() -> impl Iterator<Item = f64> {
    (-9..=15).map(|decade| 10_f64.powi(decade))
}

/// A field, with sources of it.
pub(super) struct Samples<'a> {
    pub(super) field: &'a dyn FaultField,
    pub(super) vertices: usize,
    /// The initial memory.
    pub(super) memory: Vec<f64>,
    /// The sources at slip rates from 0 to 100 m/s.
    pub(super) sources: Vec<Vec<f64>>,
    /// No sources.
    pub(super) none: Vec<f64>,
}

impl<'a> Samples<'a> {
    pub(super) fn new(
        field: &'a dyn FaultField,
        sizes: FieldSizes,
    ) -> Result<Self, FieldViolation> {
        let mut samples = Self {
            field,
            vertices: sizes.vertices,
            memory: sizes.memory,
            sources: Vec::new(),
            none: vec![0.0; sizes.sources],
        };
        samples.sources = samples.sources_at(&samples.memory)?;
        Ok(samples)
    }

    /// The sources at all rates; those of the vertices differ.
    pub(super) fn sources_at(&self, memory: &[f64]) -> Result<Vec<Vec<f64>>, FieldViolation> {
        let mut all = Vec::new();
        for rates in RATES {
            let [slip_rate, friction, normal_stress] =
                rates.map(|value| (0..self.vertices).map(|k| value * spread(k)).collect());
            let (slip_rate, friction): (Vec<f64>, Vec<f64>) = (slip_rate, friction);
            let normal_stress: Vec<f64> = normal_stress;
            let state_rate: Vec<f64> = slip_rate.iter().map(|v| 1e-3 - v / 1e-2).collect();
            let at = FaultRates {
                time: 0.0,
                slip_rate: &slip_rate,
                friction: &friction,
                state_rate: &state_rate,
                normal_stress: &normal_stress,
            };
            let mut source = vec![f64::NAN; self.none.len()];
            self.field.source(&at, memory, &mut source);
            finite("source", None, &source)?;
            all.push(source);
        }
        Ok(all)
    }

    /// The memory after `dt`.
    pub(super) fn advance(
        &self,
        from: &[f64],
        source: [&[f64]; 2],
        dt: f64,
    ) -> Result<Vec<f64>, FieldViolation> {
        let mut to = vec![f64::NAN; from.len()];
        self.field
            .advance(from, source, dt, &mut to)
            .map_err(|error| FieldViolation::Refused { dt, error })?;
        finite("memory", Some(dt), &to)?;
        Ok(to)
    }

    /// The memory after two halves of `dt`.
    pub(super) fn halves(
        &self,
        from: &[f64],
        [begin, end]: [&[f64]; 2],
        dt: f64,
    ) -> Result<Vec<f64>, FieldViolation> {
        let mean = |(begin, end): (&f64, &f64)| 0.5 * begin + 0.5 * end;
        let middle: Vec<f64> = begin.iter().zip(end).map(mean).collect();
        let half = self.advance(from, [begin, &middle], 0.5 * dt)?;
        self.advance(&half, [&middle, end], 0.5 * dt)
    }

    /// The memory with a source held for a time, and the one without a source.
    pub(super) fn held(&self, source: &[f64], time: f64) -> Result<[Vec<f64>; 2], FieldViolation> {
        let with = self.advance(&self.memory, [source; 2], time)?;
        let without = self.advance(&self.memory, [&self.none; 2], time)?;
        Ok([with, without])
    }

    /// The pore pressure at each vertex.
    pub(super) fn pressure(&self, memory: &[f64]) -> Result<Vec<f64>, FieldViolation> {
        let mut pressure = vec![0.0; self.vertices];
        self.field.pressure(memory, &mut pressure);
        finite("pressure at vertex", None, &pressure)?;
        Ok(pressure)
    }

    /// The pressure that sources have fed, from memories with and without them.
    pub(super) fn fed(&self, [with, without]: [&[f64]; 2]) -> Result<Vec<f64>, FieldViolation> {
        let mut with = self.pressure(with)?;
        for (with, without) in with.iter_mut().zip(self.pressure(without)?) {
            *with -= without;
        }
        Ok(with)
    }

    /// The largest range of the pressures that a held source leads to, up to [`HELD`].
    ///
    /// With `S(t)` the pressure that a source leads to in `t`, the pressure is `S(t + T) - S(t)` at a time `t` after it has
    /// been held for `T`: it may grow where memories cancel in it, or feed each other, but not beyond the range of `S`.
    pub(super) fn range(&self, source: &[f64]) -> Result<f64, FieldViolation> {
        let mut ranges = vec![[0.0_f64; 2]; self.vertices];
        for halving in 0..60 {
            let [with, without] = self.held(source, HELD * 0.5_f64.powi(halving))?;
            for (range, fed) in ranges.iter_mut().zip(self.fed([&with, &without])?) {
                *range = [range[0].min(fed), range[1].max(fed)];
            }
        }
        let length = |longest: f64, [least, largest]: [f64; 2]| longest.max(largest - least);
        Ok(ranges.into_iter().fold(0.0, length))
    }

    /// Whether the advance has no error of its own.
    pub(super) fn is_exact(&self) -> Result<bool, FieldViolation> {
        let mut exact = true;
        for pair in self.sources.windows(2) {
            for dt in steps() {
                let source = [pair[0].as_slice(), &pair[1]];
                let to = self.advance(&self.memory, source, dt)?;
                let mut error = vec![0.0; self.vertices];
                (self.field).error(&self.memory, source, dt, &to, &mut error);
                finite("error at vertex", Some(dt), &error)?;
                exact &= error.iter().all(|error| *error == 0.0);
            }
        }
        Ok(exact)
    }
}

/// A factor of each vertex, from 1/2 to 3/2.
fn spread(vertex: usize) -> f64 {
    1.0 + 0.5 * (1.7 * vertex as f64).sin()
}

/// Refuses the first value that is not finite.
pub(super) fn finite(
    what: &'static str,
    dt: Option<f64>,
    values: &[f64],
) -> Result<(), FieldViolation> {
    match values.iter().position(|value| !value.is_finite()) {
        None => Ok(()),
        Some(place) => Err(FieldViolation::Value {
            what,
            place,
            dt,
            value: values[place],
            requirement: "a finite number",
        }),
    }
}

/// The largest magnitude.
pub(super) fn largest(values: &[f64]) -> f64 {
    values
        .iter()
        .fold(0.0, |largest, value| value.abs().max(largest))
}

/// The place and the magnitude of the largest difference.
pub(super) fn difference(a: &[f64], b: &[f64]) -> (usize, f64) {
    let differences = a.iter().zip(b).map(|(a, b)| (a - b).abs());
    let worst = |worst: (usize, f64), (place, by): (usize, f64)| {
        if by > worst.1 { (place, by) } else { worst }
    };
    differences.enumerate().fold((0, 0.0), worst)
}
