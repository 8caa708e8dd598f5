//! A mass by numbers is the mass by blocks.

use crate::common::{Numbers, Regime, block, cases, dense};
use nalgebra::{DMatrix, SMatrix, SVector, Unit, UnitQuaternion, Vector3};
use proptest::prelude::*;
use stickslip_fem::FemError;
use stickslip_solvers::{Basis, BlockMatrix, Frames, MassMatrix, Matrix, Operator};

/// A symmetric matrix of multiples of the unit matrix: the diagonal and a random share of the other blocks.
fn multiples<const C: usize>(size: usize, share: f64, numbers: &mut Numbers) -> BlockMatrix<C> {
    let mut full = DMatrix::zeros(size, size);
    for i in 0..size {
        full[(i, i)] = numbers.between(1.0, 2.0);
        for j in 0..i {
            if numbers.between(0.0, 1.0) < share {
                full[(i, j)] = numbers.next();
                full[(j, i)] = full[(i, j)];
            }
        }
    }
    let (mut starts, mut columns, mut values) = (vec![0], Vec::new(), Vec::new());
    for i in 0..size {
        for j in (0..size).filter(|&j| full[(i, j)] != 0.0) {
            columns.push(j as u32);
            values.push(SMatrix::identity() * full[(i, j)]);
        }
        starts.push(columns.len() as u32);
    }
    BlockMatrix::new((size, size), starts, columns, values)
}

fn whole<const C: usize>(mass: &MassMatrix<C>) -> BlockMatrix<C> {
    BlockMatrix::combination_with(&[], Some((1.0, mass)))
}

/// The same bits, but for the sign of a zero.
fn check<const C: usize>(size: usize, seed: u64) -> Result<(), TestCaseError> {
    let mut numbers = Numbers(seed);
    for share in [0.0, 0.3, 1.0] {
        let blocks: BlockMatrix<C> = multiples(size, share, &mut numbers);
        let mass = blocks.clone().into_mass();
        // Where a block is a number there is nothing to save.
        prop_assert_eq!(mass.is_scalar(), C > 1);
        prop_assert_eq!(mass.vertex_count(), size);
        let mut field = || -> Vec<SVector<f64, C>> {
            (0..size)
                .map(|_| SVector::from_fn(|_, _| numbers.next()))
                .collect()
        };
        let (x, y) = (field(), field());
        let (mut by_blocks, mut by_numbers) = (y.clone(), y);
        blocks.multiply_add(-1.5, &x, &mut by_blocks);
        mass.multiply_add(-1.5, &x, &mut by_numbers);
        prop_assert_eq!(by_blocks, by_numbers);
        prop_assert_eq!(blocks.quadratic(&x), mass.quadratic(&x));
        for i in 0..size {
            prop_assert_eq!(blocks.product_at(i, &x), mass.product_at(i, &x));
            prop_assert_eq!(blocks.diagonal_block(i), mass.diagonal_block(i));
        }

        // Beside an operator of another pattern, and as the only term.
        let other: BlockMatrix<C> = multiples(size, 0.3, &mut numbers);
        let expected = BlockMatrix::combination(&[(0.7, &other), (3.0, &blocks)]);
        let mut sum = BlockMatrix::combination_with(&[(0.7, &other)], Some((3.0, &mass)));
        prop_assert_eq!(&sum, &expected);
        sum.set_combination_with(&[(1.0, &other)], Some((-2.0, &mass)));
        let expected = dense(&other) - dense(&blocks) * 2.0;
        prop_assert!((dense(&sum) - expected).amax() <= 8.0 * f64::EPSILON);
        prop_assert_eq!(&whole(&mass), &blocks);

        // Masses among themselves, and one that is not a number a pair.
        let others = other.into_mass();
        let sum = MassMatrix::combination(&[(0.5, &mass), (2.0, &others)]);
        let expected = dense(&blocks) * 0.5 + dense(&whole(&others)) * 2.0;
        prop_assert!((dense(&whole(&sum)) - expected).amax() <= 8.0 * f64::EPSILON);
        let mut uneven = blocks.clone();
        uneven.add_to_diagonal(size - 1, &SMatrix::repeat(0.5));
        let held = uneven.clone().into_mass();
        prop_assert!(!held.is_scalar());
        prop_assert_eq!(
            held.product_at(size - 1, &x),
            uneven.product_at(size - 1, &x)
        );
    }
    Ok(())
}

proptest! {
    #![proptest_config(cases(64))]

    #[test]
    fn numbers_are_blocks(size in 1..12_usize, seed in any::<u64>()) {
        check::<1>(size, seed)?;
        check::<2>(size, seed)?;
        check::<3>(size, seed)?;
    }
}

/// The mass of a body in space is held by numbers, until some of its vertices get axes of their own.
#[test]
fn a_turned_mass_has_blocks() -> Result<(), FemError> {
    let blocks = block(1, Regime::Stick, 1)?.mass;
    let mut mass = blocks.clone().into_mass();
    assert!(mass.is_scalar());
    let size = mass.vertex_count();
    assert!(mass.change_basis(&Basis::none(size)) && mass.is_scalar());
    let mut frames = Frames::none(size);
    let axis = Unit::new_normalize(Vector3::new(1.0, -2.0, 0.5));
    let turn = UnitQuaternion::from_axis_angle(&axis, 0.8).to_rotation_matrix();
    frames.set(size / 2, *turn.matrix());
    let mut turned = blocks;
    let basis = Basis::from(frames);
    assert!(turned.change_basis(&basis) && mass.change_basis(&basis) && !mass.is_scalar());
    assert_eq!(mass, turned.into_mass());
    Ok(())
}
