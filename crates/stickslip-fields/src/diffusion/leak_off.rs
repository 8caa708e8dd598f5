//! Leak-off into the rock beside the fault.

use super::error::{finite, positive};
use super::{Diffusion, DiffusionError};
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

impl Diffusion {
    /// Adds leak-off.
    ///
    /// # Errors
    /// [`DiffusionError`] for drainage times that are not above 0 and pressures that are not finite, with their cell.
    pub fn with_leak_off(mut self, leak_off: &LeakOff) -> Result<Self, DiffusionError> {
        let vertices = self.cells.vertices();
        let count = vertices.len();
        let time = leak_off
            .drainage_time
            .values("drainage time [s]", count, positive)?;
        let far = leak_off
            .far_pressure
            .values("far pressure [Pa]", count, finite)?;
        let of_cells = vertices.iter().zip(&self.capacity);
        self.leak = Some(Leak {
            conductance: of_cells
                .map(|(&vertex, capacity)| capacity / time[vertex])
                .collect(),
            far: vertices.iter().map(|&vertex| far[vertex]).collect(),
        });
        self.changed();
        Ok(self)
    }
}
