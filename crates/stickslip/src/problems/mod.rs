//! Model problems for examples, tests and benches, with the parameters of Pipping, Sander and Kornhuber, "Variational
//! formulation of rate- and state-dependent friction problems".
//!
//! | problem | model | reference |
//! | --- | --- | --- |
//! | [`Slider`] | an elastic body of 5 m x 1 m on a rigid surface | the paper's Figs. 6.1 to 6.5 |
//! | [`Layer`] | the same material, with a solution independent of x | an exact solution |
//! | [`SpringSlider`] | a block on a spring: one point | published velocity steps, linear stability |
//! | [`VelocityStep`] | a velocity step of its load point at a displacement | the parameters that fit a measured step |

#[cfg(feature = "fem")]
mod constant_rate;
#[cfg(feature = "fem")]
mod layer;
mod load_path;
#[cfg(feature = "fem")]
mod slider;
mod spring_slider;
mod velocity_step;

#[cfg(feature = "fem")]
pub use layer::{ExactSample, Layer};
pub use load_path::LoadPath;
#[cfg(feature = "fem")]
pub use slider::Slider;
pub use spring_slider::{SpringScene, SpringSlider, steady_state};
pub use velocity_step::{FitError, VelocityStep, VelocityStepFit};

use stickslip_friction::DieterichRuina;
use stickslip_state::Dieterich;

/// The friction law of both problems.
pub const FRICTION: DieterichRuina = DieterichRuina {
    a: 0.010,
    b: 0.015,
    reference_friction: 0.6,
    reference_velocity: 1e-6,
    slip_distance: 1e-5,
};

/// The aging law of both problems.
pub const AGING: Dieterich = Dieterich {
    slip_distance: 1e-5,
};

/// The initial value of `ln(theta / 1 s)` in both problems.
pub const INITIAL_LOG_THETA: f64 = -10.0;

/// The normal stress of both problems [N/m].
pub const NORMAL_STRESS: f64 = 49_050.0;

/// The end of both problems \[s\].
pub const END: f64 = 15.0;

/// The velocity of the driven side [m/s]: it grows linearly until `END / 4` and stays at `2e-4`.
pub fn load_velocity(time: f64) -> f64 {
    2e-4 * (4.0 * time / END).min(1.0)
}
