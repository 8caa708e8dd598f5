//! Loading.

use nalgebra::{DMatrix, DVector, Vector1};
use stickslip_bie::{Mode, SegmentFault, Segments, Sense};

use crate::{IN_PLANE, MEDIUM, Outcome, field, flat};

/// Shortening drives thrusts of either direction of dip; slip with the plate is back slip of nothing.
#[test]
fn a_plate_velocity_is_projected_onto_each_cell() -> Outcome {
    let right = Segments::down([(60.0, 4e3), (0.0, 4e3)], 1e3)?;
    let faults = right.with(&right.map_points(|[x, z]| [-3e3 - x, z])?)?;
    let fault = SegmentFault::half_space(faults, MEDIUM, IN_PLANE)?;
    let rates = fault.along([-1e-9, 5e-9, 0.0])?;
    for (cell, rate) in rates.iter().enumerate() {
        let exact = if cell % 8 < 4 { 0.5e-9 } else { 1e-9 };
        assert!((rate[0] - exact).abs() < 1e-22, "{cell}: {rate}");
    }
    let lifted = fault
        .clone()
        .with_sense(Sense::Normal)
        .along([0.0, 0.0, 1e-9])?;
    assert!((lifted[0][0] + 0.75_f64.sqrt() * 1e-9).abs() < 1e-22);
    let (time, mut load) = (1e7, field(&[0.0; 16]));
    fault.back_slip(&rates)?(time, &mut load);
    let exact = DMatrix::from(&fault.stiffness()) * flat(&rates) * time;
    assert!((flat(&load) - exact).amax() < 1e-12 * flat(&load).amax());
    let antiplane = SegmentFault::whole_space(right, MEDIUM, Mode::Antiplane)?;
    assert_eq!(antiplane.along([3.0, 2.0, 1.0])?, field(&[2.0; 8]));
    Ok(())
}

#[test]
fn stress_rates_are_per_area() -> Outcome {
    let segments = Segments::polyline(&[[0.0, 0.0], [1.0, -1.0], [2.0, -1.5]])?;
    let fault = SegmentFault::half_space(segments, MEDIUM, IN_PLANE)?;
    let mut load = field(&[0.0; 2]);
    fault.stress_rates(&[Vector1::new(3.0), Vector1::new(-1.0)])?(2.0, &mut load);
    let exact = DVector::from_vec(vec![6.0 * 2.0_f64.sqrt(), -2.0 * 1.25_f64.sqrt()]);
    assert!((flat(&load) - exact).amax() < 1e-14);
    Ok(())
}

#[test]
fn rates_that_are_none_are_refused() -> Outcome {
    let fault = SegmentFault::half_space(Segments::down([(60.0, 4e3)], 1e3)?, MEDIUM, IN_PLANE)?;
    let one = field(&[1.0]);
    assert_eq!(
        fault.back_slip(&one).err().map(|error| error.what),
        Some("number of plate rates")
    );
    assert_eq!(
        fault.stress_rates(&one).err().map(|error| error.what),
        Some("number of stress rates")
    );
    let what = fault
        .along([0.0, f64::NAN, 0.0])
        .err()
        .map(|error| error.what);
    assert_eq!(what, Some("plate velocity [m/s]"));
    assert!(fault.plate_loading(f64::INFINITY).is_err());
    assert!(fault.radiation_damping_times(-1.0).is_err());
    Ok(())
}
