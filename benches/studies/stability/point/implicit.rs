//! Implicit steps of a constant size, their equations checked.

use nalgebra::{SMatrix, SVector};
use stickslip::solvers::ConjugateGradients;
use stickslip::{Newmark, Point, Simulation, StateUpdate};
use stickslip_cli::laws::Laws;

use super::{SECTION, STEPS, scene};
use crate::accuracy::TOLERANCE;
use crate::case::{Case, IntoControlFlow, Refusal};
use crate::check::Check;
use crate::march::{Pace, march};
use crate::method::{EVOLUTIONS, FRICTIONS, METHODS, Method};
use crate::setup::Setup;

/// All laws and methods for a setup.
pub(crate) fn add(cases: &mut Vec<Case>, name: &str, prefix: &str, setup: Setup, quick: bool) {
    let frictions = if quick { &FRICTIONS[..1] } else { &FRICTIONS };
    for (method, update, label) in METHODS {
        for &(friction, friction_name) in frictions {
            for (law, law_name) in EVOLUTIONS {
                let member = format!("{prefix}{law_name}, {friction_name}");
                cases.push(Case::new(SECTION, name, label, member, move || {
                    let laws = setup.laws(law, friction);
                    take_steps(&setup, &laws, method, update)
                        .unwrap_or_else(IntoControlFlow::refused)
                }));
            }
        }
    }
}

fn take_steps(
    setup: &Setup,
    laws: &Laws,
    method: Method,
    update: StateUpdate,
) -> Result<IntoControlFlow, Refusal> {
    let simulation: Simulation<1> =
        Simulation::new(scene(setup, laws)?, Newmark::default(), Point)?;
    let simulation = simulation.with_state_update(update);
    let mut simulation = method.on(simulation.with_absolute_tolerance(TOLERANCE)?);
    let pull = setup.stiffness * setup.velocity;
    let load = move |time| vec![SVector::from([pull * time])];
    let check =
        Check::<SMatrix<f64, 1, 1>, 1>::of(&simulation, load, &mut ConjugateGradients::default())?;
    let steps = (STEPS, setup.dt, Pace::Constant);
    Ok(march(&mut simulation, &check, None, steps))
}
