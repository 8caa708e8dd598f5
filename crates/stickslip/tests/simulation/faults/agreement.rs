//! Different ways to the same motion.

use nalgebra::DMatrix;
use stickslip::integrate::Stepper;
use stickslip::{DenseNewton, Newmark, RungeKutta, Simulation, Snapshot, Steps};

use super::{explicit, fault, scene};
use crate::Outcome;

const YEAR: f64 = 3.15576e7;

/// ln V and ln theta of all cells, in the order of depths.
fn numbers(at: &Snapshot<'_, 1>) -> [Vec<f64>; 2] {
    let places = || {
        at.contacts()
            .flat_map(|contact| (0..contact.len()).map(move |k| (contact, k)))
    };
    [
        places()
            .map(|(contact, k)| contact.slip_rate(k).ln())
            .collect(),
        places().map(|(contact, k)| contact.state(k)).collect(),
    ]
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter()
        .zip(b)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max)
}

/// Into the first event and out of it: explicit by products and by the matrix, implicit by the matrix.
#[test]
fn explicit_and_implicit_steps_agree() -> Outcome {
    let fault = fault()?;
    let matrices = || {
        [fault.stiffness(), fault.radiation_damping()]
            .each_ref()
            .map(DMatrix::from)
    };
    let end = 40.0 * YEAR;
    let mut by_products = explicit(&fault, false)?;
    let mut fastest: f64 = 0.0;
    by_products.run(&Steps::adaptive(1e-8).until(end), |at| {
        fastest = fastest.max(at.max_slip_rate())
    })?;
    assert!(fastest > 10.0 * super::PLATE, "{fastest:e}");
    let mut dense = RungeKutta::new(scene(&fault, matrices(), false)?)?;
    dense.run(&Steps::adaptive(1e-8).until(end), |_| ())?;
    // What rounding of products, 1e-14 of 1 MPa beside a sigma of 0.5 MPa, has grown to, and some 1e3 steps.
    for (a, b) in numbers(&by_products.snapshot())
        .iter()
        .zip(&numbers(&dense.snapshot()))
    {
        assert!(largest_difference(a, b) < 1e-5);
    }
    // Of second order: an error of 1e-4 a step.
    let mut implicit = Simulation::new(
        scene(&fault, matrices(), false)?,
        Newmark::default(),
        DenseNewton::new(),
    )?;
    implicit.run(&Steps::adaptive(1e-5).until(end), |_| ())?;
    for (a, b) in numbers(&by_products.snapshot())
        .iter()
        .zip(&numbers(&implicit.snapshot()))
    {
        assert!(
            largest_difference(a, b) < 1e-2,
            "{:e}",
            largest_difference(a, b)
        );
    }
    Ok(())
}

/// Sections with a contact of their own are the whole with one.
#[test]
fn sections_make_a_whole() -> Outcome {
    let fault = fault()?;
    let steps = Steps::adaptive(1e-5).until(3.0 * YEAR);
    let (mut one, mut two) = (explicit(&fault, false)?, explicit(&fault, true)?);
    one.run(&steps, |_| ())?;
    two.run(&steps, |_| ())?;
    assert_eq!(two.snapshot().contact_count(), 2);
    for (a, b) in numbers(&one.snapshot())
        .iter()
        .zip(&numbers(&two.snapshot()))
    {
        assert!(a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits()));
    }
    Ok(())
}

/// A step takes no memory, whether it is kept or taken back.
#[test]
fn steps_take_no_memory() -> Outcome {
    for split in [false, true] {
        let mut motion = explicit(&fault()?, split)?;
        let control = stickslip::ErrorControl::default();
        motion.step_estimated(1e5, &control)?;
        // The first constant step finds the stability limit.
        motion.step(1e5)?;
        let taken = allocation_counter::measure(|| {
            for _ in 0..10 {
                if motion.step_estimated(1e5, &control).is_ok() {
                    motion.undo();
                }
                let _ = motion.step(1e5);
                let _ = motion.snapshot().max_slip_rate();
            }
        });
        assert_eq!((taken.count_total, motion.snapshot().step), (0, 12));
    }
    Ok(())
}
