//! Slip, stresses and pore pressure of a profile.

use crate::ContactView;

/// A pascal in megapascals.
const MPA: f64 = 1e-6;

/// The quantity of a profile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Quantity {
    Slip,
    ShearStress,
    NormalStress,
    PorePressure,
}

impl Quantity {
    /// Whether it has components on a plane.
    pub(super) fn is_vector(self) -> bool {
        matches!(self, Self::Slip | Self::ShearStress)
    }

    /// The name of a column, and its quantity with its unit.
    pub(super) fn column(self) -> (&'static str, &'static str) {
        match self {
            Self::Slip => ("slip", "Slip (m)"),
            Self::ShearStress => ("shear_stress", "Shear stress (MPa)"),
            Self::NormalStress => ("normal_stress", "Normal stress (MPa)"),
            Self::PorePressure => ("pore_pressure", "Pore pressure (MPa)"),
        }
    }

    /// The value at a vertex of a contact along a component; on a line their sum, since at most one is tangential.
    pub(super) fn at<const C: usize>(
        self,
        contact: &ContactView<'_, C>,
        k: usize,
        component: Option<usize>,
    ) -> f64 {
        let vector = match self {
            Self::Slip => contact.slip_vector(k),
            Self::ShearStress => MPA * contact.traction(k),
            Self::NormalStress => return MPA * contact.normal_stress(k),
            Self::PorePressure => return MPA * contact.pore_pressure(k),
        };
        match component {
            None => vector.sum(),
            Some(0) => vector[0],
            Some(_) => -vector[1],
        }
    }
}
