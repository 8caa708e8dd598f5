//! Fits by several laws, and by laws of one's own.

use stickslip_friction::DieterichRuina;
use stickslip_lab::{BoxedLaw, Evolution, Fit, Record};
use stickslip_state::{Dieterich, KatoTullis};

use crate::fits::{AGING, assert_close, record};
use crate::{Outcome, STIFFNESS, one_state, sequence, two_states};

/// Two different laws, the slow one first: the order of the laws is kept.
#[test]
fn states_have_laws_of_their_own() -> Outcome {
    let mut truth = two_states();
    truth.states.reverse();
    let laws = [Evolution::Slip, Evolution::Aging];
    let record = record(&truth, &laws, 0.0)?;
    let found = Fit::new(&laws)
        .with_stiffness(STIFFNESS)
        .run(&record, &sequence()?)?;
    assert_close(&found, &truth, 2e-5);
    Ok(())
}

/// A custom law, with derivatives by differences, has the optimum of the built-in one; another one its own.
#[test]
fn custom_laws_are_fitted() -> Outcome {
    let load = sequence()?;
    let own = |friction: &DieterichRuina| -> BoxedLaw {
        Box::new(Dieterich {
            slip_distance: friction.slip_distance,
        })
    };
    let noisy = record(&one_state(), AGING, 1e-3)?;
    let built_in = Fit::new(AGING).run(&noisy, &load)?;
    let custom = Fit::new(&[Evolution::Custom(&own)]).run(&noisy, &load)?;
    for (one, other) in built_in.estimates.iter().zip(&custom.estimates) {
        assert!(
            (one.value - other.value).abs() < 1e-4 * one.standard_error,
            "{one:?} {other:?}"
        );
        assert!((one.standard_error / other.standard_error - 1.0).abs() < 1e-3);
    }
    let composite = |friction: &DieterichRuina| -> BoxedLaw {
        Box::new(KatoTullis {
            slip_distance: friction.slip_distance,
            aging_velocity: 1e-8,
        })
    };
    let laws = [Evolution::Custom(&composite)];
    let record = record(&one_state(), &laws, 0.0)?;
    let found = Fit::new(&laws)
        .with_stiffness(STIFFNESS)
        .run(&record, &load)?;
    assert_close(&found, &one_state(), 1e-4);
    Ok(())
}

/// The criterion prefers the law and the number of states that made the data.
#[test]
fn the_information_criterion_finds_laws_and_states() -> Outcome {
    let load = sequence()?;
    let aic = |record: &Record, laws: &[Evolution<'_>]| -> Outcome<f64> {
        Ok(Fit::new(laws)
            .with_stiffness(STIFFNESS)
            .run(record, &load)?
            .aic)
    };
    let one = record(&one_state(), AGING, 1e-3)?;
    // Another state lowers the criterion by chance alone, by two parameters' worth at most in most draws.
    assert!(aic(&one, AGING)? < aic(&one, &[Evolution::Slip])? - 10.0);
    assert!(aic(&one, AGING)? < aic(&one, &[Evolution::Aging; 2])? + 4.0);
    let two = record(&two_states(), &[Evolution::Slip; 2], 1e-3)?;
    let slip = aic(&two, &[Evolution::Slip; 2])?;
    assert!(slip < aic(&two, &[Evolution::Slip])? - 10.0);
    assert!(slip < aic(&two, &[Evolution::Aging; 2])? - 10.0);
    Ok(())
}
