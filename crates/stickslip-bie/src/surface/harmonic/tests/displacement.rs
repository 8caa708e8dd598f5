//! Displacement, by its strains.

use proptest::prelude::*;

use super::{largest, slip, stress, triangle};
use crate::surface::harmonic::displacement;

/// Stress per unit shear modulus of a displacement, by differences of fourth order.
pub(crate) fn stress_of(
    displacement: impl Fn([f64; 3]) -> [f64; 3],
    nu: f64,
    point: [f64; 3],
    step: f64,
) -> [f64; 6] {
    let gradient = [0, 1, 2].map(|i| {
        let at = |share: f64| {
            let mut moved = point;
            moved[i] += share * step;
            displacement(moved)
        };
        let ([a, b], [c, d]) = ([at(-2.0), at(-1.0)], [at(1.0), at(2.0)]);
        [0, 1, 2].map(|n| (a[n] - d[n] + 8.0 * (c[n] - b[n])) / (12.0 * step))
    });
    let dilatation = 2.0 * nu / (1.0 - 2.0 * nu) * (0..3).map(|i| gradient[i][i]).sum::<f64>();
    let pairs = [[0, 0], [1, 1], [2, 2], [0, 1], [0, 2], [1, 2]];
    pairs.map(|[i, j]| {
        let normal = if i == j { dilatation } else { 0.0 };
        gradient[i][j] + gradient[j][i] + normal
    })
}

proptest! {
    #[test]
    fn strains_of_the_displacement_give_the_stress(
        triangle in triangle(), slip in slip(), nu in 0.0..0.45, point in prop::array::uniform3(-6.0..6.0),
    ) {
        let point: [f64; 3] = [point[0], point[1], -0.5 - point[2].abs()];
        let displacement = |point| displacement(&triangle, &[slip], nu, point)[0];
        let found = stress_of(displacement, nu, point, 2e-3);
        let [expected] = stress(&triangle, &[slip], nu, point);
        let scale = largest(&expected).max(1e-3);
        for n in 0..6 {
            let error = (found[n] - expected[n]).abs();
            prop_assert!(error < 1e-7 * scale, "{n}: {found:?} {expected:?}");
        }
    }

    #[test]
    fn displacement_decays_with_the_distance(triangle in triangle(), slip in slip(), angle in 0.0..6.3) {
        for distance in [1e2, 1e3, 1e4] {
            let point = [distance * f64::cos(angle), distance * f64::sin(angle), -0.5 * distance];
            let [found] = displacement(&triangle, &[slip], 0.25, point);
            // As the inverse square: areas are below 100.
            prop_assert!(largest(&found) < 100.0 / (distance * distance), "{found:?}");
        }
    }
}

#[test]
fn directions_next_to_the_vertical_are_no_special_case() {
    let at = |tilt: f64| {
        let triangle = [[0.0, 0.0, -3.0], [tilt, -tilt, -1.0], [1.0, 3.0, -5.0]];
        displacement(&triangle, &[[0.3, -0.7, 0.4]], 0.25, [1.5, -0.5, -1.0])[0]
    };
    let vertical = at(0.0);
    for power in 3..13 {
        let tilt = 10f64.powi(-power);
        for (near, vertical) in at(tilt).into_iter().zip(vertical) {
            assert!(
                (near - vertical).abs() < 3.0 * tilt + 1e-14,
                "{tilt}: {near} {vertical}"
            );
        }
    }
}
