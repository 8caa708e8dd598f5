//! Runs that stop and go on.

use stickslip::integrate::Stepper;
use stickslip::{Run, RungeKutta, Steps};

use super::{explicit, fault};
use crate::Outcome;
use crate::common::bits;

fn all(motion: &RungeKutta<1>) -> Vec<u64> {
    let at = motion.snapshot();
    let slips = at
        .contacts()
        .flat_map(|contact| (0..contact.len()).map(move |k| contact.slip(k)));
    bits(&at)
        .into_iter()
        .chain(slips.map(f64::to_bits))
        .collect()
}

/// From a state that was kept, in another integrator of the same scene, come the same bits.
#[test]
fn a_run_goes_on_from_a_state_with_the_same_bits() -> Outcome {
    let fault = fault()?;
    for split in [false, true] {
        let mut through = explicit(&fault, split)?;
        let steps = Steps::adaptive(1e-5);
        Run::run(&mut through, &steps.clone().count(40), |_| ())?;
        let kept = through.snapshot().state().clone();
        Run::run(&mut through, &steps.clone().count(40), |_| ())?;
        let mut again = explicit(&fault, split)?;
        again.restore(&kept)?;
        Run::run(&mut again, &steps.count(40), |_| ())?;
        assert_eq!(all(&through), all(&again));
        // And back.
        through.restore(&kept)?;
        Run::run(&mut through, &Steps::adaptive(1e-5).count(40), |_| ())?;
        assert_eq!(all(&through), all(&again));
    }
    Ok(())
}

/// Steps that were taken back leave no trace.
#[test]
fn a_step_taken_back_leaves_no_trace() -> Outcome {
    let fault = fault()?;
    let control = stickslip::ErrorControl::default();
    let (mut one, mut other) = (explicit(&fault, true)?, explicit(&fault, true)?);
    for _ in 0..5 {
        one.step(1e5)?;
        other.step_estimated(3e5, &control)?;
        other.undo();
        other.step(1e5)?;
        assert_eq!(all(&one), all(&other));
    }
    Ok(())
}
