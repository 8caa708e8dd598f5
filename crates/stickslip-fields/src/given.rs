//! A pore pressure in closed form.

use crate::{FaultField, FaultRates, FieldError, FieldSizes};

/// A pore pressure that is a function of time: `p(t)` at each vertex.
///
/// Its memory is the time.
///
/// ```
/// use stickslip_fields::{FaultField, GivenPressure};
///
/// // Injection raises the pressure by 1 kPa/s.
/// let given = GivenPressure::new(1, 0.0, |time, pressure| pressure[0] += 1e3 * time);
/// let (mut memory, mut pressure) = (vec![0.0], vec![0.0]);
/// given.advance(&[0.0], [&[], &[]], 60.0, &mut memory)?;
/// given.pressure(&memory, &mut pressure);
/// assert_eq!(pressure, [6e4]);
/// # Ok::<(), stickslip_fields::FieldError>(())
/// ```
#[doc(alias("injection", "pore pressure"))]
pub struct GivenPressure<F> {
    vertices: usize,
    begin: f64,
    pressure: F,
}

impl<F: Fn(f64, &mut [f64]) + Send + Sync> GivenPressure<F> {
    /// A pressure at so many vertices, in a scene that starts at time `begin` \[s\]; `pressure(t, p)` adds to `p`
    /// \[Pa\].
    pub fn new(vertices: usize, begin: f64, pressure: F) -> Self {
        Self {
            vertices,
            begin,
            pressure,
        }
    }
}

impl<F: Fn(f64, &mut [f64]) + Send + Sync> FaultField for GivenPressure<F> {
    fn sizes(&self) -> FieldSizes {
        FieldSizes {
            vertices: self.vertices,
            memory: vec![self.begin],
            sources: 0,
        }
    }

    fn source(&self, _at: &FaultRates<'_>, _memory: &[f64], _source: &mut [f64]) {}

    fn advance(
        &self,
        from: &[f64],
        _source: [&[f64]; 2],
        dt: f64,
        to: &mut [f64],
    ) -> Result<(), FieldError> {
        to[0] = from[0] + dt;
        Ok(())
    }

    fn pressure(&self, memory: &[f64], pressure: &mut [f64]) {
        (self.pressure)(memory[0], pressure);
    }
}
