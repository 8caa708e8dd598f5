//! Adaptive steps: what a tolerance buys, what a rejected step leaves, where a run ends.

mod cycles;
mod dense;
mod errors;
mod limits;
mod orders;
mod steps;

use stickslip::integrate::Stepper;
use stickslip::problems::spring_slider::{AGING, FRICTION, LoadPath, SpringSlider, steady_state};
use stickslip::{Newmark, Point, RungeKutta, SceneError, Sdirk2, Simulation, Snapshot};

/// A slider on half the critical stiffness with radiation damping, disturbed.
fn stick_slip(load_velocity: f64) -> SpringSlider {
    SpringSlider {
        stiffness: 2.5e8,
        normal_stress: 1e6,
        mass: 0.0,
        damping: 5e6,
        load: LoadPath::steady(load_velocity),
    }
}

/// The ways to integrate a slider without inertia.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Method {
    RungeKutta,
    Newmark,
    Sdirk2,
}

fn stepper(slider: &SpringSlider, method: Method) -> Result<Box<dyn Stepper<1>>, SceneError> {
    let rate = slider.load.velocity(0.0);
    let scene = slider.scene(FRICTION, AGING, 1.1 * rate, steady_state(&AGING, rate)?)?;
    Ok(match method {
        Method::RungeKutta => Box::new(RungeKutta::new(scene)?),
        Method::Newmark => Box::new(Simulation::new(scene, Newmark::default(), Point)?),
        Method::Sdirk2 => Box::new(Simulation::new(scene, Sdirk2, Point)?),
    })
}

/// `ln V` and the state.
fn motion(at: Snapshot<'_, 1>) -> [f64; 2] {
    [at.velocity[0][0].ln(), at.contact(0).state(0)]
}
