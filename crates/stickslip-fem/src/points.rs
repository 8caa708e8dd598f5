//! Search for points in a box and for the nearest point without visiting all points.

use nalgebra::SVector;

use crate::numbering::bounding_box;

/// Number of points that are not split any further.
const LEAF: usize = 8;

/// A k-d tree: the point in the middle of a range splits it along the range's longest extent.
///
/// Source: J. Bentley, "Multidimensional binary search trees used for associative searching", CACM 18 (1975).
#[derive(Clone, Debug)]
pub(crate) struct Points<const D: usize> {
    points: Vec<SVector<f64, D>>,
    numbers: Vec<u32>,
    /// The axis along which the point in the middle of its range splits.
    axes: Vec<u8>,
}

impl<const D: usize> Points<D> {
    /// Sorts points that have numbers.
    pub(crate) fn new(mut numbered: Vec<(SVector<f64, D>, u32)>) -> Self {
        let mut axes = vec![0; numbered.len()];
        split(&mut numbered, &mut axes);
        let (points, numbers) = numbered.into_iter().unzip();
        Self {
            points,
            numbers,
            axes,
        }
    }

    /// The points with their numbers, unordered.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (&SVector<f64, D>, u32)> {
        self.points.iter().zip(self.numbers.iter().copied())
    }

    /// The number of the nearest point, the lowest of several; zero without points.
    pub(crate) fn nearest(&self, x: &SVector<f64, D>) -> u32 {
        let mut best = (f64::INFINITY, 0);
        self.approach((0, self.points.len()), x, &mut best);
        best.1
    }

    /// Improves the squared distance and the number found so far.
    fn approach(&self, (start, end): (usize, usize), x: &SVector<f64, D>, best: &mut (f64, u32)) {
        let (mut first, mut last) = (start, end);
        if end - start > LEAF {
            let middle = usize::midpoint(start, end);
            let axis = usize::from(self.axes[middle]);
            let beyond = x[axis] - self.points[middle][axis];
            let (near, far) = if beyond <= 0.0 {
                ((start, middle), (middle + 1, end))
            } else {
                ((middle + 1, end), (start, middle))
            };
            self.approach(near, x, best);
            if beyond * beyond <= best.0 {
                self.approach(far, x, best);
            }
            (first, last) = (middle, middle + 1);
        }
        for k in first..last {
            let candidate = ((self.points[k] - x).norm_squared(), self.numbers[k]);
            if candidate < *best {
                *best = candidate;
            }
        }
    }

    /// Visits the points with `low <= x <= high`.
    pub(crate) fn inside(
        &self,
        low: &SVector<f64, D>,
        high: &SVector<f64, D>,
        visit: &mut impl FnMut(&SVector<f64, D>, u32),
    ) {
        self.search((0, self.points.len()), low, high, visit);
    }

    fn search(
        &self,
        (start, end): (usize, usize),
        low: &SVector<f64, D>,
        high: &SVector<f64, D>,
        visit: &mut impl FnMut(&SVector<f64, D>, u32),
    ) {
        let (mut first, mut last) = (start, end);
        if end - start > LEAF {
            let middle = usize::midpoint(start, end);
            let axis = usize::from(self.axes[middle]);
            let at = self.points[middle][axis];
            if low[axis] <= at {
                self.search((start, middle), low, high, visit);
            }
            if high[axis] >= at {
                self.search((middle + 1, end), low, high, visit);
            }
            (first, last) = (middle, middle + 1);
        }
        for k in first..last {
            let x = &self.points[k];
            if (0..D).all(|c| low[c] <= x[c] && x[c] <= high[c]) {
                visit(x, self.numbers[k]);
            }
        }
    }
}

fn split<const D: usize>(points: &mut [(SVector<f64, D>, u32)], axes: &mut [u8]) {
    if points.len() <= LEAF {
        return;
    }
    let (low, high) = bounding_box(points.iter().map(|(x, _)| x));
    let axis = (high - low).imax();
    let middle = points.len() / 2;
    points.select_nth_unstable_by(middle, |(a, _), (b, _)| a[axis].total_cmp(&b[axis]));
    axes[middle] = axis as u8;
    let (before, after) = points.split_at_mut(middle);
    let (axes_before, axes_after) = axes.split_at_mut(middle);
    split(before, axes_before);
    split(&mut after[1..], &mut axes_after[1..]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;

    /// A fixed cloud with many equal coordinates.
    #[test]
    fn boxes_hold_what_a_look_at_all_points_finds() {
        let mut number = 1_u32;
        let mut next = || {
            number = number.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(number >> 28) / 4.0
        };
        let cloud: Vec<_> = (0..500).map(|_| Vector3::from_fn(|_, _| next())).collect();
        let points = Points::new(cloud.iter().copied().zip(0..).collect());
        for _ in 0..200 {
            let low = Vector3::from_fn(|_, _| next());
            let high = low + Vector3::from_fn(|_, _| next());
            let mut found = Vec::new();
            points.inside(&low, &high, &mut |_, number| found.push(number));
            found.sort_unstable();
            let inside = |x: &Vector3<f64>| low <= *x && *x <= high;
            let expected: Vec<u32> = (0..)
                .zip(&cloud)
                .filter(|(_, x)| inside(x))
                .map(|(k, _)| k)
                .collect();
            assert_eq!(found, expected);
        }
    }

    #[test]
    fn no_point_is_nearer_than_the_nearest() {
        let mut number = 3_u32;
        let mut next = || {
            number = number.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(number >> 28) / 4.0
        };
        let cloud: Vec<_> = (0..500).map(|_| Vector3::from_fn(|_, _| next())).collect();
        let points = Points::new(cloud.iter().copied().zip(0..).collect());
        for _ in 0..200 {
            let x = Vector3::from_fn(|_, _| 1.5 * next() - 1.0);
            // The first of many at one distance.
            let distances = (0..).zip(&cloud).map(|(k, y)| ((y - x).norm_squared(), k));
            let expected = distances.fold((f64::INFINITY, 0), |a, b| if b < a { b } else { a });
            assert_eq!(points.nearest(&x), expected.1);
        }
    }
}
