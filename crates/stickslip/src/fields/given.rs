//! A pore pressure in closed form.

use super::{FaultField, FaultRates, FieldError, FieldSizes};

/// A pore pressure that is a function of time: `p(t)` at each vertex.
///
/// Its memory is the time.
///
/// ```
/// use stickslip::fields::GivenPressure;
/// use stickslip::friction::Tresca;
/// use stickslip::{BoundaryPart, Contact};
///
/// // Injection raises the pressure by 1 kPa/s.
/// let pressure = GivenPressure::new(1, 0.0, |time, pressure| pressure[0] += 1e3 * time);
/// let contact = Contact::new(BoundaryPart::point(1.0), Tresca { coefficient: 0.6 }, 50e6).with_field(pressure);
/// # let _: Contact<_, _, 1> = contact;
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
