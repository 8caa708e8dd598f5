//! Loads per cell, on lines and planes.

use nalgebra::{SVector, Vector1, Vector2};
use stickslip_bie::{Cells, DippingFault, Fault, KernelError, PlaneFault, Rectangles, Sense};
use stickslip_solvers::Matrix;

use crate::{MEDIUM, Outcome};

fn after<const C: usize>(
    load: impl Fn(f64, &mut [SVector<f64, C>]),
    count: usize,
) -> Vec<SVector<f64, C>> {
    let mut forces = vec![SVector::zeros(); count];
    load(3.0, &mut forces);
    forces
}

/// Back slip by one rate is plate loading; stress rates are forces per area; damping is scaled. Each kind of fault.
#[test]
fn loads_per_cell_agree_with_uniform_ones() -> Outcome {
    let cells = Cells::new([0.0, 2e3], 20)?;
    let (line, dipping) = (
        Fault::half_space(cells, MEDIUM)?,
        DippingFault::new(cells, MEDIUM, 0.25, 40.0, Sense::Normal)?,
    );
    let uniform = vec![Vector1::new(1e-9); 20];
    let rates: Vec<_> = (0..20).map(|k| Vector1::new(f64::from(k))).collect();
    let expected: Vec<_> = rates.iter().map(|rate| rate * 100.0 * 3.0).collect();
    assert_eq!(
        after(line.back_slip(&uniform)?, 20),
        after(line.plate_loading(1e-9), 20)
    );
    assert_eq!(
        after(dipping.back_slip(&uniform)?, 20),
        after(dipping.plate_loading(1e-9), 20)
    );
    assert_eq!(after(line.stress_rates(&rates)?, 20), expected);
    assert_eq!(after(dipping.stress_rates(&rates)?, 20), expected);
    let half = |whole: f64, scaled: f64| assert!((scaled - 0.5 * whole).abs() <= 1e-15 * whole);
    half(
        line.radiation_damping().diagonal_block(3)[(0, 0)],
        line.radiation_damping_times(0.5)?.diagonal_block(3)[(0, 0)],
    );
    half(
        dipping.radiation_damping().diagonal_block(3)[(0, 0)],
        dipping.radiation_damping_times(0.5)?.diagonal_block(3)[(0, 0)],
    );
    let plane = PlaneFault::whole_space(Rectangles::new(cells, cells), MEDIUM, 0.25)?;
    let rates = vec![Vector2::new(1.0, 2.0); 400];
    let expected = vec![Vector2::new(3e4, 6e4); 400];
    assert_eq!(after(plane.stress_rates(&rates)?, 400), expected);
    Ok(())
}

#[test]
fn wrong_loads_are_refused() -> Outcome {
    let cells = Cells::new([0.0, 2e3], 20)?;
    let fault = Fault::half_space(cells, MEDIUM)?;
    let mut wrong = vec![Vector1::new(1e-9); 20];
    wrong[7][0] = f64::NAN;
    let cell = |refused: Option<KernelError>| refused.and_then(|error| error.cell);
    assert_eq!(cell(fault.back_slip(&wrong).err()), Some(7));
    assert_eq!(cell(fault.stress_rates(&wrong).err()), Some(7));
    assert!(fault.back_slip(&wrong[..6]).is_err() && fault.stress_rates(&wrong[..6]).is_err());
    for factor in [-1.0, f64::NAN, f64::INFINITY] {
        assert!(fault.radiation_damping_times(factor).is_err());
    }
    Ok(())
}
