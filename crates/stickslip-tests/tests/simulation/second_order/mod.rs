//! Second order in time: the state at the midpoint rate, and a method of two stages; against
//! explicit integrations, the exact solution of the layer, and the extrapolated slider.

mod inertia;
mod on_time;
mod quasi_static;

use stickslip::Snapshot;
use stickslip::problems::spring_slider::{LoadPath, SpringSlider};

/// Slip rate (by its logarithm), state and displacement.
type Motion = [f64; 3];

fn motion(at: Snapshot<'_, 1>) -> Motion {
    [
        at.velocity[0][0].ln(),
        at.contact(0).state(0),
        at.displacement[0][0] / 1e-5,
    ]
}

/// The largest difference, of the slip rate and state relative, of the displacement in units of
/// `L`.
fn apart(a: Motion, b: Motion) -> f64 {
    a.iter()
        .zip(b)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max)
}

/// A slider that was disturbed and whose load point moves ever faster.
fn disturbed(mass: f64) -> SpringSlider {
    SpringSlider {
        stiffness: 2e9,
        normal_stress: 1e6,
        mass,
        damping: 5e6,
        load: LoadPath::steady(1e-6).ramp(0.0, 20.0, 5e-6),
    }
}

const UNTIL: f64 = 8.0;
