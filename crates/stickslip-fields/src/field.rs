//! The trait of fields on a fault.

use crate::FieldError;

/// The numbers of a field on a contact.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldSizes {
    /// The vertices of the contact.
    pub vertices: usize,
    /// The initial memory, any number of values.
    pub memory: Vec<f64>,
    /// The number of sources; 0 for a field that slip does not feed.
    pub sources: usize,
}

/// The quantities that a fault shows its fields: one number per vertex of the contact.
#[derive(Debug, Clone, Copy)]
pub struct FaultRates<'a> {
    /// The time \[s\].
    pub time: f64,
    /// The slip rate `V` [m/s].
    pub slip_rate: &'a [f64],
    /// The frictional stress, `c + mu (sigma_n - p)` where it slides, at most that at rest \[Pa\]: with the slip rate, the
    /// power that becomes heat.
    pub friction: &'a [f64],
    /// The rate of the state, `alpha'`, in the state law's own variable [1/s]; 0 without a state.
    pub state_rate: &'a [f64],
    /// The effective normal stress `sigma_n - p` \[Pa\].
    pub normal_stress: &'a [f64],
}

/// A quantity that a field shows beside its pressure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Reading {
    /// Its name as that of a column, such as `temperature` or `darcy_velocity`.
    pub name: &'static str,
    /// Its unit, such as `K`.
    pub unit: &'static str,
}

/// A field on a fault: a memory `y` that relaxes linearly, and a pore pressure `p` that it takes from the normal stress.
///
/// ```text
/// y' = -A y + s(V, friction, alpha', ..),     sigma = sigma_n - p(y)
/// ```
///
/// # What to implement
/// The sizes, the source, the advance and the pressure. The advance is exact, or L-stable and of second order, from any
/// `dt >= 0`, with a source that is linear in time: two halves make a whole. Whatever is known in advance, such as the
/// rate of a well, is no source: the field adds it as it advances, and keeps the time in its memory.
///
/// # What may be overridden
/// [`pressure_after`](FaultField::pressure_after) where the pressure costs less than the memory,
/// [`error`](FaultField::error) where the advance is not exact, [`stops`](FaultField::stops) where what is known jumps,
/// and the readings and totals that users see.
///
/// # How it is called
/// An explicit method advances a field at every stage from the start of the step, with a source that ends as the stages
/// before say; an implicit step finds the pressure of its end with the slip rates there, by an iteration whose contraction
/// is reported. Both are of second order at least.
///
/// # Example
/// Dilatancy with drainage (Segall and Rice, J. Geophys. Res. 100, 1995): the porosity `phi` of a fault zone grows with
/// the slip rate, which takes pressure from its fluid, and the fluid of the surroundings flows in.
///
/// ```text
/// phi' = -(V/L) (phi - phi_0 - eps ln(V/V_0)),     p' = -phi'/beta - p/t_d
/// ```
///
/// ```
/// use stickslip_fields::{FaultField, FaultRates, FieldError, FieldSizes, Reading, check_fault_field};
///
/// struct Dilatancy {
///     /// The dilatancy coefficient `eps`.
///     coefficient: f64,
///     /// The slip rate `V_0` of the porosity `phi_0` [m/s].
///     reference_velocity: f64,
///     /// The slip `L` over which porosity evolves [m].
///     slip_distance: f64,
///     /// Porosity times the compressibility of fluid and pores `beta` [1/Pa].
///     storage: f64,
///     /// The drainage time `t_d` [s].
///     drainage_time: f64,
///     /// The vertices of the contact.
///     vertices: usize,
/// }
///
/// // The memory: changes of porosity, then of pressure.
/// impl FaultField for Dilatancy {
///     fn sizes(&self) -> FieldSizes {
///         let n = self.vertices;
///         FieldSizes { vertices: n, memory: vec![0.0; 2 * n], sources: n }
///     }
///
///     fn source(&self, at: &FaultRates<'_>, memory: &[f64], source: &mut [f64]) {
///         for k in 0..self.vertices {
///             let v = at.slip_rate[k];
///             // V ln V vanishes with V.
///             let steady = if v > 0.0 { self.coefficient * (v / self.reference_velocity).ln() } else { memory[k] };
///             source[k] = -v / self.slip_distance * (memory[k] - steady);
///         }
///     }
///
///     fn advance(
///         &self,
///         from: &[f64],
///         [begin, end]: [&[f64]; 2],
///         dt: f64,
///         to: &mut [f64],
///     ) -> Result<(), FieldError> {
///         let (n, z) = (self.vertices, dt / self.drainage_time);
///         // (1 - exp(-z))/z, and (1 - that)/z.
///         let first = if z > 0.0 { -(-z).exp_m1() / z } else { 1.0 };
///         let second = if z > 1e-3 { (1.0 - first) / z } else { 0.5 - z / 6.0 + z * z / 24.0 - z.powi(3) / 120.0 };
///         for k in 0..n {
///             to[k] = from[k] + 0.5 * dt * (begin[k] + end[k]);
///             let source = first * begin[k] + second * (end[k] - begin[k]);
///             to[n + k] = (-z).exp() * from[n + k] - dt * source / self.storage;
///         }
///         Ok(())
///     }
///
///     fn pressure(&self, memory: &[f64], pressure: &mut [f64]) {
///         for (pressure, own) in pressure.iter_mut().zip(&memory[self.vertices..]) {
///             *pressure += own;
///         }
///     }
///
///     fn readings(&self) -> &[Reading] {
///         &[Reading { name: "porosity_change", unit: "1" }]
///     }
///
///     fn read(&self, _number: usize, memory: &[f64], values: &mut [f64]) {
///         values.copy_from_slice(&memory[..self.vertices]);
///     }
/// }
///
/// let dilatancy = Dilatancy {
///     coefficient: 1e-4,
///     reference_velocity: 1e-9,
///     slip_distance: 8e-3,
///     storage: 5e-10,
///     drainage_time: 1e4,
///     vertices: 3,
/// };
/// check_fault_field(&dilatancy)?;
/// # Ok::<(), stickslip_fields::FieldViolation>(())
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

    /// Adds the pore pressure at each vertex after `dt` \[Pa\]; `scratch` is as long as the memory, and may be left as it
    /// is but for what [`source`](FaultField::source) reads of it.
    ///
    /// By default it advances the memory in `scratch`.
    ///
    /// # Errors
    /// Those of [`advance`](FaultField::advance).
    fn pressure_after(
        &self,
        from: &[f64],
        source: [&[f64]; 2],
        dt: f64,
        pressure: &mut [f64],
        scratch: &mut [f64],
    ) -> Result<(), FieldError> {
        self.advance(from, source, dt, scratch)?;
        self.pressure(scratch, pressure);
        Ok(())
    }

    /// Advances a field without sources by `dt`, and adds its pore pressure after each share of it, the last of which is 1.
    ///
    /// By default it advances to each share.
    ///
    /// # Errors
    /// Those of [`advance`](FaultField::advance).
    fn pressures_within(
        &self,
        from: &[f64],
        dt: f64,
        shares: &[f64],
        pressures: &mut [Vec<f64>],
        to: &mut [f64],
    ) -> Result<(), FieldError> {
        for (share, pressure) in shares.iter().zip(pressures) {
            self.pressure_after(from, [&[], &[]], share * dt, pressure, to)?;
        }
        self.advance(from, [&[], &[]], dt, to)
    }

    /// Adds the estimated error of the advance by `dt`, as a pore pressure at each vertex \[Pa\], with its sign; none by
    /// default, as for an exact advance. `to` is the memory that the advance led to.
    fn error(
        &self,
        from: &[f64],
        source: [&[f64]; 2],
        dt: f64,
        to: &[f64],
        pressure_error: &mut [f64],
    ) {
        let _ = (from, source, dt, to, pressure_error);
    }

    /// The times at which what is known jumps or bends \[s\]: no step crosses them.
    fn stops(&self) -> Vec<f64> {
        Vec::new()
    }

    /// The quantities at each vertex that it shows beside its pressure.
    fn readings(&self) -> &[Reading] {
        &[]
    }

    /// Writes the reading of this number at each vertex.
    fn read(&self, number: usize, memory: &[f64], values: &mut [f64]) {
        let _ = (number, memory, values);
    }

    /// The quantities of the whole field that it shows, such as an injected volume.
    fn totals(&self) -> &[Reading] {
        &[]
    }

    /// The total of this number.
    fn total(&self, number: usize, memory: &[f64]) -> f64 {
        let _ = (number, memory);
        0.0
    }
}
