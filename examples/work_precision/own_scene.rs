//! A scene of one's own, measured.

use stickslip::StateUpdate::{BackwardEuler, Midpoint};
use stickslip::fem::{P1, antiplane, mass};
use stickslip::problems::{AGING, FRICTION};
use stickslip::state::LogTheta;
use stickslip::{Condensed, Measurement, Newmark, Scene, Simulation, Stepper, WorkPrecision};

use crate::common::cli::Problem;

pub(crate) fn measure() -> Result<Vec<Measurement>, Problem> {
    let space = P1::grid([1.0, 1.0], [1, 1])?.refined(3)?;
    let (bottom, top) = (space.trace(|x| x[1] == 0.0)?, space.trace(|x| x[1] == 1.0)?);
    let run = |update, dt: f64| -> Result<f64, Problem> {
        let scene = Scene::new(antiplane(&space, 4e7)?)
            .with_mass(mass(&space, 2e3)?)
            .with_friction(&bottom, FRICTION, 1e4)
            .with_state(AGING, LogTheta(0.0))
            .move_at(&top, [true], |time| [1e-3 * time]);
        let body = Simulation::new(scene, Newmark::default(), Condensed::new())?;
        let mut body = body.with_state_update(update);
        body.run((1.0 / dt).round() as usize, dt, &mut |_| ())?;
        Ok(body.snapshot().displacement[bottom.vertices()[0]][0])
    };
    let table = WorkPrecision::against(run(Midpoint, 1e-4)?)
        .method("midpoint", &[2e-3, 1e-3], |dt| run(Midpoint, dt))
        .method("paper", &[2e-3, 1e-3], |dt| run(BackwardEuler, dt));
    Ok(table.finish())
}
