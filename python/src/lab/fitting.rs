//! Fits of records.

use std::collections::BTreeMap;

use pyo3::prelude::*;
use pyo3::types::PyDict;
use stickslip::lab::Experiment;

use super::fit_result::FitResult;
use super::given::{Given, Measured};
use super::joint_result::JointFitResult;
use super::names::{Names, refused};
use super::options::Options;
use super::watch::Watch;

/// Fits rate- and state-dependent friction to a record of velocity steps and holds. No guess is needed.
///
///     mu = mu0 + a ln(V/V0) + sum b_i ln(V0 theta_i/L_i),    dmu/dt = k (V_lp - V)
///
/// Args:
///     t: times [s], ascending; None with steps_at.
///     mu: measured coefficient of friction, one per time.
///     load: pairs (time [s], velocity of the load point [m/s] from then on), 0 in a hold; the first time is ignored.
///     displacement: measured displacement of the load point [m], one per time, in the place of load.
///     resolution: of the displacement gauge [m]: the velocities between samples that meet all displacements to within
///         it; by default the least-squares polygon with as few corners as the noise of the displacement defends.
///     steps_at: pairs (displacement [m], velocity of the load point [m/s] from there on), with displacement and t=None where no
///         time was recorded: the times are those of the velocities; the first displacement is ignored.
///     law: "aging", "slip", "perrin-rice-zheng", "kato-tullis" or "nagata", or a list with one per state.
///     states: 1 or 2.
///     k: K/normal stress [1/m], the stiffness of machine and sample over the normal stress; fitted if it is None.
///     stiffness, normal_stress: K [Pa/m] and [Pa], both, in the place of k.
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
///     KeyboardInterrupt: after Ctrl-C. Its attribute partial is the FitResult of the best parameters so far, with interrupted
///         set; None before there are any.
#[pyfunction]
#[pyo3(signature = (t, mu, *, load=None, displacement=None, resolution=None, steps_at=None, law=Names::One("aging".to_owned()),
                    states=1, k=None, stiffness=None, normal_stress=None, window=None, trend=None, weights=None,
                    free_initial_state=false, loss="squares".to_owned(), step_offset=false, V0=None, free=vec![],
                    fixed=BTreeMap::new(), bounds=BTreeMap::new(), guess=BTreeMap::new()),
       text_signature = "(t, mu, *, load=None, displacement=None, resolution=None, steps_at=None, law='aging', states=1, k=None, stiffness=None, normal_stress=None, window=None, trend=None, weights=None, free_initial_state=False, loss='squares', step_offset=False, V0=None, free=[], fixed={}, bounds={}, guess={})")]
#[expect(non_snake_case, reason = "names of the field")]
#[expect(clippy::too_many_arguments, reason = "keywords in Python")]
pub(crate) fn fit(
    py: Python<'_>,
    t: Option<Vec<f64>>,
    mu: Vec<f64>,
    load: Option<Vec<(f64, f64)>>,
    displacement: Option<Vec<f64>>,
    resolution: Option<f64>,
    steps_at: Option<Vec<(f64, f64)>>,
    law: Names,
    states: usize,
    k: Option<f64>,
    stiffness: Option<f64>,
    normal_stress: Option<f64>,
    window: Option<(f64, f64)>,
    trend: Option<String>,
    weights: Option<Vec<f64>>,
    free_initial_state: bool,
    loss: String,
    step_offset: bool,
    V0: Option<f64>,
    free: Vec<String>,
    fixed: BTreeMap<String, f64>,
    bounds: BTreeMap<String, (f64, f64)>,
    guess: BTreeMap<String, f64>,
) -> PyResult<FitResult> {
    let options = Options {
        law,
        states,
        trend,
        free_initial_state,
        loss,
        step_offset,
        reference_velocity: V0,
        free,
        fixed,
        bounds,
        guess,
    };
    let given = Given {
        t,
        mu,
        load,
        displacement,
        resolution,
        steps_at,
        k,
        stiffness,
        normal_stress,
        window,
        weights,
    };
    let Measured { record, load, k } = given.read(py)?;
    let mut fit = options.fit(py, k.is_some())?;
    if let Some(k) = k {
        fit = fit.with_stiffness(k);
    }
    Watch::new().run(
        py,
        |ends| fit.clone().with_interrupt(ends).run(&record, &load),
        |fitted| FitResult::of(py, &record, &refused(py, fitted)?),
    )
}

/// Fits several records at once: they share a, b and L of each state and the parameters of state laws. Each has its own
/// stiffness, mu0, trend, step offset and beginning, and counts by its noise.
///
/// Args:
///     records: dicts with the arguments t, mu, load, displacement, resolution, steps_at, k, stiffness, normal_stress, window
///         and weights of fit: {"t": t, "mu": mu, "load": load}.
///     law, states, trend, free_initial_state, loss, step_offset, V0, free, fixed, bounds, guess: as of fit; those of a
///         parameter that each record has are for each. V0 is by default the first velocity of the first record.
///
/// Returns:
///     JointFitResult: shared parameters, those of records, standard errors, correlations; print it.
///
/// Raises:
///     FitError, KeyboardInterrupt: as fit does; partial is a JointFitResult.
#[pyfunction]
#[pyo3(signature = (records, *, law=Names::One("aging".to_owned()),
                    states=1, trend=None,
                    free_initial_state=false, loss="squares".to_owned(), step_offset=false, V0=None, free=vec![],
                    fixed=BTreeMap::new(), bounds=BTreeMap::new(), guess=BTreeMap::new()),
       text_signature = "(records, *, law='aging', states=1, trend=None, free_initial_state=False, loss='squares', step_offset=False, V0=None, free=[], fixed={}, bounds={}, guess={})")]
#[expect(non_snake_case, reason = "names of the field")]
#[expect(clippy::too_many_arguments, reason = "keywords in Python")]
pub(crate) fn joint_fit(
    py: Python<'_>,
    records: Vec<Bound<'_, PyDict>>,
    law: Names,
    states: usize,
    trend: Option<String>,
    free_initial_state: bool,
    loss: String,
    step_offset: bool,
    V0: Option<f64>,
    free: Vec<String>,
    fixed: BTreeMap<String, f64>,
    bounds: BTreeMap<String, (f64, f64)>,
    guess: BTreeMap<String, f64>,
) -> PyResult<JointFitResult> {
    let options = Options {
        law,
        states,
        trend,
        free_initial_state,
        loss,
        step_offset,
        reference_velocity: V0,
        free,
        fixed,
        bounds,
        guess,
    };
    let read = |record: &Bound<'_, PyDict>| Given::by_name(record)?.read(py);
    let measured: Vec<Measured> = records.iter().map(read).collect::<PyResult<_>>()?;
    let stiff = measured.iter().any(|measured| measured.k.is_some());
    let fit = options.fit(py, stiff)?;
    let experiments = measured.iter().map(|measured| {
        let experiment = Experiment::new(&measured.record, &measured.load);
        match measured.k {
            Some(k) => experiment.with_stiffness(k),
            None => experiment,
        }
    });
    let experiments: Vec<_> = experiments.collect();
    Watch::new().run(
        py,
        |ends| fit.clone().with_interrupt(ends).run_joint(&experiments),
        |fitted| {
            let fitted = refused(py, fitted)?;
            let records = measured.iter().map(|measured| &measured.record);
            JointFitResult::of(py, records, &fitted)
        },
    )
}
