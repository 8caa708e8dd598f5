//! Curves by state laws of a name, against integrations and closed forms of their own.

use stickslip_lab::{Evolution, LoadHistory, Parameters, StateParameters};
use stickslip_state::{LogTheta, PerrinRiceZheng, StateLaw};

use crate::{Outcome, one_state, oracle, sequence, times, two_states};

/// `a` and `b` of the order of those of Nagata and others, whose `a/(1 + c)` is the direct effect of a step.
pub(crate) fn nagata() -> Parameters {
    let mut parameters = one_state();
    parameters.a = 0.035;
    parameters.states = vec![StateParameters::steady(0.038, 6e-6)];
    parameters
}

/// Two states, the second of which weakens by stress, too.
pub(crate) fn two_nagata() -> Parameters {
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
pub(crate) fn stiff() -> Parameters {
    Parameters {
        stiffness: 1e4,
        ..one_state()
    }
}

/// Velocity steps and a hold of 5 s.
pub(crate) fn steps() -> Outcome<LoadHistory> {
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
