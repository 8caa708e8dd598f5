//! Fits whose load history was measured, too.

use stickslip_lab::{Fit, LoadHistory, Parameters, Record, StateParameters};

use crate::fits::AGING;
use crate::gauges::Gauge;
use crate::{Noise, Outcome, one_state};

/// The root mean square of the errors over the standard errors for each parameter, and the number of records in which all are
/// within four, of fits by default settings.
fn spread(gauge: Gauge, noise: f64, draws: u64) -> Outcome<(Vec<f64>, usize)> {
    let truth = Parameters {
        a: 0.008,
        states: vec![StateParameters::steady(0.012, 1.5e-5)],
        ..one_state()
    };
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
