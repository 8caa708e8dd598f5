//! The spring slider of `problems`: published values, linear stability, limits that have a closed
//! form, and the parts of a scene that need no mesh: cohesion, viscosity, normal stress in time.

mod agreement;
mod experiments;
mod laboratory;
mod problem;
mod refusals;
mod scene_parts;
mod stability;

use stickslip::friction::DieterichRuina;
use stickslip::problems::spring_slider::{FRICTION, LoadPath, SpringScene, SpringSlider};
use stickslip::state::Ruina;
use stickslip::{Newmark, Point, SceneError, Simulation};

const SLIP_DISTANCE: f64 = 1e-5;
const RUINA: Ruina = Ruina {
    slip_distance: SLIP_DISTANCE,
};

/// The implicit method of second order: Newmark's scheme, the state at the midpoint rate.
fn implicit(scene: SpringScene) -> Result<Simulation<1>, SceneError> {
    Simulation::new(scene, Newmark::default(), Point)
}

/// The velocity step from 1 to 10 um/s at 10 s that is published.
fn stepped(stiffness: f64) -> SpringSlider {
    SpringSlider {
        stiffness,
        normal_stress: 1e6,
        mass: 0.0,
        damping: 0.0,
        load: LoadPath::steady(1e-6).then(10.0, 1e-5),
    }
}

const STEPPED: DieterichRuina = DieterichRuina {
    a: 0.005,
    b: 0.01,
    ..FRICTION
};
