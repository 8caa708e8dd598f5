//! Operators are the dense matrices that they stand for.

use crate::common::{Numbers, cases, dense};
use nalgebra::{DMatrix, DVector, SMatrix, SVector};
use proptest::prelude::*;
use stickslip_solvers::{Basis, BlockMatrix, Frames, Matrix, Operator, Symmetric};

/// A symmetric matrix with its diagonal and a random share of the other blocks.
pub(crate) fn sparse<const C: usize>(
    size: usize,
    share: f64,
    numbers: &mut Numbers,
) -> BlockMatrix<C> {
    let mut full = DMatrix::zeros(C * size, C * size);
    let mut stored = vec![vec![false; size]; size];
    for i in 0..size {
        for j in 0..=i {
            stored[i][j] = i == j || numbers.between(0.0, 1.0) < share;
            stored[j][i] = stored[i][j];
        }
    }
    for i in 0..C * size {
        for j in 0..=i {
            full[(i, j)] = numbers.next();
            full[(j, i)] = full[(i, j)];
        }
    }
    let (mut starts, mut columns, mut values) = (vec![0], Vec::new(), Vec::new());
    for i in 0..size {
        for j in (0..size).filter(|&j| stored[i][j]) {
            columns.push(j as u32);
            values.push(SMatrix::from_fn(|r, c| full[(C * i + r, C * j + c)]));
        }
        starts.push(columns.len() as u32);
    }
    BlockMatrix::new((size, size), starts, columns, values)
}

pub(crate) fn flat<const C: usize>(field: &[SVector<f64, C>]) -> DVector<f64> {
    DVector::from_iterator(
        C * field.len(),
        field.iter().flat_map(|x| x.iter().copied()),
    )
}

fn check<const C: usize>(size: usize, seed: u64) -> Result<(), TestCaseError> {
    let mut numbers = Numbers(seed);
    let shares = [0.0, 0.2, 0.6, 1.0];
    let operators: Vec<BlockMatrix<C>> = shares
        .iter()
        .map(|&share| sparse(size, share, &mut numbers))
        .collect();
    let rounding = 1e-14 * (C * size) as f64;

    // Any terms in any order, some of them twice, on the union of their patterns.
    let draw = |numbers: &mut Numbers| -> Vec<(f64, &BlockMatrix<C>)> {
        let count = 1 + (numbers.between(0.0, 4.0) as usize).min(3);
        (0..count)
            .map(|_| {
                let k = (numbers.between(0.0, 4.0) as usize).min(3);
                (3.0 * numbers.next(), &operators[k])
            })
            .collect()
    };
    let expected = |terms: &[(f64, &BlockMatrix<C>)]| {
        terms
            .iter()
            .fold(DMatrix::zeros(C * size, C * size), |sum, (factor, term)| {
                sum + dense(term) * *factor
            })
    };
    let terms = draw(&mut numbers);
    let mut sum = BlockMatrix::combination(&terms);
    prop_assert!((dense(&sum) - expected(&terms)).amax() <= rounding);
    let pattern = |operator: &BlockMatrix<C>, i: usize, j: usize| operator.get(i, j).is_some();
    for i in 0..size {
        for j in 0..size {
            let union = terms.iter().any(|(_, term)| pattern(term, i, j));
            prop_assert_eq!(pattern(&sum, i, j), union);
        }
    }
    // The same operators with other factors, and in another order.
    let mut others = terms.clone();
    others.reverse();
    for (factor, _) in &mut others {
        *factor = numbers.next();
    }
    sum.set_combination(&others);
    prop_assert!((dense(&sum) - expected(&others)).amax() <= rounding);

    let x: Vec<SVector<f64, C>> = (0..size)
        .map(|_| SVector::from_fn(|_, _| numbers.next()))
        .collect();
    let y: Vec<SVector<f64, C>> = (0..size)
        .map(|_| SVector::from_fn(|_, _| numbers.next()))
        .collect();
    let matrix = dense(&sum);
    let mut z = y.clone();
    sum.multiply_add(-1.5, &x, &mut z);
    prop_assert!((flat(&z) - flat(&y) + &matrix * flat(&x) * 1.5).amax() <= 4.0 * rounding);
    let quadratic = flat(&x).dot(&(&matrix * flat(&x)));
    prop_assert!((sum.quadratic(&x) - quadratic).abs() <= rounding * (C * size) as f64);
    prop_assert_eq!(sum.vertex_count(), size);
    let norm = sum.norm(&x);
    let square = sum.quadratic(&x).max(0.0);
    prop_assert!((norm * norm - square).abs() <= rounding * (1.0 + square));
    Ok(())
}

proptest! {
    #![proptest_config(cases(96))]

    #[test]
    fn combinations_are_dense_sums(size in 1..14_usize, seed in any::<u64>()) {
        check::<1>(size, seed)?;
        check::<2>(size, seed)?;
        check::<3>(size, seed)?;
    }
}

/// A product must not take it for diagonal because it has as many blocks as rows.
#[test]
fn as_many_blocks_as_rows_are_not_always_the_diagonal() {
    let block = |value: f64| SMatrix::<f64, 1, 1>::new(value);
    for (starts, columns) in [
        (vec![0, 2, 4, 4, 4], vec![0, 1, 0, 1]),
        (vec![0, 2, 3, 4, 4], vec![0, 1, 2, 3]),
        (vec![0, 1, 2, 3, 4], vec![1, 0, 3, 2]),
        (vec![0, 1, 2, 3, 4], vec![0, 1, 2, 3]),
    ] {
        let values = [1.0, 2.0, 3.0, 4.0].map(block).to_vec();
        let matrix = BlockMatrix::new((4, 4), starts, columns, values);
        let x = [5.0, 6.0, 7.0, 8.0].map(SVector::<f64, 1>::new);
        let mut product = [SVector::zeros(); 4];
        matrix.multiply_add(1.0, &x, &mut product);
        assert_eq!(flat(&product), dense(&matrix) * flat(&x));
    }
}

/// `R^T A R` of dense, sparse and turned back, for random axes at a share of the vertices.
fn check_turned<const C: usize>(size: usize, seed: u64) -> Result<(), TestCaseError> {
    let mut numbers = Numbers(seed);
    let original: BlockMatrix<C> = sparse(size, 0.4, &mut numbers);
    let mut frames = Frames::none(size);
    let mut rotation = DMatrix::identity(C * size, C * size);
    for i in 0..size {
        if numbers.between(0.0, 1.0) < 0.5 {
            let random = SMatrix::<f64, C, C>::from_fn(|_, _| numbers.next());
            let dynamic = DMatrix::from_fn(C, C, |r, c| random[(r, c)]).qr().q();
            let axes = SMatrix::<f64, C, C>::from_fn(|r, c| dynamic[(r, c)]);
            frames.set(i, axes);
            rotation
                .fixed_view_mut::<C, C>(C * i, C * i)
                .copy_from(&axes);
        }
    }
    let expected = rotation.transpose() * dense(&original) * &rotation;
    let (mut sparse, mut full) = (original.clone(), dense(&original));
    let basis = Basis::from(frames.clone());
    prop_assert!(sparse.change_basis(&basis));
    prop_assert!(Operator::<C>::change_basis(&mut full, &basis));
    // Entries are at most 1; four products and sums of C terms each.
    let bound = 1e-14 * (C * C) as f64;
    prop_assert!((dense(&sparse) - &expected).amax() < bound);
    prop_assert!((full - expected).amax() < bound);
    for (i, row) in sparse.outer_iterator().enumerate() {
        for (j, block) in row.iter() {
            let back = frames.block_to_coordinates((i, j), *block);
            let own = original.get(i, j).copied().unwrap_or(SMatrix::zeros());
            prop_assert!((back - own).amax() < bound);
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(cases(100))]

    #[test]
    fn operators_turn_to_frames(size in 1..12_usize, seed in any::<u64>()) {
        check_turned::<2>(size, seed)?;
        check_turned::<3>(size, seed)?;
    }
}

/// A half that is stored, and the whole matrix, with zeros where a component has no row, and far from the diagonal.
fn half<const C: usize>(
    moves: &[[bool; C]],
    numbers: &mut Numbers,
) -> (Symmetric<C>, DMatrix<f64>) {
    let size = C * moves.len();
    let rows: Vec<usize> = (0..size).filter(|&i| moves[i / C][i % C]).collect();
    let mut full = DMatrix::zeros(size, size);
    let reach = numbers.between(0.0, 2.0 * size as f64);
    let operator = Symmetric::new(moves, |i, j| {
        let value = if (i - j) as f64 <= reach {
            numbers.next()
        } else {
            0.0
        };
        full[(rows[i], rows[j])] = value;
        full[(rows[j], rows[i])] = value;
        value
    });
    (operator, full)
}

/// By its entries.
fn whole<const C: usize>(operator: &Symmetric<C>) -> DMatrix<f64> {
    let size = operator.vertex_count();
    DMatrix::from_fn(C * size, C * size, |i, j| {
        match (operator.row(i / C, i % C), operator.row(j / C, j % C)) {
            (Some(row), Some(column)) => operator.entry(row, column),
            _ => 0.0,
        }
    })
}

fn check_symmetric<const C: usize>(size: usize, seed: u64) -> Result<(), TestCaseError> {
    let mut numbers = Numbers(seed);
    let share = numbers.between(0.0, 1.0);
    let moves: Vec<[bool; C]> = (0..size)
        .map(|_| std::array::from_fn(|_| numbers.between(0.0, 1.0) < share))
        .collect();
    let (one, full) = half(&moves, &mut numbers);
    let (other, beside) = half(&moves, &mut numbers);
    prop_assert_eq!(whole(&one), full.clone());
    prop_assert_eq!(
        one.count(),
        moves.iter().flatten().filter(|&&moves| moves).count()
    );
    for row in 0..one.count() {
        let (vertex, component) = one.owner(row);
        prop_assert_eq!(one.row(vertex, component), Some(row));
    }
    let rounding = 1e-14 * (C * size) as f64;

    let mut field = || -> Vec<SVector<f64, C>> {
        let vectors = (0..size).map(|_| SVector::from_fn(|_, _| numbers.next()));
        vectors.collect()
    };
    let (x, y) = (field(), field());
    let product = &full * flat(&x);
    let mut z = y.clone();
    one.multiply_add(-1.5, &x, &mut z);
    prop_assert!((flat(&z) - flat(&y) + &product * 1.5).amax() <= rounding);
    for (i, moves) in moves.iter().enumerate() {
        let row = one.product_at(i, &x) - product.fixed_rows::<C>(C * i);
        prop_assert!(row.amax() <= rounding);
        prop_assert_eq!(
            one.diagonal_block(i),
            full.fixed_view::<C, C>(C * i, C * i).into_owned()
        );
        for c in (0..C).filter(|&c| !moves[c]) {
            prop_assert_eq!(z[i][c], y[i][c]);
        }
    }
    let square = flat(&x).dot(&product);
    prop_assert!((one.quadratic(&x) - square).abs() <= rounding * (C * size) as f64);

    let mut sum = Symmetric::combination(&[(0.5, &one), (-2.0, &other), (1.0, &one)]);
    prop_assert!((whole(&sum) - (&full * 1.5 - &beside * 2.0)).amax() <= rounding);
    sum.set_combination(&[(3.0, &other), (0.25, &one)]);
    prop_assert!((whole(&sum) - (&full * 0.25 + &beside * 3.0)).amax() <= rounding);
    let mut stiffer = full;
    let mut one = one;
    for (i, moves) in moves.iter().enumerate() {
        let random = SMatrix::<f64, C, C>::from_fn(|_, _| numbers.next());
        let block = random + random.transpose();
        one.add_to_diagonal(i, &block);
        for r in 0..C {
            for c in (0..C).filter(|&c| moves[r] && moves[c]) {
                stiffer[(C * i + r, C * i + c)] += block[(r, c)];
            }
        }
    }
    prop_assert_eq!(whole(&one), stiffer);
    Ok(())
}

proptest! {
    #![proptest_config(cases(96))]

    /// On both sides of a tile's 32 rows, and with components that have none.
    #[test]
    fn halves_are_whole_matrices(size in 0..70_usize, seed in any::<u64>()) {
        check_symmetric::<1>(size, seed)?;
        check_symmetric::<2>(size, seed)?;
        check_symmetric::<3>(size / 2, seed)?;
    }
}

#[test]
fn large_halves_are_whole_matrices() -> Result<(), TestCaseError> {
    // Vectors of more than 512 rows are multiplied part by part.
    check_symmetric::<3>(400, 1)?;
    check_symmetric::<2>(600, 2)?;
    check_symmetric::<1>(1025, 3)
}

/// Axes for some of the vertices that have all their rows.
fn check_turned_half<const C: usize>(size: usize, seed: u64) -> Result<(), TestCaseError> {
    let mut numbers = Numbers(seed);
    let moves: Vec<[bool; C]> = (0..size)
        .map(|_| [numbers.between(0.0, 1.0) < 0.7; C])
        .collect();
    let (mut operator, full) = half(&moves, &mut numbers);
    let (mut frames, mut rotation) = (Frames::none(size), DMatrix::identity(C * size, C * size));
    for i in (0..size).filter(|&i| moves[i][0]) {
        if numbers.between(0.0, 1.0) < 0.5 {
            let random = DMatrix::from_fn(C, C, |_, _| numbers.next()).qr().q();
            let axes = SMatrix::<f64, C, C>::from_fn(|r, c| random[(r, c)]);
            frames.set(i, axes);
            rotation
                .fixed_view_mut::<C, C>(C * i, C * i)
                .copy_from(&axes);
        }
    }
    prop_assert!(operator.change_basis(&frames.clone().into()));
    let expected = rotation.transpose() * full * &rotation;
    prop_assert!((whole(&operator) - expected).amax() < 1e-14 * (C * C) as f64);
    // Half a vertex cannot be turned, and nothing of the rest is.
    if let Some(lacking) = (0..size).find(|&i| !moves[i][0]) {
        let before = operator.clone();
        frames.set(lacking, SMatrix::identity());
        prop_assert!(!operator.change_basis(&frames.into()));
        prop_assert_eq!(operator, before);
    }
    Ok(())
}

proptest! {
    #![proptest_config(cases(48))]

    #[test]
    fn halves_turn_to_frames(size in 1..40_usize, seed in any::<u64>()) {
        check_turned_half::<2>(size, seed)?;
        check_turned_half::<3>(size, seed)?;
    }
}
