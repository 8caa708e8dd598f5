//! Stresses on bent, parallel, branched and rough faults by an independent program, per shear modulus.

use nalgebra::Vector1;
use stickslip_bie::{DipProfile, SegmentFault, Segments};

use super::half_space;
use crate::{Outcome, field};

/// Shear and normal stress due to slip by 1 of the first cells.
fn stresses(fault: &SegmentFault, slipping: usize) -> [Vec<f64>; 2] {
    let count = fault.cells().count();
    let slip: Vec<_> = (0..count)
        .map(|cell| f64::from(u8::from(cell < slipping)))
        .collect();
    let slip = field(&slip);
    let mut force = vec![Vector1::new(0.0); count];
    stickslip_solvers::Matrix::multiply_add(&fault.stiffness(), -1.0, &slip, &mut force);
    let mut normal = vec![0.0; count];
    fault
        .normal_stiffness()
        .multiply_add(1.0, &slip, &mut normal);
    let shear = force.iter().enumerate();
    let shear = shear.map(|(cell, force)| force[0] / fault.cells().length(cell));
    [shear.collect(), normal]
}

fn close(found: f64, known: f64) {
    assert!((found - known).abs() < 1.2e-8, "{found} instead of {known}");
}

#[test]
fn a_bent_thrust_stresses_its_deeper_part() -> Outcome {
    let fault = half_space(Segments::down([(60.0, 10.0), (30.0, 10.0)], 1.0)?)?;
    let [shear, normal] = stresses(&fault, 10);
    for (cell, known) in [
        (10, [0.366_797_52, -0.199_238_83, 0.486_340_82]),
        (11, [0.120_343_98, -0.056_776_99, 0.154_410_17]),
        (14, [0.035_496_38, -0.009_221_09, 0.041_029_04]),
        (19, [0.012_131_46, 0.000_304_66, 0.011_948_66]),
    ] {
        close(shear[cell], known[0]);
        close(normal[cell], known[1]);
        close(shear[cell] - 0.6 * normal[cell], known[2]);
    }
    Ok(())
}

fn thrust(east: f64) -> Outcome<Segments> {
    let profile = DipProfile::new([(60.0, 10.0)]).starting_at([east, 0.0]);
    Ok(Segments::down(profile, 1.0)?)
}

#[test]
fn a_thrust_stresses_another() -> Outcome {
    let fault = half_space(thrust(0.0)?.with(&thrust(5.0)?)?)?;
    let [shear, normal] = stresses(&fault, 10);
    close(shear[15], 0.000_340_31);
    close(normal[15], -0.017_893_40);
    close(shear[15] - 0.6 * normal[15], 0.011_076_36);
    Ok(())
}

#[test]
fn a_thrust_stresses_its_branch() -> Outcome {
    let main = thrust(0.0)?;
    let profile = DipProfile::new([(20.0, 5.0)]).starting_at(main.ends(5)[0]);
    let fault = half_space(main.with(&Segments::down(profile, 1.0)?)?)?;
    let [shear, normal] = stresses(&fault, 10);
    let known = [
        [0.003_399_60, 0.044_589_55],
        [0.020_271_36, 0.044_118_01],
        [0.040_966_57, 0.022_655_89],
        [0.047_042_98, -0.019_930_52],
        [0.027_028_70, -0.050_513_13],
    ];
    for (cell, known) in known.into_iter().enumerate() {
        close(shear[10 + cell], known[0]);
        close(normal[10 + cell], known[1]);
    }
    Ok(())
}

#[test]
fn a_rough_line_clamps_and_unclamps_itself() -> Outcome {
    let points = (0..=10).map(f64::from).map(|k| [k, 0.05 * k.sin() - 3.0]);
    let fault = half_space(Segments::polyline(&points.collect::<Vec<_>>())?)?;
    let length = fault.cells().length(4);
    let (stiffness, normal) = (fault.stiffness(), fault.normal_stiffness());
    let known = [0.291_769_551_412, -0.837_589_814_317, 0.291_731_719_636];
    for (j, known) in (3..).zip(known) {
        assert!((-stiffness.entry(4, j) / length - known).abs() < 1e-11);
    }
    let known = [0.002_135_349_940, -0.000_109_719_452, -0.000_260_140_495];
    for (j, known) in (3..).zip(known) {
        assert!((normal.entry(4, j) - known).abs() < 1e-11);
    }
    let shear: f64 = (0..10).map(|j| -stiffness.entry(4, j) / length).sum();
    let clamped: f64 = (0..10).map(|j| normal.entry(4, j)).sum();
    assert!((shear + 0.063_207_978_28).abs() < 1e-10, "{shear}");
    assert!((clamped - 0.002_860_060_63).abs() < 1e-10, "{clamped}");
    Ok(())
}
