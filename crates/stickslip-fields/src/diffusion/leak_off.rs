//! Leak-off into the rock beside the fault.

use crate::PerVertex;

/// Leak-off through a membrane: `p' = .. - (p - p_inf)/t_d`.
#[derive(Debug, Clone, PartialEq)]
#[doc(alias("drainage", "membrane diffusion"))]
pub struct LeakOff {
    /// The drainage time `t_d` \[s\], above 0.
    pub drainage_time: PerVertex,
    /// The pore pressure of the rock beside the fault `p_inf` \[Pa\].
    pub far_pressure: PerVertex,
}

/// The leak-off of each cell.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Leak {
    /// The volume rate per pressure.
    pub conductance: Vec<f64>,
    pub far: Vec<f64>,
}

impl Leak {
    /// The volume rate that leaves all cells.
    pub(super) fn rate(&self, pressure: impl Iterator<Item = f64>) -> f64 {
        let cells = self.conductance.iter().zip(&self.far).zip(pressure);
        cells
            .map(|((conductance, far), pressure)| conductance * (pressure - far))
            .sum()
    }
}
