//! The stress of a triangle in a half space against other ways to it.

use nalgebra::{Matrix3, Vector3};
use proptest::prelude::*;
use stickslip_bie::{KernelError, RectangularDislocation, TriangularDislocation};

use super::axes;
use super::dislocation::TRIANGLE;
use crate::Outcome;

/// As those of a whole space.
#[rustfmt::skip]
const HALF_SPACE: [([f64; 3], [[f64; 6]; 3]); 4] = [
    ([2.0, 1.0, -1.0], [
        [0.013602267583, -0.019831145282, -0.019526346059, -0.015038834381, 0.00734164334, -0.018230490112],
        [1.143365028528e-02, 1.603706810464e-02, -1.007835633891e-01, 1.568043367367e-02, 5.966073869548e-03, 9.314676964073e-05],
        [0.028154648416, 0.088438967712, -0.078419924699, -0.023703667258, -0.003200773071, 0.072842967403],
    ]),
    ([-3.0, 2.0, -6.0], [
        [0.002831732397, -0.001545470501, 0.000155978081, -0.003094882298, -0.003445503192, -0.002145646758],
        [-0.00151854063, -0.003364869585, 0.005848992828, 0.002720568065, 0.003146130203, -0.000264086888],
        [0.008019381429, 0.002213608489, 0.009591373777, -0.001459405926, 0.005069523885, 0.002886636469],
    ]),
    ([1.5, 1.2, 0.0], [
        [2.538043280047e-02, 1.265382726178e-02, 0.0, -1.420138338634e-03, 0.0, 0.0],
        [9.605990341836e-02, 1.130160638872e-01, 0.0, 6.223328837782e-03, 0.0, 0.0],
        [1.146855189573e-01, 1.530911567799e-01, 0.0, -1.571442920571e-02, 0.0, 0.0],
    ]),
    ([10.0, -7.0, -4.0], [
        [3.828416605813e-05, -9.261993823200e-04, 1.053354985879e-04, 4.362691195174e-04, -2.034818787383e-05, -1.235138717972e-04],
        [0.000963017175, 0.000582048485, -0.000241384898, -0.00127836899, -0.000217060439, 0.000194193227],
        [-0.000680090046, -0.000313895559, 0.000316210688, 0.000845101657, -0.000106508799, 0.000160688143],
    ]),
];

#[test]
fn the_stress_is_that_of_angular_dislocations() -> Outcome {
    let source = TriangularDislocation::half_space(TRIANGLE, 1.0, 0.25)?;
    for (at, expected) in HALF_SPACE {
        for (slip, [xx, yy, zz, xy, xz, yz]) in axes(TRIANGLE).into_iter().zip(expected) {
            let expected = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
            let error = (source.stress(slip.into(), at) - expected).amax();
            assert!(error < 1e-9 * expected.amax() + 6e-13, "{at:?}: {error:e}");
        }
    }
    Ok(())
}

/// At its centroid, of a triangle inside and of one with an edge on the surface.
#[test]
fn the_own_traction_is_known() -> Outcome {
    let at_surface = [[1.0, -1.0, -1.5], [2.0, 0.0, 0.0], [0.0, 0.0, 0.0]];
    let inside = [
        [-0.4032026160180, -0.0100046789512, -0.000103383734582],
        [-0.0103553372756, -0.3883319885692, -0.00864804928569],
    ];
    let on_top = [
        [-0.6731775985073, 0.0, 0.0],
        [0.0, -0.4985795979707, -0.0788826775650],
    ];
    for (corners, expected) in [(TRIANGLE, inside), (at_surface, on_top)] {
        let source = TriangularDislocation::half_space(corners, 1.0, 0.25)?;
        let [strike, dip, normal] = axes(corners);
        let center = std::array::from_fn(|c| corners.iter().map(|v| v[c]).sum::<f64>() / 3.0);
        for (slip, expected) in [strike, dip].into_iter().zip(expected) {
            let traction = source.stress(slip.into(), center) * normal;
            let found = [
                traction.dot(&strike),
                traction.dot(&dip),
                -traction.dot(&normal),
            ];
            for (found, expected) in found.into_iter().zip(expected) {
                assert!((found - expected).abs() < 1e-11, "{found} {expected}");
            }
        }
    }
    Ok(())
}

/// Four triangles about an inner point, of any dip, from the surface or below it.
#[test]
fn a_fan_is_a_rectangle() -> Outcome {
    for (dip, depth) in [(90.0_f64, 5.0), (60.0, 0.0), (30.0, 1.0), (12.0, 0.0)] {
        let (sin, cos) = dip.to_radians().sin_cos();
        let (sin, cos) = if dip == 90.0 { (1.0, 0.0) } else { (sin, cos) };
        let point = |x: f64, down: f64| [x, -down * cos, -down * sin];
        let square =
            RectangularDislocation::new([-2.0, 3.0], [depth, depth + 4.0], dip, 1.0, 0.25)?;
        let corners = [[-2.0, 4.0], [3.0, 4.0], [3.0, 0.0], [-2.0, 0.0]];
        let corners = corners.map(|[x, y]| point(x, depth + y));
        let middle = point(0.7, depth + 1.3);
        for at in [
            point(0.2, depth + 2.2),
            point(-6.0, depth + 3.0),
            [1.0, 2.0, -4.0],
            [-3.0, 2.0, 0.0],
            [20.0, -30.0, -3.0],
        ] {
            for (slip, vector) in [([1.0, 0.0], [1.0, 0.0, 0.0]), ([0.0, 1.0], [0.0, cos, sin])] {
                let mut sum = Matrix3::zeros();
                for k in 0..4 {
                    let corners = [middle, corners[k], corners[(k + 1) % 4]];
                    let source = TriangularDislocation::half_space(corners, 1.0, 0.25)?;
                    sum += source.stress(vector, at);
                }
                let expected = square.stress(slip, at);
                let error = (sum - expected).amax();
                assert!(
                    error < 1e-10 * expected.amax() + 1e-14,
                    "{dip} {at:?}: {error:e}"
                );
            }
        }
    }
    Ok(())
}

/// A strip of two triangles, much longer than deep, is a segment in plane strain, and antiplane.
#[test]
fn long_strips_are_segments() -> Outcome {
    // By the potentials of edge and screw dislocations in a half space, `mu = 1`, `nu = 1/4`.
    let in_plane = [
        -0.026_754_701_390_6,
        0.040_392_948_991_3,
        0.058_687_316_684_1,
    ];
    let antiplane = [-0.038_005_102_790_0, 0.038_279_507_864_3];
    for (half, within) in [(1e2, 2e-4), (1e3, 2e-6), (1e4, 2e-8)] {
        let [a, b] = [[1.0, -2.0], [3.0, -7.0]];
        let point = |[x, z]: [f64; 2], y: f64| [x, y, z];
        // Slip of the left side, as seen along the segment.
        let triangles = [
            [point(a, -half), point(a, half), point(b, half)],
            [point(a, -half), point(b, half), point(b, -half)],
        ];
        let mut sums = [Matrix3::zeros(); 2];
        for corners in triangles {
            let source = TriangularDislocation::half_space(corners, 1.0, 0.25)?;
            assert!(axes(corners)[2].x < 0.0);
            for (sum, slip) in sums.iter_mut().zip([[0.6, 0.0, 0.8], [0.0, 1.0, 0.0]]) {
                *sum -= source.stress(slip, [-1.0, 0.0, -3.0]);
            }
        }
        let found = [sums[0][(0, 0)], sums[0][(2, 2)], sums[0][(0, 2)]];
        for (found, expected) in found.into_iter().zip(in_plane) {
            assert!(
                (found - expected).abs() < within,
                "{half}: {found} {expected}"
            );
        }
        let found = [sums[1][(0, 1)], sums[1][(1, 2)]];
        for (found, expected) in found.into_iter().zip(antiplane) {
            assert!(
                (found - expected).abs() < within,
                "{half}: {found} {expected}"
            );
        }
    }
    Ok(())
}

/// Triangles of half a metre 10 km away are points: as large ones, up to the square of their size by the distance.
#[test]
fn small_triangles_far_away_are_points() -> Outcome {
    let around = [[0.9, 0.1, 0.3], [-0.8, 0.5, -0.4], [-0.1, -0.6, 0.1]];
    let of = |size: f64, at: [f64; 3]| -> Outcome<Matrix3<f64>> {
        let corners = around.map(|[x, y, z]| [x * size, y * size, z * size - 6e3]);
        let source = TriangularDislocation::half_space(corners, 1.0, 0.25)?;
        Ok(source.stress([0.3, -0.7, 0.5], at) / (size * size))
    };
    for at in [
        [1e4, 0.0, 0.0],
        [7e3, -7e3, -2e3],
        [1.0, 2.0, -16e3],
        [300.0, 1e4, -6e3],
    ] {
        let expected = of(20.0, at)?;
        let error = (of(0.5, at)? - expected).amax() / expected.amax();
        assert!(error < 2e-5, "{at:?}: {error:e}");
    }
    Ok(())
}

fn points() -> impl Strategy<Value = [[f64; 3]; 5]> {
    prop::array::uniform5([-3.0..3.0, -3.0..3.0, -4.0..0.0])
}

proptest! {
    /// Triangles about any point of a rectangle of any dip and depth are the rectangle.
    #[test]
    fn a_random_fan_is_a_rectangle(
        dip in 3.0..90.0_f64,
        [top, length, width] in [0.0..3.0, 0.5..4.0, 0.5..4.0_f64],
        [u, v] in [0.1..0.9, 0.1..0.9_f64],
        at in [-6.0..6.0, -6.0..6.0, -6.0..0.0_f64],
        slip in [-1.0..1.0, -1.0..1.0_f64],
    ) {
        let (sin, cos) = dip.to_radians().sin_cos();
        let point = |x: f64, down: f64| [x, -down * cos, -down * sin];
        // Away from its plane.
        prop_assume!((at[1] * sin - at[2] * cos).abs() > 0.1);
        let failed = |error: KernelError| TestCaseError::fail(error.to_string());
        let square = RectangularDislocation::new([0.0, length], [top, top + width], dip, 1.0, 0.25)
            .map_err(failed)?;
        let corners = [[0.0, width], [length, width], [length, 0.0], [0.0, 0.0]];
        let corners = corners.map(|[x, y]| point(x, top + y));
        let middle = point(u * length, top + v * width);
        let vector = [slip[0], slip[1] * cos, slip[1] * sin];
        let mut sum = Matrix3::zeros();
        for k in 0..4 {
            let corners = [middle, corners[k], corners[(k + 1) % 4]];
            let source = TriangularDislocation::half_space(corners, 1.0, 0.25).map_err(failed)?;
            sum += source.stress(vector, at);
        }
        let expected = square.stress(slip, at);
        let error = (sum - expected).amax();
        prop_assert!(error < 1e-9 * (0.1 + expected.amax()), "{error:e} of {:e}", expected.amax());
    }

    /// The surface is free of traction.
    #[test]
    fn the_surface_is_free([a, b, c, at, slip] in points(), touches in any::<bool>()) {
        let mut corners = [a, b, c];
        if touches {
            corners[0][2] = 0.0;
            corners[1][2] = 0.0;
        }
        let [va, vb, vc] = corners.map(Vector3::from);
        prop_assume!((vb - va).cross(&(vc - va)).norm() > 0.5);
        let at = [at[0], at[1], 0.0];
        prop_assume!(corners.iter().all(|v| (Vector3::from(*v) - Vector3::from(at)).norm() > 0.3));
        // Away from an edge on the surface.
        let edge = (vb - va).cross(&(Vector3::from(at) - va)).norm() / (vb - va).norm();
        prop_assume!(edge > 0.3);
        let source = TriangularDislocation::half_space(corners, 1.0, 0.25)
            .map_err(|error| TestCaseError::fail(error.to_string()))?;
        let stress = source.stress(slip, at);
        let scale = 1.0 + stress.amax();
        prop_assert!(stress.column(2).amax() < 1e-12 * scale, "{:e}", stress.column(2).amax());
    }
}
