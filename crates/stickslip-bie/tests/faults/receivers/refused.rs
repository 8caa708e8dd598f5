//! Receivers that are refused.

use nalgebra::Vector1;
use stickslip_bie::{
    Cells, Fault, Mode, OffFault, PlaneFault, ReceiverError, Receivers, SurfaceFault,
    TriangularDislocation,
};

use super::{POISSON_RATIO, bent, rectangles, segments};
use crate::{IN_PLANE, MEDIUM, Outcome};

#[test]
fn points_that_have_no_displacement() -> Outcome {
    let plane = PlaneFault::half_space(rectangles(0.0)?, 90.0, MEDIUM, POISSON_RATIO)?;
    let refused = |point: [f64; 3]| Receivers::new(&plane, &[[9e3, 5.0, -1.0], point]).err();
    assert!(matches!(
        refused([0.0, f64::NAN, 0.0]),
        Some(ReceiverError::NotFinite { receiver: 1, .. })
    ));
    assert_eq!(
        refused([0.0, 0.0, 2.5]),
        Some(ReceiverError::AboveSurface {
            receiver: 1,
            height: 2.5
        })
    );
    // On the edge between two cells, and at the trace.
    for (point, cells) in [([1e3, 0.0, -700.0], [0, 1]), ([2e3, 0.0, 0.0], [1, 1])] {
        let error = refused(point);
        assert!(
            matches!(error, Some(ReceiverError::AtEdge { receiver: 1, cell, .. }) if cells.contains(&cell)),
            "{error:?}"
        );
    }
    let whole = PlaneFault::whole_space(rectangles(0.0)?, MEDIUM, POISSON_RATIO)?;
    assert!(Receivers::new(&whole, &[[0.0, 0.0, 5.0]]).is_ok());
    Ok(())
}

#[test]
fn faults_that_have_none() -> Outcome {
    let at = [[100.0, 0.0, -100.0]];
    let cells = Cells::new([0.0, 1e3], 4)?;
    let periodic = Fault::periodic(cells, MEDIUM, Mode::Antiplane)?;
    assert_eq!(
        Receivers::new(&periodic, &at).err(),
        Some(ReceiverError::Periodic)
    );
    let plane = PlaneFault::whole_space(rectangles(0.0)?, MEDIUM, POISSON_RATIO)?;
    let plane = plane.periodic_along_strike()?;
    assert_eq!(
        Receivers::new(&plane, &at).err(),
        Some(ReceiverError::Periodic)
    );
    let bent_line = Receivers::new(&segments(IN_PLANE)?, &at)?;
    assert_eq!(
        bent_line.creep(Vector1::new(1.0)),
        Err(ReceiverError::NoPlane)
    );
    let surface = SurfaceFault::half_space(bent()?, MEDIUM, POISSON_RATIO)?.with_rake(90.0)?;
    let surface = Receivers::new(&surface, &at)?;
    assert_eq!(
        surface.creep(Vector1::new(1.0)),
        Err(ReceiverError::NoPlane)
    );
    let wrong = surface.displacement(&[Vector1::new(1.0); 3]).err();
    assert!(wrong.is_some_and(|error| error.to_string().contains("number of slips")));
    assert!(surface.displacement(&[Vector1::new(1.0); 4]).is_ok());
    let line = Receivers::new(&Fault::half_space(cells, MEDIUM)?, &at)?;
    assert!(line.creep(Vector1::new(f64::NAN)).is_err());
    Ok(())
}

#[test]
fn memory_is_refused_before_it_is_taken() -> Outcome {
    let sources = Fault::half_space(Cells::new([0.0, 1e3], 100)?, MEDIUM)?.sources()?;
    let points = [[100.0, 0.0, -100.0]; 3];
    let fits = Receivers::within(3 * 100 * 24, sources.clone(), &points)?;
    assert_eq!(fits.memory(), 3 * 100 * 24);
    let refused = Receivers::within(3 * 100 * 24 - 1, sources, &points).err();
    assert_eq!(
        refused,
        Some(ReceiverError::Memory {
            receivers: 3,
            cells: 100,
            bytes: 7200.0,
            limit: 7199.0
        })
    );
    Ok(())
}

#[test]
fn triangles_in_different_rock_are_no_fault() -> Outcome {
    let corners = [[0.0, 0.0, -1.0], [1.0, 0.0, -1.0], [0.0, 1.0, -2.0]];
    let one = TriangularDislocation::half_space(corners, 1.0, 0.25)?;
    let other = TriangularDislocation::half_space(corners, 2.0, 0.25)?;
    let slip = [[1.0, 0.0, 0.0]];
    let of = |triangles: [TriangularDislocation; 2]| {
        stickslip_bie::Sources::triangles(triangles.map(|triangle| (triangle, slip)))
    };
    assert!(of([one, one]).is_some_and(|sources| sources.count() == 2));
    assert!(of([one, other]).is_none());
    Ok(())
}
