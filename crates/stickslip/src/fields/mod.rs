//! Fields that live on a fault and advance with it: pore pressure, temperature, porosity.
//!
//! | item | meaning |
//! | --- | --- |
//! | [`FaultField`] | memory with a linear relaxation, fed by slip, that takes pressure from the normal stress |
//! | [`FieldSizes`], [`FaultRates`] | its numbers, and what the fault shows it |
//! | [`GivenPressure`] | a pore pressure in closed form |
//!
//! A [`Contact`](crate::Contact) has any number of them ([`with_field`](crate::Contact::with_field)); their pressures add.

mod given;

use thiserror::Error;

pub use given::GivenPressure;

/// The numbers of a field on a contact.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldSizes {
    /// The vertices of the contact.
    pub vertices: usize,
    /// The initial memory, any number of values.
    pub memory: Vec<f64>,
    /// The number of sources.
    pub sources: usize,
}

/// The quantities that a fault shows its fields: one number per vertex of the contact.
#[derive(Debug, Clone, Copy)]
pub struct FaultRates<'a> {
    /// The time \[s\].
    pub time: f64,
    /// The slip rate `V` [m/s].
    pub slip_rate: &'a [f64],
    /// The frictional strength, `c + mu (sigma_n - p)` \[Pa\]: with the slip rate, the power that becomes heat.
    pub friction: &'a [f64],
    /// The rate of the state, `alpha'`, in the state law's own variable [1/s]; 0 without a state.
    pub state_rate: &'a [f64],
    /// The effective normal stress `sigma_n - p` \[Pa\].
    pub normal_stress: &'a [f64],
}

/// A field that cannot advance.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error("{what} {value:e} at place {place}")]
pub struct FieldError {
    /// The quantity.
    pub what: &'static str,
    /// Its place in the memory.
    pub place: usize,
    /// Its value.
    pub value: f64,
}

/// A field on a fault: a memory `y` that relaxes linearly, and a pore pressure `p` that it takes from the normal stress.
///
/// ```text
/// y' = -A y + s(V, friction, alpha', ..),     sigma = sigma_n - p(y)
/// ```
///
/// Implement the sizes, the source, the advance and the pressure. The advance is exact, or L-stable and of second order,
/// from any `dt >= 0`, with a source that is linear in time: two halves make a whole. [`RungeKutta`](crate::RungeKutta)
/// advances a field at every stage from the start of the step, with the source of the stage from its tableau; a
/// [`Simulation`](crate::Simulation) finds the pressure of the end of a step with the slip rates there, by the iteration of
/// [normal stresses from the deformation](crate::NormalStress::from_body), whose contraction is
/// [reported](crate::integrate::StepReport::contraction), and refused from 1 on. Both are of second order at least.
///
/// A pressure that slip raises, and that drains:
///
/// ```
/// use stickslip::fields::{FaultField, FaultRates, FieldError, FieldSizes};
/// use stickslip::friction::Tresca;
/// use stickslip::nalgebra::{Matrix1, Vector1};
/// use stickslip::{BoundaryPart, Contact, RungeKutta, Scene, Steps};
///
/// /// `p' = C V - p/t_d` [Pa/s].
/// struct Drained {
///     rise: f64,
///     time: f64,
/// }
///
/// impl FaultField for Drained {
///     fn sizes(&self) -> FieldSizes {
///         FieldSizes { vertices: 1, memory: vec![0.0], sources: 1 }
///     }
///
///     fn source(&self, at: &FaultRates<'_>, _memory: &[f64], source: &mut [f64]) {
///         source[0] = self.rise * at.slip_rate[0];
///     }
///
///     fn advance(
///         &self,
///         from: &[f64],
///         [begin, end]: [&[f64]; 2],
///         dt: f64,
///         to: &mut [f64],
///     ) -> Result<(), FieldError> {
///         let z = dt / self.time;
///         // (1 - exp(-z))/z, and (1 - that)/z.
///         let first = if z > 0.0 { -(-z).exp_m1() / z } else { 1.0 };
///         let second = if z > 1e-3 { (1.0 - first) / z } else { 0.5 - z / 6.0 + z * z / 24.0 };
///         to[0] = from[0] * (-z).exp() + dt * (first * begin[0] + second * (end[0] - begin[0]));
///         Ok(())
///     }
///
///     fn pressure(&self, memory: &[f64], pressure: &mut [f64]) {
///         pressure[0] += memory[0];
///     }
/// }
///
/// // A dashpot under a constant load: V = (f - mu (sigma_n - p))/eta, and p = C t_d V in the end.
/// let (load, eta) = (0.61e6, 1e9);
/// let drained = Drained { rise: 1e10, time: 5.0 };
/// let contact = Contact::new(BoundaryPart::point(1.0), Tresca { coefficient: 0.01 }, 60e6)
///     .with_field(drained);
/// let scene = Scene::new(Matrix1::new(0.0))
///     .with_viscosity(Matrix1::new(eta))
///     .with_load(vec![Vector1::new(load)])
///     .with_contact(contact);
/// let mut block = RungeKutta::new(scene)?;
/// block.run(&Steps::adaptive(1e-8).until(200.0), |_| ())?;
/// let steady = (load - 0.01 * 60e6) / (eta - 0.01 * 1e10 * 5.0);
/// assert!((block.snapshot().velocity[0][0] / steady - 1.0).abs() < 1e-5);
/// assert!((block.snapshot().contact(0).pore_pressure(0) / (1e10 * 5.0 * steady) - 1.0).abs() < 1e-5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait FaultField: Send + Sync {
    /// The numbers of vertices, memory and sources.
    fn sizes(&self) -> FieldSizes;

    /// Writes the sources `s` at a time.
    fn source(&self, at: &FaultRates<'_>, memory: &[f64], source: &mut [f64]);

    /// Advances the memory by `dt` \[s\], with sources that change linearly from the first to the second.
    ///
    /// # Errors
    /// [`FieldError`] for a memory that it cannot advance: the step fails.
    fn advance(
        &self,
        from: &[f64],
        source: [&[f64]; 2],
        dt: f64,
        to: &mut [f64],
    ) -> Result<(), FieldError>;

    /// Adds its pore pressure at each vertex \[Pa\], linear in the memory.
    fn pressure(&self, memory: &[f64], pressure: &mut [f64]);
}
