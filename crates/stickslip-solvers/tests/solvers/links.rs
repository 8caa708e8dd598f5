//! Jumps across faults as unknowns: products with the links of copies, against dense ones.

use nalgebra::{DMatrix, SMatrix, SVector};
use proptest::prelude::*;
use stickslip_solvers::{Basis, BlockMatrix, Link, Links, Operator, Symmetric};

use crate::common::{Numbers, cases, dense};
use crate::operators::{flat, sparse};

/// Pairs among random vertices, and places where two faults cross, in a random order of vertices.
fn links(size: usize, numbers: &mut Numbers) -> Links {
    let mut free: Vec<usize> = (0..size).collect();
    for k in (1..size).rev() {
        free.swap(k, numbers.between(0.0, (k + 1) as f64) as usize);
    }
    let mut links = Vec::new();
    while numbers.between(0.0, 1.0) < 0.8 {
        let mut take = || free.pop();
        let (Some(below), Some(vertex)) = (take(), take()) else {
            break;
        };
        let crossing = numbers.between(0.0, 1.0) < 0.3;
        let reversed = !crossing && numbers.between(0.0, 1.0) < 0.3;
        let share = match crossing {
            true => 0.0,
            false => numbers.between(-0.3, 1.0).max(0.0),
        };
        links.push(Link {
            reversed,
            share,
            ..Link::new(vertex, vec![below])
        });
        if let (true, Some(other), Some(both)) = (crossing, free.pop(), free.pop()) {
            links.push(Link::new(both, vec![other, below, vertex]));
            links.push(Link::new(other, vec![below]));
        }
    }
    Links::new(links)
}

/// `T = L R`, and the basis.
fn basis<const C: usize>(size: usize, numbers: &mut Numbers) -> (Basis<C>, DMatrix<f64>) {
    let mut basis = Basis::none(size);
    basis.links = links(size, numbers);
    let (mut joined, mut rotation) = (
        DMatrix::<f64>::identity(C * size, C * size),
        DMatrix::identity(C * size, C * size),
    );
    for link in basis.links.iter() {
        for c in 0..C {
            let row = C * link.vertex + c;
            let sign = if link.reversed { -1.0 } else { 1.0 };
            joined[(row, row)] = sign * (1.0 - link.share);
            for &base in &link.bases {
                joined[(row, C * base + c)] = 1.0;
            }
            if link.share > 0.0 {
                joined[(C * link.bases[0] + c, row)] = -sign * link.share;
            }
        }
    }
    for i in 0..size {
        if numbers.between(0.0, 1.0) < 0.3 {
            let random = DMatrix::from_fn(C, C, |_, _| numbers.next()).qr().q();
            let axes = SMatrix::<f64, C, C>::from_fn(|r, c| random[(r, c)]);
            basis.axes.set(i, axes);
            rotation
                .fixed_view_mut::<C, C>(C * i, C * i)
                .copy_from(&axes);
        }
    }
    (basis, joined * rotation)
}

fn check<const C: usize>(size: usize, seed: u64) -> Result<(), TestCaseError> {
    let mut numbers = Numbers(seed);
    let (basis, change) = basis::<C>(size, &mut numbers);
    let original: BlockMatrix<C> = sparse(size, 0.4, &mut numbers);
    let before = dense(&original);
    let expected = change.transpose() * &before * &change;
    let bound = 1e-13 * (C * C) as f64;
    let (mut blocks, mut full) = (original.clone(), before.clone());
    prop_assert!(blocks.change_basis(&basis) && Operator::<C>::change_basis(&mut full, &basis));
    prop_assert!((dense(&blocks) - &expected).amax() < bound);
    prop_assert!((full - &expected).amax() < bound);
    let moves = vec![[true; C]; size];
    let mut half = Symmetric::new(&moves, |i, j| before[(i, j)]);
    prop_assert!(half.change_basis(&basis));
    let whole = DMatrix::from_fn(C * size, C * size, |i, j| half.entry(i.max(j), i.min(j)));
    prop_assert!((whole - &expected).amax() < bound);
    for (rows, whole) in [
        (basis.rows(), change.clone()),
        (
            basis.inverse_rows(),
            change.clone().try_inverse().unwrap_or_default(),
        ),
    ] {
        let mut written = DMatrix::<f64>::identity(C * size, C * size);
        for (i, row) in rows {
            written.rows_mut(C * i, C).fill(0.0);
            for (j, block) in row {
                let mut place = written.fixed_view_mut::<C, C>(C * i, C * j);
                place += block;
            }
        }
        prop_assert!((written - whole).amax() < bound);
    }
    // Fields and forces, there and back.
    let field: Vec<SVector<f64, C>> = (0..size)
        .map(|_| SVector::from_fn(|_, _| numbers.next()))
        .collect();
    let mut changed = field.clone();
    basis.field_to_coordinates(&mut changed);
    prop_assert!((flat(&changed) - &change * flat(&field)).amax() < bound);
    basis.field_to_basis(&mut changed);
    prop_assert!((flat(&changed) - flat(&field)).amax() < bound);
    basis.forces_to_basis(&mut changed);
    prop_assert!((flat(&changed) - change.transpose() * flat(&field)).amax() < bound);
    basis.forces_to_coordinates(&mut changed);
    prop_assert!((flat(&changed) - flat(&field)).amax() < bound);
    Ok(())
}

proptest! {
    #![proptest_config(cases(96))]

    #[test]
    fn operators_fields_and_forces_follow_the_jumps(size in 1..14_usize, seed in any::<u64>()) {
        check::<1>(size, seed)?;
        check::<2>(size, seed)?;
        check::<3>(size, seed)?;
    }
}

#[test]
#[should_panic(expected = "incomplete bases")]
fn a_base_comes_with_its_own_bases() {
    Links::new([Link::new(1, vec![0]), Link::new(2, vec![1])]);
}

#[test]
#[should_panic(expected = "moves back")]
fn a_base_of_two_links_stays() {
    let share = 0.5;
    let back = Link {
        share,
        ..Link::new(1, vec![0])
    };
    Links::new([back, Link::new(2, vec![0])]);
}
