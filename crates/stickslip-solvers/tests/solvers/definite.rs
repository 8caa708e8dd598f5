//! Weakening at blocks that are solved one by one, against eigenvalues.

use nalgebra::{DMatrix, SMatrix, SVector};
use proptest::prelude::*;
use stickslip_friction::{DieterichRuina, Radial};
use stickslip_solvers::{BlockMatrix, Diagonal, Energy, NonsmoothSolver};
use stickslip_state::LogTheta;

use crate::common::{LAW, Numbers, dense};

/// A symmetric block with eigenvalues of at least `least`.
fn block<const C: usize>(least: f64, numbers: &mut Numbers) -> SMatrix<f64, C, C> {
    let root = SMatrix::<f64, C, C>::from_fn(|_, _| numbers.next());
    root * root.transpose() + SMatrix::identity() * least
}

/// Blocks of which the last two are coupled, if the coupling is not zero.
fn matrix<const C: usize>(size: usize, paired: bool, numbers: &mut Numbers) -> BlockMatrix<C> {
    let coupling = SMatrix::<f64, C, C>::from_fn(|_, _| 0.3 * numbers.next());
    let (mut starts, mut columns, mut values) = (vec![0], Vec::new(), Vec::new());
    for i in 0..size {
        let own = (i, block(2.0, numbers));
        let row = match size - i {
            2 if paired => vec![own, (i + 1, coupling)],
            1 if paired => vec![(i - 1, coupling.transpose()), own],
            _ => vec![own],
        };
        for (column, block) in row {
            columns.push(column as u32);
            values.push(block);
        }
        starts.push(columns.len() as u32);
    }
    BlockMatrix::new((size, size), starts, columns, values)
}

/// The least eigenvalue on free components with slopes added at the vertices.
fn least<const C: usize>(
    operator: &BlockMatrix<C>,
    fixed: &[[bool; C]],
    (vertices, slopes): (&[usize], &[f64]),
) -> f64 {
    let mut whole: DMatrix<f64> = dense(operator);
    for (&vertex, slope) in vertices.iter().zip(slopes) {
        for c in 0..C {
            whole[(C * vertex + c, C * vertex + c)] += slope;
        }
    }
    let free: Vec<usize> = (0..whole.nrows())
        .filter(|&k| !fixed[k / C][k % C])
        .collect();
    if free.is_empty() {
        return f64::INFINITY;
    }
    let part = whole.select_rows(&free).select_columns(&free);
    part.symmetric_eigenvalues().min()
}

fn check<const C: usize>(
    (size, paired): (usize, bool),
    steepest: f64,
    seed: u64,
) -> Result<(), TestCaseError> {
    let numbers = &mut Numbers(seed);
    let operator: BlockMatrix<C> = matrix(size, paired, numbers);
    let fixed: Vec<[bool; C]> = (0..size)
        .map(|_| std::array::from_fn(|_| numbers.between(0.0, 1.0) < 0.2))
        .collect();
    // Of a pair one vertex has friction at most.
    let vertices: Vec<usize> = (0..size - usize::from(paired))
        .filter(|_| numbers.between(0.0, 1.0) < 0.7)
        .collect();
    let law = Radial {
        law: LAW,
        force: 1.0,
        state: LogTheta(0.0),
    };
    let potentials: Vec<Radial<DieterichRuina>> = vec![law; vertices.len()];
    let load = vec![SVector::zeros(); size];
    let energy = Energy {
        operator: &operator,
        load: &load,
        potentials: &potentials,
        vertices: &vertices,
        fixed: &fixed,
    };
    let mut solver = Diagonal::new();
    NonsmoothSolver::<BlockMatrix<C>, C>::prepare(&mut solver, &energy).expect("blocks");
    let slopes: Vec<f64> = vertices
        .iter()
        .map(|_| steepest * numbers.between(-1.0, 0.2))
        .collect();
    let least = least(&operator, &fixed, (&vertices, &slopes));
    let mut told = |slopes: &[f64]| {
        NonsmoothSolver::<BlockMatrix<C>, C>::is_definite_with(&mut solver, slopes)
    };
    if least.abs() > 1e-9 {
        prop_assert_eq!(told(&slopes), Some(least > 0.0), "{}", least);
    }
    prop_assert_eq!(told(&vec![0.0; vertices.len()]), Some(true));
    let free = vertices
        .iter()
        .position(|&vertex| fixed[vertex].contains(&false));
    if let Some(k) = free {
        let mut wrong = slopes;
        wrong[k] = f64::NAN;
        prop_assert_eq!(told(&wrong), Some(false));
    }
    Ok(())
}

proptest! {
    /// A matrix of blocks is positive definite if each of them is.
    #[test]
    fn blocks_resist_weakening_one_by_one(
        size in 2..7usize,
        paired in any::<bool>(),
        steepest in 0.5..6.0,
        seed in any::<u64>(),
    ) {
        check::<1>((size, paired), steepest, seed)?;
        check::<2>((size, paired), steepest, seed)?;
        check::<3>((size, paired), steepest, seed)?;
    }
}
