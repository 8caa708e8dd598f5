//! Planes that are none.

use nalgebra::Vector2;
use stickslip_bie::{Cells, KernelError, Medium, PlaneFault, Rectangles, RectangularDislocation};

use super::{POISSON, cells};
use crate::{MEDIUM, Outcome};

fn refused<T>(result: Result<T, KernelError>) -> KernelError {
    match result {
        Err(error) => error,
        Ok(_) => panic!("accepted"),
    }
}

#[test]
fn planes_out_of_their_range_are_refused() -> Outcome {
    let rectangles = cells([3, 2], [1.0, 1.0], 0.0)?;
    for dip in [0.0, -10.0, 90.1, f64::NAN, f64::INFINITY] {
        let error = refused(PlaneFault::half_space(rectangles, dip, MEDIUM, POISSON));
        assert_eq!(
            (error.what, error.value.to_bits()),
            ("dip [degrees]", dip.to_bits())
        );
    }
    let above = cells([3, 2], [1.0, 1.0], -0.5)?;
    let error = refused(PlaneFault::half_space(above, 30.0, MEDIUM, POISSON));
    assert_eq!(
        error.to_string(),
        "distance [m] of the plane's upper end from the surface must be at least 0, is -0.5"
    );
    for poisson_ratio in [-1.0, 0.5, f64::NAN] {
        for error in [
            refused(PlaneFault::half_space(
                rectangles,
                30.0,
                MEDIUM,
                poisson_ratio,
            )),
            refused(PlaneFault::whole_space(rectangles, MEDIUM, poisson_ratio)),
        ] {
            assert_eq!(error.what, "Poisson's ratio");
        }
    }
    for wrong in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        for (rock, name) in [
            (
                Medium {
                    shear_modulus: wrong,
                    ..MEDIUM
                },
                "shear modulus",
            ),
            (
                Medium {
                    shear_wave_speed: wrong,
                    ..MEDIUM
                },
                "shear wave speed",
            ),
        ] {
            assert_eq!(
                refused(PlaneFault::whole_space(rectangles, rock, POISSON)).what,
                name
            );
            assert_eq!(
                refused(PlaneFault::half_space(rectangles, 9.0, rock, POISSON)).what,
                name
            );
        }
    }
    for rake in [f64::NAN, f64::INFINITY] {
        let fault = PlaneFault::whole_space(rectangles, MEDIUM, POISSON)?;
        assert_eq!(refused(fault.with_rake(rake)).what, "rake [degrees]");
    }
    let half = PlaneFault::half_space(rectangles, 90.0, MEDIUM, POISSON)?;
    let error = refused(half.clone().periodic_along_strike());
    assert_eq!(
        error.what,
        "number of free surfaces beside a periodic plane"
    );
    assert_eq!(refused(half.periodic_down_dip()), error);
    let dipping = PlaneFault::half_space(rectangles, 60.0, MEDIUM, POISSON)?;
    let error = refused(dipping.transformed_down_dip());
    assert_eq!((error.value, error.bound), (60.0, Some(90.0)));
    let whole = PlaneFault::whole_space(rectangles, MEDIUM, POISSON)?;
    let error = refused(whole.transformed_down_dip());
    assert_eq!((error.value, error.bound), (0.0, Some(1.0)));
    Ok(())
}

#[test]
fn loads_of_another_plane_are_refused() -> Outcome {
    let fault = PlaneFault::whole_space(cells([3, 2], [1.0, 1.0], 0.0)?, MEDIUM, POISSON)?;
    let error = refused(fault.back_slip(&[Vector2::zeros(); 5]));
    assert_eq!(
        error.to_string(),
        "number of plate rates must be that of the cells, 6, is 5"
    );
    let mut rates = [Vector2::zeros(); 6];
    rates[4][1] = f64::NAN;
    let error = refused(fault.back_slip(&rates));
    assert_eq!(
        (error.what, error.cell),
        ("plate rate [m/s] of cell", Some(4))
    );
    let error = refused(fault.plate_loading(Vector2::new(f64::INFINITY, 0.0)));
    assert_eq!(
        (error.what, error.cell),
        ("plate rate [m/s] of cell", Some(0))
    );
    for factor in [-1.0, f64::NAN, f64::INFINITY] {
        let error = refused(fault.radiation_damping_times(factor));
        assert_eq!(error.what, "factor of radiation damping");
    }
    let error = refused(fault.section(|[x, _]| x > 1e3));
    assert_eq!(
        (error.what, error.value),
        ("number of cells of a section", 0.0)
    );
    Ok(())
}

#[test]
fn rectangles_that_are_none_are_refused() {
    let of = |along, down, dip| RectangularDislocation::new(along, down, dip, 30e9, POISSON);
    for (error, what) in [
        (
            refused(of([1.0, 1.0], [0.0, 1.0], 30.0)),
            "end along strike [m]",
        ),
        (
            refused(of([0.0, f64::NAN], [0.0, 1.0], 30.0)),
            "end along strike [m]",
        ),
        (
            refused(of([0.0, 1.0], [2.0, 1.0], 30.0)),
            "end down dip [m]",
        ),
        (
            refused(of([0.0, 1.0], [-0.1, 1.0], 30.0)),
            "distance [m] of the plane's upper end from the surface",
        ),
        (refused(of([0.0, 1.0], [0.0, 1.0], 0.0)), "dip [degrees]"),
    ] {
        assert_eq!(error.what, what);
    }
}

/// Positions, sections and fingerprints.
#[test]
fn cells_are_numbered_along_strike_first() -> Outcome {
    let rectangles = cells([3, 2], [2.0, 1.0], 0.0)?;
    assert_eq!((rectangles.count(), rectangles.area()), (6, 2.0));
    assert_eq!(
        (rectangles.center(4), rectangles.index([1, 1])),
        ([3.0, 1.5], 4)
    );
    assert_eq!(rectangles.column_and_row(4), [1, 1]);
    let section = rectangles.section(|[x, y]| x > 2.0 && y > 1.0)?;
    assert_eq!(section.vertices(), [4, 5]);
    assert_eq!(section.map(|[x, _]| x), [3.0, 5.0]);
    assert_eq!(section.cells(), &rectangles);
    assert_eq!(rectangles.all().vertices().len(), 6);
    let turned = Rectangles::new(*rectangles.down_dip(), *rectangles.along_strike());
    assert_ne!(turned.fingerprint(), rectangles.fingerprint());
    let other = Rectangles::new(*rectangles.along_strike(), Cells::new([0.0, 2.0], 3)?);
    assert_ne!(other.fingerprint(), rectangles.fingerprint());
    Ok(())
}
