//! Closed forms against tables of 60-digit arithmetic, written by `reference.py`.

use stickslip_state::{
    Dieterich, LogTheta, Ruina, StateLaw,
    wright::{ln_omega, omega},
};

fn table<const N: usize>(text: &str) -> Vec<[f64; N]> {
    text.lines()
        .skip(1)
        .map(|line| {
            let mut row = [0.0; N];
            for (entry, field) in row.iter_mut().zip(line.split(',')) {
                *entry = field.parse().expect("a number");
            }
            row
        })
        .collect()
}

/// Representable numbers between two finite numbers of the same sign.
fn ulps(x: f64, y: f64) -> u64 {
    if x == y {
        return 0;
    }
    assert!(x * y > 0.0 || x.min(y) == 0.0, "{x} {y}");
    x.abs().to_bits().abs_diff(y.abs().to_bits())
}

#[test]
fn omega_is_accurate_to_two_ulp() {
    let mut worst = (0, 0);
    for [x, w, z] in table(include_str!("wright.csv")) {
        worst.0 = worst.0.max(ulps(omega(x), w));
        worst.1 = worst.1.max(ulps(ln_omega(x), z));
        assert!(
            ulps(omega(x), w) <= 2,
            "omega({x:e}) = {:e}, not {w:e}",
            omega(x)
        );
        assert!(
            ulps(ln_omega(x), z) <= 4,
            "ln_omega({x:e}) = {:e}, not {z:e}",
            ln_omega(x)
        );
    }
    println!("omega {} ulp, ln_omega {} ulp", worst.0, worst.1);
}

#[test]
fn omega_is_total() {
    assert_eq!(omega(f64::NEG_INFINITY), 0.0);
    assert_eq!(omega(f64::INFINITY), f64::INFINITY);
    assert!(omega(f64::NAN).is_nan());
    assert_eq!(ln_omega(f64::NEG_INFINITY), f64::NEG_INFINITY);
    assert_eq!(ln_omega(f64::INFINITY), f64::INFINITY);
    assert!(ln_omega(f64::NAN).is_nan());
    assert_eq!(ln_omega(f64::MIN), f64::MIN);
    assert_eq!(omega(f64::MAX), f64::MAX);
}

/// The relative error of `got`, over what one rounding of the inputs does to the result.
fn amplification(got: f64, want: f64, sensitivity: f64) -> f64 {
    (got - want).abs() / (f64::EPSILON * (want.abs() + sensitivity)).max(f64::MIN_POSITIVE)
}

#[test]
fn states_are_as_accurate_as_the_problem_allows() {
    let (mut worst, mut closest) = ([0f64; 4], 0f64);
    for [from, slip_rate, dt, slip_distance, de, dx, re, rx] in table(include_str!("steps.csv")) {
        let start = LogTheta(from);
        let dieterich = Dieterich { slip_distance };
        let ruina = Ruina { slip_distance };
        let c = dt * (slip_rate / slip_distance);
        let pull = if c > 0.0 {
            (slip_rate / slip_distance).ln().abs()
        } else {
            0.0
        };
        // The sums of abs(dalpha/dp p) over the inputs p.
        let omega = omega(dt.ln() + c - from);
        let decay = -(-c).exp_m1();
        let ages = (from - c - dx).exp();
        let sensitivities = [
            (from.abs() + 2.0 * c + omega) / (1.0 + omega),
            ages * (from.abs() + 2.0 * c) + 2.0 * (1.0 - ages),
            (from.abs() + 2.0 * c * (1.0 + pull)) / (1.0 + c),
            from.abs() * (1.0 - decay)
                + 2.0 * decay * (1.0 + pull)
                + 2.0 * c * (-c).exp() * (from.abs() + pull),
        ];
        let euler =
            |law: &dyn StateLaw<State = LogTheta>| law.advance(start, slip_rate, dt).map(|s| s.0);
        let exact = |law: &dyn StateLaw<State = LogTheta>| {
            law.advance_exact(start, slip_rate, dt)
                .map_or(f64::NAN, |s| s.0)
        };
        let got = [
            euler(&dieterich).expect("a step"),
            exact(&dieterich),
            euler(&ruina).expect("a step"),
            exact(&ruina),
        ];
        for (k, want) in [de, dx, re, rx].into_iter().enumerate() {
            let error = amplification(got[k], want, sensitivities[k]);
            worst[k] = worst[k].max(error);
            assert!(
                error < 8.0,
                "{k}: {} {want} from {from} V {slip_rate:e} dt {dt:e} L {slip_distance:e}: {error}",
                got[k]
            );
            // To 1e-14 of the state, or of 1 next to 0, where its terms cancel no worse than so; below
            // 1e-290 products underflow.
            for size in [want.abs(), want.abs().max(1.0)] {
                if sensitivities[k] <= 4.0 * size {
                    let error = (got[k] - want).abs() / size.max(1e-290);
                    closest = closest.max(error);
                    assert!(
                        error <= 1e-14,
                        "{k}: {error:e} from {from} V {slip_rate:e} dt {dt:e} L {slip_distance:e}"
                    );
                }
            }
        }
    }
    println!("in roundings of the inputs: {worst:?}, relative: {closest:e}");
}
