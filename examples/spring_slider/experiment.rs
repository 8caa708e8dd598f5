//! An experiment with all its numbers.

use stickslip::problems::{LoadPath, SpringSlider};

use crate::arguments::{Arguments, Friction, Preset};
use crate::common::state_law::Law;

/// What is to be done, by the flags and the preset.
pub(crate) struct Experiment {
    pub(crate) preset: Preset,
    pub(crate) law: Law,
    pub(crate) friction: Friction,
    pub(crate) a: f64,
    pub(crate) b: f64,
    pub(crate) slider: SpringSlider,
    pub(crate) load_velocity: f64,
    pub(crate) initial_slip_rate: f64,
    /// The step size, or the tolerance by which it adapts.
    pub(crate) steps: Steps,
    pub(crate) until: f64,
}

/// How time is divided.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Steps {
    Constant(f64),
    Adaptive(f64),
}

impl Experiment {
    pub(crate) fn new(arguments: &Arguments) -> Self {
        let preset = arguments.preset_flag.unwrap_or(arguments.preset);
        let (a, b, load_velocity, dt) = match preset {
            Preset::VelocityStep => (0.005, 0.01, 1e-6, Some(5e-3)),
            Preset::SlideHoldSlide => (0.01, 0.015, 1e-5, None),
            Preset::StickSlip => (0.01, 0.015, 1e-6, None),
        };
        let (a, b) = (arguments.a.unwrap_or(a), arguments.b.unwrap_or(b));
        let load_velocity = arguments.load_velocity.unwrap_or(load_velocity);
        let mut load = LoadPath::steady(load_velocity);
        let mut until = match preset {
            Preset::StickSlip => 1200.0,
            _ => 40.0,
        };
        let steps = preset == Preset::VelocityStep;
        if steps || arguments.step_to.is_some() || arguments.step_at.is_some() {
            let time = arguments.step_at.unwrap_or(10.0);
            load = load.then(time, arguments.step_to.unwrap_or(10.0 * load_velocity));
            until = f64::max(until, 4.0 * time);
        }
        let hold = (preset == Preset::SlideHoldSlide).then_some((20.0, 120.0));
        if let Some((start, end)) = arguments.hold.or(hold) {
            let velocity = load.velocity(end);
            load = load.then(start, 0.0).then(end, velocity);
            until = f64::max(until, end + 40.0);
        }
        let normal_stress = arguments.normal_stress;
        let critical = |distance| SpringSlider::critical_stiffness(normal_stress, a, b, distance);
        let stiffness = arguments.stiffness.unwrap_or(match preset {
            Preset::StickSlip => 0.5 * critical(arguments.slip_distance),
            _ => 1e9,
        });
        let damping = arguments.damping.unwrap_or(match preset {
            Preset::StickSlip => 5e6,
            _ => 0.0,
        });
        // Steady sliding on a soft spring is an equilibrium that nothing would ever leave.
        let disturbed = match preset {
            Preset::StickSlip => 1.01 * load_velocity,
            _ => load_velocity,
        };
        Self {
            preset,
            law: arguments.law,
            friction: arguments.friction.unwrap_or(match arguments.law {
                Law::None => Friction::Tresca,
                _ => Friction::DieterichRuina,
            }),
            a,
            b,
            slider: SpringSlider {
                stiffness,
                normal_stress,
                mass: arguments.mass,
                damping,
                load,
            },
            load_velocity,
            initial_slip_rate: arguments.initial_slip_rate.unwrap_or(disturbed),
            steps: match arguments.dt.or(dt) {
                Some(dt) => Steps::Constant(dt),
                None => Steps::Adaptive(arguments.tolerance),
            },
            until: arguments.until.unwrap_or(until),
        }
    }
}
