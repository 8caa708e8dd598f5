//! Surfaces of triangles: sheets, orientation, axes, and what is refused.

use nalgebra::Vector3;
use stickslip_bie::{SurfaceError, Triangles};

use super::meshes::{Mesh, both, equilateral, grid, sphere};
use crate::Outcome;

fn triangles((points, triangles): &Mesh) -> Result<Triangles, SurfaceError> {
    Triangles::new(points, triangles)
}

/// A plane that dips to the south, with its upper edge along x.
fn dipping(counts: [usize; 2], dip: f64) -> Mesh {
    let (sin, cos) = dip.to_radians().sin_cos();
    grid(counts, |[x, y]| [x, -y * cos, -1.0 - y * sin])
}

fn message(mesh: &Mesh) -> String {
    triangles(mesh).map_or_else(|error| error.to_string(), |_| String::new())
}

#[test]
fn a_plane_has_the_axes_of_planar_faults() -> Outcome {
    for dip in [10.0_f64, 60.0, 90.0] {
        let cells = triangles(&dipping([4, 3], dip))?;
        let (sin, cos) = dip.to_radians().sin_cos();
        assert_eq!((cells.count(), cells.sheet_count()), (24, 1));
        // Strike and up dip turn together if the plane is vertical: either side may be that of the normal.
        let side = if cells.axes(0).strike[0] > 0.0 {
            1.0
        } else {
            -1.0
        };
        assert!(side > 0.0 || dip == 90.0);
        for cell in 0..cells.count() {
            let axes = cells.axes(cell);
            for (found, expected) in [
                (axes.strike, [side, 0.0, 0.0]),
                (axes.up_dip, [0.0, cos, sin]),
                (axes.normal, [0.0, -sin * side, cos]),
            ] {
                let error = (Vector3::from(found) - Vector3::from(expected)).amax();
                assert!(error < 1e-15, "{dip}: {error:e}");
            }
            assert!((cells.area(cell) - 0.5).abs() < 1e-15);
        }
    }
    Ok(())
}

/// Whatever the order of corners, the sheet is the same.
#[test]
fn orientations_are_made_consistent() -> Outcome {
    let mesh = dipping([5, 4], 40.0);
    let expected = triangles(&mesh)?;
    let mut turned = mesh.clone();
    let places = [0, 7, 8, 21, 39];
    for &cell in &places {
        turned.1[cell].swap(0, 1);
    }
    let found = triangles(&turned)?;
    for cell in 0..expected.count() {
        assert_eq!(expected.axes(cell), found.axes(cell));
        let was_turned = places.contains(&cell);
        let (before, after) = (expected.flipped(), found.flipped());
        assert_eq!(before.contains(&cell) ^ was_turned, after.contains(&cell));
    }
    Ok(())
}

#[test]
fn neighbors_share_their_edges() -> Outcome {
    let cells = triangles(&sphere(4))?;
    assert_eq!((cells.count(), cells.sheet_count()), (320, 1));
    let volume: f64 = (0..cells.count())
        .map(|cell| {
            let [a, b, c] = cells.corners(cell).map(Vector3::from);
            a.dot(&b.cross(&c)) / 6.0
        })
        .sum();
    assert!((volume.abs() - 4.0 / 3.0 * std::f64::consts::PI).abs() < 0.2);
    for cell in 0..cells.count() {
        for (k, other) in cells.neighbors(cell).iter().enumerate() {
            let corners = cells.triangles()[cell];
            let edge = [corners[k], corners[(k + 1) % 3]];
            let other = other.ok_or("a sphere has no rim")?;
            assert!(edge.iter().all(|v| cells.triangles()[other].contains(v)));
            assert!(cells.neighbors(other).contains(&Some(cell)));
        }
        // Five or six cells at each corner.
        assert!((11..=13).contains(&cells.vertex_neighbors(cell).len()));
    }
    Ok(())
}

#[test]
fn points_that_coincide_are_merged() -> Outcome {
    let (points, mesh) = dipping([3, 2], 55.0);
    // As a file of separate triangles, with rounding.
    let mut apart: Mesh = (Vec::new(), Vec::new());
    for (number, corners) in mesh.iter().enumerate() {
        apart.1.push([0, 1, 2].map(|k| 3 * number + k));
        for &corner in corners {
            apart
                .0
                .push(points[corner].map(|x| x + 1e-12 * number as f64));
        }
    }
    let cells = triangles(&apart)?;
    assert_eq!(cells.points().len(), 12);
    assert_eq!(cells.merged_points(), 3 * 12 - 12);
    assert_eq!(cells.sheet_count(), 1);
    Ok(())
}

/// A branch ends on a sheet: this goes on beyond it, and the branch is one of its own.
#[test]
fn branches_are_sheets() -> Outcome {
    let main = grid([6, 4], |[x, y]| [x, 0.0, -1.0 - y]);
    let branch = grid([3, 4], |[x, y]| [3.0 + 0.9 * x, 0.4 * x, -1.0 - y]);
    let cells = triangles(&both(main, branch))?;
    assert_eq!(cells.sheet_count(), 2);
    assert_eq!(cells.merged_points(), 5);
    let inner = |cell: usize| cells.neighbors(cell).iter().flatten().count();
    let sides: usize = (0..cells.count()).map(inner).sum();
    // Of both grids, without the edges along rims.
    assert_eq!(sides, 3 * 72 - 2 * (6 + 4) - 2 * (3 + 4));
    Ok(())
}

/// Strike goes on where a sheet is horizontal, and beyond.
#[test]
fn strike_goes_on_over_a_fold() -> Outcome {
    let cells = triangles(&grid([12, 2], |[x, y]| {
        let angle = (x - 2.0) * 0.15;
        [4.0 * angle.sin(), y, 4.0 * angle.cos() - 9.0]
    }))?;
    let flat = triangles(&grid([2, 2], |[x, y]| [x, y, -1.0]))?;
    assert_eq!(flat.axes(3).strike, [1.0, 0.0, 0.0]);
    for cell in 0..cells.count() {
        let axes = cells.axes(cell);
        assert!(axes.normal[2] > 0.0 && axes.strike[1] * cells.axes(0).strike[1] > 0.99);
        let [s, d, n] = [axes.strike, axes.up_dip, axes.normal].map(Vector3::from);
        assert!((s.cross(&d) - n).amax() < 1e-15);
    }
    Ok(())
}

#[test]
fn quality_is_reported() -> Outcome {
    let even = triangles(&equilateral(2.0, 0.25))?.quality();
    assert!(even.sides.iter().all(|side| (side - 0.25).abs() < 1e-15));
    assert!(even.largest_bend.is_some_and(|(bend, _)| bend == 0.0));
    let quality = triangles(&grid([4, 2], |[x, y]| {
        let bend = if x > 2.0 { 0.2 * (x - 2.0) } else { 0.0 };
        [30.0 * x, bend, -1.0 - y]
    }))?
    .quality();
    assert_eq!((quality.needles.len(), quality.uneven.len()), (16, 0));
    let (bend, _) = quality.largest_bend.ok_or("no neighbours")?;
    assert!((bend - (0.2_f64 / 30.0).atan().to_degrees()).abs() < 1e-9);
    assert!(
        quality
            .to_string()
            .starts_with("16 triangles, 1 sheets, box 120.0000 m x 0.4000 m x 2.0000 m")
    );
    Ok(())
}

#[test]
fn surfaces_that_are_none_are_refused() {
    let mesh = dipping([2, 2], 30.0);
    let with = |corners: [usize; 3]| {
        let mut mesh = mesh.clone();
        mesh.1.push(corners);
        mesh
    };
    assert!(message(&(mesh.0.clone(), Vec::new())).starts_with("the surface has no triangle"));
    assert_eq!(
        message(&with([0, 1, 9])),
        "triangle 8 has point 9 of 9: points are counted from 0"
    );
    assert!(message(&with([0, 1, 2])).starts_with("triangle 8 is degenerate: its area"));
    assert!(message(&with([0, 3, 3])).contains("is degenerate"));
    assert!(message(&with([4, 0, 1])).starts_with("triangles 0 and 8 have the same corners"));
    let mut holed = mesh.clone();
    holed.0[3][1] = f64::INFINITY;
    assert!(message(&holed).starts_with("point 3 has a coordinate that is"));
    // Another diagonal over the same square.
    assert!(matches!(
        triangles(&with([1, 4, 3])),
        Err(SurfaceError::TooNear { .. })
    ));
}

#[test]
fn a_moebius_strip_is_refused() {
    let mut mesh = grid([16, 1], |[x, y]| {
        let angle = x * std::f64::consts::PI / 8.0;
        let (sin, cos) = (0.5 * angle).sin_cos();
        let r = 4.0 + (y - 0.5) * cos;
        [r * angle.cos(), r * angle.sin(), (y - 0.5) * sin]
    });
    assert!(matches!(
        triangles(&mesh),
        Err(SurfaceError::NotOrientable { .. })
    ));
    // Cut open it has two sides.
    mesh.1.truncate(30);
    assert!(triangles(&mesh).is_ok());
}

#[test]
fn sheets_that_meet_where_they_should_not_are_refused() {
    let sheet = || grid([4, 4], |[x, y]| [x, y, -2.0]);
    let above = |height: f64| grid([4, 4], |[x, y]| [x + 0.3, y + 0.2, -2.0 + height]);
    for (height, is_refused) in [(0.0, true), (0.05, true), (0.2, false)] {
        let found = triangles(&both(sheet(), above(height)));
        assert_eq!(
            matches!(found, Err(SurfaceError::TooNear { .. })),
            is_refused
        );
    }
    // Through its middle, between the centroids; up to it, and not quite.
    for (top, is_refused) in [(0.5, true), (0.0, false), (-0.1, false)] {
        let wall = grid([2, 2], |[x, y]| [1.5 * x + 0.1, 1.99, -2.0 + top - y]);
        let found = triangles(&both(sheet(), wall));
        let crosses = matches!(found, Err(SurfaceError::Crossing { .. }));
        assert_eq!(crosses, is_refused, "{top}");
    }
}

/// Up to rounding above the free surface is on it.
#[test]
fn surfaces_above_the_free_surface_are_refused() -> Outcome {
    let below = |shift: f64, top: f64| {
        let mesh = grid([3, 3], |[x, y]| {
            let z = if y == 0.0 { top } else { -y };
            [x, 0.3 * y, z + shift]
        });
        triangles(&mesh)?.below_surface()
    };
    assert!(
        below(0.0, 1e-10)?
            .points()
            .iter()
            .all(|point| point[2] <= 0.0)
    );
    assert!(matches!(below(0.1, 0.0), Err(SurfaceError::AboveSurface { at }) if at[2] == 0.1));
    assert!(
        matches!(below(3.0, 0.0), Err(SurfaceError::DepthPositive { highest }) if highest == 3.0)
    );
    let mesh = grid([3, 3], |[x, y]| {
        [x, 0.3 * y, if y > 0.0 { -y } else { -1e-4 * x }]
    });
    assert!(matches!(
        triangles(&mesh)?.below_surface(),
        Err(SurfaceError::Gap { .. })
    ));
    Ok(())
}
