//! What does a factor take as the body grows, in the plane and in space?
//!
//! The entries of the factor by the order that the library takes, and by minimum degree alone; the time of the factor
//! and of a solve. A cube of 100 000 unknowns takes minutes.
//!
//! ```text
//! cargo run --release --manifest-path studies/Cargo.toml --bin factors -- --unknowns 20000 100000
//! ```

use std::process::ExitCode;
use std::time::Instant;

use clap::Parser;
use faer::Side;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{Pair, SymbolicSparseColMat};
use nalgebra::SVector;
use stickslip::fem::{Constraints, Elastic, P1, elasticity};
use stickslip::friction::{Radial, Tresca};
use stickslip::tnnmg::{Energy, Stopping};
use stickslip::{BlockMatrix, Condensed, NonsmoothSolver};
use support::cli::{self, Problem};

const STEEL: Elastic = Elastic {
    young_modulus: 2e11,
    poisson_ratio: 0.3,
};

/// Entries and times of factors
#[derive(Debug, Parser)]
#[command(name = "factors")]
struct Arguments {
    /// About so many unknowns in each body
    #[arg(long, value_name = "COUNT", num_args = 1.., default_values_t = [20_000, 100_000])]
    unknowns: Vec<usize>,
    /// The memory that a factor may take [GiB]
    #[arg(long, value_name = "GIB", default_value_t = 4)]
    memory: usize,
}

fn main() -> ExitCode {
    cli::run(|arguments: &Arguments| {
        println!(
            "| body | unknowns | entries | by minimum degree | ratio | analysis and factor | factor | solve |\n\
             | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |"
        );
        let memory = arguments.memory << 30;
        for &unknowns in &arguments.unknowns {
            row::<2>("square", unknowns, memory)?;
        }
        for &unknowns in &arguments.unknowns {
            row::<3>("cube", unknowns, memory)?;
        }
        Ok(())
    })
}

/// One line of the table: a body of equal sides that stands on a held base and is pulled sideways.
fn row<const D: usize>(name: &str, unknowns: usize, memory: usize) -> Result<(), Problem> {
    let cells = (unknowns as f64 / D as f64).powf(1.0 / D as f64).round() as usize - 1;
    let space = P1::<D>::grid([1.0; D], [cells; D])?;
    let base = space.trace(|x| x[D - 1] == 0.0)?;
    let mut fixed = Constraints::none(&space);
    fixed.hold(&base, [true; D])?;
    let fixed = fixed.as_slice();
    let mut operators = [elasticity(&space, &STEEL)?, elasticity(&space, &STEEL)?];
    operators[1]
        .data_mut()
        .iter_mut()
        .for_each(|block| *block *= 2.0);
    let load = stickslip::fem::body_force(&space, |_| SVector::from_fn(|c, _| f64::from(c == 0)));
    let friction: Vec<Radial<Tresca>> = Vec::new();
    let energy = |operator| Energy {
        operator,
        load: &load,
        potentials: &friction,
        vertices: &[],
        fixed,
    };
    let mut solver = Condensed::new()
        .with_memory_limit(memory)
        .with_cached_factors(1);
    let begun = Instant::now();
    if let Err(error) = solver.prepare(&energy(&operators[0])) {
        println!("| {name} | {} | {error} |", D * space.vertex_count());
        return Ok(());
    }
    let first = begun.elapsed().as_secs_f64();
    let begun = Instant::now();
    solver.prepare(&energy(&operators[1]))?;
    let factor = begun.elapsed().as_secs_f64();
    let stopping = Stopping {
        norm: &operators[1],
        tolerance: 1e-9,
        relative: 0.0,
        equivalence: 1.0,
        max_iterations: 10,
    };
    let mut v = vec![SVector::zeros(); space.vertex_count()];
    let begun = Instant::now();
    solver.minimize(&energy(&operators[1]), &stopping, &mut v)?;
    let solve = begun.elapsed().as_secs_f64();
    let (free, by_degree) = by_minimum_degree(&operators[0], fixed)?;
    let entries = solver.counters().factor_entries;
    println!(
        "| {name} | {free} | {entries} | {by_degree} | {:.2} | {first:.2} s | {factor:.2} s | {solve:.3} s |",
        entries as f64 / by_degree as f64,
    );
    Ok(())
}

/// The free components, and the entries of their supernodal factor by minimum degree alone, merged as faer does it.
fn by_minimum_degree<const C: usize>(
    operator: &BlockMatrix<C>,
    fixed: &[[bool; C]],
) -> Result<(usize, usize), Problem> {
    let mut count = 0;
    let mut places = vec![[None; C]; fixed.len()];
    for (places, fixed) in places.iter_mut().zip(fixed) {
        for c in (0..C).filter(|&c| !fixed[c]) {
            places[c] = Some(count);
            count += 1;
        }
    }
    let mut entries = Vec::new();
    for (_, (i, j)) in operator.iter() {
        for row in places[i as usize].into_iter().flatten() {
            let columns = places[j as usize].into_iter().flatten();
            entries.extend(
                columns
                    .filter(|&col| row >= col)
                    .map(|col| Pair { row, col }),
            );
        }
    }
    let failed = |error: &dyn std::fmt::Debug| Problem::from(format!("{error:?}"));
    let (pattern, _) = SymbolicSparseColMat::try_new_from_indices(count, count, &entries)
        .map_err(|error| failed(&error))?;
    let params = CholeskySymbolicParams {
        supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
        ..Default::default()
    };
    let order = SymmetricOrdering::Amd;
    let symbolic = factorize_symbolic_cholesky(pattern.as_ref(), Side::Lower, order, params)
        .map_err(|error| failed(&error))?;
    Ok((count, symbolic.len_val()))
}
