//! Curves, and which of them cover others.

use plotters::style::RGBColor;

use super::Points;

/// More curves are a family.
const FAMILY: usize = 8;
/// The distance of two lines that cover one another, as a share of the axis.
const NEAR: f64 = 4e-3;

/// A curve with its name and its look.
pub(super) struct Curve<'a> {
    pub(super) label: &'a str,
    pub(super) color: RGBColor,
    pub(super) width: u32,
    pub(super) look: Look,
    pub(super) points: Points,
}

/// The look of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Look {
    /// A line.
    Line,
    /// A line with a few dots.
    Dotted,
    /// Points alone, as many as there are data.
    Points,
}

/// Which lines cover an earlier one over nearly all of their length: dashed, they show it. None of a family of many.
pub(super) fn covering(curves: &[Curve<'_>], logarithmic: bool) -> Vec<bool> {
    let is_line = |curve: &Curve<'_>| curve.look == Look::Line && curve.points.len() > 1;
    let height = |y: f64| if logarithmic { y.abs().log10() } else { y };
    let points = curves.iter().flat_map(|curve| &curve.points);
    let heights = points.map(|p| height(p.1)).filter(|y| y.is_finite());
    let ends = (f64::INFINITY, f64::NEG_INFINITY);
    let (low, high) = heights.fold(ends, |(low, high), y| (low.min(y), high.max(y)));
    let near = NEAR * (high - low);
    let of = |k: usize| {
        let this = &curves[k];
        let mut earlier = curves[..k].iter().filter(|curve| is_line(curve));
        let covers = |other: &Curve<'_>| covers(&this.points, &other.points, near, height);
        curves.len() <= FAMILY && is_line(this) && earlier.any(covers)
    };
    (0..curves.len()).map(of).collect()
}

/// Whether nine in ten points of a curve over increasing places lie within a distance of another one, after a map of heights.
fn covers(
    curve: &[(f64, f64)],
    other: &[(f64, f64)],
    near: f64,
    height: impl Fn(f64) -> f64,
) -> bool {
    let increases = |points: &[(f64, f64)]| points.windows(2).all(|pair| pair[0].0 <= pair[1].0);
    if !increases(curve) || !increases(other) {
        return false;
    }
    let mut close = 0;
    for &(x, y) in curve {
        let next = other.partition_point(|p| p.0 < x);
        let (Some(&to), Some(&from)) = (other.get(next), other.get(next.saturating_sub(1))) else {
            continue;
        };
        let part = if to.0 > from.0 {
            (x - from.0) / (to.0 - from.0)
        } else {
            1.0
        };
        let [low, high] = [from.1, to.1].map(&height);
        close += usize::from((low + part * (high - low) - height(y)).abs() <= near);
    }
    10 * close > 9 * curve.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_curves_near_one_another_cover() {
        let curve = |shift: f64, count: i32| -> Vec<(f64, f64)> {
            let place = |k: i32| f64::from(k) / f64::from(count);
            (0..=count).map(|k| (place(k), place(k) + shift)).collect()
        };
        let over = |shift, count| covers(&curve(shift, count), &curve(0.0, 100), 0.01, |y| y);
        assert!(over(0.0, 7) && over(0.005, 1000) && !over(0.05, 100));
        let back: Vec<_> = curve(0.0, 100).into_iter().rev().collect();
        assert!(!covers(&back, &curve(0.0, 100), 0.01, |y| y));
    }
}
