//! Stresses that jump, at vertices: averages over their areas.

use stickslip::fem::Trace;

/// A value on a rectangle of the fault, beside what is there without it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Patch {
    /// Along strike and down dip: from, to \[m\].
    pub extent: [[f64; 2]; 2],
    /// The value.
    pub value: f64,
}

/// A corner of a polygon within a face: its place, and the hat functions of the corners of the face there.
type Corner = ([f64; 2], [f64; 3]);

/// `integral of f phi_p / integral of phi_p` for the sum `f` of patches at each vertex `p` of a fault, whose points have
/// these places along strike and down dip \[m\]: exact.
pub(super) fn averages(
    fault: &Trace<3>,
    place: impl Fn(usize) -> [f64; 2],
    patches: &[Patch],
) -> Vec<f64> {
    let mut sums = vec![0.0; fault.vertices().len()];
    for face in fault.faces() {
        let places = face.map(&place);
        for patch in patches {
            for (&k, share) in face.iter().zip(shares(places, patch.extent)) {
                sums[k] += patch.value * share;
            }
        }
    }
    let weights = fault.weights().iter();
    sums.iter().zip(weights).map(|(sum, w)| sum / w).collect()
}

/// The integrals of the hat functions of a triangle over its part in a rectangle \[m^2\].
fn shares(triangle: [[f64; 2]; 3], extent: [[f64; 2]; 2]) -> [f64; 3] {
    let hat = |k: usize| std::array::from_fn(|l| if l == k { 1.0 } else { 0.0 });
    let mut polygon: Vec<Corner> = (0..3).map(|k| (triangle[k], hat(k))).collect();
    for (axis, [low, high]) in extent.into_iter().enumerate() {
        polygon = cut(&polygon, |x| x[axis] - low);
        polygon = cut(&polygon, |x| high - x[axis]);
    }
    let mut integrals = [0.0; 3];
    let Some((first, rest)) = polygon.split_first() else {
        return integrals;
    };
    for pair in rest.windows(2) {
        let [a, b, c] = [first, &pair[0], &pair[1]];
        let along = |to: &Corner| [to.0[0] - a.0[0], to.0[1] - a.0[1]];
        let (u, v) = (along(b), along(c));
        let area = 0.5 * (u[0] * v[1] - u[1] * v[0]).abs();
        for (k, integral) in integrals.iter_mut().enumerate() {
            *integral += area * (a.1[k] + b.1[k] + c.1[k]) / 3.0;
        }
    }
    integrals
}

/// The part of a convex polygon where a linear function is not negative.
fn cut(polygon: &[Corner], side: impl Fn([f64; 2]) -> f64) -> Vec<Corner> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (n, from) in polygon.iter().enumerate() {
        let to = &polygon[(n + 1) % polygon.len()];
        let (here, there) = (side(from.0), side(to.0));
        if here >= 0.0 {
            kept.push(*from);
        }
        if (here > 0.0 && there < 0.0) || (here < 0.0 && there > 0.0) {
            let part = here / (here - there);
            let between = |a: f64, b: f64| a + part * (b - a);
            kept.push((
                std::array::from_fn(|i| between(from.0[i], to.0[i])),
                std::array::from_fn(|k| between(from.1[k], to.1[k])),
            ));
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        /// Parts on both sides of any line are the whole, whose hat functions have a third of its area each.
        #[test]
        fn parts_of_a_triangle_are_the_whole(
            triangle in [[-3.0..3.0, -3.0..3.0], [-3.0..3.0, -3.0..3.0], [-3.0..3.0, -3.0..3.0]],
            at in [-3.0..3.0, -3.0..3.0],
        ) {
            let [a, b, c]: [[f64; 2]; 3] = triangle;
            let area = 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs();
            let [x, y]: [f64; 2] = at;
            let halves = |place: f64| [[-9.0, place], [place, 9.0]];
            let mut sums = [0.0; 3];
            for along in halves(x) {
                for down in halves(y) {
                    for (sum, share) in sums.iter_mut().zip(shares(triangle, [along, down])) {
                        *sum += share;
                    }
                }
            }
            for sum in sums {
                prop_assert!((sum - area / 3.0).abs() < 1e-13, "{} {}", sum, area);
            }
        }
    }

    /// The square over two sides of a triangle: a closed form.
    #[test]
    fn hat_functions_over_a_square() {
        let triangle = [[0.0, 0.0], [2.0, 0.0], [0.0, 2.0]];
        let [first, second, third] = shares(triangle, [[0.0, 1.0], [0.0, 1.0]]);
        // The integrals of 1 - (x + y)/2, x/2 and y/2.
        assert!((first - 0.5).abs() < 1e-15 && (second - 0.25).abs() < 1e-15);
        assert_eq!(second, third);
    }
}
