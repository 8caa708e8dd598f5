//! Stick-slip of an elastic body that is pulled over a rigid surface: time, size and slip rate of its events.
//!
//! The main experiment of Pipping, Sander and Kornhuber: a body of 5 m x 1 m in plane strain, moved
//! at its top, with rate- and state-dependent friction at its bottom. The body sticks, creeps, and
//! slips in events; histories are recorded at the middle of the bottom, `x0 = (2.5, 0)`.
//!
//! ```text
//! stickslip slider --refinements 4 --steps 10000 --law dieterich
//! ```

use std::time::Instant;

use super::{Arguments, Body, RECORDING, Setup, report};
use crate::cli::Problem;
use crate::record::Recording;
use stickslip::integrate::Stepper;
use stickslip::problems::pipping_slider::PippingSlider;
use stickslip::state::LogTheta;
use stickslip::{DenseNewton, Simulation};

/// The paper's slider, with the requested schemes, solvers and couplings.
///
/// # Errors
/// In one line: a wrong setting, a failed step, a file that cannot be written.
pub fn run(arguments: &Arguments) -> Result<(), Problem> {
    let clock = Instant::now();
    let body = arguments.slider();
    let space = body.space()?;
    let bottom = PippingSlider::bottom(&space)?;
    let initial = LogTheta(arguments.initial_log_theta);
    let laws = arguments.laws()?;
    let scene = laws.on(
        body.scene(&space)?,
        &bottom,
        arguments.normal_stress,
        initial,
    );
    let centre = PippingSlider::centre(&space).ok_or("the mesh has no vertex at x0")?;
    let run = |simulation: &mut dyn Stepper<2>, vertex, setup| {
        let recording = Recording {
            vertex,
            every: arguments.every.get(),
            end: arguments.end(),
            adaptive: arguments.adaptive.is_some(),
            ..RECORDING
        };
        let (keep, tags) = (&arguments.checkpoints, arguments.tags()?);
        let run = keep.take(recording, simulation, &tags, |taken| arguments.plan(taken))?;
        report(arguments, setup, run)
    };
    match arguments.body {
        Body::Full => {
            let solver = arguments.solver(&space);
            let simulation = Simulation::new(scene, arguments.scheme(), solver)?;
            let mut simulation = arguments.coupled(simulation)?;
            let setup = Setup::new(simulation.fixed(), clock);
            run(&mut simulation, centre, setup)
        }
        Body::Reduced => {
            let body = arguments.reduced(&scene)?;
            let scene = body.reduce(scene)?;
            let simulation = Simulation::new(scene, arguments.scheme(), DenseNewton::new())?;
            let mut simulation = arguments.coupled(simulation)?;
            let setup = Setup::new(simulation.fixed(), clock).with_modes(&body);
            let vertex = body.vertex(centre).ok_or("x0 is not on the contact")?;
            run(&mut simulation, vertex, setup)
        }
    }
}
