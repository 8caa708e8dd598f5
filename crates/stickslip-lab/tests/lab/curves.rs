//! Curves are the solution of the model.

use stickslip_lab::{Evolution, Parameters};

use crate::{Outcome, one_state, oracle, sequence, times, two_states};

fn largest(one: &[f64], two: &[f64]) -> f64 {
    let differences = one.iter().zip(two).map(|(x, y)| (x - y).abs());
    differences.fold(0.0, f64::max)
}

/// Steps have a local error of 1e-10 in `ln V` and states; between them the dense output has that of its third order.
#[test]
fn curves_are_the_solution_through_steps_and_holds() -> Outcome {
    let (load, times) = (sequence()?, times());
    let cases: [(Parameters, &[Evolution<'_>], &[oracle::Rate]); 4] = [
        (one_state(), &[Evolution::Aging], &[oracle::aging]),
        (one_state(), &[Evolution::Slip], &[oracle::slip]),
        (
            two_states(),
            &[Evolution::Aging; 2],
            &[oracle::aging, oracle::aging],
        ),
        (
            two_states(),
            &[Evolution::Slip, Evolution::Aging],
            &[oracle::slip, oracle::aging],
        ),
    ];
    for (parameters, laws, rates) in cases {
        let exact = oracle::friction(&parameters, rates, &load, &times, 0.01);
        let found = parameters.curve(laws, &load, &times)?;
        let difference = largest(&exact, &found);
        println!("{laws:?}: {difference:e}");
        assert!(difference < 1e-9, "{laws:?}: {difference:e}");
    }
    Ok(())
}
