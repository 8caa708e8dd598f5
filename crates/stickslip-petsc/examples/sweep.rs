//! The sweep over laws on a reduced slider in several processes; its serial twin is `stickslip sweep`.
//!
//! ```text
//! mpirun -n 4 target/release/examples/sweep --sets 200
//! ```

use std::process::ExitCode;

use stickslip_cli::cli::{self, Problem};
use stickslip_cli::sweep::{Arguments, Runs, Seen, in_threads};
use stickslip_petsc::{World, run};

/// Takes the runs of this process, each with as many others between it and the next as there are processes: neighbours
/// in the sequence of laws are far apart in all of their parameters, so that no process has the slow ones.
fn sweep(world: World, arguments: &Arguments) -> Result<(), Problem> {
    let (laws, processes) = (arguments.laws(), world.size());
    // What cannot be written is known before the runs.
    let output = (world.is_first().then(|| arguments.output())).transpose()?;
    let runs = Runs::new(arguments)?;
    let own = laws.iter().copied().skip(world.rank()).step_by(processes);
    let own: Vec<_> = own.collect();
    let seen = in_threads(arguments.threads(1), &own, |law| runs.take(law))?;
    let parts: Vec<Vec<Seen>> = world.collect(&seen)?;
    let Some(output) = output else { return Ok(()) };
    let rows = laws.into_iter().enumerate();
    output.write(
        rows.map(|(k, law)| (law, parts[k % processes][k / processes].clone()))
            .collect(),
    )
}

fn main() -> ExitCode {
    match cli::read::<Arguments>() {
        Ok(arguments) => run(|world| sweep(world, &arguments)),
        Err(status) => status,
    }
}
