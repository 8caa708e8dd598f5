//! Systems that are none, and parts of those that are.

use nalgebra::{Vector1, Vector2};
use stickslip_bie::{FaultSystem, KernelError, Medium, Placement, PlaneFault};

use super::{at, plane, planes};
use crate::planes::{POISSON, cells};
use crate::{MEDIUM, Outcome};

fn refused<T>(result: Result<T, KernelError>) -> KernelError {
    match result {
        Err(error) => error,
        Ok(_) => panic!("accepted"),
    }
}

#[test]
fn memory_is_limited() -> Outcome {
    // Two planes of 20 and 15 cells: 2 * 300 pairs, with four numbers for shear and two for normal stress.
    let two = || -> Outcome<_> { Ok(planes(0.0)?.into_iter().take(2)) };
    let bytes = 2 * 20 * 15 * 6 * 8;
    FaultSystem::with_memory_limit(two()?, bytes)?;
    let error = refused(FaultSystem::with_memory_limit(two()?, bytes - 1));
    assert_eq!(
        error.to_string(),
        "memory [bytes] of the interaction between planes must be at most 28799, is 28800"
    );
    // Beyond 2 GiB, refused before any of it is taken.
    let one = || plane(cells([200, 100], [100.0, 100.0], 0.0)?, 90.0);
    let error = refused(FaultSystem::new([
        (one()?, at(0.0, [0.0, 0.0])),
        (one()?, at(0.0, [1e3, 0.0])),
    ]));
    assert_eq!(error.bound, Some(2_f64.powi(31)));
    assert_eq!(error.value, 2.0 * 4e8 * 6.0 * 8.0);
    Ok(())
}

#[test]
fn planes_of_no_system_are_refused() -> Outcome {
    let one = || plane(cells([3, 2], [100.0, 100.0], 0.0)?, 60.0);
    let none: [(PlaneFault, Placement); 0] = [];
    let error = refused(FaultSystem::new(none));
    assert_eq!(error.what, "number of planes of a system");
    for (placement, what) in [
        (at(f64::NAN, [0.0; 2]), "strike [degrees]"),
        (at(f64::INFINITY, [0.0; 2]), "strike [degrees]"),
        (at(0.0, [f64::NAN, 0.0]), "origin [m] to the east"),
        (at(0.0, [0.0, f64::INFINITY]), "origin [m] to the north"),
    ] {
        let error = refused(FaultSystem::new([
            (one()?, at(0.0, [0.0; 2])),
            (one()?, placement),
        ]));
        assert_eq!((error.what, error.plane), (what, Some(1)));
    }
    let whole = PlaneFault::whole_space(*one()?.cells(), MEDIUM, POISSON)?;
    let error = refused(FaultSystem::new([(whole, at(0.0, [0.0; 2]))]));
    assert_eq!(
        error.to_string(),
        "number of free surfaces of plane 0 must be at least 1, is 0"
    );
    let stiffer = Medium {
        shear_modulus: 40e9,
        ..MEDIUM
    };
    let faster = Medium {
        shear_wave_speed: 4e3,
        ..MEDIUM
    };
    for (rock, poisson_ratio, what) in [
        (stiffer, POISSON, "shear modulus"),
        (faster, POISSON, "shear wave speed"),
        (MEDIUM, 0.3, "Poisson's ratio"),
    ] {
        let other = PlaneFault::half_space(*one()?.cells(), 60.0, rock, poisson_ratio)?;
        let error = refused(FaultSystem::new([
            (one()?, at(0.0, [0.0; 2])),
            (other, at(0.0, [5e3, 0.0])),
        ]));
        assert_eq!((error.what, error.plane), (what, Some(1)));
    }
    Ok(())
}

#[test]
fn planes_that_cross_are_refused() -> Outcome {
    let of = |dip: f64| plane(cells([10, 4], [100.0, 100.0], 0.0)?, dip);
    let pair = |first: (f64, Placement), second: (f64, Placement)| -> Outcome<_> {
        let planes = [(of(first.0)?, first.1), (of(second.0)?, second.1)];
        Ok(FaultSystem::new(planes))
    };
    let first = (90.0, at(0.0, [0.0; 2]));
    // An X, between the centres of cells.
    let error = refused(pair(first, (90.0, at(90.0, [-500.0, 500.0])))?);
    assert_eq!(error.what, "length [m] of the intersection");
    assert!((error.value - 400.0).abs() < 1e-3, "{}", error.value);
    assert!(
        error
            .to_string()
            .contains("of the intersection of plane 0 and plane 1 must be at most 0, is ")
    );
    // Two planes that dip towards each other cross below the surface, where both end at the surface they do not.
    let opposite = |apart: f64| (45.0, at(180.0, [apart, 1e3]));
    let dipping = (45.0, at(0.0, [0.0; 2]));
    let error = refused(pair(dipping, opposite(300.0))?);
    assert!((error.value - 1e3).abs() < 1e-3, "{}", error.value);
    pair(dipping, opposite(600.0))?.map_err(|error| error.to_string())?;
    // The same plane, a part of it, and by less than half of a cell.
    for shift in [0.0, 450.0, 970.0] {
        let error = refused(pair(first, (90.0, at(0.0, [0.0, shift])))?);
        assert_eq!(error.what, "length [m] of the intersection");
        let error = refused(pair(first, (90.0, at(180.0, [0.0, 1e3 + shift])))?);
        assert_eq!(error.what, "length [m] of the intersection");
    }
    // They may continue each other, bend, and end on one another.
    for second in [
        at(0.0, [0.0, 1e3]),
        at(30.0, [0.0, 1e3]),
        at(90.0, [0.0, 1e3]),
        at(90.0, [0.0, 500.0]),
        at(90.0, [-1e3, 500.0]),
    ] {
        pair(first, (90.0, second))?.map_err(|error| error.to_string())?;
        pair((90.0, second), first)?.map_err(|error| error.to_string())?;
    }
    Ok(())
}

/// Stress is singular at the edges of cells.
#[test]
fn centres_on_other_planes_are_refused() -> Outcome {
    let of = |size: f64| plane(cells([5, 4], [size, size], 0.0)?, 90.0);
    let pair = |origin: [f64; 2], strike: f64| -> Outcome<_> {
        Ok(FaultSystem::new([
            (of(100.0)?, at(0.0, [0.0; 2])),
            (of(100.0)?, at(strike, origin)),
        ]))
    };
    // A plane that ends on a column of centres.
    let error = refused(pair([0.0, 250.0], 90.0)?);
    assert_eq!(
        error.to_string(),
        "distance [m] between the centre of cell 2 of plane 0 and plane 1 must be at least 10, is 0"
    );
    // Parallel planes.
    let error = refused(pair([9.0, 0.0], 0.0)?);
    assert_eq!((error.cell, error.value), (Some(0), 9.0));
    assert_eq!((error.plane, error.other_plane), (Some(0), Some(1)));
    pair([11.0, 0.0], 0.0)?.map_err(|error| error.to_string())?;
    Ok(())
}

#[test]
fn loads_of_another_system_are_refused() -> Outcome {
    let system = FaultSystem::new(planes(0.0)?)?;
    let error = refused(system.plate_loading(&[Vector2::zeros(); 2]));
    assert_eq!(
        error.to_string(),
        "number of plate rates must be that of the planes, 3, is 2"
    );
    let mut rates = [Vector2::zeros(); 3];
    rates[1][0] = f64::NAN;
    let error = refused(system.plate_loading(&rates));
    assert_eq!(error.cell, Some(20));
    let error = refused(system.back_slip(&rates));
    assert_eq!(error.what, "number of plate rates");
    let error = refused(system.radiation_damping_times(-1.0));
    assert_eq!(error.what, "factor of radiation damping");
    Ok(())
}

/// Vertices, centres and sections.
#[test]
fn vertices_are_numbered_plane_after_plane() -> Outcome {
    let system = FaultSystem::new(super::raked(planes(180.0)?, 20.0)?)?;
    assert_eq!(system.vertex_count(), 20 + 15 + 12);
    assert_eq!(system.vertices(1), 20..35);
    assert_eq!(system.plane_and_cell(34), [1, 14]);
    assert_eq!(system.area(20), 62_500.0);
    // Strike to the south.
    let [east, north, up] = system.center(0);
    assert!((east + 100.0).abs() < 1e-12 && (north + 100.0).abs() < 1e-12);
    assert_eq!(up, -100.0);
    // A plane dips to the right.
    let dipping = plane(cells([1, 1], [2.0, 2.0], 0.0)?, 30.0)?;
    let system_of_one = FaultSystem::new([(dipping, at(0.0, [0.0; 2]))])?;
    let [east, north, up] = system_of_one.center(0);
    assert!((east - 30f64.to_radians().cos()).abs() < 1e-15);
    assert!((north - 1.0).abs() < 1e-15 && (up + 0.5).abs() < 1e-15);
    let section = system.section(1, |[x, y]| x > 500.0 && y < 500.0)?;
    assert_eq!((section.plane(), section.vertices()), (1, &[22, 25][..]));
    assert_eq!(section.map(|[x, _]| x), [625.0, 625.0]);
    assert_eq!(section.points()[1], system.center(25));
    assert_eq!(section.cells(), system.cells(1));
    assert_eq!(section.identity(), system.identity());
    let error = refused(system.section(1, |_| false));
    assert_eq!(
        (error.what, error.plane),
        ("number of cells of a section", Some(1))
    );
    let error = refused(system.section(3, |_| true));
    assert_eq!((error.value, error.bound), (3.0, Some(3.0)));
    let slip = vec![Vector1::new(1.0); 47];
    assert_eq!(slip[system.vertices(2)].len(), 12);
    Ok(())
}
