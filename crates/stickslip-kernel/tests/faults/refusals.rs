//! Faults that are none.

use stickslip_kernel::{Cells, Fault, KernelError, Mode, Rock};

use crate::{Outcome, ROCK};

#[test]
fn cells_that_are_none_or_uneven_are_refused() {
    assert_eq!(Cells::new([0.0, 1.0], 0), Err(KernelError::NoCells));
    for edges in [&[][..], &[1.0]] {
        assert_eq!(Cells::between(edges), Err(KernelError::NoCells));
    }
    for ends in [
        [1.0, 1.0],
        [1.0, 0.0],
        [0.0, f64::INFINITY],
        [f64::NAN, 1.0],
        [-1e308, 1e308],
    ] {
        let refused = Cells::new(ends, 2);
        assert!(
            matches!(refused, Err(KernelError::Extent { .. })),
            "{ends:?}"
        );
    }
    let error = Cells::between(&[0.0, 1.0, 2.5, 3.0]);
    assert_eq!(
        error,
        Err(KernelError::Uneven {
            cell: 1,
            length: 1.5,
            mean: 1.0
        })
    );
    let error = Cells::between(&[0.0, f64::NAN, 3.0]);
    assert!(
        matches!(error, Err(KernelError::Uneven { cell: 0, .. })),
        "{error:?}"
    );
    assert_eq!(Cells::between(&[0.0, 1.0, 2.0]), Cells::new([0.0, 2.0], 2));
}

#[test]
fn rock_that_is_none_is_refused() -> Outcome {
    let cells = Cells::new([0.0, 1.0], 2)?;
    for wrong in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        for (rock, name) in [
            (
                Rock {
                    shear_modulus: wrong,
                    ..ROCK
                },
                "shear modulus",
            ),
            (
                Rock {
                    shear_wave_speed: wrong,
                    ..ROCK
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
                    matches!(fault, Err(KernelError::Parameter { parameter, .. }) if parameter == name),
                    "{fault:?}"
                );
            }
        }
    }
    for poisson_ratio in [-1.0, 0.5, f64::NAN] {
        let fault = Fault::whole_space(cells, ROCK, Mode::InPlane { poisson_ratio });
        assert!(
            matches!(fault, Err(KernelError::Parameter { .. })),
            "{fault:?}"
        );
    }
    let above = Fault::half_space(Cells::new([-0.5, 1.0], 2)?, ROCK);
    assert_eq!(above, Err(KernelError::AboveSurface { begin: -0.5 }));
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
        let empty = cells.section(range);
        assert!(
            matches!(empty, Err(KernelError::EmptySection { .. })),
            "{empty:?}"
        );
    }
    Ok(())
}
