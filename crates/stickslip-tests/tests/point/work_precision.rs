//! Tables of error against run time.

use stickslip::work_precision::{Measurement, WorkPrecision, observed_order, seconds_to};

fn at(setting: f64, error: f64, seconds: f64) -> Measurement {
    Measurement {
        method: "m".into(),
        setting,
        error,
        seconds,
        failure: None,
    }
}

#[test]
fn errors_failures_and_interpolated_times() {
    let mut runs = 0;
    let table = WorkPrecision::against(1.0)
        .with_runs(3)
        .method("exact", &[0.5, 0.25], |h| {
            runs += 1;
            Ok::<_, String>(1.0 + h)
        })
        .method("broken", &[1.0], |_| Err::<f64, _>("no"))
        .finish();
    assert_eq!(runs, 6);
    assert_eq!(table[0].error, 0.5);
    assert_eq!(table[1].error, 0.25);
    assert_eq!(table[2].failure.as_deref(), Some("no"));
    let two = [at(0.1, 1e-2, 1.0), at(0.01, 1e-4, 100.0)];
    let between = seconds_to(&two, "m", 1e-3).expect("between the two");
    assert!((between - 10.0).abs() < 1e-9);
    assert_eq!(seconds_to(&two, "m", 1e-5), None);
    let cheapest = seconds_to(&two, "m", 0.1).expect("the first is better");
    assert!((cheapest - 1.0).abs() < 1e-12);
    assert_eq!(seconds_to(&two, "other", 1e-3), None);
}

#[test]
fn one_error_that_is_too_small_leaves_the_order_alone() {
    let order = |points: &[(f64, f64)]| {
        let table: Vec<_> = points.iter().map(|&(h, e)| at(h, e, 1.0)).collect();
        observed_order(&table, "m")
    };
    let close = |order: Option<f64>| order.is_some_and(|order| (order - 2.0).abs() < 1e-12);
    let exact = [(0.8, 6.4), (0.4, 1.6), (0.2, 0.4), (0.1, 0.1)];
    assert!(close(order(&exact)));
    assert!(close(order(&exact[..2])));
    let mut with_change_of_sign = exact;
    with_change_of_sign[2].1 = 1e-3;
    assert!(close(order(&with_change_of_sign)));
    // Neither exact results nor failures have a logarithm.
    let without = [exact[0], (0.4, 0.0), (0.2, f64::NAN), exact[3]];
    assert!(close(order(&without)));
    assert_eq!(order(&without[..3]), None);
    assert_eq!(order(&[(0.1, 1.0), (0.1, 2.0)]), None);
    assert_eq!(order(&[]), None);
}
