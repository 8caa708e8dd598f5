//! The sum of the three parts, against published numbers and the equations of a half space.

pub(crate) mod displacement;
mod published;

use proptest::prelude::*;

use super::stress;

const TRIANGLE: [[f64; 3]; 3] = [[0.0, 0.0, -3.0], [4.0, 1.0, -2.0], [1.0, 3.0, -5.0]];

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        a[j] * b[k] - a[k] * b[j]
    })
}

fn subtract(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| a[i] - b[i])
}

fn unit(a: [f64; 3]) -> [f64; 3] {
    let length = dot(a, a).sqrt();
    a.map(|x| x / length)
}

/// The triangle in a whole space: integrals of Peach and Koehler over its edges, as written.
pub(crate) fn whole(triangle: &[[f64; 3]; 3], b: [f64; 3], nu: f64, p: [f64; 3]) -> [f64; 6] {
    let mut sum = [0.0; 6];
    for n in 0..3 {
        let (a, c) = (triangle[n], triangle[(n + 1) % 3]);
        let edge = subtract(c, a);
        let t = unit(edge);
        let r = subtract(p, a);
        let along = dot(r, t);
        let d = [0, 1, 2].map(|i| r[i] - along * t[i]);
        let d2 = dot(d, d);
        let at = |s: f64| {
            let r = (d2 + s * s).sqrt();
            let r3 = r * r * r;
            [
                s / (d2 * r),
                -1.0 / r,
                s / (3.0 * d2 * r3) + 2.0 * s / (3.0 * d2 * d2 * r),
                -1.0 / (3.0 * r3),
                s * s * s / (3.0 * d2 * r3),
            ]
        };
        let (begin, end) = (at(-along), at(dot(edge, t) - along));
        let j: [f64; 5] = std::array::from_fn(|i| end[i] - begin[i]);
        let i1 = [0, 1, 2].map(|i| d[i] * j[0] - t[i] * j[1]);
        let (v, w) = (cross(i1, b), cross(b, t));
        let (wd, wi) = (3.0 * dot(w, d), dot(w, i1));
        let pi4 = 4.0 * std::f64::consts::PI;
        for (n, (i, k)) in [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)]
            .into_iter()
            .enumerate()
        {
            let outer =
                d[i] * d[k] * j[2] - (d[i] * t[k] + t[i] * d[k]) * j[3] + t[i] * t[k] * j[4];
            let trace = if i == k { wi } else { 0.0 };
            let bracket = wd * outer - (w[i] * i1[k] + w[k] * i1[i]) + trace;
            sum[n] += (v[i] * t[k] + v[k] * t[i]) / pi4 - bracket / (pi4 * (1.0 - nu));
        }
    }
    sum
}

pub(crate) fn half(triangle: &[[f64; 3]; 3], b: [f64; 3], nu: f64, p: [f64; 3]) -> [f64; 6] {
    let [harmonic] = stress(triangle, &[b], nu, p);
    let direct = whole(triangle, b, nu, p);
    let image = whole(triangle, b, nu, [p[0], p[1], -p[2]]);
    let signs = [1.0, 1.0, 1.0, 1.0, -1.0, -1.0];
    std::array::from_fn(|n| direct[n] + signs[n] * image[n] + harmonic[n])
}

/// Strike, up dip and normal of a triangle that is not horizontal.
pub(crate) fn axes(triangle: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let n = unit(cross(
        subtract(triangle[1], triangle[0]),
        subtract(triangle[2], triangle[0]),
    ));
    let strike = unit(cross([0.0, 0.0, 1.0], n));
    [strike, cross(n, strike), n]
}

/// The largest modulus.
pub(crate) fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, x| x.abs().max(most))
}

/// A vertex at most at the surface: a few on it, a few edges vertical or horizontal.
fn vertex() -> impl Strategy<Value = [f64; 3]> {
    let height = prop_oneof![4 => -5.0..-0.1, 1 => Just(0.0), 1 => Just(-2.0)];
    let place = prop_oneof![4 => -5.0..5.0, 1 => Just(1.0)];
    (place.clone(), place, height).prop_map(|(x, y, z)| [x, y, z])
}

pub(crate) fn triangle() -> impl Strategy<Value = [[f64; 3]; 3]> {
    prop::array::uniform3(vertex()).prop_filter("degenerate", |triangle| {
        let [a, b] = [1, 2].map(|n| subtract(triangle[n], triangle[0]));
        let normal = cross(a, b);
        dot(normal, normal) > 0.5
    })
}

pub(crate) fn slip() -> impl Strategy<Value = [f64; 3]> {
    prop::array::uniform3(-1.0..1.0)
}

/// The distance of a point from the lines of a triangle's edges, where sums of the test's own formula cancel.
pub(crate) fn clearance(triangle: &[[f64; 3]; 3], point: [f64; 3]) -> f64 {
    let distance = |n: usize| {
        let edge = unit(subtract(triangle[(n + 1) % 3], triangle[n]));
        let across = cross(subtract(point, triangle[n]), edge);
        dot(across, across).sqrt()
    };
    (0..3).map(distance).fold(f64::INFINITY, f64::min)
}

proptest! {
    #[test]
    fn the_surface_is_free_of_traction(
        triangle in triangle(), slip in slip(), nu in 0.0..0.49, x in -20.0..20.0, y in -20.0..20.0,
    ) {
        let point = [x, y, 0.0];
        prop_assume!(clearance(&triangle, point) > 0.3);
        let stress = half(&triangle, slip, nu, point);
        let scale = largest(&stress).max(largest(&whole(&triangle, slip, nu, point)));
        for n in [2, 4, 5] {
            prop_assert!(stress[n].abs() < 1e-12 * scale + 1e-15, "{n}: {stress:?}");
        }
    }

    #[test]
    fn the_body_is_in_equilibrium(
        triangle in triangle(), slip in slip(), nu in 0.0..0.49, point in prop::array::uniform3(-6.0..6.0),
    ) {
        let point: [f64; 3] = [point[0], point[1], -0.5 - point[2].abs()];
        let step = 1e-3;
        let derivative = |i: usize| {
            let at = |share: f64| {
                let mut moved = point;
                moved[i] += share * step;
                stress(&triangle, &[slip], nu, moved)[0]
            };
            let ([a, b], [c, d]) = ([at(-2.0), at(-1.0)], [at(1.0), at(2.0)]);
            let slope = |n: usize| (a[n] - d[n] + 8.0 * (c[n] - b[n])) / (12.0 * step);
            std::array::from_fn::<f64, 6, _>(slope)
        };
        let d = [0, 1, 2].map(derivative);
        let scale = d.iter().fold(1e-3, |most: f64, d| largest(d).max(most));
        for [x, y, z] in [[0, 3, 4], [3, 1, 5], [4, 5, 2]] {
            let sum = d[0][x] + d[1][y] + d[2][z];
            prop_assert!(sum.abs() < 1e-8 * scale, "{sum} of {scale}");
        }
    }

    #[test]
    fn parts_of_a_triangle_add_up(
        triangle in triangle(), slip in slip(), nu in 0.0..0.49, share in 0.2..0.8,
        point in prop::array::uniform3(-6.0..6.0),
    ) {
        let [a, b, c] = triangle;
        let point: [f64; 3] = [point[0], point[1], -0.2 - point[2].abs()];
        let middle = [0, 1, 2].map(|i| a[i] + share * (b[i] - a[i]));
        let sum = |parts: &[[[f64; 3]; 3]]| {
            let mut sum = [0.0; 6];
            for part in parts {
                let [stress] = stress(part, &[slip], nu, point);
                (0..6).for_each(|n| sum[n] += stress[n]);
            }
            sum
        };
        let (whole, parts) = (sum(&[triangle]), sum(&[[a, middle, c], [middle, b, c]]));
        let scale = largest(&whole).max(1e-3);
        for n in 0..6 {
            prop_assert!((whole[n] - parts[n]).abs() < 1e-11 * scale, "{whole:?} {parts:?}");
        }
    }

    #[test]
    fn nothing_is_singular_on_the_continuation_of_an_edge(
        triangle in triangle(), slip in slip(), along in 1.1..50.0, aside in -9.0..-3.0,
    ) {
        let [a, b, _] = triangle;
        let at = |share: f64| [0, 1, 2].map(|i| a[i] + share * (b[i] - a[i]));
        let point = [along, 1.0 - along].map(at).into_iter().find(|point| point[2] <= 0.0);
        let point = point.unwrap_or([9.0, 9.0, -1.0]);
        let offset = 10f64.powf(aside);
        let on = half_without_direct(&triangle, slip, point);
        let beside = half_without_direct(&triangle, slip, [point[0] + offset, point[1] - offset, point[2]]);
        let scale = largest(&on).max(1e-4);
        for n in 0..6 {
            let change = (on[n] - beside[n]).abs();
            prop_assert!(change < (20.0 * offset + 1e-9) * scale, "{on:?} {beside:?}");
        }
    }
}

/// The harmonic part alone.
fn half_without_direct(triangle: &[[f64; 3]; 3], slip: [f64; 3], point: [f64; 3]) -> [f64; 6] {
    stress(triangle, &[slip], 0.25, point)[0]
}

#[test]
fn slips_are_served_at_once() {
    let axes = axes(&TRIANGLE);
    let point = [1.0, 2.0, -1.0];
    let together = stress(&TRIANGLE, &axes, 0.3, point);
    for (axis, stresses) in axes.into_iter().zip(together) {
        assert_eq!(stress(&TRIANGLE, &[axis], 0.3, point), [stresses]);
    }
}

#[test]
fn directions_next_to_the_vertical_are_no_special_case() {
    // A vertical edge, and edges inclined by 1e-3 down to 1e-12.
    let at = |tilt: f64| {
        let triangle = [[0.0, 0.0, -3.0], [tilt, -tilt, -1.0], [1.0, 3.0, -5.0]];
        stress(&triangle, &[[0.3, -0.7, 0.4]], 0.25, [1.5, -0.5, -1.0])[0]
    };
    let vertical = at(0.0);
    let scale = largest(&vertical);
    for power in 3..13 {
        let tilt = 10f64.powi(-power);
        for (near, vertical) in at(tilt).into_iter().zip(vertical) {
            assert!(
                (near - vertical).abs() < (3.0 * tilt + 1e-13) * scale,
                "{tilt}: {near} {vertical}"
            );
        }
    }
}
