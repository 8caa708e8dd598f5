//! Synthetic experiments on a quasi-static spring slider.

use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use stickslip::lab::{LoadHistory, Parameters};

use super::names::{Names, machine, refused};
use crate::arguments::count;
use crate::errors::argument;
use crate::laws::parameters;
use crate::memory::{SAMPLE, check_memory};

/// Times, friction, and the history of the load point.
type Curve<'py> = (
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<f64>>,
    Vec<(f64, f64)>,
);

fn curve<'py>(
    py: Python<'py>,
    load: LoadHistory,
    ([a, b, slip_distance], [mu0, v0]): ([f64; 3], [f64; 2]),
    (law, k, samples, pieces): (String, Option<f64>, usize, usize),
) -> PyResult<Curve<'py>> {
    let friction = parameters([a, b, slip_distance], [mu0, v0])?;
    let laws = Names::One(law).laws(1)?;
    let parameters = Parameters::one_state(
        &friction,
        k.ok_or_else(|| argument("k", "given, K/normal stress [1/m]", "None"))?,
    );
    check_memory("samples", &[pieces, count("samples", samples)?], SAMPLE)?;
    let times = load.samples(samples);
    let mu = refused(py, parameters.curve(&laws, &load, &times))?;
    let mut pieces = vec![(0.0, load.velocity(0.0))];
    for pair in times.windows(2) {
        let velocity = load.velocity(pair[0]);
        if pieces.last().is_some_and(|last| last.1 != velocity) {
            pieces.push((pair[0], velocity));
        }
    }
    Ok((times.into_pyarray(py), mu.into_pyarray(py), pieces))
}

/// Friction through velocity steps, from steady sliding at the first velocity.
///
/// Args:
///     velocities: of the load point [m/s], one after the other, > 0.
///     displacement: of the load point at each [m], > 0.
///     k: K/normal stress [1/m], the stiffness of machine and sample over the normal stress, above critical.
///     stiffness, normal_stress: K [Pa/m] and [Pa], both, in the place of k.
///     a, b, Dc, mu0, V0: as of SpringSlider.
///     law: "aging", "slip", "perrin-rice-zheng", "kato-tullis" or "nagata", with the published Vc = 1e-8 m/s and c = 2.
///     samples: number of samples at each velocity.
///
/// Returns:
///     (t, mu, load): arrays of times [s] and friction, and pairs (time, velocity) for fit.
#[pyfunction]
#[pyo3(signature = (velocities, displacement, *, k=None, a, b, Dc, mu0=0.6, V0=1e-6, law="aging".to_owned(), samples=200,
                    stiffness=None, normal_stress=None))]
#[expect(non_snake_case, reason = "names of the field")]
#[expect(clippy::too_many_arguments, reason = "keywords in Python")]
pub(crate) fn velocity_step<'py>(
    py: Python<'py>,
    velocities: Vec<f64>,
    displacement: f64,
    k: Option<f64>,
    a: f64,
    b: f64,
    Dc: f64,
    mu0: f64,
    V0: f64,
    law: String,
    samples: usize,
    stiffness: Option<f64>,
    normal_stress: Option<f64>,
) -> PyResult<Curve<'py>> {
    let load = refused(py, LoadHistory::velocity_steps(&velocities, displacement))?;
    let k = machine(k, stiffness, normal_stress)?;
    let numerics = (law, k, samples, velocities.len());
    curve(py, load, ([a, b, Dc], [mu0, V0]), numerics)
}

/// Friction through holds between slides at one velocity.
///
/// Args:
///     velocity: of the slides [m/s], > 0.
///     durations: of the holds [s], > 0.
///     displacement: of each slide [m], > 0.
///     k, stiffness, normal_stress, a, b, Dc, mu0, V0, law, samples: as of velocity_step.
///
/// Returns:
///     (t, mu, load): as of velocity_step.
#[pyfunction]
#[pyo3(signature = (velocity, durations, displacement, *, k=None, a, b, Dc, mu0=0.6, V0=1e-6, law="aging".to_owned(),
                    samples=200, stiffness=None, normal_stress=None))]
#[expect(non_snake_case, reason = "names of the field")]
#[expect(clippy::too_many_arguments, reason = "keywords in Python")]
pub(crate) fn slide_hold_slide<'py>(
    py: Python<'py>,
    velocity: f64,
    durations: Vec<f64>,
    displacement: f64,
    k: Option<f64>,
    a: f64,
    b: f64,
    Dc: f64,
    mu0: f64,
    V0: f64,
    law: String,
    samples: usize,
    stiffness: Option<f64>,
    normal_stress: Option<f64>,
) -> PyResult<Curve<'py>> {
    let load = LoadHistory::slide_hold_slide(velocity, &durations, displacement);
    curve(
        py,
        refused(py, load)?,
        ([a, b, Dc], [mu0, V0]),
        (
            law,
            machine(k, stiffness, normal_stress)?,
            samples,
            2 * durations.len() + 1,
        ),
    )
}
