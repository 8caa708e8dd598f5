use crate::{Noise, Outcome, STIFFNESS, one_state, sequence, times, two_states};
use std::time::Instant;
use stickslip_lab::{Evolution, Fit, Record};

#[test]
fn explore() -> Outcome {
    let (load, times) = (sequence()?, times());
    for (p, laws) in [
        (one_state(), vec![Evolution::Aging]),
        (one_state(), vec![Evolution::Slip]),
        (two_states(), vec![Evolution::Aging; 2]),
        (two_states(), vec![Evolution::Slip; 2]),
    ] {
        let clean = p.curve(&laws, &load, &times)?;
        let record = Record::new(times.clone(), Noise::new(1).added_to(&clean, 1e-3))?;
        for free in [false, true] {
            let mut fit = Fit::new(&laws);
            if !free {
                fit = fit.with_stiffness(STIFFNESS);
            }
            let clock = Instant::now();
            let found = fit.run(&record, &load)?;
            println!(
                "{:.3} ms\n{found}\n{:?} {} {:e}",
                clock.elapsed().as_secs_f64() * 1e3,
                found.work,
                found.steps,
                found.offset
            );
        }
    }
    Ok(())
}
