//! Thinning of curves to the resolution of a picture.

/// Thins the points of a curve to at most four in each of `columns` columns of a picture: the first, the last, the
/// lowest and the highest. They keep their order. The thinned curve covers the same pixels.
pub(super) fn thinned(points: &[(f64, f64)], columns: f64) -> Vec<(f64, f64)> {
    let ends = points
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |ends, p| {
            (ends.0.min(p.0), ends.1.max(p.0))
        });
    let scale = columns / (ends.1 - ends.0);
    let column = |point: &(f64, f64)| ((point.0 - ends.0) * scale).floor();
    let mut kept = Vec::new();
    for group in points.chunk_by(|a, b| column(a) == column(b)) {
        let extreme = |sign: f64| {
            let heights = group.iter().enumerate();
            let highest = heights.max_by(|a, b| (sign * a.1.1).total_cmp(&(sign * b.1.1)));
            highest.map_or(0, |(k, _)| k)
        };
        let mut chosen = [0, extreme(1.0), extreme(-1.0), group.len() - 1];
        chosen.sort_unstable();
        for (k, &place) in chosen.iter().enumerate() {
            if k == 0 || chosen[k - 1] != place {
                kept.push(group[place]);
            }
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Thinning keeps the picture: in each column the same extremes, and the same ends.
    #[test]
    fn extremes_and_ends_stay() {
        // Columns of 256 points, without rounding.
        let points: Vec<(f64, f64)> = (0..=98_304)
            .map(|k| {
                let x = f64::from(k) / 1024.0;
                let spike = if k % 7919 == 0 { 5.0 } else { 0.0 };
                (x, (0.3 * x).sin() + spike)
            })
            .collect();
        let kept = thinned(&points, 384.0);
        assert!(kept.len() <= 4 * 385);
        assert!(kept.windows(2).all(|pair| pair[0].0 < pair[1].0));
        assert_eq!(kept.first(), points.first());
        assert_eq!(kept.last(), points.last());
        for column in 0..=384 {
            let extremes = |points: &[(f64, f64)]| {
                let within = points.iter().filter(|p| (p.0 * 4.0) as i32 == column);
                within.fold((f64::INFINITY, f64::NEG_INFINITY), |ends, p| {
                    (ends.0.min(p.1), ends.1.max(p.1))
                })
            };
            assert_eq!(extremes(&points), extremes(&kept), "{column}");
        }
    }

    #[test]
    fn few_points_stay_as_they_are() {
        let points = [(0.0, 1.0), (1.0, 3.0), (1.0, 2.0)];
        assert_eq!(thinned(&points, 1000.0), points);
    }
}
