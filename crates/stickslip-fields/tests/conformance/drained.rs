//! A field that drains, `p' = s - p/t_d`, with a flaw on request.

use stickslip_fields::{FaultField, FaultRates, FieldError, FieldSizes, Reading};

/// The fault of a field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Flaw {
    None,
    NoVertices,
    InitialMemory,
    SourceAtRest,
    SourceUnwritten,
    MemoryUnwritten,
    LongSteps,
    NoStep,
    FirstSourceOnly,
    Assigned,
    Squared,
    OtherPressure,
    ScratchUnwritten,
    Growth,
    Ringing,
    BackwardEuler,
    Trapezoid,
    ErrorNan,
    Reading,
    Total,
}

/// Two vertices; the memory is the pressure.
pub(crate) struct Drained(pub(crate) Flaw);

/// The drainage time \[s\].
const TIME: f64 = 1e4;

impl Drained {
    /// The number of values that are written of two.
    fn written(&self, flaw: Flaw) -> usize {
        if self.0 == flaw { 1 } else { 2 }
    }
}

/// `(1 - exp(-z))/z` and `(1 - that)/z`.
fn phi(z: f64) -> [f64; 2] {
    if z > 0.1 {
        let first = -(-z).exp_m1() / z;
        return [first, (1.0 - first) / z];
    }
    let series = |first: u32| -> f64 {
        let mut term = 1.0 / f64::from((1..=first).product::<u32>());
        let mut sum = 0.0;
        for n in first + 1..first + 12 {
            sum += term;
            term *= -z / f64::from(n);
        }
        sum
    };
    [series(1), series(2)]
}

impl FaultField for Drained {
    fn sizes(&self) -> FieldSizes {
        let vertices = if self.0 == Flaw::NoVertices { 0 } else { 2 };
        let initial = if self.0 == Flaw::InitialMemory {
            f64::NAN
        } else {
            0.0
        };
        FieldSizes {
            vertices,
            memory: vec![initial; vertices],
            sources: vertices,
        }
    }

    fn source(&self, at: &FaultRates<'_>, memory: &[f64], source: &mut [f64]) {
        for k in 0..self.written(Flaw::SourceUnwritten) {
            source[k] = at.slip_rate[k] * at.friction[k] / 27.0;
            if self.0 == Flaw::SourceAtRest {
                source[k] *= at.slip_rate[k].ln();
            }
            if self.0 == Flaw::ScratchUnwritten {
                source[k] += 0.0 * memory[k];
            }
        }
    }

    fn advance(
        &self,
        from: &[f64],
        [begin, end]: [&[f64]; 2],
        dt: f64,
        to: &mut [f64],
    ) -> Result<(), FieldError> {
        if self.0 == Flaw::LongSteps && dt > 1e10 {
            return Err(FieldError {
                what: "time step",
                place: 0,
                value: dt,
            });
        }
        let z = dt / TIME;
        let [first, second] = phi(z);
        for k in 0..self.written(Flaw::MemoryUnwritten) {
            let sum = begin[k] + end[k];
            let exact =
                |change: f64| (-z).exp() * from[k] + dt * (first * begin[k] + second * change);
            to[k] = match self.0 {
                Flaw::Growth => from[k] * (1.0 + 1e-9 * z) + dt * begin[k],
                Flaw::Ringing | Flaw::Trapezoid => {
                    ((1.0 - 0.5 * z) * from[k] + 0.5 * dt * sum) / (1.0 + 0.5 * z)
                }
                Flaw::BackwardEuler => (from[k] + dt * end[k]) / (1.0 + z),
                Flaw::NoStep => exact(end[k] - begin[k]) + 1.0,
                Flaw::FirstSourceOnly => exact(0.0),
                _ => exact(end[k] - begin[k]),
            };
        }
        Ok(())
    }

    fn pressure(&self, memory: &[f64], pressure: &mut [f64]) {
        for k in 0..pressure.len() {
            match self.0 {
                Flaw::Assigned => pressure[k] = memory[k],
                Flaw::Squared => pressure[k] += memory[k] * memory[k],
                _ => pressure[k] += memory[k],
            }
        }
    }

    fn pressure_after(
        &self,
        from: &[f64],
        source: [&[f64]; 2],
        dt: f64,
        pressure: &mut [f64],
        scratch: &mut [f64],
    ) -> Result<(), FieldError> {
        let factor = if self.0 == Flaw::OtherPressure {
            1.001
        } else {
            1.0
        };
        let mut own = scratch.to_vec();
        let scratch = match self.0 {
            Flaw::ScratchUnwritten => &mut own[..],
            _ => scratch,
        };
        self.advance(from, source, dt, scratch)?;
        for (pressure, scratch) in pressure.iter_mut().zip(scratch) {
            *scratch *= factor;
            self.pressure(
                std::slice::from_ref(scratch),
                std::slice::from_mut(pressure),
            );
        }
        Ok(())
    }

    fn error(
        &self,
        _from: &[f64],
        _source: [&[f64]; 2],
        _dt: f64,
        _to: &[f64],
        pressure_error: &mut [f64],
    ) {
        match self.0 {
            Flaw::Ringing | Flaw::BackwardEuler => pressure_error[0] += 1.0,
            Flaw::ErrorNan => pressure_error[1] = f64::NAN,
            _ => {}
        }
    }

    fn readings(&self) -> &[Reading] {
        &[Reading {
            name: "drainage",
            unit: "Pa/s",
        }]
    }

    fn read(&self, _number: usize, memory: &[f64], values: &mut [f64]) {
        for k in 0..self.written(Flaw::Reading) {
            values[k] = memory[k] / TIME;
        }
    }

    fn totals(&self) -> &[Reading] {
        &[Reading {
            name: "volume",
            unit: "m3",
        }]
    }

    fn total(&self, _number: usize, memory: &[f64]) -> f64 {
        match self.0 {
            Flaw::Total => f64::NAN,
            _ => memory.iter().sum(),
        }
    }
}
