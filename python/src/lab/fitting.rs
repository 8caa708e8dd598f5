//! Fits of records.

use std::collections::BTreeMap;

use pyo3::prelude::*;
use stickslip::lab::{Fit, Loss, Parameter, Record, Trend};

use super::fit_result::FitResult;
use super::history::{Names, history, refused};
use crate::arguments::positive;
use crate::errors::argument;
use crate::exit::Call;

/// Fits rate- and state-dependent friction to a record of velocity steps and holds. No guess is needed.
///
///     mu = mu0 + a ln(V/V0) + sum b_i ln(V0 theta_i/L_i),    dmu/dt = k (V_lp - V)
///
/// Args:
///     t: times [s], ascending.
///     mu: measured coefficient of friction, one per time.
///     load: pairs (time [s], velocity of the load point [m/s] from then on), 0 in a hold; the first time is ignored.
///     displacement: measured displacement of the load point [m], one per time, in the place of load.
///     resolution: of the displacement gauge [m]: the velocities between samples that meet all displacements to within
///         it; by default the least-squares polygon with as few corners as the noise of the displacement defends.
///     law: "aging", "slip", "perrin-rice-zheng", "kato-tullis" or "nagata", or a list with one per state.
///     states: 1 or 2.
///     stiffness: k = K/normal stress [1/m]; fitted if it is None.
///     window: (from, to) [s]; it begins while the load point moves.
///     trend: None, "time" or "displacement": a linear trend is fitted, too.
///     weights: of the squares of residuals, one per time.
///     free_initial_state: whether stress and state at the first sample are fitted; else the block slides steadily there.
///     loss: of residuals: "squares", or "huber", which bounds the influence of spikes.
///     step_offset: whether the time [s] by which all velocity steps are later than load or displacement say is fitted, too.
///     V0: reference velocity [m/s]; by default the first velocity.
///     free: names of parameters of laws that are fitted, too: "Vc1", "Vc2" of kato-tullis, 1e-8 m/s else, and "c1", "c2" of
///         nagata, 2 else.
///     fixed: values of parameters by name: "a", "b1", "L1", "b2", "L2", "k", "mu0", "trend", "step_offset", "Vc1", "c1"; "b",
///         "L", "Vc" and "c" are the first.
///     bounds: pairs (low, high) of parameters by name.
///     guess: values of parameters by name to start from; the other starts are computed from the curve.
///
/// Returns:
///     FitResult: parameters, standard errors, correlations, curve, warnings; print it.
///
/// Raises:
///     FitError: for records that cannot be fitted, and fits without a minimum.
#[pyfunction]
#[pyo3(signature = (t, mu, *, load=None, displacement=None, resolution=None, law=Names::One("aging".to_owned()),
                    states=1, stiffness=None, window=None, trend=None, weights=None, free_initial_state=false,
                    loss="squares", step_offset=false, V0=None, free=vec![],
                    fixed=BTreeMap::new(), bounds=BTreeMap::new(), guess=BTreeMap::new()),
       text_signature = "(t, mu, *, load=None, displacement=None, resolution=None, law='aging', states=1, stiffness=None, window=None, trend=None, weights=None, free_initial_state=False, loss='squares', step_offset=False, V0=None, free=[], fixed={}, bounds={}, guess={})")]
#[expect(non_snake_case, reason = "names of the field")]
#[expect(clippy::too_many_arguments, reason = "keywords in Python")]
pub(crate) fn fit(
    py: Python<'_>,
    t: Vec<f64>,
    mu: Vec<f64>,
    load: Option<Vec<(f64, f64)>>,
    displacement: Option<Vec<f64>>,
    resolution: Option<f64>,
    law: Names,
    states: usize,
    stiffness: Option<f64>,
    window: Option<(f64, f64)>,
    trend: Option<&str>,
    weights: Option<Vec<f64>>,
    free_initial_state: bool,
    loss: &str,
    step_offset: bool,
    V0: Option<f64>,
    free: Vec<String>,
    fixed: BTreeMap<String, f64>,
    bounds: BTreeMap<String, (f64, f64)>,
    guess: BTreeMap<String, f64>,
) -> PyResult<FitResult> {
    let load = history(py, &t, load, displacement, resolution)?;
    let mut record = refused(py, Record::new(t, mu))?;
    if let Some(weights) = weights {
        record = refused(py, record.with_weights(weights))?;
    }
    if let Some((from, to)) = window {
        if from.is_nan() || to.is_nan() || from >= to {
            return Err(argument("window", "a pair (from, to) in order", (from, to)));
        }
        record = record.window(from, to);
    }
    let mut fit = Fit::new(&law.laws(states)?);
    let mut given = Vec::new();
    if let Some(stiffness) = stiffness {
        fit = fit.with_stiffness(positive("stiffness", stiffness)?);
        given.push(Parameter::Stiffness);
    }
    fit = match trend {
        None => fit,
        Some("time") => fit.with_trend(Trend::Time),
        Some("displacement") => fit.with_trend(Trend::Displacement),
        Some(other) => {
            let names = "None, \"time\" or \"displacement\"";
            return Err(argument("trend", names, other));
        }
    };
    if free_initial_state {
        fit = fit.with_free_initial_state();
    }
    fit = match loss {
        "squares" => fit,
        "huber" => fit.with_loss(Loss::Huber),
        other => return Err(argument("loss", "\"squares\" or \"huber\"", other)),
    };
    if step_offset {
        fit = fit.with_step_offset();
    }
    if let Some(velocity) = V0 {
        fit = fit.with_reference_velocity(velocity);
    }
    for name in &free {
        fit = fit.with_free(refused(py, name.parse::<Parameter>())?);
    }
    let mut parameter = |what: &'static str, name: &str| {
        let parameter = refused(py, name.parse::<Parameter>())?;
        if given.contains(&parameter) {
            let once = "a parameter that is given once: by stiffness, fixed or bounds";
            return Err(argument(what, once, name));
        }
        given.push(parameter);
        Ok(parameter)
    };
    for (name, value) in &fixed {
        fit = fit.with_fixed(parameter("fixed", name)?, *value);
    }
    for (name, (low, high)) in &bounds {
        fit = fit.with_bounds(parameter("bounds", name)?, *low, *high);
    }
    for (name, value) in &guess {
        fit = fit.with_guess_of(refused(py, name.parse::<Parameter>())?, *value);
    }
    let call = Call::begin()?;
    let fitted = call.detach(py, || fit.run(&record, &load));
    FitResult::of(py, &record, &refused(py, fitted)?)
}
