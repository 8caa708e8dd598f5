//! Dilatancy: pores that open with the slip rate.

use super::error::{not_negative, positive};
use super::{Diffusion, DiffusionError};

/// Dilatancy (Segall and Rice, J. Geophys. Res. 100, 1995): the porosity `phi` of the fault zone evolves with slip to a
/// value that grows with the slip rate, which takes pressure from its fluid.
///
/// ```text
/// phi' = -(V/L) (phi - phi_0 - eps ln(V/V_0)),    beta phi p' = .. - phi'
/// ```
///
/// The storage `beta phi` is that of [`Hydraulics`](super::Hydraulics): the porosity times the compressibility of fluid
/// and pores.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dilatancy {
    /// The dilatancy coefficient `eps`, at least 0.
    pub coefficient: f64,
    /// The slip rate `V_0` of the initial porosity [m/s], above 0.
    pub reference_velocity: f64,
    /// The slip `L` over which porosity evolves \[m\], above 0.
    pub slip_distance: f64,
    /// The change of porosity at the start; `eps ln(V/V_0)` is steady at `V`.
    pub initial_change: f64,
}

impl Dilatancy {
    /// `phi'` at a change of porosity and a slip rate [1/s].
    pub(super) fn rate(&self, change: f64, slip_rate: f64) -> f64 {
        let v = slip_rate.abs();
        // V ln(V) vanishes with V.
        if v < f64::MIN_POSITIVE {
            return 0.0;
        }
        let steady = self.coefficient * (v / self.reference_velocity).ln();
        -v / self.slip_distance * (change - steady)
    }
}

impl Diffusion {
    /// Adds dilatancy.
    ///
    /// # Errors
    /// [`DiffusionError`] for parameters out of their ranges.
    pub fn with_dilatancy(mut self, dilatancy: Dilatancy) -> Result<Self, DiffusionError> {
        not_negative("dilatancy coefficient", None, dilatancy.coefficient)?;
        positive(
            "reference velocity of dilatancy [m/s]",
            None,
            dilatancy.reference_velocity,
        )?;
        positive(
            "slip distance of dilatancy [m]",
            None,
            dilatancy.slip_distance,
        )?;
        super::error::finite("initial change of porosity", None, dilatancy.initial_change)?;
        self.dilatancy = Some(dilatancy);
        self.changed();
        Ok(self)
    }
}
