//! Extrapolated rates.

use super::*;

#[test]
fn rates_lead_straight_up_and_never_through_rest() {
    assert_eq!(lead(1.0, 3.0, 2.0), 7.0);
    assert_eq!(lead(-1.0, -3.0, 2.0), -7.0);
    assert_eq!(lead(4.0, 2.0, 1.0), 1.0);
    assert_eq!(lead(-4.0, -2.0, 2.0), -2.0 / 3.0);
    // The slip turned or stopped already.
    assert_eq!(lead(1.0, -1.0, 1.0), -3.0);
    assert_eq!(lead(1.0, 0.0, 1.0), 0.0);
    assert_eq!(lead(1.0, f64::from_bits(1), 1e9), 0.0);
    assert_eq!(lead(0.0, 0.0, 1.0), 0.0);
    // No step yet.
    assert_eq!(lead(7.0, 0.0, 0.0), 0.0);
    assert_eq!(lead(7.0, 2.0, 0.0), 2.0);
}

/// Its error is of the order of a straight line's.
#[test]
fn a_rate_that_falls_leads_to_second_order() {
    let error = |dt: f64| {
        let rate = |t: f64| (-t).exp() + 1.0;
        (lead(rate(-dt), rate(0.0), 0.5) - rate(0.5 * dt)).abs()
    };
    let order = (error(1e-3) / error(5e-4)).log2();
    assert!((order - 2.0).abs() < 1e-2, "{order}");
}
