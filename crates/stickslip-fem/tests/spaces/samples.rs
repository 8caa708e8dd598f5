//! Fields by samples: exact where the function is of their kind, refused where there is none.

use crate::{empty, repeated};
use nalgebra::{SVector, Vector1, Vector2, Vector3};
use stickslip_fem::{FemError, Samples};

/// A function that is linear along each axis in turn.
fn trilinear(x: &Vector3<f64>) -> f64 {
    (2.0 - x[0]) * (1.0 + 3.0 * x[1]) * (0.5 + x[2]) + x[1]
}

/// Numbers in [0, 1) without order.
fn numbers() -> impl FnMut() -> f64 {
    let mut number = 7_u32;
    move || {
        number = number.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(number >> 8) / f64::from(1 << 24)
    }
}

#[test]
fn functions_linear_along_each_axis_are_their_own_interpolation() {
    let axes = [&[-1.0, 0.3, 0.4, 2.0][..], &[0.1, 0.7], &[-3.0, -0.1, 5.0]];
    let mut points: Vec<Vector3<f64>> = Vec::new();
    for &z in axes[2] {
        for &x in axes[0] {
            points.extend(axes[1].iter().map(|&y| Vector3::new(x, y, z)));
        }
    }
    // Rounding does not make a new coordinate.
    points[3][0] += 1e-15;
    let values: Vec<f64> = points.iter().map(trilinear).collect();
    let linear = Samples::new(&points, &values).unwrap().linear().unwrap();
    let mut next = numbers();
    for _ in 0..1000 {
        let x = Vector3::new(3.0 * next() - 1.0, 0.1 + 0.6 * next(), 8.0 * next() - 3.0);
        assert!((linear.at(&x) - trilinear(&x)).abs() < 1e-12);
        // Outside it is the value at the nearest point of the box.
        let out = x.map(|c| 3.0 * c);
        let border = Vector3::new(
            out[0].clamp(-1.0, 2.0),
            out[1].clamp(0.1, 0.7),
            out[2].clamp(-3.0, 5.0),
        );
        assert!((linear.at(&out) - trilinear(&border)).abs() < 1e-12);
    }
    for (x, value) in points.iter().zip(&values) {
        assert!((linear.at(x) - value).abs() < 1e-12);
    }
}

#[test]
fn a_grid_in_a_plane_does_not_ask_for_the_third_coordinate() {
    let mut points = Vec::new();
    for x in [0.0, 1.0, 4.0] {
        points.extend([0.0, 2.0].map(|z| Vector3::new(x, 0.3, z)));
    }
    let values: Vec<f64> = points.iter().map(|x| x[0] * x[2]).collect();
    let linear = Samples::new(&points, &values).unwrap().linear().unwrap();
    for height in [-5.0, 0.3, 7.0] {
        assert!((linear.at(&Vector3::new(2.5, height, 1.5)) - 2.5 * 1.5).abs() < 1e-14);
    }
}

#[test]
fn samples_on_an_oblique_line_are_interpolated_along_it() {
    let (from, to) = (Vector3::new(1.0, 2.0, -1.0), Vector3::new(4.0, 1.0, 3.0));
    let on = |share: f64| from + (to - from) * share;
    // Not in order.
    let shares = [0.3, 0.0, 1.0, 0.7];
    let value = |share: f64| if share < 0.3 { share } else { 0.6 - share };
    let samples = Samples::new(&shares.map(on), &shares.map(value))
        .unwrap()
        .linear()
        .unwrap();
    let across = (to - from).cross(&Vector3::x());
    for k in 0..=20 {
        let share = f64::from(k) / 20.0;
        assert!((samples.at(&(on(share) + across)) - value(share)).abs() < 1e-13);
    }
    assert_eq!(
        (samples.at(&on(-2.0)), samples.at(&on(5.0))),
        (0.0, value(1.0))
    );
}

#[test]
fn the_nearest_sample_has_its_cell() {
    let mut next = numbers();
    let points: Vec<_> = (0..300).map(|_| Vector2::new(next(), next())).collect();
    let values: Vec<f64> = (0..300).map(f64::from).collect();
    let samples = Samples::new(&points, &values).unwrap();
    for _ in 0..500 {
        let x = Vector2::new(2.0 * next() - 0.5, 2.0 * next() - 0.5);
        let distance = |k: f64| (points[k as usize] - x).norm();
        let found = samples.nearest(&x);
        assert!(values.iter().all(|&k| distance(found) <= distance(k)));
    }
    assert_eq!(
        samples.linear().map(|_| ()),
        Err(FemError::Scattered {
            samples: 300,
            along: vec![300, 300]
        })
    );
}

#[test]
fn one_sample_is_a_constant() {
    let samples = Samples::new(&[Vector1::new(2.0)], &[5.0]).unwrap();
    for x in [-1e9, 2.0, 7.0] {
        assert_eq!(samples.nearest(&Vector1::new(x)), 5.0);
        assert_eq!(samples.linear().unwrap().at(&Vector1::new(x)), 5.0);
    }
}

#[test]
fn bad_samples_are_refused() {
    let points = [
        Vector2::new(0.0, 0.0),
        Vector2::new(1.0, 0.0),
        Vector2::new(0.0, 0.0),
    ];
    let new = |points: &[Vector2<f64>], values: &[f64]| Samples::new(points, values).map(|_| ());
    assert_eq!(new(&[], &[]), Err(empty("samples")));
    assert_eq!(
        new(&points, &[1.0]),
        Err(FemError::Length {
            what: "values of samples",
            expected: 3,
            found: 1
        })
    );
    assert_eq!(new(&points, &[1.0; 3]), Err(repeated("samples", [0, 2])));
    assert_eq!(
        new(&points[..2], &[1.0, f64::NAN]),
        Err(FemError::Point {
            what: "sample",
            index: 1,
            requirement: "finite coordinates and a finite value"
        })
    );
    let far = [SVector::repeat(f64::INFINITY)];
    assert_eq!(
        new(&far, &[1.0]),
        Err(FemError::Point {
            what: "sample",
            index: 0,
            requirement: "finite coordinates and a finite value"
        })
    );
    // A grid with a hole.
    let hole = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0), (2.0, 0.0)];
    let hole = hole.map(|(x, y)| Vector2::new(x, y));
    assert_eq!(
        Samples::new(&hole, &[1.0; 5]).unwrap().linear().map(|_| ()),
        Err(FemError::Scattered {
            samples: 5,
            along: vec![3, 2]
        })
    );
}
