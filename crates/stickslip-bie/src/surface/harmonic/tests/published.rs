//! Numbers of M. Nikkhoo and T. Walter's solution.

use super::{TRIANGLE, axes, dot, half};

#[test]
fn numbers_of_nikkhoo_and_walter() {
    // Strike, up dip and opening, at three points below the surface and one on it.
    let expected: [([f64; 3], [[f64; 6]; 3]); 4] = [
        (
            [2.0, 1.0, -1.0],
            [
                [
                    0.013602267583,
                    -0.019831145282,
                    -0.019526346059,
                    -0.015038834381,
                    0.00734164334,
                    -0.018230490112,
                ],
                [
                    0.01143365028528,
                    0.01603706810464,
                    -0.1007835633891,
                    0.01568043367367,
                    0.005966073869548,
                    9.314676964073e-05,
                ],
                [
                    0.028154648416,
                    0.088438967712,
                    -0.078419924699,
                    -0.023703667258,
                    -0.003200773071,
                    0.072842967403,
                ],
            ],
        ),
        (
            [-3.0, 2.0, -6.0],
            [
                [
                    0.002831732397,
                    -0.001545470501,
                    0.000155978081,
                    -0.003094882298,
                    -0.003445503192,
                    -0.002145646758,
                ],
                [
                    -0.00151854063,
                    -0.003364869585,
                    0.005848992828,
                    0.002720568065,
                    0.003146130203,
                    -0.000264086888,
                ],
                [
                    0.008019381429,
                    0.002213608489,
                    0.009591373777,
                    -0.001459405926,
                    0.005069523885,
                    0.002886636469,
                ],
            ],
        ),
        (
            [1.5, 1.2, 0.0],
            [
                [
                    0.02538043280047,
                    0.01265382726178,
                    0.0,
                    -0.001420138338634,
                    0.0,
                    0.0,
                ],
                [
                    0.09605990341836,
                    0.1130160638872,
                    0.0,
                    0.006223328837782,
                    0.0,
                    0.0,
                ],
                [
                    0.1146855189573,
                    0.1530911567799,
                    0.0,
                    -0.01571442920571,
                    0.0,
                    0.0,
                ],
            ],
        ),
        (
            [10.0, -7.0, -4.0],
            [
                [
                    3.828416605813e-05,
                    -0.00092619938232,
                    0.0001053354985879,
                    0.0004362691195174,
                    -2.034818787383e-05,
                    -0.0001235138717972,
                ],
                [
                    0.000963017175,
                    0.000582048485,
                    -0.000241384898,
                    -0.00127836899,
                    -0.000217060439,
                    0.000194193227,
                ],
                [
                    -0.000680090046,
                    -0.000313895559,
                    0.000316210688,
                    0.000845101657,
                    -0.000106508799,
                    0.000160688143,
                ],
            ],
        ),
    ];
    let axes = axes(&TRIANGLE);
    for (point, stresses) in expected {
        for (slip, expected) in axes.into_iter().zip(stresses) {
            let found = half(&TRIANGLE, slip, 0.25, point);
            let scale = expected.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            for n in 0..6 {
                let error = (found[n] - expected[n]).abs() / scale;
                assert!(
                    error < 1e-9,
                    "{point:?} {slip:?} {n}: {} {}",
                    found[n],
                    expected[n]
                );
            }
        }
    }
}

#[test]
fn a_triangle_that_breaks_the_surface() {
    let triangle = [[1.0, -1.0, -1.5], [2.0, 0.0, 0.0], [0.0, 0.0, 0.0]];
    let axes = axes(&triangle);
    let center = [1.0, -1.0 / 3.0, -0.5];
    // Traction along strike and dip and the compression, of slip along strike and dip: M. Nikkhoo and T. Walter's solution.
    let expected = [
        [-0.6731775985073083, 0.0, 0.0],
        [0.0, -0.4985795979706739, -0.07888267756498724],
    ];
    for (slip, expected) in axes.into_iter().zip(expected) {
        let [xx, yy, zz, xy, xz, yz] = half(&triangle, slip, 0.25, center);
        let [strike, dip, n] = axes;
        let traction = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]].map(|row| dot(row, n));
        let found = [dot(traction, strike), dot(traction, dip), -dot(traction, n)];
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-12, "{found} {expected}");
        }
    }
}
