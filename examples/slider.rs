//! When does an elastic body that is pulled over a rigid surface slip, how far, and how fast?
//!
//! The main experiment of Pipping, Sander and Kornhuber: a body of 5 m x 1 m in plane strain, moved
//! at its top, with rate- and state-dependent friction at its bottom. The body sticks, creeps, and
//! slips in events; histories are recorded at the middle of the bottom, `x0 = (2.5, 0)`.
//!
//! ```text
//! cargo run --release --example slider -- --refinements 4 --steps 10000 --law dieterich
//! ```

use std::process::ExitCode;
use std::time::Instant;

use stickslip::Simulation;
use stickslip::problems::Slider;
use stickslip::state::LogTheta;
use support::cli;
use support::record::Recording;
use support::slider::{Arguments, RECORDING, Setup, report};

fn main() -> ExitCode {
    cli::run(|arguments: &Arguments| {
        let clock = Instant::now();
        let body = arguments.slider();
        let space = body.space()?;
        let bottom = Slider::bottom(&space)?;
        let initial = LogTheta(arguments.initial_log_theta);
        let laws = arguments.laws()?;
        let scene = laws.on(
            body.scene(&space)?,
            &bottom,
            arguments.normal_stress,
            initial,
        );
        let mut simulation = Simulation::new(scene, arguments.scheme(), arguments.solver(&space))?
            .with_coupling(arguments.coupling())
            .with_state_update(arguments.state_update())
            .with_absolute_tolerance(arguments.tolerance)?;
        let setup = Setup {
            unknowns: (simulation.fixed().iter().flatten())
                .filter(|&&fixed| !fixed)
                .count(),
            seconds: clock.elapsed().as_secs_f64(),
        };
        let recording = Recording {
            vertex: Slider::centre(&space).ok_or("the mesh has no vertex at x0")?,
            every: arguments.every.get(),
            end: arguments.end(),
            adaptive: arguments.adaptive.is_some(),
            ..RECORDING
        };
        let (keep, tags) = (&arguments.checkpoints, arguments.tags()?);
        let run = keep.take(recording, &mut simulation, &tags, |taken| {
            arguments.plan(taken)
        })?;
        report(arguments, setup, run)
    })
}
