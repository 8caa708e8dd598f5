//! Betti's theorem: the tractions of slip on one cell work as much on slip of another as the other way round.

use nalgebra::Vector3;
use proptest::prelude::*;
use stickslip_bie::{RectangularDislocation, TriangularDislocation};

use super::POISSON_RATIO;
use crate::MEDIUM;

/// Points of Gauss and weights on [0, 1], exact for polynomials of degree 9.
const GAUSS: [[f64; 2]; 5] = [
    [0.046_910_077_030_668, 0.118_463_442_528_094_54],
    [0.230_765_344_947_158_45, 0.239_314_335_249_683_23],
    [0.5, 0.284_444_444_444_444_45],
    [0.769_234_655_052_841_5, 0.239_314_335_249_683_23],
    [0.953_089_922_969_332, 0.118_463_442_528_094_54],
];

type Corners = [Vector3<f64>; 3];

/// The work of the traction of slip `b` of one triangle on slip `d` of another.
fn work(
    of: &Corners,
    b: Vector3<f64>,
    on: &Corners,
    d: Vector3<f64>,
) -> Result<f64, TestCaseError> {
    let corners = of.map(Into::into);
    let source = TriangularDislocation::half_space(corners, MEDIUM.shear_modulus, POISSON_RATIO);
    let source = source.map_err(|error| TestCaseError::fail(error.to_string()))?;
    let [a, u, v] = [on[0], on[1] - on[0], on[2] - on[0]];
    let normal = u.cross(&v);
    let mut sum = 0.0;
    for [s, of_s] in GAUSS {
        for [t, of_t] in GAUSS {
            // Duffy's map of the square to the triangle.
            let at = a + u * (s * (1.0 - t)) + v * (s * t);
            let stress = source.stress(b.into(), at.into());
            sum += of_s * of_t * s * d.dot(&(stress * normal));
        }
    }
    Ok(sum)
}

fn corner(depth: f64) -> impl Strategy<Value = Vector3<f64>> {
    (-1e3..1e3, -1e3..1e3, -1e3..1e3).prop_map(move |(x, y, z)| Vector3::new(x, y, z - depth))
}

fn vector() -> impl Strategy<Value = Vector3<f64>> {
    prop::array::uniform3(-1.0..1.0).prop_map(Vector3::from)
}

proptest! {
    #[test]
    fn triangles_work_on_each_other_alike(
        first in prop::array::uniform3(corner(1.1e3)), second in prop::array::uniform3(corner(9e3)),
        slips in prop::array::uniform2(vector()),
    ) {
        let large = |[a, b, c]: &Corners| (b - a).cross(&(c - a)).norm() > 1e5;
        prop_assume!(large(&first) && large(&second));
        let one = work(&first, slips[0], &second, slips[1])?;
        let other = work(&second, slips[1], &first, slips[0])?;
        // Of the largest possible of such slips: mu b d A A'/distance^3.
        let area = |[a, b, c]: &Corners| 0.5 * (b - a).cross(&(c - a)).norm();
        let scale = MEDIUM.shear_modulus * area(&first) * area(&second) / 8e3_f64.powi(3);
        prop_assert!((one - other).abs() < 1e-6 * scale, "{one} {other} of {scale}");
    }
}

proptest! {
    /// Displacement, by loops, against stress, by the formulae of Okada.
    #[test]
    fn rectangles_are_strained_as_okada_says(
        x in -8e3..8e3, y in -9e3..9e3, depth in 200.0..12e3_f64, dip in 10.0..=90.0,
        slip in prop::array::uniform2(-1.0..1.0),
    ) {
        let patch = RectangularDislocation::new([-2e3, 1e3], [1e3, 4e3], dip, 1.0, POISSON_RATIO);
        let patch = patch.map_err(|error| TestCaseError::fail(error.to_string()))?;
        // Not across the plane, nor next to its edges.
        let (sin, cos) = f64::to_radians(dip).sin_cos();
        let (y, depth): (f64, f64) = (y, depth);
        prop_assume!((y * sin + depth * cos).abs() > 300.0);
        let step = 20.0;
        let at = [x, y, -depth];
        let mut gradient = nalgebra::Matrix3::zeros();
        for axis in 0..3 {
            let moved = |n: f64| {
                let mut at = at;
                at[axis] += n * step;
                Vector3::from(patch.displacement(slip, at))
            };
            let near = moved(1.0) - moved(-1.0);
            let column = (near * 8.0 - (moved(2.0) - moved(-2.0))) / (12.0 * step);
            gradient.set_column(axis, &column);
        }
        let ratio = 2.0 * POISSON_RATIO / (1.0 - 2.0 * POISSON_RATIO);
        let found = gradient + gradient.transpose()
            + nalgebra::Matrix3::identity() * (ratio * gradient.trace());
        let expected = patch.stress(slip, at);
        let scale = expected.abs().max() + 1e-7;
        prop_assert!((found - expected).abs().max() < 1e-3 * scale, "{found} {expected}");
    }
}
