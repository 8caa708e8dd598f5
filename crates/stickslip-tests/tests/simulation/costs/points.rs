//! A block on a spring, through an event.

use stickslip::friction::RegularizedDieterichRuina;
use stickslip::problems::pipping_slider::{AGING, FRICTION};
use stickslip::problems::spring_slider::{LoadPath, SpringScene, SpringSlider, steady_state};
use stickslip::{
    BackwardEuler, ErrorControl, GeneralizedAlpha, Newmark, Point, RungeKutta, Sdirk2, Simulation,
    Steps,
};

use super::{Cost, simulated, stepped};
use crate::Outcome;

/// With radiation damping, or with inertia.
fn slider(mass: f64) -> Outcome<SpringScene> {
    let slider = SpringSlider {
        stiffness: 2.5e8,
        normal_stress: 1e6,
        mass,
        damping: if mass > 0.0 { 0.0 } else { 5e6 },
        load: LoadPath::steady(1e-6),
    };
    let law = RegularizedDieterichRuina::from(FRICTION);
    Ok(slider.scene(law, AGING, 1.1e-6, steady_state(&AGING, 1e-6)?)?)
}

pub(super) fn all() -> Outcome<Vec<Cost>> {
    let adaptive = Steps::adaptive(1e-5).until(1000.0);
    let constant = Steps::constant(0.5).until(500.0);
    let extrapolated = adaptive
        .clone()
        .with_error_control(ErrorControl::extrapolated(3));
    Ok(vec![
        stepped(
            "point Runge-Kutta",
            RungeKutta::new(slider(0.0)?)?,
            &adaptive,
        )?,
        simulated(
            "point Newmark adaptive",
            Simulation::new(slider(0.0)?, Newmark::default(), Point)?,
            &adaptive,
        )?,
        simulated(
            "point Newmark extrapolated",
            Simulation::new(slider(0.0)?, Newmark::default(), Point)?,
            &extrapolated,
        )?,
        simulated(
            "point Sdirk2 adaptive",
            Simulation::new(slider(0.0)?, Sdirk2, Point)?,
            &adaptive,
        )?,
        simulated(
            "point generalised-alpha with inertia",
            Simulation::new(slider(1e4)?, GeneralizedAlpha::default(), Point)?,
            &adaptive,
        )?,
        simulated(
            "point backward Euler",
            Simulation::new(slider(0.0)?, BackwardEuler, Point)?,
            &constant,
        )?,
    ])
}
