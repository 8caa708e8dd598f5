//! Contours of fields that are linear in triangles.

use super::Points;

/// The largest number of contours of a field.
const MOST: usize = 8;

/// The least of 1, 2 or 5 times a power of ten that is in `end` at most so many times.
pub fn interval(end: f64) -> f64 {
    let least = end / (MOST as f64 + 1.0);
    let power = 10_f64.powf(least.log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|factor| factor * power);
    steps
        .into_iter()
        .find(|step| *step >= least)
        .unwrap_or(least)
}

/// The pieces of contours at multiples of a step, within triangles in which the field is linear; none in triangles with a
/// corner whose value is not finite.
pub fn contours(places: &[[[f64; 2]; 3]], values: &[[f64; 3]], step: f64) -> Vec<Points> {
    let mut pieces = Vec::new();
    for (places, values) in places.iter().zip(values) {
        if !values.iter().all(|value| value.is_finite()) {
            continue;
        }
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let (first, last) = ((low / step).floor().max(0.0) as u64, (high / step) as u64);
        for level in (first + 1..=last).map(|n| n as f64 * step) {
            let crossing = |k: usize| {
                let (from, to) = (values[k], values[(k + 1) % 3]);
                if (from < level) == (to < level) {
                    return None;
                }
                let part = (level - from) / (to - from);
                let [a, b] = [places[k], places[(k + 1) % 3]];
                let between = |c: usize| a[c] + part * (b[c] - a[c]);
                Some((between(0), between(1)))
            };
            let piece: Points = (0..3).filter_map(crossing).collect();
            if piece.len() == 2 {
                pieces.push(piece);
            }
        }
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::{contours, interval};

    #[test]
    fn contours_of_a_linear_field_are_straight() {
        let places = [
            [[0.0, 0.0], [4.0, 0.0], [4.0, 3.0]],
            [[0.0, 0.0], [4.0, 3.0], [0.0, 3.0]],
        ];
        let values = places.map(|corners| corners.map(|[x, y]| x + 2.0 * y));
        let pieces = contours(&places, &values, 2.5);
        let mut length = 0.0;
        for piece in &pieces {
            let level = |n: usize| piece[n].0 + 2.0 * piece[n].1;
            assert!((level(0) - level(1)).abs() < 1e-12);
            assert!(((level(0) / 2.5).round() * 2.5 - level(0)).abs() < 1e-12);
            length += (piece[0].0 - piece[1].0).hypot(piece[0].1 - piece[1].1);
        }
        // Levels 2.5, 5 and 7.5 cross the rectangle of 4 by 3.
        let exact = 5_f64.sqrt() * (1.25 + 2.0 + 1.25);
        assert!((length - exact).abs() < 1e-12, "{length} {exact}");
    }

    #[test]
    fn contours_are_at_round_times() {
        for (end, step) in [(30.0, 5.0), (0.7, 0.1), (17.0, 2.0), (100.0, 20.0)] {
            assert!((interval(end) / step - 1.0).abs() < 1e-12, "{end}");
        }
    }
}
