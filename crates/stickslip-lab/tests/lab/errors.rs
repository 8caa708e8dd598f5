//! Standard errors, losses and spikes for data as gauges give them.

use stickslip_lab::{Errors, Fit, Fitted, Loss, Record, Warning};

use crate::fits::{AGING, assert_within};
use crate::{Noise, Outcome, one_state, sequence, times};

const DRAWS: u64 = 100;
const NOISE: f64 = 1e-3;

/// The record of a sequence with noise of which neighbours have a correlation.
fn correlated(correlation: f64, seed: u64) -> Outcome<Record> {
    let mut random = Noise::new(seed);
    let mut error = random.normal();
    let fresh = (1.0 - correlation * correlation).sqrt();
    let friction = one_state().curve(AGING, &sequence()?, &times())?;
    let noisy = friction.iter().map(|mu| {
        error = correlation * error + fresh * random.normal();
        mu + NOISE * error
    });
    Ok(Record::new(times(), noisy.collect())?)
}

/// The root mean square of the errors over their standard errors, for each parameter.
fn spread(fits: &[Fitted]) -> Vec<f64> {
    let of = |k: usize| {
        let squares = fits.iter().map(|fitted| {
            let estimate = fitted.estimates[k];
            let error = estimate.value - estimate.parameter.of(&one_state());
            (error / estimate.standard_error).powi(2)
        });
        (squares.sum::<f64>() / fits.len() as f64).sqrt()
    };
    (0..fits[0].estimates.len()).map(of).collect()
}

/// The root mean square of a hundred errors over true standard errors is between 0.7 and 1.3 in all but one of 10 000 cases.
/// With a correlation of .95, 25 independent samples in a thousand, the correlation itself is uncertain.
#[test]
fn standard_errors_hold_whatever_the_correlation() -> Outcome {
    for (correlation, most) in [(0.0, 1.3), (0.5, 1.3), (0.8, 1.3), (0.95, 1.4)] {
        let fits: Result<Vec<Fitted>, Box<dyn std::error::Error>> = (0..DRAWS)
            .map(|seed| Ok(Fit::new(AGING).run(&correlated(correlation, seed)?, &sequence()?)?))
            .collect();
        let fits = fits?;
        let spread = spread(&fits);
        assert!(
            spread.iter().all(|z| (0.7..most).contains(z)),
            "{correlation}: {spread:?}"
        );
        for fitted in &fits {
            let warned = fitted
                .warnings
                .iter()
                .any(|warning| matches!(warning, Warning::CorrelatedResiduals { .. }));
            let expected = if correlation > 0.0 {
                Errors::Correlated
            } else {
                Errors::Independent
            };
            assert_eq!(
                (fitted.errors, warned),
                (expected, correlation > 0.0),
                "{fitted}"
            );
            assert!((fitted.lag_one - correlation).abs() < 0.2, "{fitted}");
        }
    }
    Ok(())
}

/// Huber's loss has the truth within its standard errors, which are a few percent larger than those of squares.
#[test]
fn standard_errors_of_hubers_loss_hold() -> Outcome {
    let (mut fits, mut ratio) = (Vec::new(), 0.0);
    for seed in 0..DRAWS {
        let record = correlated(0.0, seed)?;
        let squares = Fit::new(AGING).run(&record, &sequence()?)?;
        let huber = Fit::new(AGING)
            .with_loss(Loss::Huber)
            .run(&record, &sequence()?)?;
        let a = |fitted: &Fitted| fitted.estimates[0].standard_error;
        ratio += a(&huber) / a(&squares) / DRAWS as f64;
        fits.push(huber);
    }
    let spread = spread(&fits);
    assert!(spread.iter().all(|z| (0.7..1.3).contains(z)), "{spread:?}");
    // 1/0.95^(1/2) = 1.026.
    assert!((ratio - 1.026).abs() < 0.01, "{ratio}");
    Ok(())
}

/// Spikes of up to three samples are reported with their times, and Huber's loss finds the parameters beside them, which
/// squares miss.
#[test]
fn spikes_are_reported_and_do_not_bend_the_fit() -> Outcome {
    let load = sequence()?;
    let clean = one_state().curve(AGING, &load, &times())?;
    let mut missed = 0;
    for seed in 0..20 {
        let mut friction = Noise::new(seed).added_to(&clean, NOISE);
        // Behind the steps, where they count most.
        let places = [60, 61, 62, 420, 421, 422, 700, 701, 702, 850];
        for n in places {
            friction[n] += 0.03;
        }
        let record = Record::new(times(), friction)?;
        let squares = Fit::new(AGING).run(&record, &load)?;
        let huber = Fit::new(AGING).with_loss(Loss::Huber).run(&record, &load)?;
        for fitted in [&squares, &huber] {
            let found: Vec<f64> = fitted.spikes.iter().map(|spike| spike.time).collect();
            assert_eq!(found, places.map(|n| times()[n]), "{seed}: {fitted}");
            let warned = fitted.warnings.iter().any(|warning| {
                matches!(warning, Warning::Spikes { count: 10, first, largest }
                    if *first == times()[60] && (*largest - 0.03).abs() < 0.01)
            });
            assert!(warned, "{seed}: {fitted}");
        }
        assert_within(&huber, &one_state());
        let error = |fitted: &Fitted| (fitted.parameters.a - one_state().a).abs();
        missed += usize::from(error(&squares) > error(&huber));
    }
    assert!(missed >= 18, "{missed}");
    Ok(())
}

/// One of ten thousand records without spikes has one.
#[test]
fn noise_has_no_spikes() -> Outcome {
    let mut found = 0;
    for seed in 0..DRAWS {
        let fitted = Fit::new(AGING).run(&correlated(0.0, 1000 + seed)?, &sequence()?)?;
        found += usize::from(!fitted.spikes.is_empty());
    }
    assert!(found <= 1, "{found}");
    Ok(())
}
