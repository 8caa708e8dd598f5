//! Permeability that slip raises and time heals.

use crate::PerVertex;

/// Permeability that rises with slip and heals with time (Zhu et al., Nat. Commun. 11, 4833, 2020):
///
/// ```text
/// k' = -(V/L_k) (k - k_max) - (k - k_min)/T_k
/// ```
///
/// It is exact at constant slip rates; diffusion takes it at the middle of a step.
#[derive(Debug, Clone, PartialEq)]
#[doc(alias("permeability enhancement", "healing", "fault valving"))]
pub struct PermeabilityEvolution {
    /// The permeability `k_min` that healing tends to [m^2], at least 0.
    pub minimum: PerVertex,
    /// The permeability `k_max` that slip tends to [m^2], at least `k_min`.
    pub maximum: PerVertex,
    /// The slip `L_k` over which permeability rises \[m\], above 0.
    pub slip_distance: PerVertex,
    /// The time `T_k` over which permeability heals \[s\], above 0; infinite for none.
    pub healing_time: PerVertex,
}

/// The evolution in each cell: of `x = (k - k_min)/(k_max - k_min)`, `x' = -(V/L_k) (x - 1) - x/T_k`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Evolution {
    pub minimum: Vec<f64>,
    pub range: Vec<f64>,
    /// `1/L_k`.
    pub rise: Vec<f64>,
    /// `1/T_k`.
    pub heal: Vec<f64>,
    /// The initial `x`.
    pub initial: Vec<f64>,
}

impl Evolution {
    /// The permeability of a cell.
    pub(super) fn permeability(&self, cell: usize, excess: f64) -> f64 {
        self.minimum[cell] + self.range[cell] * excess
    }

    /// The excess after a time at a slip rate.
    pub(super) fn after(&self, cell: usize, excess: f64, slip_rate: f64, dt: f64) -> f64 {
        let (rise, heal) = (slip_rate.abs() * self.rise[cell], self.heal[cell]);
        let rate = rise + heal;
        if rate <= 0.0 {
            return excess;
        }
        // exp(-rate dt) to all digits of what it lacks to 1.
        excess - (rise / rate - excess) * (-rate * dt).exp_m1()
    }
}
