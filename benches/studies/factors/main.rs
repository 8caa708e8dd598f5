//! The cost of a factor over the size of the body, in the plane and in space.
//!
//! The entries of the factor by the order that the library takes, with the feature `dissection` or without, and by
//! minimum degree alone; the time of the factor and of a solve, and beside them those of multigrid. A cube of 100 000
//! unknowns takes minutes.
//!
//! ```text
//! cargo run --release --manifest-path benches/studies/Cargo.toml --bin factors -- \
//!     --unknowns 20000 100000
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
use stickslip::fem::{Assembled, Constraints, Elastic, P1, elasticity};
use stickslip::friction::{Radial, Tresca};
use stickslip::solvers::{Energy, SolveError, SolveReport, Stopping};
use stickslip::{BlockMatrix, Condensed, NonsmoothSolver, Tnnmg};
use stickslip_cli::cli::{self, Problem};

const STEEL: Elastic = Elastic {
    young_modulus: 2e11,
    poisson_ratio: 0.3,
};

/// The fewest cells along a side of the coarsest mesh.
const COARSEST: f64 = 4.0;
/// The share of its change to which the motion is solved for.
const RELATIVE: f64 = 1e-10;

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
            "| body | unknowns | entries | by minimum degree | ratio | analysis and factor | factor | solve | levels | cycles | solve |\n\
             | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |"
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
    let cells = (unknowns as f64 / D as f64).powf(1.0 / D as f64) - 1.0;
    let refinements = (cells / COARSEST).log2().floor().max(0.0) as usize;
    let coarsest = (cells / 2_f64.powi(refinements as i32)).round() as usize;
    let space = P1::<D>::grid([1.0; D], [coarsest; D])?.refined(refinements)?;
    let base = space.trace(|x| x[D - 1] == 0.0)?;
    let mut fixed = Constraints::none(&space);
    fixed.fix(&base, [true; D])?;
    let fixed = fixed.as_slice();
    let mut operators =
        [elasticity(&space, &STEEL)?, elasticity(&space, &STEEL)?].map(Assembled::into_matrix);
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
    let (free, by_degree) = by_minimum_degree(&operators[0], fixed)?;
    let energies = [energy(&operators[0]), energy(&operators[1])];
    let mut factor = Condensed::new()
        .with_memory_limit(memory)
        .with_cached_factors(1);
    print!("| {name} | {free} ");
    match timed(&mut factor, &energies) {
        Ok((first, second, solve, _)) => {
            let entries = factor.counters().factor_entries;
            print!(
                "| {entries} | {by_degree} | {:.2} | {first:.2} s | {second:.2} s | {solve:.3} s ",
                entries as f64 / by_degree as f64,
            );
        }
        Err(error) => print!("| {error} | {by_degree} | | | | "),
    }
    let (first, _, solve, report) = timed(&mut Tnnmg::new(space.transfers()), &energies)?;
    println!("| {first:.2} s | {} | {solve:.3} s |", report.cycles);
    Ok(())
}

/// The seconds to prepare for an operator, for another one of its pattern, and to solve with that.
fn timed<const C: usize>(
    solver: &mut impl NonsmoothSolver<BlockMatrix<C>, C>,
    energies: &[Energy<'_, BlockMatrix<C>, C>; 2],
) -> Result<(f64, f64, f64, SolveReport), SolveError> {
    let begun = Instant::now();
    solver.prepare(&energies[0])?;
    let first = begun.elapsed().as_secs_f64();
    let begun = Instant::now();
    solver.prepare(&energies[1])?;
    let second = begun.elapsed().as_secs_f64();
    let stopping = Stopping {
        norm: energies[1].operator,
        tolerance: f64::MIN_POSITIVE,
        relative: RELATIVE,
        equivalence: 1.0,
        max_iterations: 100,
    };
    let mut v = vec![SVector::zeros(); energies[1].load.len()];
    let begun = Instant::now();
    let report = solver.minimize(&energies[1], &stopping, &mut v)?;
    Ok((first, second, begun.elapsed().as_secs_f64(), report))
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
