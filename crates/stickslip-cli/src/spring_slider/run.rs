//! Spring slider: velocity step, slide-hold-slide and stick-slip.
//!
//! The numerical counterpart of the experiments to which rate-and-state friction is fitted. One point without a mesh:
//! only the laws and the time integration.
//!
//! ```text
//! stickslip spring-slider velocity-step
//! stickslip spring-slider slide-hold-slide --hold 20,1020
//! stickslip spring-slider stick-slip --damping 5e6
//! ```

use std::time::Instant;

use super::arguments::PUBLISHED;
use super::{Arguments, Experiment, Record, Sample};
use crate::cli::Problem;
use crate::laws::Law;
use crate::progress::Progress;
use stickslip::integrate::Stepper;
use stickslip::state::Theta;
use stickslip::{Newmark, Point, Run, RungeKutta, Sdirk2, Simulation, Snapshot};

/// A spring slider through a velocity step, holds or stick-slip.
///
/// # Errors
/// In one line: a wrong setting, a failed step, a file that cannot be written.
pub fn run(arguments: &Arguments) -> Result<(), Problem> {
    let experiment = arguments.experiment()?;
    let (method, mut block) = block(arguments, &experiment)?;
    let mut record = Record::new(method, arguments.every, PUBLISHED.0);
    // The spring starts unstretched by the slip to come.
    let origin = block.snapshot().displacement[0][0];
    let log_theta = arguments.law.log_theta();
    let mut observe = |at: Snapshot<'_, 1>| {
        let contact = at.contact(0);
        record.add(Sample {
            time: at.time,
            slip_rate: at.velocity[0][0],
            displacement: at.displacement[0][0] - origin,
            theta: log_theta(contact.state(0)).exp(),
            friction: contact.coefficient(0),
            solves: at.report.solver_iterations,
        });
    };
    observe(block.snapshot());
    let (clock, mut progress) = (Instant::now(), Progress::default());
    let failure = block.run(&experiment.steps, |at| {
        progress.at(at.time, experiment.until, at.velocity[0][0].abs());
        observe(at);
    });
    let failure = failure.err();
    drop(progress);
    record.seconds = clock.elapsed().as_secs_f64();
    record.report(arguments, &experiment, failure, || {
        let (_, mut block) = self::block(arguments, &experiment)?;
        let clock = Instant::now();
        block.run(&experiment.steps, |_| ())?;
        Ok(clock.elapsed().as_secs_f64())
    })
}

/// An explicit method for adaptive steps and a smooth right-hand side, else an implicit one.
fn block(
    arguments: &Arguments,
    experiment: &Experiment,
) -> Result<(&'static str, Box<dyn Stepper<1>>), Problem> {
    let (slider, rate) = (&experiment.slider, experiment.initial_slip_rate);
    let theta = arguments.initial_theta.map(Theta);
    let scene = experiment.laws.spring(slider, rate, theta)?;
    let smooth = !matches!(arguments.law, Law::Discontinuous | Law::None);
    Ok(match experiment.step_size {
        Some(_) => (
            "newmark",
            Box::new(Simulation::new(scene, Newmark::default(), Point)?),
        ),
        None if smooth && slider.mass == 0.0 => ("runge-kutta", Box::new(RungeKutta::new(scene)?)),
        None => ("sdirk2", Box::new(Simulation::new(scene, Sdirk2, Point)?)),
    })
}
