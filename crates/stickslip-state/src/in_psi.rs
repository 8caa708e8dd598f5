//! Laws of `ln theta` in units of friction.

use crate::{LogTheta, Psi, StateError, StateLaw};

/// A law of `alpha = ln theta`, such as the aging law, the slip law or a composite law, with the state in units of friction:
///
/// ```text
/// psi = mu0 + b ln(V0 theta/L),    psi' = b alpha'
/// aging law    psi' = (b V0/L) ( exp((mu0 - psi)/b) - V/V0 )
/// slip law     psi' = -(V/L) ( psi - mu0 - b ln(V0/V) )
/// ```
///
/// It is the same law with the same closed forms. `aging_in_psi` and `slip_in_psi` of regularised friction return it with
/// the parameters of that friction, `in_psi` the friction that reads it.
///
/// ```
/// use stickslip_state::{Dieterich, InPsi, Psi, StateLaw};
///
/// let law = InPsi {
///     law: Dieterich { slip_distance: 0.4 },
///     b: 0.014,
///     reference_friction: 0.6,
///     reference_velocity: 1e-6,
///     slip_distance: 0.4,
/// };
/// // Steady sliding at a tenth of V0: theta = 10 L/V0.
/// let Psi(psi) = law.advance_at_constant_rate(Psi(0.6), 1e-7, 1e9)?;
/// assert!((psi - 0.6 - 0.014 * 10f64.ln()).abs() < 1e-12);
/// # Ok::<(), stickslip_state::StateError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(alias("psi", "SeisSol", "tandem"))]
pub struct InPsi<T> {
    /// The law of `ln theta`.
    pub law: T,
    /// `b`, the coefficient of the evolution effect, finite and positive.
    pub b: f64,
    /// `mu0`, finite and non-negative.
    pub reference_friction: f64,
    /// `V0` \[m/s\], finite and positive.
    pub reference_velocity: f64,
    /// `L` \[m\] of friction, finite and positive.
    #[doc(alias("D_c", "d_c", "critical slip distance"))]
    pub slip_distance: f64,
}

impl<T> InPsi<T> {
    /// `psi = mu0 + b ln(V0 theta/L)`.
    #[must_use]
    pub fn psi(&self, LogTheta(alpha): LogTheta) -> Psi {
        Psi(self.reference_friction + self.b * (alpha - self.at_reference()))
    }

    /// `ln theta = (psi - mu0)/b - ln(V0/L)`.
    #[must_use]
    pub fn log_theta(&self, Psi(psi): Psi) -> LogTheta {
        LogTheta((psi - self.reference_friction) / self.b + self.at_reference())
    }

    /// `ln(L/V0)`, which is `ln theta` at `psi = mu0`.
    fn at_reference(&self) -> f64 {
        self.slip_distance.ln() - self.reference_velocity.ln()
    }

    /// The state that a change from one `ln theta` to another leads to.
    fn changed(&self, from: Psi, start: LogTheta, end: LogTheta) -> Psi {
        Psi(from.0 + self.b * (end.0 - start.0))
    }
}

impl<T: StateLaw<State = LogTheta>> StateLaw for InPsi<T> {
    type State = Psi;

    fn evolution(&self, state: Psi, slip_rate: f64) -> f64 {
        self.b * self.law.evolution(self.log_theta(state), slip_rate)
    }

    fn evolution_state_slope(&self, state: Psi, slip_rate: f64) -> f64 {
        (self.law).evolution_state_slope(self.log_theta(state), slip_rate)
    }

    fn advance(&self, from: Psi, slip_rate: f64, dt: f64) -> Result<Psi, StateError> {
        let start = self.log_theta(from);
        let end = self.law.advance(start, slip_rate, dt)?;
        Ok(self.changed(from, start, end))
    }

    fn advance_exact(&self, from: Psi, slip_rate: f64, dt: f64) -> Option<Psi> {
        let start = self.log_theta(from);
        let end = self.law.advance_exact(start, slip_rate, dt)?;
        Some(self.changed(from, start, end))
    }

    fn advance_rate_slope(&self, from: Psi, to: Psi, slip_rate: f64, dt: f64) -> f64 {
        let [start, end] = [from, to].map(|state| self.log_theta(state));
        self.b * self.law.advance_rate_slope(start, end, slip_rate, dt)
    }

    fn advance_at_constant_rate(
        &self,
        from: Psi,
        slip_rate: f64,
        dt: f64,
    ) -> Result<Psi, StateError> {
        let start = self.log_theta(from);
        let end = self.law.advance_at_constant_rate(start, slip_rate, dt)?;
        Ok(self.changed(from, start, end))
    }

    fn advance_at_constant_rate_rate_slope(
        &self,
        from: Psi,
        to: Psi,
        slip_rate: f64,
        dt: f64,
    ) -> f64 {
        let [start, end] = [from, to].map(|state| self.log_theta(state));
        let slope = (self.law).advance_at_constant_rate_rate_slope(start, end, slip_rate, dt);
        self.b * slope
    }

    fn validate_state(&self, state: Psi) -> Result<(), StateError> {
        StateError::check_state(state.0)?;
        self.law.validate_state(self.log_theta(state))
    }

    fn validate(&self) -> Result<(), StateError> {
        StateError::check_positive("b", self.b)?;
        let mu0 = self.reference_friction;
        let legal = mu0.is_finite() && mu0 >= 0.0;
        StateError::check("reference_friction", "finite and non-negative", mu0, legal)?;
        StateError::check_positive("reference_velocity", self.reference_velocity)?;
        StateError::check_positive("slip_distance", self.slip_distance)?;
        self.law.validate()
    }
}
