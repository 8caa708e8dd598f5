//! The cost of an explicit step in space: with the matrix of the stiffness, and by elements.
//!
//! A cube that slides on its base by rate- and state-dependent friction, with dashpots on the other sides, takes steps by
//! `CentralDifferences`: once with `elasticity`, once with `element_stiffness`, in turns in one program, in one thread and in
//! several. A triad `a = b + s c` of large arrays in the same run is the bandwidth to compare with.
//!
//! With `--levels` the cube slides on a patch of its base, with cells that grow from there to eight times their edges: once in
//! equal steps, once in local ones.
//!
//! ```text
//! cargo run --release --manifest-path benches/studies/Cargo.toml --bin explicit
//! cargo run --release --manifest-path benches/studies/Cargo.toml --bin explicit -- --side 119 --memory
//! cargo run --release --manifest-path benches/studies/Cargo.toml --bin explicit -- --side 24 --levels 4 --steps 16
//! cargo run --release --manifest-path benches/studies/Cargo.toml --bin explicit -- --side 24 --levels 4 --steps 16 --patch 50
//! ```

use std::process::ExitCode;
use std::time::Instant;

use clap::Parser;
use nalgebra::Vector3;
use rayon::{ThreadPool, ThreadPoolBuilder};
use stickslip::fem::{
    Elastic, Impedance, P1, Trace, dashpot, elasticity, element_stiffness, lumped_mass,
};
use stickslip::friction::RegularizedDieterichRuina;
use stickslip::solvers::IntoOperator;
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{
    BlockMatrix, CentralDifferences, Contact, Diagonal, NonsmoothSolver, Scene, Simulation,
};
use stickslip_cli::cli::{self, Problem};

/// Explicit steps in space, with and without a matrix
#[derive(Debug, Parser)]
#[command(name = "explicit")]
struct Arguments {
    /// Bricks of six cells along each side
    #[arg(long, value_name = "COUNT", num_args = 1.., default_values_t = [40, 80])]
    side: Vec<usize>,
    /// Steps of a round
    #[arg(long, value_name = "COUNT", default_value_t = 10)]
    steps: usize,
    /// Rounds, of which the fastest counts
    #[arg(long, value_name = "COUNT", default_value_t = 5)]
    rounds: usize,
    /// Numbers of threads
    #[arg(long, value_name = "COUNT", num_args = 1.., default_values_t = [1, 2])]
    threads: Vec<usize>,
    /// Levels of local steps, against equal steps of a graded body
    #[arg(long, value_name = "COUNT", conflicts_with = "memory")]
    levels: Option<usize>,
    /// With levels: the radius of the patch that slides, with the smallest cells [m]
    #[arg(long, value_name = "METRES", default_value_t = 25.0)]
    patch: f64,
    /// Without the matrix: the memory of one simulation
    #[arg(long)]
    memory: bool,
}

const ROCK: Elastic = Elastic {
    young_modulus: 8e10,
    poisson_ratio: 0.25,
};
const DENSITY: f64 = 2670.0;

fn main() -> ExitCode {
    cli::run(|arguments: &Arguments| {
        println!("triad: {:.1} GB/s in one thread", triad());
        if let Some(levels) = arguments.levels {
            println!(
                "| vertices | cells of levels | threads | equal \\[ns\\] | local \\[ns\\] | ratio of steps | ratio of run times |\n\
                 | ---: | ---: | ---: | ---: | ---: | ---: | ---: |"
            );
            let mut sides = arguments.side.iter();
            return sides.try_for_each(|&side| local(side, levels, arguments));
        }
        println!(
            "| vertices | cells | threads | matrix \\[ns\\] | elements \\[ns\\] | ratio | memory \\[GiB\\] |\n\
             | ---: | ---: | ---: | ---: | ---: | ---: | ---: |"
        );
        let mut sides = arguments.side.iter();
        sides.try_for_each(|&side| rows(side, arguments))
    })
}

/// The lines of one size.
fn rows(side: usize, arguments: &Arguments) -> Result<(), Problem> {
    let space = P1::<3>::grid([1e3; 3], [side; 3])?;
    let (vertices, cells) = (space.vertex_count(), space.mesh().cell_count());
    let base = space.trace(|x| x[2] == 0.0)?;
    let elements = simulation(&space, &base, element_stiffness(&space, &ROCK)?)?;
    let matrix = match arguments.memory {
        true => None,
        false => Some(simulation(&space, &base, elasticity(&space, &ROCK)?)?),
    };
    let mut bodies = [matrix, Some(elements)];
    for &threads in &arguments.threads {
        let best = best(&mut bodies, arguments, threads)?;
        let [matrix, elements] = best.map(|time| 1e9 * time / vertices as f64);
        println!(
            "| {vertices} | {cells} | {threads} | {matrix:.1} | {elements:.1} | {:.2} | {} |",
            matrix / elements,
            peak_memory().map_or("".into(), |bytes| format!(
                "{:.2}",
                bytes / 1024_f64.powi(3)
            )),
        );
    }
    if let [Some(matrix), Some(elements)] = &bodies {
        let [u, v] = [matrix, elements].map(|body| body.snapshot().displacement);
        let difference = u.iter().zip(v).map(|(u, v)| (u - v).amax());
        let largest = u.iter().map(|u| u.amax()).fold(0.0, f64::max);
        let difference = difference.fold(0.0, f64::max) / largest;
        println!("largest difference of the displacements, relative: {difference:.1e}");
    }
    Ok(())
}

/// The line of one size of a graded body, in equal and in local steps.
fn local(side: usize, levels: usize, arguments: &Arguments) -> Result<(), Problem> {
    let middle = Vector3::new(500.0, 500.0, 0.0);
    let beyond = |x: &Vector3<f64>| ((x - middle).norm() - arguments.patch).max(0.0);
    let edge = 1e3 / side as f64;
    // From an eighth of the edge of a brick, to the edge at half of the way to the sides.
    let space = P1::<3>::grid([1e3; 3], [side; 3])?;
    let space = space.graded(|x| edge * (0.125 + 0.875 * beyond(x) / 250.0))?;
    let base = space.trace(|x| x[2] == 0.0 && beyond(x) == 0.0)?;
    let (equal, mass) = (
        element_stiffness(&space, &ROCK)?,
        lumped_mass(&space, DENSITY)?,
    );
    let local = equal.with_local_steps(&space, &mass, base.vertices(), levels)?;
    let cells = format!("{:?}", local.cells_of_levels());
    let vertices = space.vertex_count();
    let bodies = [
        simulation(&space, &base, equal)?,
        simulation(&space, &base, local)?,
    ];
    let limits = bodies
        .each_ref()
        .map(|body| body.step_limit().unwrap_or(f64::NAN));
    let steps = limits[1] / limits[0];
    let mut bodies = bodies.map(Some);
    for &threads in &arguments.threads {
        let [equal, local] = best(&mut bodies, arguments, threads)?;
        println!(
            "| {vertices} | {cells} | {threads} | {:.1} | {:.1} | {steps:.3} | {:.2} |",
            1e9 * equal / vertices as f64,
            1e9 * local / vertices as f64,
            steps * equal / local
        );
    }
    Ok(())
}

/// The least times of a step of both bodies in a number of threads, in turns \[s\].
fn best(
    bodies: &mut [Option<Simulation<3>>; 2],
    arguments: &Arguments,
    threads: usize,
) -> Result<[f64; 2], Problem> {
    let pool = ThreadPoolBuilder::new().num_threads(threads).build()?;
    let mut best = [f64::INFINITY; 2];
    for _ in 0..arguments.rounds {
        for (body, best) in bodies.iter_mut().zip(&mut best) {
            if let Some(body) = body {
                *best = best.min(round(body, arguments.steps, &pool)?);
            }
        }
    }
    Ok(best)
}

/// A cube that slides on its base.
fn simulation<S>(space: &P1<3>, base: &Trace<3>, stiffness: S) -> Result<Simulation<3>, Problem>
where
    S: IntoOperator<3, Operator: From<BlockMatrix<3>>>,
    Diagonal<3>: NonsmoothSolver<S::Operator, 3>,
{
    let sides =
        space.trace(|x| x[0] == 0.0 || x[0] == 1e3 || x[1] == 0.0 || x[1] == 1e3 || x[2] == 1e3)?;
    let law = RegularizedDieterichRuina {
        a: 0.008,
        b: 0.012,
        reference_friction: 0.6,
        reference_velocity: 1e-6,
        slip_distance: 0.01,
    };
    let aging = Dieterich {
        slip_distance: 0.01,
    };
    let impedance = Impedance::of(&ROCK, DENSITY)?;
    let scene = Scene::new(stiffness)
        .with_mass(lumped_mass(space, DENSITY)?)
        .with_viscosity(dashpot(space, &sides, |_| impedance)?)
        .with_contact(
            Contact::new(base, law, 1e7)
                .with_state(aging, LogTheta(0.0))
                .with_shear_stress(Vector3::new(6.5e6, 0.0, 0.0)),
        )
        .with_velocity(vec![Vector3::new(1e-3, 0.0, 0.0); space.vertex_count()]);
    let mut body = Simulation::new(scene, CentralDifferences, Diagonal::new())?;
    // A step that is too large tells the limit, and leaves everything as it is.
    let _ = body.step(f64::MAX);
    Ok(body)
}

/// The time of a step \[s\].
fn round(body: &mut Simulation<3>, steps: usize, pool: &ThreadPool) -> Result<f64, Problem> {
    let dt = 0.5 * body.step_limit().ok_or("the scheme is implicit")?;
    let begun = Instant::now();
    pool.install(|| (0..steps).try_for_each(|_| body.step(dt).map(|_| ())))?;
    Ok(begun.elapsed().as_secs_f64() / steps as f64)
}

/// The bandwidth of `a = b + s c` \[GB/s\], with three numbers of eight bytes an entry.
fn triad() -> f64 {
    let size = 1 << 23;
    let (mut a, b, c) = (vec![0.0; size], vec![1.0; size], vec![2.0; size]);
    let mut best = f64::INFINITY;
    for _ in 0..8 {
        let begun = Instant::now();
        for ((a, b), c) in a.iter_mut().zip(&b).zip(&c) {
            *a = b + 3.0 * c;
        }
        best = best.min(begun.elapsed().as_secs_f64());
        std::hint::black_box(&mut a);
    }
    24.0 * size as f64 / best / 1e9
}

/// The most memory that this process has had so far \[byte\], where the system tells.
fn peak_memory() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM"))?;
    let kibibytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(1024.0 * kibibytes)
}
