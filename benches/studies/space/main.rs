//! The cost of a body in space over its size: time, memory, cycles.
//!
//! A block of 3 m x 2 m x 2 m of the paper's material, moved at its top, 20 degrees off its long side, takes steps by
//! `Tnnmg` from an equilibrium by `MultigridSolver`: nothing takes more than in proportion to the unknowns.
//!
//! ```text
//! cargo run --release --manifest-path benches/studies/Cargo.toml --bin space
//! RAYON_NUM_THREADS=2 cargo run --release --manifest-path benches/studies/Cargo.toml --bin space
//! cargo run --release --manifest-path benches/studies/Cargo.toml --bin space -- --single-precision
//! ```

use std::process::ExitCode;
use std::time::Instant;

use clap::Parser;
use nalgebra::Vector3;
use stickslip::fem::{P1, body_force, elasticity, mass};
use stickslip::problems::pipping_slider::{
    AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider, load_velocity,
};
use stickslip::state::LogTheta;
use stickslip::{Contact, MultigridSolver, Newmark, Scene, Simulation, Steps, Tnnmg};
use stickslip_cli::cli::{self, Problem};

/// A block in space at size
#[derive(Debug, Parser)]
#[command(name = "space")]
struct Arguments {
    /// Refinements of a block of 72 cells; 5 of them make 1.2 million unknowns
    #[arg(long, value_name = "COUNT", num_args = 1.., default_values_t = [3, 4, 5])]
    refinements: Vec<usize>,
    /// Steps to take
    #[arg(long, value_name = "COUNT", default_value_t = 20)]
    steps: usize,
    /// Blocks of cycles in single precision
    #[arg(long)]
    single_precision: bool,
    /// The size of a step [s]
    #[arg(long, value_name = "SECONDS", default_value_t = 1.5e-3)]
    step: f64,
}

fn main() -> ExitCode {
    cli::run(|arguments: &Arguments| {
        println!(
            "| unknowns | frictional vertices | setup \\[s\\] | step \\[s\\] | cycles a step | step a cycle and unknown \\[ns\\] | memory \\[GiB\\] |\n\
             | ---: | ---: | ---: | ---: | ---: | ---: | ---: |"
        );
        let mut sizes = arguments.refinements.iter();
        sizes.try_for_each(|&refinements| row(refinements, arguments))
    })
}

/// One line of the table.
fn row(refinements: usize, arguments: &Arguments) -> Result<(), Problem> {
    let begun = Instant::now();
    let space = P1::<3>::grid([3.0, 2.0, 2.0], [3, 2, 2])?.refined(refinements)?;
    let bottom = space.trace(|x| x[2] == 0.0)?;
    let top = space.trace(|x| x[2] == 2.0)?;
    let PippingSlider {
        density,
        gravity,
        elastic,
        ..
    } = PippingSlider::default();
    let weight = Vector3::new(0.0, 0.0, -density * gravity);
    let contact = Contact::new(&bottom, FRICTION, NORMAL_STRESS)
        .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
    let (sin, cos) = 20_f64.to_radians().sin_cos();
    let scene = Scene::new(elasticity(&space, &elastic)?)
        .with_mass(mass(&space, density)?)
        .with_load(body_force(&space, |_| weight))
        .with_contact(contact)
        .prescribe_velocity(&top, [true; 3], move |time| {
            [cos, sin, 0.0].map(|part| part * load_velocity(time))
        })
        .in_equilibrium(MultigridSolver::new(space.transfers()));
    let mut solver = Tnnmg::new(space.transfers());
    if arguments.single_precision {
        solver = solver.in_single_precision();
    }
    let mut block = Simulation::new(scene, Newmark::default(), solver)?;
    let setup = begun.elapsed().as_secs_f64();
    let mut cycles = 0;
    let begun = Instant::now();
    let steps = Steps::constant(arguments.step).count(arguments.steps);
    block.run(&steps, |at| cycles += at.report.solver_iterations)?;
    let step = begun.elapsed().as_secs_f64() / arguments.steps as f64;
    let (unknowns, cycles) = (
        3 * space.vertex_count(),
        cycles as f64 / arguments.steps as f64,
    );
    println!(
        "| {unknowns} | {} | {setup:.1} | {step:.3} | {cycles:.1} | {:.0} | {} |",
        bottom.vertices().len(),
        1e9 * step / (cycles * unknowns as f64),
        peak_memory().map_or("".into(), |bytes| format!(
            "{:.2}",
            bytes / 1024_f64.powi(3)
        )),
    );
    Ok(())
}

/// The most memory that this process has had so far \[byte\], where the system tells.
fn peak_memory() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM"))?;
    let kibibytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(1024.0 * kibibytes)
}
