//! The order of vertices: sweeps along the longest extent of the bounding box.
//!
//! Neighbours are then at most one cross-section apart, and a Gauss-Seidel sweep finds them in cache.

use nalgebra::SVector;

/// The axes, longest extent first; equal ones in their natural order.
pub(crate) fn sweep_axes<const D: usize>(extent: &[f64; D]) -> [usize; D] {
    let mut axes = std::array::from_fn(|axis| axis);
    axes.sort_by(|&i, &j| extent[j].total_cmp(&extent[i]));
    axes
}

/// Smallest and largest coordinates.
pub(crate) fn bounding_box<'a, const D: usize>(
    points: impl IntoIterator<Item = &'a SVector<f64, D>>,
) -> (SVector<f64, D>, SVector<f64, D>) {
    let empty = (
        SVector::repeat(f64::INFINITY),
        SVector::repeat(f64::NEG_INFINITY),
    );
    points
        .into_iter()
        .fold(empty, |(low, high), x| (low.inf(x), high.sup(x)))
}

/// The order of points: the index of the k-th point.
///
/// Coordinates are compared on a lattice of 2^31 (D = 2) or 2^20 (D = 3) steps along each axis, which keeps
/// cross-sections together under rounding errors. The number is a power of two: dyadic fractions of the extent are
/// lattice points and not halfway between two.
pub(crate) fn sweep_order<const D: usize>(points: &[SVector<f64, D>]) -> Vec<u32> {
    let (low, high) = bounding_box(points);
    let extent = high - low;
    let axes = sweep_axes(&extent.into());
    let bits = 64 / D as u32;
    let steps = (1_u64 << (bits - 1)) as f64;
    let key = |x: &SVector<f64, D>| {
        axes.iter().fold(0_u64, |key, &axis| {
            (key << bits) | ((x[axis] - low[axis]) / extent[axis] * steps).round() as u64
        })
    };
    let mut keyed: Vec<(u64, u32)> = points.iter().map(key).zip(0..).collect();
    keyed.sort_unstable();
    keyed.into_iter().map(|(_, old)| old).collect()
}

/// The position of each old index in an order.
pub(crate) fn ranks(order: &[u32]) -> Vec<u32> {
    let mut ranks = vec![0; order.len()];
    for (rank, &old) in (0..).zip(order) {
        ranks[old as usize] = rank;
    }
    ranks
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector2;

    #[test]
    fn the_longest_axis_is_slowest() {
        let points: Vec<_> = (0..6)
            .map(|k| Vector2::new(0.1 * f64::from(k % 3), 0.7 * f64::from(k / 3)))
            .collect();
        assert_eq!(sweep_order(&points), [0, 1, 2, 3, 4, 5]);
        let turned: Vec<_> = points.iter().map(|x| Vector2::new(x[1], x[0])).collect();
        assert_eq!(sweep_order(&turned), [0, 1, 2, 3, 4, 5]);
        let reversed: Vec<_> = points.iter().map(|x| -x).collect();
        assert_eq!(sweep_order(&reversed), [5, 4, 3, 2, 1, 0]);
        assert_eq!(ranks(&[2, 0, 1]), [1, 2, 0]);
    }

    #[test]
    fn rounding_does_not_split_a_cross_section() {
        let third = 1.0 / 3.0;
        let points = [
            (third + 1e-16, 0.0),
            (third - 1e-16, 0.4),
            (0.0, 0.0),
            (1.0, 0.1),
        ]
        .map(|(x, y)| Vector2::new(x, y));
        assert_eq!(sweep_order(&points), [2, 0, 1, 3]);
    }
}
