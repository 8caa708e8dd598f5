//! Faults that are none.

use stickslip_bie::{Cells, Fault, KernelError, Medium, Mode};

use crate::{MEDIUM, Outcome};

#[test]
fn cells_that_are_none_or_uneven_are_refused() {
    let none = |refused: Result<Cells, KernelError>| {
        let error = refused.expect_err("accepted");
        assert_eq!((error.what, error.value), ("number of cells", 0.0));
    };
    none(Cells::new([0.0, 1.0], 0));
    for edges in [&[][..], &[1.0]] {
        none(Cells::between(edges));
    }
    for ends in [
        [1.0, 1.0],
        [1.0, 0.0],
        [0.0, f64::INFINITY],
        [f64::NAN, 1.0],
        [-1e308, 1e308],
    ] {
        let error = Cells::new(ends, 2).expect_err("accepted");
        assert_eq!(error.what, "end of the cells [m]");
        let told = [error.bound.expect("a bound"), error.value];
        assert_eq!(told.map(f64::to_bits), ends.map(f64::to_bits));
    }
    let error = Cells::between(&[0.0, 1.0, 2.5, 3.0]).expect_err("accepted");
    assert_eq!(
        (error.cell, error.value, error.bound),
        (Some(1), 1.5, Some(1.0))
    );
    assert_eq!(
        error.to_string(),
        "length [m] of cell 1 must be the mean of all, 1, is 1.5"
    );
    let error = Cells::between(&[0.0, f64::NAN, 3.0]).expect_err("accepted");
    assert_eq!((error.what, error.cell), ("length [m] of cell", Some(0)));
    assert_eq!(Cells::between(&[0.0, 1.0, 2.0]), Cells::new([0.0, 2.0], 2));
}

#[test]
fn rock_that_is_none_is_refused() -> Outcome {
    let cells = Cells::new([0.0, 1.0], 2)?;
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
            for fault in [
                Fault::half_space(cells, rock),
                Fault::whole_space(cells, rock, Mode::Antiplane),
                Fault::periodic(cells, rock, Mode::Antiplane),
            ] {
                assert!(
                    matches!(fault, Err(KernelError { what, .. }) if what == name),
                    "{fault:?}"
                );
            }
        }
    }
    for poisson_ratio in [-1.0, 0.5, f64::NAN] {
        let fault = Fault::whole_space(cells, MEDIUM, Mode::InPlane { poisson_ratio });
        assert!(
            matches!(
                fault,
                Err(KernelError {
                    what: "Poisson's ratio",
                    ..
                })
            ),
            "{fault:?}"
        );
    }
    let above = Fault::half_space(Cells::new([-0.5, 1.0], 2)?, MEDIUM);
    let error = above.expect_err("accepted");
    assert_eq!(
        (error.what, error.value),
        ("depth [m] of the fault's upper end", -0.5)
    );
    Ok(())
}

/// Sections that share an end share no cell, and have all between them.
#[test]
fn sections_part_the_cells() -> Outcome {
    let cells = Cells::new([0.0, 10.0], 10)?;
    let (upper, lower) = (cells.section([0.0, 4.5])?, cells.section([4.5, 10.0])?);
    assert_eq!(
        (upper.vertices(), lower.vertices()[0]),
        (&[0, 1, 2, 3][..], 4)
    );
    assert_eq!(upper.map(|z| z), [0.5, 1.5, 2.5, 3.5]);
    assert_eq!(cells.all().vertices().len(), 10);
    for range in [[11.0, 12.0], [5.0, 4.0], [f64::NAN, 1.0]] {
        let error = cells.section(range).expect_err("accepted");
        assert_eq!(error.what, "end of a section [m]");
        let told = [error.bound.expect("a bound"), error.value];
        assert_eq!(told.map(f64::to_bits), range.map(f64::to_bits));
    }
    Ok(())
}
