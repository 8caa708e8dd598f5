//! Fits whose load history was measured, too.

use stickslip_lab::{Fit, LoadHistory, Parameters, Record, StateParameters};

use crate::fits::AGING;
use crate::gauges::Gauge;
use crate::{Noise, Outcome, one_state};

fn truth() -> Parameters {
    Parameters {
        a: 0.008,
        states: vec![StateParameters::steady(0.012, 1.5e-5)],
        ..one_state()
    }
}

/// The root mean square of the errors over the standard errors for each parameter, and the number of records in which all are
/// within four, of fits by default settings.
fn spread(gauge: Gauge, noise: f64, draws: u64) -> Outcome<(Vec<f64>, usize)> {
    let truth = truth();
    let exact = LoadHistory::velocity_steps(&[1e-6, 1e-5, 1e-6, 1e-5, 3e-6], 3e-4)?;
    let times = exact.samples(200);
    let friction = truth.curve(AGING, &exact, &times)?;
    let (mut squares, mut within) = (vec![0.0; 5], 0);
    for seed in 0..draws {
        let readings = gauge.reads(&exact, &times, seed);
        let load = LoadHistory::measured(&times, &readings, None, None)?;
        let data = Noise::new(1000 + seed).added_to(&friction, noise);
        let fit = Fit::new(AGING).with_reference_velocity(1e-6);
        let found = fit.run(&Record::new(times.clone(), data)?, &load)?;
        let errors = found.estimates.iter().map(|estimate| {
            (estimate.value - estimate.parameter.of(&truth)) / estimate.standard_error
        });
        let errors: Vec<f64> = errors.collect();
        within += usize::from(errors.iter().all(|z| z.abs() <= 4.0));
        for (square, z) in squares.iter_mut().zip(errors) {
            *square += z * z / draws as f64;
        }
    }
    Ok((squares.into_iter().map(f64::sqrt).collect(), within))
}

/// From friction without noise, where all errors are those of the gauge, to noise beside which these vanish: the errors are
/// within the standard errors. Of residuals that the gauge alone leaves, `mu0` knows more than it says.
#[test]
fn standard_errors_know_the_noise_of_the_gauge() -> Outcome {
    for gauge in [1e-8, 1e-7] {
        for noise in [0.0, 1e-5, 3e-5, 1e-3] {
            let (spread, within) = spread(Gauge::white(gauge), noise, 60)?;
            assert!(within >= 59, "{gauge:e} m, {noise:e}: {within} of 60");
            assert!(
                spread.iter().all(|z| (0.4..1.35).contains(z)),
                "{gauge:e} m, {noise:e}: {spread:?}"
            );
        }
    }
    Ok(())
}

/// Steps of the gauge of a micrometre, whose errors are no noise: the standard errors are those of the worst case.
#[test]
fn standard_errors_know_the_steps_of_the_gauge() -> Outcome {
    for noise in [0.0, 1e-5, 1e-3] {
        let gauge = Gauge {
            quantum: 1e-6,
            ..Gauge::white(0.0)
        };
        let (spread, within) = spread(gauge, noise, 30)?;
        assert!(
            within == 30 && spread.iter().all(|z| *z < 1.35),
            "{noise:e}: {within} {spread:?}"
        );
    }
    Ok(())
}

/// From 1 to 1000 samples per second, with noise of 1e-4 to 1e-2 of the displacement at each velocity, independent and with a
/// correlation of .9 in displacement and friction: all parameters are within four standard errors, and some 95 of 100 within
/// two. Of 306 records with five parameters each, which depend on one another, 92 of 100 is two standard deviations less.
#[test]
fn standard_errors_hold_whatever_the_rate_and_the_noise() -> Outcome {
    let displacement = 1e-4;
    let exact = LoadHistory::velocity_steps(&[1e-6, 1e-5, 1e-6, 1e-5, 3e-6], displacement)?;
    let (mut close, mut count, mut seed) = (0, 0, 0);
    for (rate, draws) in [(1.0, 20), (10.0, 20), (100.0, 10), (1000.0, 1)] {
        let times: Vec<f64> = (0..(253.0 * rate) as u32)
            .map(|n| f64::from(n) / rate)
            .collect();
        let friction = truth().curve(AGING, &exact, &times)?;
        let levels = [1e-4, 1e-3, 1e-2].into_iter();
        for (level, together) in levels.flat_map(|level| [(level, 0.0), (level, 0.9)]) {
            let gauge = Gauge {
                together,
                ..Gauge::white(level * displacement)
            };
            for _ in 0..draws {
                seed += 2;
                let readings = gauge.reads(&exact, &times, seed);
                let load = LoadHistory::measured(&times, &readings, None, None)?;
                let noise = Gauge {
                    noise: 3e-4,
                    ..gauge
                };
                let data = noise.adds_to(&friction, seed + 1);
                let fit = Fit::new(AGING).with_reference_velocity(1e-6);
                let found = fit.run(&Record::new(times.clone(), data)?, &load)?;
                for estimate in &found.estimates {
                    let error = (estimate.value - estimate.parameter.of(&truth())).abs();
                    let bound = 4.0 * estimate.standard_error;
                    assert!(error <= bound, "{rate} {gauge:?}: {found}");
                    close += usize::from(error <= 0.5 * bound);
                    count += 1;
                }
            }
        }
    }
    assert!(100 * close >= 92 * count, "{close} of {count}");
    Ok(())
}
