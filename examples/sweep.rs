//! One body, many laws: how often and how fast does the slider slip, for which `a`, `b` and `L`?
//!
//! Reducing the body to its bottom takes its time once. Each run is then one on the bottom alone; all of them share the
//! reduced body, in as many threads as there are processors.
//!
//! ```text
//! cargo run --release --example sweep -- --sets 200
//! ```

use std::process::ExitCode;

use stickslip::fem::P1;
use stickslip::friction::DieterichRuina;
use stickslip::problems::{END, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, Slider};
use stickslip::state::LogTheta;
use stickslip::{
    BlockMatrix, Contact, DenseNewton, Events, Newmark, Reduced, ReducedBody, Scene, SceneError,
    Simulation, Steps, Symmetric,
};
use support::cli;
use support::sweep::{Arguments, Seen, work_off};

/// The slip rates [m/s] at which an event begins, and below which it is over.
const EVENT: (f64, f64) = (1e-3, 2e-4);

fn scene(
    slider: &Slider,
    space: &P1<2>,
    law: DieterichRuina,
) -> Result<Scene<BlockMatrix<2>, 2>, SceneError> {
    let contact = Contact::new(&Slider::bottom(space)?, law, NORMAL_STRESS);
    let contact = contact.with_state(law.aging(), LogTheta(INITIAL_LOG_THETA));
    Ok(slider.scene(space)?.with_contact(contact))
}

/// Takes a run as far as it goes.
fn take(scene: Result<Scene<Symmetric<2>, 2>, SceneError>, steps: usize, middle: usize) -> Seen {
    let (mut events, mut peak_slip_rate) = (Events::new(EVENT.0, EVENT.1), 0.0_f64);
    let run =
        scene.and_then(|scene| Simulation::new(scene, Newmark::default(), DenseNewton::new()));
    let ended = match run {
        Err(error) => Err(error.to_string()),
        Ok(mut run) => {
            let steps = Steps::constant(END / steps as f64).count(steps).bridging();
            let ended = run.run(&steps, |at| {
                events.record(at.time, at.velocity[middle].norm());
                peak_slip_rate = peak_slip_rate.max(at.max_slip_rate());
            });
            ended.map_err(|failure| failure.to_string())
        }
    };
    Seen {
        events: events.times().to_vec(),
        peak_slip_rate,
        lost: ended.err(),
    }
}

fn main() -> ExitCode {
    cli::run(|arguments: &Arguments| {
        let slider = Slider {
            refinements: arguments.refinements.into(),
            ..Slider::default()
        };
        let space = slider.space()?;
        let whole = scene(&slider, &space, FRICTION)?;
        let body: ReducedBody<2> = Reduced::new(&whole).up_to(arguments.frequency)?;
        let middle = Slider::centre(&space).and_then(|vertex| body.vertex(vertex));
        let middle = middle.ok_or("the mesh has no vertex at the middle of the bottom")?;
        let steps = arguments.steps.get();
        work_off(arguments, |law| {
            let reduced = scene(&slider, &space, law).and_then(|scene| body.reduce(scene));
            take(reduced, steps, middle)
        })
    })
}
