//! How does a block on a spring slide: after a velocity step, after a hold, in stick-slip?
//!
//! The numerical counterpart of the experiments to which rate- and state-dependent friction is
//! fitted. One point, no mesh: nothing but the laws and the time integration.
//!
//! ```text
//! cargo run --release --example spring_slider -- velocity-step
//! cargo run --release --example spring_slider -- slide-hold-slide --hold 20,1020
//! cargo run --release --example spring_slider -- stick-slip --damping 5e6
//! ```

mod arguments;
#[path = "../common/mod.rs"]
mod common;
mod experiment;
mod integrate;
mod report;

use std::process::ExitCode;

use stickslip::friction::{
    DieterichRuina, FrictionLaw, RegularizedDieterichRuina, StateDependentTresca, Tresca,
};
use stickslip::problems::steady_state;
use stickslip::state::{Dieterich, Discontinuous, LogTheta, Ruina, StateLaw, Theta};

use arguments::{Arguments, Friction};
use common::cli::{self, Problem};
use common::output::Output;
use common::plot;
use common::state_law::Law;
use experiment::Experiment;
use report::Summary;

const HISTORY: &str = "history.csv";
const PICTURE: &str = "history.png";
const SUMMARY: &str = "summary.json";

fn main() -> ExitCode {
    cli::run(choose_friction)
}

fn choose_friction(arguments: &Arguments) -> Result<(), Problem> {
    let experiment = Experiment::new(arguments);
    let law = DieterichRuina {
        a: experiment.a,
        b: experiment.b,
        reference_friction: arguments.reference_friction,
        reference_velocity: arguments.reference_velocity,
        slip_distance: arguments.slip_distance,
    };
    match (experiment.friction, experiment.law) {
        (Friction::Tresca, Law::None) => {
            let coefficient = arguments.reference_friction;
            slide(arguments, &experiment, Tresca { coefficient }, (), ())
        }
        (_, Law::None) => Err("this friction law needs a state, --law none has none".into()),
        (Friction::DieterichRuina, _) => choose_state(arguments, &experiment, law),
        (Friction::Regularized, _) => choose_state(
            arguments,
            &experiment,
            RegularizedDieterichRuina {
                a: law.a,
                b: law.b,
                reference_friction: law.reference_friction,
                reference_velocity: law.reference_velocity,
                slip_distance: law.slip_distance,
            },
        ),
        (Friction::Tresca, _) => choose_state(
            arguments,
            &experiment,
            StateDependentTresca {
                b: law.b,
                reference_friction: law.reference_friction,
                reference_velocity: law.reference_velocity,
                slip_distance: law.slip_distance,
            },
        ),
    }
}

fn choose_state<L>(
    arguments: &Arguments,
    experiment: &Experiment,
    friction: L,
) -> Result<(), Problem>
where
    L: FrictionLaw<State = LogTheta> + Clone + 'static,
{
    let slip_distance = arguments.slip_distance;
    match experiment.law {
        Law::Dieterich => start(arguments, experiment, friction, Dieterich { slip_distance }),
        Law::Ruina => start(arguments, experiment, friction, Ruina { slip_distance }),
        Law::Discontinuous | Law::None => start(arguments, experiment, friction, Discontinuous),
    }
}

/// Steady sliding at the load velocity, unless a state is given.
fn start<L, S>(
    arguments: &Arguments,
    experiment: &Experiment,
    friction: L,
    law: S,
) -> Result<(), Problem>
where
    L: FrictionLaw<State = LogTheta> + Clone + 'static,
    S: StateLaw + Clone + 'static,
    S::State: From<Theta>,
    LogTheta: From<S::State>,
{
    let state = match arguments.initial_theta {
        Some(theta) => Theta(theta).into(),
        None => steady_state(&law, experiment.load_velocity)?,
    };
    slide(arguments, experiment, friction, law, state)
}

fn slide<L, S>(
    arguments: &Arguments,
    experiment: &Experiment,
    friction: L,
    law: S,
    state: S::State,
) -> Result<(), Problem>
where
    L: FrictionLaw + Clone + 'static,
    S: StateLaw + Clone + 'static,
    L::State: From<S::State>,
{
    let output = Output::create(&arguments.out, &[HISTORY, PICTURE, SUMMARY])?;
    let run = integrate::run(experiment, friction, law, state)?;
    let summary = Summary::new(experiment, &run, arguments.slip_distance);
    run.write(experiment, &output, HISTORY, arguments.every.get())?;
    output.json(SUMMARY, &summary)?;
    plot::draw(&output.path(PICTURE), &report::panels(&run))?;
    summary.print();
    println!(
        "{HISTORY}, {PICTURE}, {SUMMARY} in {}",
        output.folder().display()
    );
    run.failure.map_or(Ok(()), |failure| Err(failure.into()))
}
