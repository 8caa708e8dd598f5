//! Steady levels alone, as a model to compare with.

use nalgebra::{DMatrix, DVector};

use crate::model::Model;
use crate::parameter::Parameter;
use crate::part::Part;

/// Akaike's information criterion of the levels `mu0 + (a - b) ln(V_lp/V0)`, with the trend of the model; `None` with
/// holds, which have no level. Of several records each has its own.
pub(crate) fn aic(model: &Model<'_>) -> Option<f64> {
    model.parts.iter().map(of_record).sum()
}

fn of_record(part: &Part<'_>) -> Option<f64> {
    let record = part.record;
    let v0 = part.fixed.parameters.reference_velocity;
    // A sample at a velocity step has the level before.
    let velocity = |time: f64| part.load.velocity_before(time);
    let (first, last) = (*record.times().first()?, *record.times().last()?);
    let reversed = || record.times().iter().any(|&time| velocity(time) <= 0.0);
    if part.load.has_hold(first, last) || reversed() {
        return None;
    }
    let with_trend = part.free.contains(&Parameter::Trend);
    let columns = if with_trend { 3 } else { 2 };
    let root = |n: usize| record.weights()[n].sqrt();
    let matrix = DMatrix::from_fn(record.times().len(), columns, |n, column| {
        root(n)
            * match column {
                0 => 1.0,
                1 => (velocity(record.times()[n]) / v0).ln(),
                _ => part.trend[n],
            }
    });
    let data = DVector::from_fn(record.times().len(), |n, _| root(n) * record.friction()[n]);
    let solution = matrix
        .clone()
        .svd(true, true)
        .solve(&data, f64::EPSILON)
        .ok()?;
    let squares = (&matrix * solution - data).norm_squared();
    let samples = record.weighted() as f64;
    Some(samples * (squares / samples).ln() + 2.0 * (columns as f64 + 1.0))
}
