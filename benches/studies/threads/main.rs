//! The gain by threads over the size of the body.
//!
//! A body of equal sides that stands on a held base is pulled sideways, and `Tnnmg` solves for its displacement, in one
//! thread and in several, in turns: the time a cycle, of the fastest of the rounds, with the sweep and the vector
//! operations that belong to it. The displacement must be the same bits.
//!
//! ```text
//! cargo run --release --manifest-path benches/studies/Cargo.toml --bin threads
//! ```

use std::process::ExitCode;
use std::time::Instant;

use clap::Parser;
use nalgebra::SVector;
use rayon::{ThreadPool, ThreadPoolBuilder};
use stickslip::fem::{Constraints, Elastic, P1, body_force, elasticity};
use stickslip::friction::{Radial, Tresca};
use stickslip::solvers::{Energy, Stopping};
use stickslip::{NonsmoothSolver, Tnnmg};
use stickslip_cli::cli::{self, Problem};

const STEEL: Elastic = Elastic {
    young_modulus: 2e11,
    poisson_ratio: 0.3,
};

/// The time of a cycle in several threads
#[derive(Debug, Parser)]
#[command(name = "threads")]
struct Arguments {
    /// Refinements of a square of two cells, from 1
    #[arg(long, value_name = "COUNT", num_args = 0.., default_values_t = [7, 8, 9])]
    square: Vec<usize>,
    /// Refinements of a cube of three cells a side, from 1
    #[arg(long, value_name = "COUNT", num_args = 0.., default_values_t = [3, 4])]
    cube: Vec<usize>,
    /// Numbers of threads
    #[arg(long, value_name = "COUNT", num_args = 1.., default_values_t = [1, 2])]
    threads: Vec<usize>,
    /// The repetitions of each measurement
    #[arg(long, value_name = "COUNT", default_value_t = 5)]
    rounds: usize,
}

fn main() -> ExitCode {
    cli::run(|arguments: &Arguments| {
        let pools = (arguments.threads.iter())
            .map(|&threads| ThreadPoolBuilder::new().num_threads(threads).build())
            .collect::<Result<Vec<_>, _>>()?;
        print!("| body | unknowns | cycles |");
        for threads in &arguments.threads {
            print!(" {threads} |");
        }
        println!("\n| --- | ---: | ---: |{}", " ---: |".repeat(pools.len()));
        for &refinements in &arguments.square {
            row::<2>(("square", 1), refinements, &pools, arguments.rounds)?;
        }
        for &refinements in &arguments.cube {
            row::<3>(("cube", 3), refinements, &pools, arguments.rounds)?;
        }
        Ok(())
    })
}

/// One line of the table: milliseconds a cycle, by the number of threads. The body has so many cells a side that are refined.
fn row<const D: usize>(
    (name, cells): (&str, usize),
    refinements: usize,
    pools: &[ThreadPool],
    rounds: usize,
) -> Result<(), Problem> {
    let space = P1::<D>::grid([1.0; D], [cells; D])?.refined(refinements)?;
    let base = space.trace(|x| x[D - 1] == 0.0)?;
    let mut fixed = Constraints::none(&space);
    fixed.fix(&base, [true; D])?;
    let operator = elasticity(&space, &STEEL)?.into_matrix();
    let load = body_force(&space, |_| SVector::from_fn(|c, _| f64::from(c == 0)));
    let friction: Vec<Radial<Tresca>> = Vec::new();
    let energy = Energy {
        operator: &operator,
        load: &load,
        potentials: &friction,
        vertices: &[],
        fixed: fixed.as_slice(),
    };
    let stopping = Stopping {
        norm: &operator,
        tolerance: 0.0,
        relative: 1e-8,
        equivalence: 1.0,
        max_iterations: 20,
    };
    let mut solver = Tnnmg::new(space.transfers());
    solver.prepare(&energy)?;
    let start = vec![SVector::zeros(); space.vertex_count()];
    let (mut first, mut cycles) = (None, 0);
    let mut best = vec![f64::INFINITY; pools.len()];
    for _ in 0..rounds {
        for (pool, best) in pools.iter().zip(&mut best) {
            let mut v = start.clone();
            let begun = Instant::now();
            let report = pool.install(|| solver.minimize(&energy, &stopping, &mut v))?;
            let milliseconds = 1e3 * begun.elapsed().as_secs_f64() / report.cycles as f64;
            *best = best.min(milliseconds);
            cycles = report.cycles;
            if *first.get_or_insert_with(|| v.clone()) != v {
                return Err("the displacement depends on the number of threads".into());
            }
        }
    }
    print!("| {name} | {} | {cycles} |", D * space.vertex_count());
    for milliseconds in best {
        print!(" {milliseconds:.2} |");
    }
    println!();
    Ok(())
}
