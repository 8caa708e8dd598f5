//! The stress of a triangle against other ways to it.

use nalgebra::{Matrix3, Vector3};
use proptest::prelude::*;
use stickslip_bie::{KernelError, RectangularDislocation, TriangularDislocation};

use super::axes;
use crate::Outcome;

pub(super) const TRIANGLE: [[f64; 3]; 3] = [[0.0, 0.0, -3.0], [4.0, 1.0, -2.0], [1.0, 3.0, -5.0]];

/// `xx yy zz xy xz yz` at four points of slip along strike, up dip and open, `mu = 1`, `nu = 1/4`, by angular
/// dislocations (M. Nikkhoo and T. R. Walter, Geophys. J. Int. 201 (2015); cutde).
#[rustfmt::skip]
const WHOLE_SPACE: [([f64; 3], [[f64; 6]; 3]); 4] = [
    ([2.0, 1.0, -1.0], [
        [0.009146050234, -0.014928907808, -0.023165176738, -0.011730261222, 0.019453747525, -0.010363881955],
        [-1.401179127083e-02, -2.789286196188e-03, -1.722610464625e-01, 1.189957570095e-02, 4.992744441751e-03, -1.411347643466e-04],
        [0.003851692711, 0.060729971536, -0.133125947405, -0.021018620664, 0.006029465614, 0.049985876933],
    ]),
    ([-3.0, 2.0, -6.0], [
        [0.003356307902, -0.001353691394, -0.002002616508, -0.002644651725, -0.003236798577, -0.00164650806],
        [-0.002341055646, -0.002647708653, 0.004988764299, 0.002842424707, 0.001441351142, 0.000422813945],
        [0.006899633372, 0.002297989063, 0.005045793601, -0.001849473122, 0.002059690263, 0.001940639141],
    ]),
    ([1.5, 1.2, 0.0], [
        [0.004923095244, -0.004382993356, -0.012318018762, -0.003115943939, -0.000732041276, -0.005939420898],
        [0.000735611461, 0.001292730547, -0.068339761096, 0.004812688693, 0.00959687946, -0.005555478366],
        [0.007488679188, 0.02359044481, -0.068539475914, -0.006155185095, 0.005947562439, 0.013914007562],
    ]),
    ([10.0, -7.0, -4.0], [
        [-5.206001631534e-05, -7.729146455447e-04, 1.368525126085e-04, 4.509354601219e-04, -1.594755895256e-04, -1.085068549740e-04],
        [1.010024615632e-03, 7.376597041555e-04, -6.306561746673e-05, -1.216023506148e-03, -1.405653277515e-04, 1.311142801395e-04],
        [-0.00076025658, -0.000501717493, 0.00065633708, 0.001002923516, -0.000241422368, 0.000343362366],
    ]),
];

fn triangle(corners: [[f64; 3]; 3]) -> Result<TriangularDislocation, KernelError> {
    TriangularDislocation::whole_space(corners, 1.0, 0.25)
}

#[test]
fn the_stress_is_that_of_angular_dislocations() -> Outcome {
    let source = triangle(TRIANGLE)?;
    for (at, expected) in WHOLE_SPACE {
        for (slip, [xx, yy, zz, xy, xz, yz]) in axes(TRIANGLE).into_iter().zip(expected) {
            let expected = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
            let error = (source.stress(slip.into(), at) - expected).amax();
            // The numbers have twelve digits behind the point at least.
            assert!(error < 1e-10 * expected.amax() + 6e-13, "{at:?}: {error:e}");
        }
    }
    Ok(())
}

/// The own traction is regular.
#[test]
fn the_traction_at_the_centroid_is_known() -> Outcome {
    let source = triangle(TRIANGLE)?;
    let [strike, dip, normal] = axes(TRIANGLE);
    let center: [f64; 3] =
        std::array::from_fn(|c| TRIANGLE.iter().map(|v| v[c]).sum::<f64>() / 3.0);
    for (slip, expected) in [
        (strike, [-0.4103563876090, -0.0103335186322, 0.0]),
        (dip, [-0.0103335186322, -0.4013034138589, 0.0]),
    ] {
        let traction = source.stress(slip.into(), center) * normal;
        for (axis, expected) in [strike, dip, normal].iter().zip(expected) {
            let error: f64 = traction.dot(axis) - expected;
            assert!(error.abs() < 1e-12, "{error:e}");
        }
    }
    Ok(())
}

/// A surface without a rim that moves as a whole: the stress of a rigid inclusion's translation, none.
#[test]
fn closed_surfaces_of_one_slip_vector_stress_nothing() -> Outcome {
    let cube = |k: usize| [0, 1, 2].map(|axis| f64::from(u8::from(k >> axis & 1 == 1)));
    // Seen from outside, counterclockwise.
    let faces = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let cube: Vec<_> = (faces.iter())
        .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
        .map(|triangle| triangle.map(cube))
        .collect();
    let [a, b, c] = TRIANGLE;
    let d = [1.0, -2.0, -4.5];
    let tetrahedron = vec![[a, b, c], [b, a, d], [c, b, d], [a, c, d]];
    for surface in [cube, tetrahedron] {
        for at in [[0.4, 0.3, 1.7], [3.0, -2.0, -1.0], [0.3, 0.4, 0.2]] {
            let (mut sum, mut largest) = (Matrix3::zeros(), 0.0_f64);
            for &corners in &surface {
                let stress = triangle(corners)?.stress([0.3, -0.7, 0.5], at);
                largest = largest.max(stress.amax());
                sum += stress;
            }
            assert!(sum.amax() < 1e-12 * largest, "{at:?}: {:e}", sum.amax());
        }
    }
    Ok(())
}

/// Four triangles about an inner point, 1000 times deeper than wide: the half space is a whole one.
#[test]
fn a_fan_is_a_rectangle() -> Outcome {
    let (dip, depth) = (50.0_f64, 5e3);
    let (sin, cos) = dip.to_radians().sin_cos();
    let point = |x: f64, down: f64| [x, -down * cos, -down * sin];
    let square = RectangularDislocation::new([-2.0, 3.0], [depth, depth + 4.0], dip, 1.0, 0.25)?;
    let corners =
        [[-2.0, 4.0], [3.0, 4.0], [3.0, 0.0], [-2.0, 0.0]].map(|[x, y]| point(x, depth + y));
    let middle = point(0.7, depth + 1.3);
    for at in [
        point(0.2, depth + 2.2),
        point(-6.0, depth - 3.0),
        [1.0, 2.0, -4e3 * sin],
    ] {
        for (slip, vector) in [([1.0, 0.0], [1.0, 0.0, 0.0]), ([0.0, 1.0], [0.0, cos, sin])] {
            let mut sum = Matrix3::zeros();
            for k in 0..4 {
                let corners = [middle, corners[k], corners[(k + 1) % 4]];
                sum += triangle(corners)?.stress(vector, at);
            }
            let expected = square.stress(slip, at);
            let error = (sum - expected).amax() / expected.amax();
            // The image is 1e4 lengths away.
            assert!(error < 1e-7 || expected.amax() < 1e-5, "{at:?}: {error:e}");
        }
    }
    Ok(())
}

/// On the continuations of edges the stress is that beside them, and rounding does not grow.
#[test]
fn edges_go_on_without_a_mark() -> Outcome {
    let source = triangle(TRIANGLE)?;
    let corners = TRIANGLE.map(Vector3::from);
    for k in 0..3 {
        let (a, b) = (corners[k], corners[(k + 1) % 3]);
        for share in [-3.0, -0.5, -1e-3, 1.001, 1.5, 40.0] {
            let at = a + (b - a) * share;
            let on = source.stress([0.3, -0.7, 0.5], at.into());
            for off in [1e-13, 1e-10, 1e-8] {
                let beside = source.stress([0.3, -0.7, 0.5], at.add_scalar(off).into());
                let error = (on - beside).amax() / beside.amax();
                let near = if share < 2.0 && share > -1.0 {
                    1e-3
                } else {
                    1.0
                };
                assert!(
                    error < 1e2 * off / near + 1e-11,
                    "{k} {share} {off}: {error:e}"
                );
            }
        }
    }
    Ok(())
}

#[test]
fn triangles_that_are_none_are_refused() {
    let whole = TriangularDislocation::whole_space;
    let mut corners = TRIANGLE;
    assert!(whole(corners, 0.0, 0.25).is_err() && whole(corners, 1.0, 0.5).is_err());
    corners[1][2] = f64::NAN;
    assert!(whole(corners, 1.0, 0.25).is_err());
    let flat = whole([[0.0; 3], [1.0; 3], [2.0; 3]], 1.0, 0.25);
    let message = flat.map_or_else(|error| error.to_string(), |_| String::new());
    assert_eq!(
        message,
        "area [m^2] of a triangle must be positive and finite, is 0"
    );
}

fn points() -> impl Strategy<Value = [[f64; 3]; 5]> {
    prop::array::uniform5(prop::array::uniform3(-3.0..3.0))
}

proptest! {
    /// `div sigma = 0` and the pressure is harmonic, by central differences of fourth order; stress is symmetric.
    #[test]
    fn stress_is_in_equilibrium([a, b, c, at, slip] in points()) {
        let corners = [a, b, c];
        let [va, vb, vc] = corners.map(Vector3::from);
        prop_assume!((vb - va).cross(&(vc - va)).norm() > 0.5);
        // Away from the plane of the triangle, and so from its edges.
        let [_, _, normal] = axes(corners);
        prop_assume!((Vector3::from(at) - va).dot(&normal).abs() > 0.3);
        let source = triangle(corners).map_err(|error| TestCaseError::fail(error.to_string()))?;
        let own = source.stress(slip, at);
        prop_assert!((own - own.transpose()).amax() < 1e-11 * (1.0 + own.amax()));
        let step = 1e-2;
        let (mut divergence, mut largest) = (Vector3::zeros(), 0.0_f64);
        let (mut laplacian, mut curvature) = (0.0, 0.0_f64);
        for axis in 0..3 {
            let stress = |steps: f64| {
                let mut moved = at;
                moved[axis] += steps * step;
                source.stress(slip, moved)
            };
            let [below, beneath, above, over] = [-2.0, -1.0, 1.0, 2.0].map(stress);
            let derivative = ((above - beneath) * 8.0 - over + below) / (12.0 * step);
            divergence += derivative.column(axis);
            largest = largest.max(derivative.amax());
            let second = ((above + beneath) * 16.0 - over - below - own * 30.0) / (12.0 * step * step);
            laplacian += second.trace();
            curvature = curvature.max(second.amax());
        }
        prop_assert!(divergence.amax() < 1e-3 * largest + 1e-9, "{:e} of {largest:e}", divergence.amax());
        prop_assert!(laplacian.abs() < 3e-3 * curvature + 1e-7, "{laplacian:e} of {curvature:e}");
    }
}
