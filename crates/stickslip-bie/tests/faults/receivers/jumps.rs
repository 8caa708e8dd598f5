//! The jump of displacement across cells.

use nalgebra::{Vector1, Vector3};
use stickslip_bie::{
    Cells, DippingFault, Fault, FaultSystem, Mode, OffFault, Placement, PlaneFault, Receivers,
    Sense, SurfaceFault,
};

use super::{POISSON_RATIO, bent, rectangles, segments};
use crate::{IN_PLANE, MEDIUM, Outcome};

/// Expects that slip of a cell is the jump across its middle from the side of the normal: displacement is the mean of points
/// so near on both sides that its gradient, about slip over size, moves it by less than 1e-12.
fn expect(
    name: &str,
    fault: &impl OffFault<1>,
    cell: usize,
    [middle, normal, slip]: [Vector3<f64>; 3],
) -> Outcome {
    let beside = |side: f64| (middle + normal * (1e-9 * side)).into();
    let receivers = Receivers::new(fault, &[beside(1.0), beside(-1.0)])?;
    let mut slips = vec![Vector1::new(0.0); receivers.cell_count()];
    slips[cell][0] = 1.5;
    let moved = receivers.displacement(&slips)?;
    for (i, slip) in slip.iter().enumerate() {
        let jump = moved[0][i] - moved[1][i];
        assert!(
            (jump - 1.5 * slip).abs() < 1e-10,
            "{name}: {moved:?} {slip}"
        );
    }
    Ok(())
}

#[test]
fn lines_jump_by_their_slip() -> Outcome {
    let [x, y, z] = [Vector3::x(), Vector3::y(), Vector3::z()];
    let cells = Cells::new([0.0, 6e3], 3)?;
    let middle = z * -3e3;
    let fault = Fault::half_space(cells, MEDIUM)?;
    expect("half space", &fault, 1, [middle, x, y])?;
    expect("one of two", &fault.one_sided(), 1, [middle, x, y * 2.0])?;
    let fault = Fault::whole_space(cells, MEDIUM, Mode::Antiplane)?;
    expect("whole space", &fault, 1, [middle, x, y])?;
    let fault = Fault::whole_space(cells, MEDIUM, IN_PLANE)?;
    expect("plane strain", &fault, 1, [middle, x, z])?;
    for dip in [90.0_f64, 60.0, 15.0] {
        let (sin, cos) = dip.to_radians().sin_cos();
        let (normal, up) = (Vector3::new(sin, 0.0, cos), Vector3::new(-cos, 0.0, sin));
        for (sense, slip) in [(Sense::Thrust, up), (Sense::Normal, -up)] {
            let fault = DippingFault::new(cells, MEDIUM, POISSON_RATIO, dip, sense)?;
            // The first reaches the surface.
            for cell in 0..3 {
                let middle = up * -cells.center(cell);
                expect("dipping", &fault, cell, [middle, normal, slip])?;
            }
        }
    }
    for mode in [IN_PLANE, Mode::Antiplane] {
        let fault = segments(mode)?;
        for cell in 0..3 {
            let [a, b] = fault.cells().ends(cell);
            let middle = Vector3::new(0.5 * (a[0] + b[0]), 0.0, 0.5 * (a[1] + b[1]));
            let axes = fault.axes(cell).map(|[x, z]| Vector3::new(x, 0.0, z));
            let slip = if mode == Mode::Antiplane { y } else { axes[1] };
            expect("segments", &fault, cell, [middle, axes[0], slip])?;
        }
    }
    Ok(())
}

#[test]
fn planes_jump_by_their_slip() -> Outcome {
    let cells = rectangles(0.0)?;
    for dip in [90.0_f64, 60.0, 15.0] {
        let (sin, cos) = dip.to_radians().sin_cos();
        let up = Vector3::new(0.0, cos, sin);
        let normal = Vector3::new(0.0, -sin, cos);
        let plane = PlaneFault::half_space(cells, dip, MEDIUM, POISSON_RATIO)?;
        for rake in [0.0_f64, 90.0, -140.0] {
            let fault = plane.clone().with_rake(rake)?;
            let (s, c) = rake.to_radians().sin_cos();
            for cell in 0..cells.count() {
                // The centre is on the diagonal.
                let [along, down] = cells.center(cell);
                let middle = Vector3::x() * along - up * down;
                let slip = Vector3::x() * c + up * s;
                expect("plane", &fault, cell, [middle, normal, slip])?;
            }
        }
    }
    let fault = PlaneFault::whole_space(cells, MEDIUM, POISSON_RATIO)?.with_rake(90.0)?;
    let [x, y] = cells.center(5);
    let places = [Vector3::new(x, -y, 0.0), Vector3::z(), Vector3::y()];
    expect("whole space", &fault, 5, places)
}

#[test]
fn systems_and_surfaces_jump_by_their_slip() -> Outcome {
    let plane = PlaneFault::half_space(rectangles(0.0)?, 50.0, MEDIUM, POISSON_RATIO)?;
    let plane = plane.with_rake(90.0)?;
    let place = |strike: f64, origin| Placement { strike, origin };
    let system = FaultSystem::new([
        (plane.clone(), place(0.0, [0.0, 0.0])),
        (plane, place(90.0, [40e3, 0.0])),
    ])?;
    let (sin, cos) = 50_f64.to_radians().sin_cos();
    for (cell, [x, y]) in [(3, [1.0, 0.0]), (15, [0.0, -1.0])] {
        // Down to the right of strike.
        let normal = Vector3::new(x * sin, y * sin, cos);
        let slip = Vector3::new(-x * cos, -y * cos, sin);
        expect(
            "system",
            &system,
            cell,
            [system.center(cell).into(), normal, slip],
        )?;
    }
    let surface = bent()?;
    let fault = SurfaceFault::half_space(surface.clone(), MEDIUM, POISSON_RATIO)?;
    let fault = fault.with_rake(90.0)?;
    for cell in 0..surface.count() {
        let axes = surface.axes(cell);
        let middle = surface.centroid(cell).into();
        let places = [middle, axes.normal.into(), axes.up_dip.into()];
        expect("surface", &fault, cell, places)?;
    }
    Ok(())
}

/// The rest of a plane does not jump across the cells, and by its slip beyond them.
#[test]
fn creep_beyond_the_cells_is_smooth_across_them() -> Outcome {
    let cells = Cells::new([0.0, 6e3], 3)?;
    let fault = DippingFault::new(cells, MEDIUM, POISSON_RATIO, 60.0, Sense::Thrust)?;
    let (sin, cos) = 60_f64.to_radians().sin_cos();
    let beside = |down: f64, side: f64| {
        let (along, across) = (down, 1e-9 * side);
        [along * cos + across * sin, 0.0, across * cos - along * sin]
    };
    for (down, jump) in [(1e3, 0.0), (5.5e3, 0.0), (6.5e3, 1.0), (30e3, 1.0)] {
        let receivers = Receivers::new(&fault, &[beside(down, 1.0), beside(down, -1.0)])?;
        let moved = receivers.creep(Vector1::new(2.0))?;
        let expected = [-cos, 0.0, sin].map(|part| 2.0 * jump * part);
        for i in 0..3 {
            let found = moved[0][i] - moved[1][i];
            assert!((found - expected[i]).abs() < 1e-10, "{down}: {found}");
        }
    }
    Ok(())
}
