//! Different ways to the same motion.

use nalgebra::{DMatrix, Vector1};
use stickslip::bie::{Cells, DippingFault, Sense};
use stickslip::integrate::Stepper;
use stickslip::state::LogTheta;
use stickslip::{
    Contact, DenseNewton, Newmark, RungeKutta, Scene, Sdirk2, Simulation, Snapshot, Steps,
};

use super::{AGING, MEDIUM, NORMAL, PLATE, explicit, fault, law, scene};
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

/// Nor does an implicit step that iterates on the normal stress and on the skew part of the stiffness.
#[test]
fn implicit_steps_on_a_thrust_take_no_memory() -> Outcome {
    let cells = Cells::new([0.0, 20e3], 16)?;
    let fault = DippingFault::new(cells, MEDIUM, 0.25, 30.0, Sense::Thrust)?;
    let steady = LogTheta((AGING.slip_distance / PLATE).ln());
    let contact = Contact::new(&fault, law(0.02), NORMAL)
        .with_state(AGING, steady)
        .with_shear_stress(Vector1::new(0.6 * NORMAL));
    let scene = Scene::new(DMatrix::from(&fault.stiffness()))
        .with_viscosity(DMatrix::from(&fault.radiation_damping()))
        .with_load_history(fault.plate_loading(PLATE))
        .with_normal_stress_change(fault.normal_stiffness(), Vector1::new(PLATE))
        .with_contact(contact);
    let mut motion = Simulation::new(scene, Sdirk2, DenseNewton::new())?;
    let control = stickslip::ErrorControl::default();
    motion.step_estimated(1e4, &control)?;
    motion.step(1e4)?;
    let mut iterations = 0;
    let memory = allocation_counter::measure(|| {
        for _ in 0..10 {
            if motion.step_estimated(1e4, &control).is_ok() {
                motion.undo();
            }
            iterations = motion
                .step(1e4)
                .map_or(0, |taken| taken.reaction_iterations);
        }
    });
    assert!(iterations > 2);
    // One in halves, and those of a constant size.
    assert_eq!(
        (memory.count_total, motion.snapshot().step),
        (0, 2 + 1 + 10)
    );
    Ok(())
}
