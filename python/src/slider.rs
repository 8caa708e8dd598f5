//! A block on a spring.

mod start;

use std::ops::ControlFlow;
use std::sync::{Mutex, PoisonError};

use pyo3::prelude::*;
use pyo3::types::PyString;
use stickslip::problems::spring_slider::SpringSlider as Slider;
use stickslip::{Snapshot, Steps};

use crate::arguments::{Load, Numbers, count, named, non_negative, positive, sample_times};
use crate::errors::{self, argument};
use crate::exit::Call;
use crate::fields::AnyField;
use crate::laws::{Evolution, Friction, Further, given, parameters};
use crate::plain::{Reduced, html, reduced, text};
use crate::progress::Progress;
use crate::raised::Raised;
use crate::restart::{restore, state_bytes};
use crate::run::{Course, Ended, run};
use crate::slider_run::{Samples, SliderRun};

/// A block of 1 m^2 on a spring, by rate- and state-dependent friction:
///
///     mass u'' + damping u' + tau(V, theta) = stiffness (x(t) - u),    V = u',    x' the load velocity
///
/// Args:
///     stiffness: of the spring, per area [Pa/m], > 0.
///     normal_stress: [Pa], >= 0.
///     a: coefficient of the direct effect, > 0.
///     b: coefficient of the evolution effect, >= 0.
///     Dc: characteristic slip distance [m], > 0.
///     mu0: coefficient of friction at V0 in steady sliding.
///     V0: reference velocity [m/s], > 0.
///     friction: "cut-off", mu = max(0, mu0 + a ln(V/V0) + b ln(V0 theta/Dc)), or "regularized", by asinh; or a law
///         of your own: a CompiledFriction, or an object with the methods coefficient(V, theta), slope(V, theta) and
///         potential(V, theta), its derivative and its integral in V. Their contract is checked at once. Methods of Python
///         take about a microsecond a call: hundreds of times as long as compiled functions.
///     law: "aging", theta' = 1 - V theta/Dc, or "slip", theta' = -(V theta/Dc) ln(V theta/Dc), or "perrin-rice-zheng",
///         theta' = 1 - (V theta/2 Dc)^2 and 2 Dc in friction, or "kato-tullis", theta' = exp(-V/Vc) - (V theta/Dc) ln(V theta/Dc), or "sato",
///         theta' = exp(-W/0.01) - W ln W with W = V theta/Dc, or "nagata",
///         theta' = 1 - V theta/Dc - (c/b) theta mu', with friction "cut-off"; or a law of your own: a CompiledState, or an
///         object with the methods rate(theta, V) and slope(theta, V), its derivative in theta.
///     damping: [Pa s/m], such as radiation damping G/(2 cs).
///     mass: per area [kg/m^2]; 0 is quasi-static or quasi-dynamic.
///     load: velocity of the load point [m/s], or pairs (time [s], velocity [m/s] from then on), the first at time 0.
///     V: slip rate at time 0 [m/s]; by default that of the load.
///     theta: state at time 0 [s]; by default that of steady sliding at the velocity of the load.
///     Vc: slip rate up to which contacts age [m/s], > 0, of law="kato-tullis".
///     c: weight of the stress rate, > 0, of law="nagata".
///     fields: ThermalPressurization or ShearHeating of the surface of the block. Their pore pressure lowers the normal stress.
///
/// Raises:
///     ValueError: for a value out of its range; the message names the argument.
#[pyclass(frozen, module = "stickslip")]
#[expect(non_snake_case, reason = "names of the field")]
pub(crate) struct SpringSlider {
    slider: Slider,
    laws: (Friction, Evolution),
    #[pyo3(get)]
    stiffness: f64,
    #[pyo3(get)]
    normal_stress: f64,
    #[pyo3(get)]
    a: Option<f64>,
    #[pyo3(get)]
    b: Option<f64>,
    #[pyo3(get)]
    Dc: Option<f64>,
    #[pyo3(get)]
    mu0: f64,
    #[pyo3(get)]
    V0: f64,
    #[pyo3(get)]
    friction: Py<PyAny>,
    #[pyo3(get)]
    law: Py<PyAny>,
    #[pyo3(get)]
    damping: f64,
    #[pyo3(get)]
    mass: f64,
    #[pyo3(get)]
    load: Load,
    #[pyo3(get)]
    V: f64,
    #[pyo3(get)]
    theta: Option<f64>,
    #[pyo3(get)]
    Vc: Option<f64>,
    #[pyo3(get)]
    c: Option<f64>,
    #[pyo3(get)]
    fields: Vec<AnyField>,
}

#[pymethods]
impl SpringSlider {
    #[new]
    #[pyo3(signature = (stiffness, normal_stress, *, a=None, b=None, Dc=None, mu0=0.6, V0=1e-6, friction=None, law=None,
                        damping=0.0, mass=0.0, load=Load::Steady(1e-6), V=None, theta=None, Vc=None, c=None, fields=Vec::new()),
           text_signature = "(stiffness, normal_stress, *, a=None, b=None, Dc=None, mu0=0.6, V0=1e-6, friction='cut-off', law='aging', damping=0.0, mass=0.0, load=1e-06, V=None, theta=None, Vc=None, c=None, fields=[])")]
    #[expect(non_snake_case, reason = "names of the field")]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn new(
        py: Python<'_>,
        #[pyo3(from_py_with = named)] stiffness: f64,
        #[pyo3(from_py_with = named)] normal_stress: f64,
        #[pyo3(from_py_with = named)] a: Option<f64>,
        #[pyo3(from_py_with = named)] b: Option<f64>,
        #[pyo3(from_py_with = named)] Dc: Option<f64>,
        #[pyo3(from_py_with = named)] mu0: f64,
        #[pyo3(from_py_with = named)] V0: f64,
        friction: Option<&Bound<'_, PyAny>>,
        law: Option<&Bound<'_, PyAny>>,
        #[pyo3(from_py_with = named)] damping: f64,
        #[pyo3(from_py_with = named)] mass: f64,
        #[pyo3(from_py_with = named)] load: Load,
        #[pyo3(from_py_with = named)] V: Option<f64>,
        #[pyo3(from_py_with = named)] theta: Option<f64>,
        #[pyo3(from_py_with = named)] Vc: Option<f64>,
        #[pyo3(from_py_with = named)] c: Option<f64>,
        #[pyo3(from_py_with = named)] fields: Vec<AnyField>,
    ) -> PyResult<Self> {
        let _call = Call::begin()?;
        let parameters = || {
            let fitted = [given("a", a)?, given("b", b)?, given("Dc", Dc)?];
            parameters(fitted, [mu0, V0])
        };
        let slider = Slider {
            stiffness: positive("stiffness", stiffness)?,
            normal_stress: non_negative("normal_stress", normal_stress)?,
            mass: non_negative("mass", mass)?,
            damping: non_negative("damping", damping)?,
            load: load.clone().path()?,
        };
        let by_name = |name: &str| PyString::new(py, name).into_any();
        let friction = friction.cloned().unwrap_or_else(|| by_name("cut-off"));
        let law = law.cloned().unwrap_or_else(|| by_name("aging"));
        let V = non_negative("V", V.unwrap_or_else(|| slider.load.velocity(0.0)))?;
        let further = Further {
            aging_velocity: Vc,
            stress_weight: c,
        };
        let evolution = Evolution::of(&law, parameters, further)?;
        let block = Self {
            laws: (
                evolution.friction(Friction::of(&friction, parameters)?)?,
                evolution,
            ),
            Vc,
            c,
            fields,
            slider,
            stiffness,
            normal_stress,
            a,
            b,
            Dc,
            mu0,
            V0,
            friction: friction.unbind(),
            law: law.unbind(),
            damping,
            mass,
            load,
            V,
            theta: theta.map(|theta| positive("theta", theta)).transpose()?,
        };
        block.stepper(py, &Raised::default())?;
        Ok(block)
    }

    /// The stiffness below which steady sliding without inertia and damping is unstable, (b - a) sigma_n/Dc [Pa/m].
    #[staticmethod]
    #[pyo3(signature = (normal_stress, *, a, b, Dc))]
    #[expect(non_snake_case, reason = "names of the field")]
    fn critical_stiffness(
        #[pyo3(from_py_with = named)] normal_stress: f64,
        #[pyo3(from_py_with = named)] a: f64,
        #[pyo3(from_py_with = named)] b: f64,
        #[pyo3(from_py_with = named)] Dc: f64,
    ) -> PyResult<f64> {
        let [normal_stress, b] = [
            non_negative("normal_stress", normal_stress)?,
            non_negative("b", b)?,
        ];
        Ok(Slider::critical_stiffness(
            normal_stress,
            positive("a", a)?,
            b,
            positive("Dc", Dc)?,
        ))
    }

    /// Slides from time 0, or from the end of another run, to `until` [s].
    ///
    /// Without mass by an explicit Runge-Kutta method of order 5, with mass by an implicit one of order 2. The interpreter's
    /// lock is free during the run; Ctrl-C ends it between two steps.
    ///
    /// Args:
    ///     until: end [s], after the start.
    ///     rtol: local error of a step in ln V and in the state, > 0.
    ///     max_steps: number of steps, accepted or not, after which the run fails.
    ///     t_eval: times [s] of the samples, in order, from the start to `until`; by default the ends of steps. Without mass
    ///         they lie inside of steps, which stay as they are, by a continuous extension of the method; with mass steps
    ///         end there.
    ///     start: the `state` of a run of a slider with the same arguments, which goes on with the same bits.
    ///     progress: whether a bar of tqdm, if it is installed, or a line shows the time reached.
    ///
    /// Returns:
    ///     SliderRun: arrays t, V, theta, mu, slip, shear_stress, pore_pressure and effective_normal_stress, one entry per
    ///         sample.
    ///
    /// Raises:
    ///     StepError: for a step that fails, such as a slip instability without mass and damping.
    #[pyo3(signature = (until, rtol=1e-6, max_steps=2_000_000, *, t_eval=None, start=None, progress=false))]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn run(
        &self,
        py: Python<'_>,
        #[pyo3(from_py_with = named)] until: f64,
        #[pyo3(from_py_with = named)] rtol: f64,
        #[pyo3(from_py_with = named)] max_steps: usize,
        #[pyo3(from_py_with = named)] t_eval: Option<Numbers>,
        #[pyo3(from_py_with = named)] start: Option<&[u8]>,
        #[pyo3(from_py_with = named)] progress: bool,
    ) -> PyResult<SliderRun> {
        let call = Call::begin()?;
        let raised = Raised::default();
        let mut stepper = self.stepper(py, &raised)?;
        let origin = stepper.snapshot().displacement[0][0];
        if let Some(bytes) = start {
            restore(py, "start", &mut *stepper, bytes)?;
        }
        let begin = stepper.snapshot().time;
        if !(until.is_finite() && until > begin) {
            let requirement = format!("finite and after the start at {begin} s");
            return Err(argument("until", &requirement, until));
        }
        let steps = Steps::adaptive(positive("rtol", rtol)?)
            .with_max_steps(count("max_steps", max_steps)?)
            .stopping_at(self.slider.load.kinks())
            .until(until);
        let times = sample_times(t_eval, [begin, until])?;
        let mut samples = Samples::new(origin, &stepper.snapshot());
        if times.is_none() {
            samples.add(&stepper.snapshot(), &self.laws.1);
        }
        // Times and steps are shown one after the other.
        let samples = Mutex::new(samples);
        let add = |at: &Snapshot<'_, 1>| {
            if let Ok(mut samples) = samples.lock() {
                samples.add(at, &self.laws.1);
            }
        };
        let mut progress = Progress::new(py, progress, [begin, until])?;
        let course = Course {
            steps: &steps,
            times: times.as_deref().unwrap_or_default(),
            progress: progress.as_mut(),
        };
        let report = run((py, &call, &raised), &mut *stepper, course, add, |at| {
            if times.is_none() {
                add(at);
            }
            Ok(ControlFlow::Continue(()))
        });
        let mut samples = samples.into_inner().unwrap_or_else(PoisonError::into_inner);
        if let Some(times) = times {
            samples.at(&times);
        }
        let state = state_bytes(py, &stepper.snapshot())?;
        let error = match report {
            Ok(report) => {
                let taken_back = report.rejected + report.failed;
                return SliderRun::of(py, samples, taken_back, state);
            }
            Err(Ended::Raised(error)) => error,
            Err(Ended::Failed(failure)) => errors::failure(py, &failure),
        };
        let partial = SliderRun::of(py, samples, 0, state)?;
        error.value(py).setattr("partial", partial)?;
        Err(error)
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        text("SpringSlider", &self.given(py)?)
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        html("SpringSlider", &self.given(py)?)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<Self>(py, self.given(py)?)
    }
}
