//! Meshes that are the finest themselves: levels of some of their vertices serve as well as coarser meshes.

use std::path::PathBuf;

use crate::common::{
    DENSITY, ELASTIC, Fallible, Problem, REGIMES, Regime, block, cases, dense, slider,
};
use nalgebra::{DMatrix, Rotation2, SMatrix, Vector2};
use proptest::prelude::*;
use stickslip_fem::{Mesh, P1, elasticity, gmsh, mass};
use stickslip_solvers::{SolveError, Tnnmg};

fn example(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../examples/meshes");
    folder.join(name)
}

/// A mesh with its parts "top" and "fault", which is held normal to the last axis.
fn body<const D: usize>(
    mesh: Mesh<D>,
    regime: Regime,
) -> Result<Problem<D>, Box<dyn std::error::Error>> {
    let space = P1::new(mesh).with_auxiliary_levels()?;
    assert!(!space.transfers().1.is_empty());
    let operators = (elasticity(&space, &ELASTIC)?, mass(&space, DENSITY)?);
    let parts = (space.part("top")?, space.part("fault")?);
    let closed = std::array::from_fn(|c| c == D - 1);
    Ok(Problem::new(&space, operators, parts, closed, regime, 2)?)
}

/// The cycles that reduce an error by ten orders of magnitude.
fn cycles<const D: usize>(problem: &Problem<D>) -> Result<usize, Box<dyn std::error::Error>> {
    let mut solver = Tnnmg::new(&problem.transfers);
    let mut v = problem.nearby(1e-4, 3);
    let goal = 1e-10 * problem.error(&v);
    let report = problem.solve(&mut solver, goal, &mut v)?;
    assert!(problem.error(&v) <= goal);
    Ok(report.cycles)
}

/// With inertia, and without: at a step of 1 s it is a share of 1e-4 of the operator.
const TIME_STEPS: [f64; 2] = [crate::common::TIME_STEP, 1.0];

fn compare<const D: usize>(
    given: &mut Problem<D>,
    nested: &mut Problem<D>,
    what: Regime,
) -> Fallible {
    for tau in TIME_STEPS {
        given.set_time_step(tau);
        nested.set_time_step(tau);
        let (found, expected) = (cycles(given)?, cycles(nested)?);
        assert!(
            found <= 2 * expected,
            "{what:?}, {tau:e}: {found} cycles, {expected} on nested meshes"
        );
    }
    Ok(())
}

#[test]
fn a_mesh_from_a_file_takes_at_most_twice_the_cycles_of_nested_ones() -> Fallible {
    let plane = gmsh::read::<2>(example("slider.msh"))?;
    for regime in REGIMES {
        compare(
            &mut body(plane.clone(), regime)?,
            &mut slider(4, regime, 2)?,
            regime,
        )?;
    }
    // Some thousand tetrahedra without any order; their own coarser mesh is not used.
    let solid = P1::new(gmsh::read::<3>(example("block.msh"))?).refined(1)?;
    for regime in [Regime::Stick, Regime::Slip] {
        compare(
            &mut body(solid.mesh().clone(), regime)?,
            &mut block(3, regime, 2)?,
            regime,
        )?;
    }
    Ok(())
}

/// As few cells as leave a coarser level to be made.
const CELLS: [usize; 2] = [11, 9];
/// Two a vertex.
const SHIFTS: usize = 2 * (CELLS[0] + 1) * (CELLS[1] + 1);

/// A rectangle of well-shaped cells, its inner vertices moved by up to a fifth of a cell, turned, and graded.
fn random(shifts: &[f64], angle: f64, grading: f64) -> Mesh<2> {
    let length = 0.1 * CELLS[0] as f64;
    let grid = P1::grid([length, 1.0], CELLS).expect("valid grid");
    let inside = |x: f64, end: f64| x > 1e-9 && x < end - 1e-9;
    let turn = Rotation2::new(angle);
    let vertices = grid
        .mesh()
        .vertices()
        .iter()
        .zip(shifts.chunks(2))
        .map(|(x, shift)| {
            let mut x = *x;
            if inside(x[0], length) && inside(x[1], 1.0) {
                x += Vector2::from_column_slice(shift) * 0.02;
            }
            turn * Vector2::new(x[0], x[1] * (1.0 + grading * x[1]))
        });
    let cells = grid.mesh().cells().flatten().copied().collect();
    Mesh::new(vertices.collect(), cells).expect("no cell is inverted")
}

proptest! {
    #![proptest_config(cases(12))]

    /// A coarse vertex is a fine one, so that `P^T P` is at least the identity, and no coarse operator has a smaller
    /// eigenvalue than the operator itself.
    #[test]
    fn coarse_operators_are_as_definite_as_the_finest(
        shifts in prop::collection::vec(-1.0..1.0, SHIFTS),
        angle in 0.0..6.3,
        grading in 0.0..3.0,
    ) {
        let space = P1::new(random(&shifts, angle, grading)).with_auxiliary_levels().expect("small");
        let stiffness = elasticity(&space, &ELASTIC).expect("valid material");
        let inertia = mass::<2, 2>(&space, 1e7).expect("valid density");
        let operator = dense(&stiffness) + dense(&inertia);
        // A factor tells on which side of the smallest eigenvalue a number is, for a small share of what that takes.
        let is_above = |bound: f64| {
            let size = operator.nrows();
            (operator.clone() - DMatrix::identity(size, size) * bound).cholesky().is_some()
        };
        let mut matrix = operator.clone();
        prop_assert!(!space.transfers().1.is_empty());
        for prolongation in space.transfers().1.iter().rev() {
            let mut p = DMatrix::zeros(2 * prolongation.rows(), 2 * prolongation.cols());
            for (&weight, (i, j)) in prolongation.iter() {
                let block = SMatrix::<f64, 2, 2>::identity() * weight;
                p.fixed_view_mut::<2, 2>(2 * i as usize, 2 * j as usize).copy_from(&block);
            }
            matrix = p.transpose() * &matrix * p;
            let rounding = 1e-12 * matrix.amax() * matrix.nrows() as f64;
            let least = matrix.clone().symmetric_eigenvalues().min();
            prop_assert!(!is_above(least + rounding));
        }
    }

    #[test]
    fn the_minimiser_is_found_on_any_mesh(
        shifts in prop::collection::vec(-1.0..1.0, SHIFTS),
        angle in 0.0..6.3,
        grading in 0.0..3.0,
        regime in prop::sample::select(REGIMES.to_vec()),
    ) {
        let mesh = random(&shifts, angle, grading);
        let height = 1.0 + grading;
        let space = P1::new(mesh).with_auxiliary_levels().expect("small");
        let back = Rotation2::new(-angle);
        let at = |y: f64| space.trace(move |x| ((back * x)[1] - y).abs() < 1e-9).expect("a side");
        let operators = (
            elasticity(&space, &ELASTIC).expect("valid material"),
            mass(&space, DENSITY).expect("valid density"),
        );
        let problem = Problem::new(&space, operators, (at(height), at(0.0)), [false; 2], regime, 5)
            .expect("valid parts");
        cycles(&problem).expect("converges");
    }
}

/// A list of transfers that is none, and one with a weight that is no number.
#[test]
fn transfers_that_do_not_fit_one_another_are_refused() -> Fallible {
    let problem = slider(2, Regime::Slip, 1)?;
    let good = problem.transfers.prolongations();
    let answer =
        |transfers: &[_]| problem.solve(&mut Tnnmg::new(transfers), 1e-9, &mut problem.at_rest());
    let (last, first) = (good[1].clone(), good[0].clone());
    let mismatch = SolveError::TransferMismatch {
        level: 1,
        rows: last.rows(),
        columns: first.cols(),
    };
    assert_eq!(answer(&[last.clone(), first.clone()]), Err(mismatch));
    let mut broken = last;
    broken.data_mut()[5] = f64::INFINITY;
    let (_, (row, column)) = broken.iter().nth(5).ok_or("more than five weights")?;
    let weight = SolveError::TransferWeight {
        level: 1,
        row: row as usize,
        column: column as usize,
        weight: f64::INFINITY,
    };
    assert_eq!(answer(&[first, broken]), Err(weight));
    Ok(())
}
