//! Linear problems: three solvers and a dense factorisation agree, and say no to what they cannot do.

use nalgebra::{DMatrix, DVector, SMatrix, SVector};
use proptest::prelude::*;
use stickslip_solvers::{
    BlockMatrix, Cholesky, ConjugateGradients, LinearSolver, Matrix, MultigridSolver, Operator,
    SolveError,
};

use crate::common::{
    Fallible, Numbers, Problem, Regime, antiplane, block, cases, dense, levels, slider,
};

type Boxed<const C: usize> = Box<dyn LinearSolver<BlockMatrix<C>, C>>;

fn solvers<const C: usize>(problem: &Problem<C>) -> [Boxed<C>; 3] {
    [
        Box::new(ConjugateGradients::default()),
        Box::new(MultigridSolver::new(&problem.transfers)),
        Box::new(Cholesky::new()),
    ]
}

/// `B x = r` on the free components of a dense matrix.
fn oracle<const C: usize>(
    operator: &BlockMatrix<C>,
    fixed: &[[bool; C]],
    load: &[SVector<f64, C>],
    start: &[SVector<f64, C>],
) -> Vec<SVector<f64, C>> {
    let matrix = dense(operator);
    let flat = |field: &[SVector<f64, C>]| {
        DVector::from_iterator(C * field.len(), field.iter().flatten().copied())
    };
    let free: Vec<usize> = (0..C * fixed.len())
        .filter(|&i| !fixed[i / C][i % C])
        .collect();
    let mut x = start.to_vec();
    for &i in &free {
        x[i / C][i % C] = 0.0;
    }
    let left = flat(load) - &matrix * flat(&x);
    let reduced = DMatrix::from_fn(free.len(), free.len(), |i, j| matrix[(free[i], free[j])]);
    let right = DVector::from_fn(free.len(), |i, _| left[free[i]]);
    let solution = reduced.cholesky().expect("definite").solve(&right);
    for (&i, value) in free.iter().zip(&solution) {
        x[i / C][i % C] = *value;
    }
    x
}

/// In the norm of the stiffness, where conjugate gradients know their error; the condition number of
/// these meshes is some thousands.
fn agree<const C: usize>(problem: &Problem<C>, seed: u64) -> Result<(), TestCaseError> {
    let mut numbers = Numbers(seed);
    let size = problem.exact.len();
    let mut random = || -> Vec<SVector<f64, C>> {
        (0..size)
            .map(|_| SVector::from_fn(|_, _| numbers.next()))
            .collect()
    };
    let (load, start) = (random(), random());
    let expected = oracle(&problem.stiffness, &problem.fixed, &load, &start);
    let scale = problem.stiffness.norm(&expected);
    for (kind, mut solver) in solvers(problem).into_iter().enumerate() {
        let fail = |e: SolveError| TestCaseError::fail(format!("{kind}: {e}"));
        let mut x = start.clone();
        solver
            .prepare(&problem.stiffness, &problem.fixed)
            .map_err(fail)?;
        solver
            .solve(&problem.stiffness, &load, &mut x)
            .map_err(fail)?;
        let difference: Vec<_> = x.iter().zip(&expected).map(|(x, y)| x - y).collect();
        let distance = problem.stiffness.norm(&difference);
        prop_assert!(
            distance <= 1e-10 * scale,
            "{kind}: {distance:e} of {scale:e}"
        );
        for (i, fixed) in problem.fixed.iter().enumerate() {
            for c in (0..C).filter(|&c| fixed[c]) {
                prop_assert_eq!(x[i][c], start[i][c]);
            }
        }
        // Of the solution nothing is left to do.
        let again = x.clone();
        solver
            .solve(&problem.stiffness, &load, &mut x)
            .map_err(fail)?;
        let moved: Vec<_> = x.iter().zip(&again).map(|(x, y)| x - y).collect();
        prop_assert!(problem.stiffness.norm(&moved) <= 1e-10 * scale);
    }
    Ok(())
}

proptest! {
    #![proptest_config(cases(24))]

    #[test]
    fn all_find_what_a_dense_factorisation_finds(level in levels(0..3), seed in any::<u64>()) {
        agree(&slider(level, Regime::Slip, 1).expect("valid"), seed)?;
        agree(&antiplane(level, Regime::Slip, 1).expect("valid"), seed)?;
        agree(&block(level.min(1), Regime::Slip, 1).expect("valid"), seed)?;
    }
}

/// One iteration of conjugate gradients inverts a lumped mass, block by block, to rounding.
#[test]
fn a_diagonal_operator_is_inverted_at_once() -> Fallible {
    let values: Vec<_> = (0..50)
        .map(|i| SMatrix::<f64, 2, 2>::identity() * 1.7_f64.powi(i - 25))
        .collect();
    let count = values.len();
    let operator = BlockMatrix::new(
        (count, count),
        (0..=count as u32).collect(),
        (0..count as u32).collect(),
        values.clone(),
    );
    let (load, mut x) = (
        vec![SVector::from([3.0, -1.0]); count],
        vec![SVector::zeros(); count],
    );
    let mut solver = ConjugateGradients::default();
    solver.prepare(&operator, &vec![[false; 2]; count])?;
    solver.solve(&operator, &load, &mut x)?;
    for (x, block) in x.iter().zip(&values) {
        let exact = SVector::from([3.0, -1.0]) / block[(0, 0)];
        assert!((x - exact).norm() <= 1e-15 * exact.norm());
    }
    Ok(())
}

#[test]
fn what_cannot_be_solved_is_refused() -> Fallible {
    let problem = slider(1, Regime::Slip, 1)?;
    let size = problem.exact.len();
    for mut solver in solvers(&problem) {
        let short = &problem.fixed[1..];
        let (expected, found) = (size, size - 1);
        let mismatch = Err(SolveError::SizeMismatch { expected, found });
        assert_eq!(solver.prepare(&problem.stiffness, short), mismatch);
        solver.prepare(&problem.stiffness, &problem.fixed)?;
        let mut x = problem.at_rest();
        assert_eq!(
            solver.solve(&problem.stiffness, &problem.load[1..], &mut x),
            mismatch
        );
        assert_eq!(
            solver.solve(&problem.stiffness, &problem.load, &mut x[1..]),
            mismatch
        );
        let mut load = problem.load.clone();
        load[3][0] = f64::NAN;
        let lost = solver.solve(&problem.stiffness, &load, &mut x);
        assert!(
            matches!(lost, Err(SolveError::NotFinite { .. })),
            "{lost:?}"
        );
        // Nothing at all, and a body that floats.
        let nothing = BlockMatrix::combination(&[(0.0, &problem.stiffness)]);
        let refused = solver.prepare(&nothing, &problem.fixed);
        assert_eq!(refused, Err(SolveError::IndefiniteBlock { vertex: 0 }));
        let free = vec![[false; 2]; size];
        let mut x = problem.at_rest();
        let floats = (solver.prepare(&problem.stiffness, &free))
            .and_then(|()| solver.solve(&problem.stiffness, &problem.load, &mut x));
        let far = x.iter().any(|x| x.norm() > 1e3);
        assert!(floats.is_err() || far, "{floats:?}");
    }
    Ok(())
}
