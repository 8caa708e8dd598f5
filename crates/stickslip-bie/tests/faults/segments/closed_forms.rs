//! Stresses and slips on curves that are known.

use std::f64::consts::{PI, TAU};

use nalgebra::{Complex, DMatrix, DVector};
use stickslip_bie::{Mode, SegmentFault, Segments};

use super::UNIT;
use crate::{IN_PLANE, Outcome};

/// Shear and normal stress of slip `cos(k theta)` on a polygon of radius 1, per `cos(k theta)` and `sin(k theta)`. All of its
/// cells see the same.
fn circle(count: usize, k: f64) -> Outcome<[f64; 2]> {
    let corner = |n: usize| {
        // Closed to the bit.
        let angle = TAU * (n % count) as f64 / count as f64;
        [angle.cos(), angle.sin()]
    };
    let points: Vec<_> = (0..=count).map(corner).collect();
    let fault = SegmentFault::whole_space(Segments::polyline(&points)?, UNIT, IN_PLANE)?;
    let angle = |cell: usize| TAU * (cell as f64 + 0.5) / count as f64;
    let slip = DVector::from_fn(count, |cell, _| (k * angle(cell)).cos());
    let (stiffness, normal) = (fault.stiffness(), fault.normal_stiffness());
    let length = fault.cells().length(0);
    let row = |entry: &dyn Fn(usize) -> f64| (0..count).map(|j| entry(j) * slip[j]).sum::<f64>();
    // A cell off the axes.
    let i = count / 16;
    let shear = -row(&|j| stiffness.entry(i, j)) / length / slip[i];
    let normal = row(&|j| normal.entry(i, j));
    let sine = (k * angle(i)).sin();
    Ok([shear, if k > 0.0 { normal / sine } else { normal }])
}

/// `-(mu/(2 (1 - nu) R)) k cos(k theta)` of shear, of first order, and as much normal stress for every `k`; a circle that turns
/// inside a body is not stressed.
#[test]
fn a_circle_in_plane_strain_is_of_first_order() -> Outcome {
    let exact = 1.0 / (2.0 * 0.75);
    let [coarse, fine] = [circle(512, 2.0)?, circle(1024, 2.0)?];
    let [shear, normal] = [0, 1].map(|part| 2.0 * fine[part] - coarse[part]);
    assert!((shear + 2.0 * exact).abs() < 3e-5, "{shear}");
    assert!((normal.abs() - exact).abs() < 3e-6, "{normal}");
    // An independent computation.
    for (count, shear, normal) in [(16, -1.374_95, 0.462_53), (256, -1.339_62, 0.653_80)] {
        let found = circle(count, 2.0)?;
        assert!((found[0] - shear).abs() < 1e-5, "{found:?}");
        assert!((found[1].abs() - normal).abs() < 1e-5, "{found:?}");
    }
    for (count, shear) in [(16, -0.102_347_48), (256, -0.006_425_41)] {
        let found = circle(count, 0.0)?;
        assert!(
            (found[0] - shear).abs() < 1e-8 && found[1].abs() < 1e-12,
            "{found:?}"
        );
    }
    for k in [1.0, 3.0, 5.0] {
        let [coarse, fine] = [circle(256, k)?, circle(512, k)?];
        let [shear, normal] = [0, 1].map(|part| 2.0 * fine[part] - coarse[part]);
        assert!((shear + k * exact).abs() < 1e-3 * k * exact, "{k} {shear}");
        assert!((normal.abs() - exact).abs() < 1e-3 * exact, "{k} {normal}");
    }
    Ok(())
}

/// The slip of an arc through (-2, 0), (0, 1) and (2, 0) that bears no traction under a remote stress of 1 across the plane:
/// of its image on a circle, `z = zeta + 1/zeta`.
fn arc_slip(z: Complex<f64>) -> f64 {
    let middle = Complex::new(0.0, 0.5);
    let radius = 1.25_f64.sqrt();
    let root = (z * z - 4.0).sqrt();
    let angles = [1.0, -1.0].map(|sign| ((z + root * sign) * 0.5 - middle).arg());
    2.0 * radius * ((angles[0] - 0.5 * PI).cos() - (angles[1] - 0.5 * PI).cos()).abs()
}

/// The largest error of slip inside the arc.
fn arc_error(count: usize) -> Outcome<f64> {
    let half = (2.0_f64 / 2.5).asin();
    let points = (0..=count).map(|k| {
        let angle = half * (2.0 * k as f64 / count as f64 - 1.0);
        [2.5 * angle.sin(), 2.5 * angle.cos() - 1.5]
    });
    let points: Vec<_> = points.collect();
    let fault = SegmentFault::whole_space(Segments::polyline(&points)?, UNIT, Mode::Antiplane)?;
    let cells = fault.cells();
    let load = |cell: usize| {
        let [[_, up], _] = fault.axes(cell);
        cells.length(cell) * up
    };
    let load = DVector::from_fn(count, |cell, _| load(cell));
    let slip = DMatrix::from(&fault.stiffness()).lu().solve(&load);
    let slip = slip.ok_or("singular")?;
    let mut largest = 0.0_f64;
    for cell in 0..count {
        let angle = half * ((2 * cell + 1) as f64 / count as f64 - 1.0);
        let z = Complex::new(2.5 * angle.sin(), 2.5 * angle.cos() - 1.5);
        if z.re.abs() < 1.8 {
            largest = largest.max((slip[cell] - arc_slip(z)).abs());
        }
    }
    Ok(largest)
}

#[test]
fn an_antiplane_arc_slips_as_known() -> Outcome {
    for (x, z, known) in [
        (0.0, 1.0, 4.472_136),
        (0.785_501, 0.873_392, 4.126_200),
        (1.438_492, 0.544_686, 3.146_697),
        (1.750_963, 0.284_413, 2.207_752),
    ] {
        let found = arc_slip(Complex::new(x, z));
        assert!((found - known).abs() < 3e-6, "{found}");
    }
    let errors = [arc_error(75)?, arc_error(150)?, arc_error(300)?];
    // Of first order.
    assert!(errors[0] < 0.05 * 4.472, "{errors:?}");
    for pair in errors.windows(2) {
        assert!((1.8..2.3).contains(&(pair[0] / pair[1])), "{errors:?}");
    }
    Ok(())
}
