//! State laws by name: their curves, against integrations and closed forms of their own, and their fits.

use stickslip_friction::DieterichRuina;
use stickslip_lab::{
    Evolution, Fit, Fitted, LabError, LoadHistory, Parameter, Parameters, Record, StateParameters,
};
use stickslip_state::{LogTheta, PerrinRiceZheng, StateLaw};

use crate::fits::{assert_close, assert_within};
use crate::{Noise, Outcome, one_state, oracle, sequence, times, two_states};

/// `a` and `b` of the order of those of Nagata and others, whose `a/(1 + c)` is the direct effect of a step.
fn nagata() -> Parameters {
    let mut parameters = one_state();
    parameters.a = 0.035;
    parameters.states = vec![StateParameters::steady(0.038, 6e-6)];
    parameters
}

/// Two states, the second of which weakens by stress, too.
fn two_nagata() -> Parameters {
    let mut parameters = nagata();
    parameters.states = vec![
        StateParameters::steady(0.025, 3e-6),
        StateParameters {
            stress_weight: 0.5,
            ..StateParameters::steady(0.013, 4e-5)
        },
    ];
    parameters
}

/// A stiff machine: far above its steady state `theta` of Perrin, Rice and Zheng falls like `1/V^2`, that of the slip law
/// faster than by `L`, and on softer machines slip is unstable behind long holds.
fn stiff() -> Parameters {
    Parameters {
        stiffness: 1e4,
        ..one_state()
    }
}

/// Velocity steps and a hold of 5 s.
fn steps() -> Outcome<LoadHistory> {
    let changes = [
        (50.0, 1e-5),
        (90.0, 3e-6),
        (220.0, 1e-5),
        (235.0, 0.0),
        (240.0, 1e-5),
        (265.0, 3e-6),
    ];
    Ok(LoadHistory::new(1e-6, &changes)?)
}

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

fn largest(one: &[f64], two: &[f64]) -> f64 {
    let differences = one.iter().zip(two).map(|(x, y)| (x - y).abs());
    differences.fold(0.0, f64::max)
}

/// As the curves of the aging and slip law, to the local error; with initial states, and steady states below `Vc`.
#[test]
fn curves_are_the_solution_of_each_law() -> Outcome {
    use Evolution::{Aging, KatoTullis, Nagata, PerrinRiceZheng};
    let (load, times) = (sequence()?, times());
    let mut slow = one_state();
    (slow.states[0].aging_velocity, slow.states[0].initial_state) = (4e-6, 0.4);
    let mut young = stiff();
    young.states[0].initial_state = -0.7;
    let cases: [(Parameters, &[Evolution<'_>], &[oracle::Rate]); 6] = [
        (young, &[PerrinRiceZheng], &[oracle::perrin_rice_zheng]),
        (slow, &[KatoTullis], &[oracle::kato_tullis]),
        (nagata(), &[Nagata], &[oracle::nagata]),
        (
            two_nagata(),
            &[Nagata; 2],
            &[oracle::nagata, oracle::nagata],
        ),
        (
            two_nagata(),
            &[Nagata, Aging],
            &[oracle::nagata, oracle::aging],
        ),
        (
            Parameters {
                stiffness: 1e4,
                ..two_states()
            },
            &[KatoTullis, PerrinRiceZheng],
            &[oracle::kato_tullis, oracle::perrin_rice_zheng],
        ),
    ];
    for (parameters, laws, rates) in cases {
        let load = if laws.iter().any(|law| law.name() == PerrinRiceZheng.name()) {
            steps()?
        } else {
            load.clone()
        };
        let exact = oracle::friction(&parameters, rates, &load, &times, 0.01);
        let found = parameters.curve(laws, &load, &times)?;
        let difference = largest(&exact, &found);
        assert!(difference < 2e-9, "{laws:?}: {difference:e}");
    }
    Ok(())
}

/// On a rigid machine the slip rate is that of the load point: `a ln(V/V0)` and the closed form of the state. The machine of
/// 1e9/m slips `a/k`, a millionth of `L`, behind the load point.
#[test]
fn a_rigid_machine_has_the_closed_form_of_the_state() -> Outcome {
    let load = LoadHistory::new(1e-6, &[(10.0, 1e-5)])?.ending(20.0)?;
    let times: Vec<f64> = (0..=100)
        .map(|n| 10.0 + 0.1 * f64::from(n))
        .skip(1)
        .collect();
    let with_start = |times: &[f64]| -> Vec<f64> { [&[0.0], times].concat() };
    let close = |parameters: &Parameters, law, exact: &dyn Fn(f64) -> f64| -> Outcome {
        let rigid = Parameters {
            stiffness: 1e9,
            ..parameters.clone()
        };
        let curve = rigid.curve(&[law], &load, &with_start(&times))?;
        for (time, mu) in times.iter().zip(&curve[1..]) {
            let difference = (mu - exact(time - 10.0)).abs();
            assert!(difference < 1e-6, "{law:?} {time}: {difference:e}");
        }
        Ok(())
    };
    let law = PerrinRiceZheng {
        slip_distance: 1.2e-5,
    };
    let steady = LogTheta((2.0 * 1.2e-5_f64 / 1e-6).ln());
    close(&one_state(), Evolution::PerrinRiceZheng, &|since| {
        let LogTheta(alpha) = law.advance_exact(steady, 1e-5, since).unwrap_or(steady);
        let aged = alpha + (1e-6_f64 / 2.4e-5).ln();
        0.6 + 0.009 * 10_f64.ln() + 0.012 * aged
    })?;
    let truth = nagata();
    let (friction, law) = truth.friction(0).weakened_by_stress(2.0);
    let steady = law.state(6.0, 1e-6);
    close(&truth, Evolution::Nagata, &|since| {
        let LogTheta(alpha) = law.advance_exact(steady, 1e-5, since).unwrap_or(steady);
        0.6 + friction.a * 10_f64.ln() + friction.b * (alpha + (1e-6_f64 / 6e-6).ln())
    })
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

/// By Nagata's law a spring below `(b - a)/(L (1 + c))` oscillates, and one above does not.
#[test]
fn the_critical_stiffness_of_nagata_divides_damped_from_growing_oscillations() -> Outcome {
    let load = LoadHistory::new(1e-6, &[(10.0, 1.05e-6)])?.ending(3000.0)?;
    for (truth, laws) in [
        (nagata(), vec![Evolution::Nagata]),
        (two_nagata(), vec![Evolution::Nagata; 2]),
    ] {
        // A softer spring needs velocity weakening.
        let mut truth = truth;
        truth.a = 0.03;
        let critical = truth.critical_stiffness_by(&laws);
        assert!(critical > 0.0);
        let swing = |share: f64| -> Outcome<f64> {
            truth.stiffness = share * critical;
            let times: Vec<f64> = (0..=2990).map(|n| 10.0 + f64::from(n)).collect();
            let mu = truth.curve(&laws, &load, &times)?;
            let level = truth.steady_coefficient(1.05e-6);
            let largest = |part: &[f64]| {
                part.iter()
                    .fold(0.0_f64, |most, mu| most.max((mu - level).abs()))
            };
            let third = mu.len() / 3;
            Ok(largest(&mu[2 * third..]) / largest(&mu[..third]))
        };
        let mut swing = swing;
        assert!(swing(1.1)? < 1.0);
        assert!(swing(0.97).map_or(true, |ratio| ratio > 1.0));
    }
    Ok(())
}
