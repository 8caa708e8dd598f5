//! Displacement against stress, jumps, and closed forms of a long strip.

use proptest::prelude::*;

use super::{half_space, whole_space};
use crate::surface::harmonic::{self, tests};

proptest! {
    #[test]
    fn strains_give_the_stress(
        triangle in tests::triangle(), slip in tests::slip(), nu in 0.0..0.45, point in prop::array::uniform3(-6.0..6.0),
    ) {
        let point: [f64; 3] = [point[0], point[1], -0.3 - point[2].abs()];
        prop_assume!(tests::clearance(&triangle, point) > 0.3);
        let whole = |point| whole_space(&triangle, slip, nu, point);
        let half = |point| half_space(&triangle, slip, nu, point);
        let expected = [tests::whole(&triangle, slip, nu, point), tests::half(&triangle, slip, nu, point)];
        let found = [
            tests::displacement::stress_of(whole, nu, point, 1e-3),
            tests::displacement::stress_of(half, nu, point, 1e-3),
        ];
        // A point next to the triangle has its differences across it.
        let jumps = (0..6).any(|n| (found[0][n] - expected[0][n]).abs() > 10.0);
        prop_assume!(!jumps);
        for (found, expected) in found.iter().zip(&expected) {
            let scale = tests::largest(expected).max(1e-2);
            for n in 0..6 {
                let error = (found[n] - expected[n]).abs();
                prop_assert!(error < 1e-6 * scale, "{n}: {found:?} {expected:?}");
            }
        }
    }

    #[test]
    fn the_jump_is_the_slip(
        triangle in tests::triangle(), slip in tests::slip(), nu in 0.0..0.49, inside in prop::array::uniform3(0.2..1.0),
    ) {
        let total: f64 = inside.iter().sum();
        let point = [0, 1, 2].map(|i| (0..3).map(|n| inside[n] / total * triangle[n][i]).sum::<f64>());
        let [_, _, normal] = tests::axes(&triangle);
        let beside = |side: f64| [0, 1, 2].map(|i| point[i] + 1e-9 * side * normal[i]);
        prop_assume!(beside(1.0)[2] < 0.0 && beside(-1.0)[2] < 0.0);
        for displacement in [whole_space, half_space] {
            let [plus, minus] = [1.0, -1.0].map(|side| displacement(&triangle, slip, nu, beside(side)));
            for i in 0..3 {
                prop_assert!((plus[i] - minus[i] - slip[i]).abs() < 1e-7, "{plus:?} {minus:?} {slip:?}");
            }
        }
    }

    #[test]
    fn a_closed_surface_of_constant_slip_moves_its_inside_alone(
        base in tests::triangle(), top in prop::array::uniform3(-4.0..4.0), slip in tests::slip(),
        point in prop::array::uniform3(-6.0..6.0),
    ) {
        let [a, b, c] = base;
        let top: [f64; 3] = [top[0], top[1], -5.5 - top[2].abs()];
        let point: [f64; 3] = [point[0], point[1], -0.1 - point[2].abs()];
        let faces = [[a, b, c], [a, c, top], [c, b, top], [b, a, top]];
        for displacement in [whole_space, half_space] {
            let sum = faces.iter().fold([0.0; 3], |sum, face| {
                let part = displacement(face, slip, 0.25, point);
                [0, 1, 2].map(|i| sum[i] + part[i])
            });
            // Outside 0, inside the slip, against the normals' side.
            let is = |share: f64| (0..3).all(|i| (sum[i] - share * slip[i]).abs() < 1e-9);
            prop_assert!(is(0.0) || is(1.0) || is(-1.0), "{sum:?} {slip:?}");
        }
    }
}

#[test]
fn a_long_strike_slip_fault_moves_the_surface_by_an_arctangent() {
    // From the surface to depth 1, 2e4 long, left-lateral: u = -(D/pi) [sign(x) pi/2 - arctan(x/1)].
    let [begin, end] = [-1e4, 1e4];
    let corners = [
        [0.0, begin, -1.0],
        [0.0, end, -1.0],
        [0.0, end, 0.0],
        [0.0, begin, 0.0],
    ];
    let [a, b, c, d] = corners;
    for x in [0.1_f64, 0.7, 3.0] {
        let at = |x: f64| {
            let parts = [[a, b, c], [a, c, d]];
            let parts = parts.map(|part| half_space(&part, [0.0, 1.0, 0.0], 0.25, [x, 0.0, 0.0]));
            parts[0][1] + parts[1][1]
        };
        // The normal of the triangles is x: slip of the side of positive x.
        let expected = (1.0 / x).atan() / std::f64::consts::PI;
        assert!((at(x) - expected).abs() < 1e-7, "{x}: {} {expected}", at(x));
        assert!((at(-x) + expected).abs() < 1e-7);
    }
}

#[test]
fn the_surface_moves_as_below_it() {
    let triangle = [[0.0, 0.0, -3.0], [4.0, 1.0, -2.0], [1.0, 3.0, -5.0]];
    let at = |z: f64| half_space(&triangle, [0.3, -0.7, 0.4], 0.25, [1.0, 0.5, z]);
    for (surface, below) in at(0.0).into_iter().zip(at(-1e-9)) {
        assert!((surface - below).abs() < 1e-8);
    }
    let slips = [[0.3, -0.7, 0.4]];
    let [harmonic] = harmonic::displacement(&triangle, &slips, 0.25, [1.0, 0.5, 0.0]);
    assert!(harmonic.iter().all(|u| u.is_finite()));
}

/// Source: Y. Okada, Bull. Seismol. Soc. Am. 75 (1985), Table 2, case 2: the origin is at the lower left corner of the rectangle,
/// 4 deep, 3 long and 2 wide, dip 70 degrees, seen from x = 2, y = 3 at the surface. Four digits are published.
#[test]
fn okada_published_these_displacements() {
    let (sin, cos) = 70_f64.to_radians().sin_cos();
    let corner = |x: f64, up: f64| [x, up * cos, up * sin - 4.0];
    let corners = [
        corner(0.0, 0.0),
        corner(3.0, 0.0),
        corner(3.0, 2.0),
        corner(0.0, 2.0),
    ];
    let [a, b, c, d] = corners;
    for (slip, published) in [
        ([1.0, 0.0, 0.0], [-8.689e-3, -4.298e-3, -2.747e-3]),
        ([0.0, cos, sin], [-4.682e-3, -3.527e-2, -3.564e-2]),
        ([0.0, -sin, cos], [-2.660e-4, 1.056e-2, 3.214e-3]),
    ] {
        let at = [2.0, 3.0, 0.0];
        let found = half_space(&corners, slip, 0.25, at);
        let parts = [[a, b, c], [a, c, d]].map(|part| half_space(&part, slip, 0.25, at));
        for i in 0..3 {
            let digit = 10_f64.powf(f64::abs(published[i]).log10().floor() - 3.0);
            assert!(
                (found[i] - published[i]).abs() < 0.51 * digit,
                "{found:?} {published:?}"
            );
            assert!((parts[0][i] + parts[1][i] - found[i]).abs() < 1e-14);
        }
    }
}
