//! The optimum of a fit beside that of a plain least squares with an integration of its own.

use nalgebra::{DMatrix, DVector};
use stickslip_lab::{Evolution, Fit, LoadHistory, Parameters, Record};

use crate::{Noise, Outcome, STIFFNESS, one_state, oracle, sequence, times, two_states};

/// The values `a`, `b_i`, `L_i`, `mu0`.
fn values(parameters: &Parameters) -> Vec<f64> {
    let states = &parameters.states;
    let mut values = vec![parameters.a];
    values.extend(states.iter().map(|state| state.b));
    values.extend(states.iter().map(|state| state.slip_distance));
    values.push(parameters.reference_friction);
    values
}

fn with_values(parameters: &Parameters, values: &[f64]) -> Parameters {
    let mut found = parameters.clone();
    let n = found.states.len();
    found.a = values[0];
    for (i, state) in found.states.iter_mut().enumerate() {
        state.b = values[1 + i];
        state.slip_distance = values[1 + n + i];
    }
    found.reference_friction = values[1 + 2 * n];
    found
}

/// The method of Gauss and Newton from the truth on, with derivatives by central differences: the values of the optimum
/// and their standard errors.
fn optimum(
    truth: &Parameters,
    rates: &[oracle::Rate],
    load: &LoadHistory,
    record: &Record,
) -> Outcome<(Vec<f64>, Vec<f64>)> {
    let curve = |values: &[f64]| {
        let parameters = with_values(truth, values);
        DVector::from(oracle::friction(
            &parameters,
            rates,
            load,
            record.times(),
            0.05,
        ))
    };
    let data = DVector::from(record.friction().to_vec());
    let mut at = values(truth);
    let mut jacobian = DMatrix::zeros(data.len(), at.len());
    for round in 0..6 {
        let residual = curve(&at) - &data;
        // The last derivatives are close enough for the last steps.
        if round < 4 {
            for k in 0..at.len() {
                let h = 1e-4 * at[k].abs();
                let moved = |by: f64| {
                    let mut to = at.clone();
                    to[k] += by;
                    curve(&to)
                };
                jacobian.set_column(k, &((moved(h) - moved(-h)) / (2.0 * h)));
            }
        }
        // Columns of length one.
        let scale = DVector::from_fn(at.len(), |k, _| jacobian.column(k).norm());
        let scaled = DMatrix::from_fn(data.len(), at.len(), |n, k| jacobian[(n, k)] / scale[k]);
        let normal = scaled.tr_mul(&scaled).try_inverse().ok_or("singular")?;
        if round == 5 {
            let variance = residual.norm_squared() / (data.len() - at.len()) as f64;
            let errors = (0..at.len()).map(|k| (variance * normal[(k, k)]).sqrt() / scale[k]);
            return Ok((at, errors.collect()));
        }
        let step = normal * scaled.tr_mul(&residual);
        for k in 0..at.len() {
            at[k] -= step[k] / scale[k];
        }
    }
    Err("unreachable".into())
}

/// The step of the oracle leaves its curves with errors of 1e-9, those of the fit are as large.
#[test]
fn a_plain_least_squares_has_the_same_optimum() -> Outcome {
    let load = sequence()?;
    let cases: [(Parameters, &[Evolution<'_>], &[oracle::Rate]); 3] = [
        (one_state(), &[Evolution::Aging], &[oracle::aging]),
        (one_state(), &[Evolution::Slip], &[oracle::slip]),
        (
            two_states(),
            &[Evolution::Aging; 2],
            &[oracle::aging, oracle::aging],
        ),
    ];
    for (truth, laws, rates) in cases {
        let clean = truth.curve(laws, &load, &times())?;
        let record = Record::new(times(), Noise::new(11).added_to(&clean, 1e-3))?;
        let (exact, errors) = optimum(&truth, rates, &load, &record)?;
        let found = Fit::new(laws)
            .with_stiffness(STIFFNESS)
            .run(&record, &load)?;
        for (k, estimate) in found.estimates.iter().enumerate() {
            let relative = (estimate.value / exact[k] - 1.0).abs();
            assert!(relative < 1e-6, "{}: {relative:e}", estimate.parameter);
            let ratio = estimate.standard_error / errors[k];
            assert!(
                (ratio - 1.0).abs() < 1e-3,
                "{}: {ratio}",
                estimate.parameter
            );
        }
    }
    Ok(())
}
