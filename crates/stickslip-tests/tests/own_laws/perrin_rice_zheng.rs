//! The law of Perrin, Rice and Zheng.

use stickslip::state::{StateLaw, Theta};

/// `theta' = 1 - (V theta / 2L)^2` (G. Perrin, J. Rice, G. Zheng, J. Mech. Phys. Solids 43 (1995)),
/// with the steady state `2L/V`, next to which it evolves as Dieterich's law does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PerrinRiceZheng {
    /// `L` \[m\], finite and positive.
    pub(crate) slip_distance: f64,
}

impl StateLaw for PerrinRiceZheng {
    type State = Theta;

    // The square keeps its sign, so that g also decreases where theta < 0.
    fn evolution(&self, Theta(theta): Theta, slip_rate: f64) -> f64 {
        let x = slip_rate * theta / (2.0 * self.slip_distance);
        1.0 - x * x.abs()
    }

    fn evolution_state_slope(&self, Theta(theta): Theta, slip_rate: f64) -> f64 {
        let rate = slip_rate / (2.0 * self.slip_distance);
        -2.0 * theta.abs() * rate * rate
    }
}
