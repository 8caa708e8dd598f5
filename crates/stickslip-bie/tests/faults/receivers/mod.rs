//! Displacement and stress off faults.

mod closed_forms;
mod jumps;
mod reciprocity;
mod refused;
mod strains;

use stickslip_bie::{
    Cells, DippingFault, Fault, FaultSystem, Mode, OffFault, Placement, PlaneFault, Rectangles,
    SegmentFault, Segments, Sense, Sources, SurfaceFault, Triangles,
};

use crate::{IN_PLANE, MEDIUM, Outcome};

pub(crate) const POISSON_RATIO: f64 = 0.25;

/// Rectangular cells of 2 km x 1.5 km, from a distance down dip on.
pub(crate) fn rectangles(from: f64) -> Outcome<Rectangles> {
    let down = Cells::new([from, from + 4.5e3], 3)?;
    Ok(Rectangles::new(Cells::new([-1e3, 7e3], 4)?, down))
}

/// A bent surface of triangles below the free surface.
pub(crate) fn bent() -> Outcome<Triangles> {
    let points = [
        [0.0, 0.0, -1e3],
        [3e3, 200.0, -1.2e3],
        [3.2e3, -2e3, -3e3],
        [-100.0, -1.8e3, -2.9e3],
        [0.0, -2.5e3, -6e3],
        [3e3, -2.6e3, -6.2e3],
    ];
    Ok(Triangles::new(
        &points,
        &[[0, 2, 1], [0, 3, 2], [3, 4, 2], [4, 5, 2]],
    )?)
}

/// A bent line in plane strain or antiplane.
pub(crate) fn segments(mode: Mode) -> Outcome<SegmentFault> {
    let cells = Segments::polyline(&[[0.0, 0.0], [1e3, -2e3], [3e3, -4e3], [6e3, -5e3]])?;
    Ok(SegmentFault::half_space(cells, MEDIUM, mode)?)
}

/// Lines: their sources as such of two components.
pub(crate) fn lines() -> Outcome<Vec<(&'static str, Sources<1>)>> {
    let below = Cells::new([0.0, 6e3], 3)?;
    let around = Cells::new([-3e3, 3e3], 3)?;
    Ok(vec![
        ("half space", Fault::half_space(below, MEDIUM)?.sources()?),
        (
            "one of two halves",
            Fault::half_space(below, MEDIUM)?.one_sided().sources()?,
        ),
        (
            "whole space, antiplane",
            Fault::whole_space(around, MEDIUM, Mode::Antiplane)?.sources()?,
        ),
        (
            "whole space, plane strain",
            Fault::whole_space(around, MEDIUM, IN_PLANE)?.sources()?,
        ),
        (
            "thrust",
            DippingFault::new(below, MEDIUM, POISSON_RATIO, 40.0, Sense::Thrust)?.sources()?,
        ),
        (
            "normal fault",
            DippingFault::new(below, MEDIUM, POISSON_RATIO, 70.0, Sense::Normal)?.sources()?,
        ),
        ("segments", segments(IN_PLANE)?.sources()?),
        ("segments, antiplane", segments(Mode::Antiplane)?.sources()?),
    ])
}

/// Faults in space.
pub(crate) fn in_space() -> Outcome<Vec<(&'static str, Sources<2>)>> {
    let plane = PlaneFault::half_space(rectangles(0.0)?, 50.0, MEDIUM, POISSON_RATIO)?;
    let vertical = PlaneFault::half_space(rectangles(2e3)?, 90.0, MEDIUM, POISSON_RATIO)?;
    let place = |strike: f64, origin| Placement { strike, origin };
    let system = FaultSystem::new([
        (plane.clone(), place(30.0, [0.0, 0.0])),
        (vertical.clone(), place(140.0, [9e3, -12e3])),
    ])?;
    Ok(vec![
        ("plane", plane.sources()?),
        ("vertical plane", vertical.sources()?),
        (
            "plane in a whole space",
            PlaneFault::whole_space(rectangles(-2e3)?, MEDIUM, POISSON_RATIO)?.sources()?,
        ),
        ("system", system.sources()?),
        (
            "surface",
            SurfaceFault::half_space(bent()?, MEDIUM, POISSON_RATIO)?.sources()?,
        ),
        (
            "surface in a whole space",
            SurfaceFault::whole_space(bent()?, MEDIUM, POISSON_RATIO)?.sources()?,
        ),
    ])
}
