//! Fits by state laws of a name, and of the parameters that these have.

use stickslip_friction::DieterichRuina;
use stickslip_lab::{Evolution, Fit, Fitted, LabError, LoadHistory, Parameter, Parameters, Record};
use stickslip_state::{LogTheta, PerrinRiceZheng, StateLaw};

use crate::evolutions::{nagata, steps, stiff, two_nagata};
use crate::fits::{assert_close, assert_within};
use crate::{Noise, Outcome, one_state, sequence, times};

/// Holds in which the slip rate falls from far above to far below `Vc`.
fn holds() -> Outcome<LoadHistory> {
    Ok(LoadHistory::slide_hold_slide(
        1e-5,
        &[10.0, 100.0, 1e3],
        3e-4,
    )?)
}

fn kato_tullis() -> Parameters {
    let mut parameters = stiff();
    parameters.states[0].aging_velocity = 3e-8;
    parameters
}

/// A case: the law, the truth, a load history, and the parameter of the law that is fitted.
type Case = (
    Evolution<'static>,
    Parameters,
    LoadHistory,
    Option<Parameter>,
);

fn cases() -> Outcome<Vec<Case>> {
    use Evolution::{KatoTullis, Nagata, PerrinRiceZheng};
    Ok(vec![
        (PerrinRiceZheng, stiff(), steps()?, None),
        (KatoTullis, one_state(), sequence()?, None),
        (
            KatoTullis,
            kato_tullis(),
            holds()?,
            Some(Parameter::AgingVelocity(0)),
        ),
        (Nagata, nagata(), sequence()?, None),
        (
            Nagata,
            nagata(),
            sequence()?,
            Some(Parameter::StressWeight(0)),
        ),
    ])
}

fn fitted(case: &Case, noise: f64, seed: u64) -> Outcome<Fitted> {
    let (law, truth, load, free) = case;
    let times = match free {
        Some(Parameter::AgingVelocity(_)) => load.samples(120),
        _ => times(),
    };
    let friction = truth.curve(&[*law], load, &times)?;
    let record = Record::new(times, Noise::new(seed).added_to(&friction, noise))?;
    let fit = Fit::new(&[*law]).with_reference_velocity(1e-6);
    let fit = free.iter().fold(fit, |fit, free| fit.with_free(*free));
    Ok(fit.run(&record, load)?)
}

/// Without a guess; the parameter of a law from its published value on.
#[test]
fn exact_data_give_the_parameters_of_each_law() -> Outcome {
    for case in cases()? {
        let found = fitted(&case, 0.0, 0)?;
        assert_close(&found, &case.1, 1e-4);
        assert_eq!(found.laws, [case.0.name()]);
    }
    Ok(())
}

/// The root mean square of a hundred errors over theirs is between 0.7 and 1.3 in all but one of 10 000 cases, and of 2600
/// parameters four are beyond four standard errors with a probability of 1e-5.
#[test]
fn noisy_data_give_the_parameters_of_each_law_with_their_errors() -> Outcome {
    let mut beyond = 0;
    for case in cases()? {
        let mut squares: Vec<f64> = Vec::new();
        for seed in 0..100 {
            let found = fitted(&case, 5e-4, seed)?;
            squares.resize(found.estimates.len(), 0.0);
            for (square, estimate) in squares.iter_mut().zip(&found.estimates) {
                let error = estimate.value - estimate.parameter.of(&case.1);
                let z = error / estimate.standard_error;
                *square += 0.01 * z * z;
                beyond += usize::from(z.abs() > 4.0);
            }
        }
        let rms: Vec<f64> = squares.iter().map(|square| square.sqrt()).collect();
        assert!(
            rms.iter().all(|z| (0.7..1.3).contains(z)),
            "{:?}: {rms:?}",
            case.0
        );
    }
    assert!(beyond < 4, "{beyond}");
    Ok(())
}

/// Two states of Nagata's law, and one beside a state that ages.
#[test]
fn two_states_of_nagata_are_fitted() -> Outcome {
    let truth = two_nagata();
    for laws in [
        [Evolution::Nagata; 2],
        [Evolution::Nagata, Evolution::Aging],
    ] {
        let friction = truth.curve(&laws, &sequence()?, &times())?;
        let record = Record::new(times(), Noise::new(11).added_to(&friction, 2e-4))?;
        let fit = Fit::new(&laws).with_fixed(Parameter::StressWeight(0), 2.0);
        let fit = if laws[1].parameter(1).is_some() {
            fit.with_fixed(Parameter::StressWeight(1), 0.5)
        } else {
            fit
        };
        let found = fit.run(&record, &sequence()?)?;
        assert_within(&found, &truth);
    }
    Ok(())
}

/// The derivatives of the named laws are those of differences: the same optimum and errors as by the law as one's own.
#[test]
fn named_laws_have_the_optimum_of_laws_by_differences() -> Outcome {
    let load = steps()?;
    let friction = stiff().curve(&[Evolution::PerrinRiceZheng], &load, &times())?;
    let record = Record::new(times(), Noise::new(7).added_to(&friction, 1e-3))?;
    // Friction compares theta with L: half of that of the law.
    struct Half(PerrinRiceZheng);
    impl StateLaw for Half {
        type State = LogTheta;
        fn evolution(&self, LogTheta(alpha): LogTheta, slip_rate: f64) -> f64 {
            self.0.evolution(LogTheta(alpha + 2_f64.ln()), slip_rate)
        }
        fn evolution_state_slope(&self, LogTheta(alpha): LogTheta, slip_rate: f64) -> f64 {
            (self.0).evolution_state_slope(LogTheta(alpha + 2_f64.ln()), slip_rate)
        }
        fn validate(&self) -> Result<(), stickslip_state::StateError> {
            self.0.validate()
        }
    }
    let own = |friction: &DieterichRuina| -> stickslip_lab::BoxedLaw {
        Box::new(Half(PerrinRiceZheng {
            slip_distance: friction.slip_distance,
        }))
    };
    let named = Fit::new(&[Evolution::PerrinRiceZheng]).run(&record, &load)?;
    let custom = Fit::new(&[Evolution::Custom(&own)]).run(&record, &load)?;
    for (one, other) in named.estimates.iter().zip(&custom.estimates) {
        let difference = (one.value - other.value).abs();
        assert!(difference < 1e-3 * one.standard_error, "{one:?} {other:?}");
        assert!((one.standard_error / other.standard_error - 1.0).abs() < 1e-3);
    }
    Ok(())
}

/// Parameters of laws are held at their published values, at a given one, or fitted: by name, with bounds or a guess.
#[test]
fn parameters_of_laws_are_held_or_fitted_by_name() -> Outcome {
    let c = Parameter::StressWeight(0);
    let record = crate::fits::record(&nagata(), &[Evolution::Nagata], 1e-4)?;
    let load = sequence()?;
    let run = |fit: Fit<'_>| fit.run(&record, &load);
    let fit = Fit::new(&[Evolution::Nagata]);
    let held = run(fit.clone())?;
    assert_eq!((held.value(c), held.standard_error(c)), (2.0, 0.0));
    assert_eq!(run(fit.clone().with_fixed(c, 1.5))?.value(c), 1.5);
    for fit in [
        fit.clone().with_free("c".parse()?),
        fit.clone().with_bounds("c1".parse()?, 0.1, 10.0),
        fit.clone().with_guess_of(c, 1.0),
    ] {
        let found = run(fit)?;
        assert!(found.standard_error(c) > 0.0, "{found}");
        assert!(found.to_string().contains("\nc1 "), "{found}");
    }
    for (fit, parameter) in [
        (Fit::new(&[Evolution::Aging]), c),
        (Fit::new(&[Evolution::Nagata]), Parameter::AgingVelocity(0)),
    ] {
        let refused = run(fit.with_free(parameter));
        assert!(
            matches!(refused, Err(LabError::OtherLaw { .. })),
            "{refused:?}"
        );
    }
    for name in [
        "aging",
        "slip",
        "perrin-rice-zheng",
        "kato-tullis",
        "nagata",
    ] {
        assert_eq!(name.parse::<Evolution<'_>>()?.name(), name);
    }
    assert!("ageing".parse::<Evolution<'_>>().is_err());
    Ok(())
}
