//! Slip front in three dimensions: its nucleation and propagation.
//!
//! A body of 5 m x 1 m x 1 m of the paper's slider's material, moved at its top, 20 degrees off its long side. The
//! middle of its bottom is velocity weakening, a rim around it velocity strengthening. Slip has both components:
//! friction has the direction of the slip rate.
//!
//! ```text
//! stickslip slider3d
//! stickslip slider3d --vtu-every 100
//! ```

use super::{Arguments, report, take};
use crate::cli::Problem;
use stickslip::fem::{P1, body_force, elasticity, mass};
use stickslip::friction::DieterichRuina;
use stickslip::nalgebra::Vector3;
use stickslip::problems::pipping_slider::{
    AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider, load_velocity,
};
use stickslip::state::LogTheta;
use stickslip::{Cholesky, Condensed, Contact, GeneralizedAlpha, Scene, Simulation};

/// `a` grows from 0.010 to 0.020 towards the edge, over 0.7 m at the ends and 0.2 m at the sides.
fn law(x: f64, y: f64) -> DieterichRuina {
    let from_end = x.min(5.0 - x) / 0.7;
    let from_side = y.min(1.0 - y) / 0.2;
    let rim = 1.0 - from_end.min(from_side).min(1.0);
    DieterichRuina {
        a: 0.010 + 0.010 * rim,
        ..FRICTION
    }
}

/// A slip front in space.
///
/// # Errors
/// In one line: a wrong setting, a failed step, a file that cannot be written.
pub fn run(arguments: &Arguments) -> Result<(), Problem> {
    let coarse = P1::<3>::grid([5.0, 1.0, 1.0], [5, 1, 1])?;
    let space = coarse.refined(arguments.refinements.into())?;
    let bottom = space.trace(|x| x[2] == 0.0)?;
    let top = space.trace(|x| x[2] == 1.0)?;
    let PippingSlider {
        density,
        gravity,
        elastic,
        ..
    } = PippingSlider::default();
    let weight = Vector3::new(0.0, 0.0, -density * gravity);
    let laws = bottom.map(|x| law(x[0], x[1]));
    let contact = Contact::per_vertex(&bottom, laws, NORMAL_STRESS)
        .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
    let (sin, cos) = arguments.degrees.to_radians().sin_cos();
    let scene = Scene::new(elasticity(&space, &elastic)?)
        .with_mass(mass(&space, density)?)
        .with_load(body_force(&space, |_| weight))
        .with_contact(contact)
        .prescribe_velocity(&top, [true; 3], move |time| {
            [cos, sin, 0.0].map(|part| part * load_velocity(time))
        })
        .in_equilibrium(Cholesky::new());
    let mut slider = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;
    let run = take(arguments, &mut slider, (&space, &bottom), elastic)?;
    report(arguments, &space, &bottom, run)
}
