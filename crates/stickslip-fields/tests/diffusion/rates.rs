//! Rates in time.

use proptest::prelude::*;
use stickslip_fields::{Diffusion, Line, RateHistory, Well};

use crate::march::{March, zone};

fn rows() -> impl Strategy<Value = Vec<(f64, f64)>> {
    let row = (prop_oneof![Just(0.0), 0.1..100.0_f64], -5.0..5.0_f64);
    prop::collection::vec(row, 1..8).prop_map(|rows| {
        let mut time = -20.0;
        let sum = |(wait, rate)| {
            time += wait;
            (time, rate)
        };
        rows.into_iter().map(sum).collect()
    })
}

proptest! {
    #[test]
    fn volumes_add(rows in rows(), cuts in prop::collection::vec(-50.0..500.0_f64, 4)) {
        let mut cuts = cuts;
        cuts.sort_by(f64::total_cmp);
        for rates in [RateHistory::constant_between(&rows), RateHistory::linear_between(&rows)] {
            let rates = rates.expect("rates");
            let parts: f64 = cuts.windows(2).map(|span| rates.volume([span[0], span[1]])).sum();
            prop_assert!((parts - rates.volume([cuts[0], cuts[3]])).abs() < 1e-9);
        }
    }

    /// Against a sum over fine intervals.
    #[test]
    fn volume_is_the_integral(rows in rows()) {
        for rates in [RateHistory::constant_between(&rows), RateHistory::linear_between(&rows)] {
            let rates = rates.expect("rates");
            let (begin, span, n) = (-30.0, 400.0, 40_000_u32);
            let sum: f64 = (0..n).map(|i| rates.at(begin + span * (f64::from(i) + 0.5) / f64::from(n))).sum();
            let sum = sum * span / f64::from(n);
            // Each jump is off by half an interval at most.
            prop_assert!((sum - rates.volume([begin, begin + span])).abs() < 0.01 * 10.0 * 8.0);
        }
    }
}

#[test]
fn rates_at_their_knots() {
    let steps = RateHistory::constant_between(&[(1.0, 2.0), (3.0, -1.0)]).expect("rates");
    assert_eq!(
        [0.0, 1.0, 2.9, 3.0, 1e9].map(|time| steps.at(time)),
        [0.0, 2.0, 2.0, -1.0, -1.0]
    );
    let ramps = [(1.0, 2.0), (3.0, 4.0), (3.0, 0.0), (4.0, 1.0)];
    let ramps = RateHistory::linear_between(&ramps).expect("rates");
    assert_eq!(
        [0.9, 1.0, 2.0, 3.0, 3.5, 9.0].map(|time| ramps.at(time)),
        [0.0, 2.0, 3.0, 0.0, 0.5, 1.0]
    );
    assert_eq!(ramps.knots(), [1.0, 3.0, 3.0, 4.0]);
    assert_eq!(RateHistory::constant(1.0).expect("rate").knots(), [0.0; 0]);
}

/// One cell: its pressure is the volume, also over knots.
#[test]
fn a_cell_holds_what_a_step_over_a_knot_injects() {
    let rates = RateHistory::linear_between(&[(0.0, 0.0), (10.0, 4.0), (25.0, 1.0), (25.0, 0.0)])
        .expect("rates");
    let field =
        Diffusion::new(Line::uniform([0.0, 1.0], 1).expect("line"), &zone(1e-13)).expect("field");
    let field = field.with_well(Well::new(0.5, rates)).expect("well");
    let mut march = March::new(&field);
    for dt in [7.0, 11.0, 20.0, 100.0] {
        march.step(dt);
    }
    assert!((march.pressure()[0] * 1e-9 / 57.5 - 1.0).abs() < 1e-14);
}

#[cfg(feature = "csv")]
#[test]
fn text_that_is_no_table_is_refused() {
    let cases = [
        (
            "time,rate\n0,1\nx,2\n",
            "line 3 of the rates: not two numbers",
        ),
        ("0,1\n1,2,3\n", "line 2 of the rates: 3 columns"),
        ("0,1\na,b\n", "line 2 of the rates: not two numbers"),
        ("time,rate\n", "rows of rates: 0 values"),
        ("0,1\n-1,2\n", "row 1 of the rates"),
        ("0,nan\n", "row 0 of the rates"),
    ];
    for (text, expected) in cases {
        let error = RateHistory::linear_from_csv(text.as_bytes())
            .expect_err(text)
            .to_string();
        assert!(error.contains(expected), "{error}");
    }
}
