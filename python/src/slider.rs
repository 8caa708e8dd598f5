//! A block on a spring.

use std::ops::ControlFlow;

use pyo3::prelude::*;
use stickslip::integrate::Stepper;
use stickslip::problems::spring_slider::{SpringSlider as Slider, steady_state};
use stickslip::state::{LogTheta, Theta};
use stickslip::{Point, RungeKutta, Sdirk2, Simulation, Steps};

use crate::arguments::{Load, count, non_negative, positive};
use crate::errors;
use crate::exit::Call;
use crate::laws::{Evolution, Friction, given, parameters};
use crate::raised::Raised;
use crate::run::{Ended, run};
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
///     law: "aging", theta' = 1 - V theta/Dc, or "slip", theta' = -(V theta/Dc) ln(V theta/Dc); or a law of your own: a
///         CompiledState, or an object with the methods rate(theta, V) and slope(theta, V), its derivative in theta.
///     damping: [Pa s/m], such as radiation damping G/(2 cs).
///     mass: per area [kg/m^2]; 0 is quasi-static or quasi-dynamic.
///     load: velocity of the load point [m/s], or pairs (time [s], velocity [m/s] from then on), the first at time 0.
///     V: slip rate at time 0 [m/s]; by default that of the load.
///     theta: state at time 0 [s]; by default that of steady sliding at the velocity of the load.
///
/// Raises:
///     ValueError: for a value out of its range; the message names the argument.
#[pyclass(frozen, module = "stickslip")]
pub(crate) struct SpringSlider {
    slider: Slider,
    friction: Friction,
    evolution: Evolution,
    slip_rate: f64,
    theta: Option<f64>,
}

#[pymethods]
impl SpringSlider {
    #[new]
    #[pyo3(signature = (stiffness, normal_stress, *, a=None, b=None, Dc=None, mu0=0.6, V0=1e-6, friction=None, law=None,
                        damping=0.0, mass=0.0, load=Load::Steady(1e-6), V=None, theta=None),
           text_signature = "(stiffness, normal_stress, *, a, b, Dc, mu0=0.6, V0=1e-6, friction='cut-off', law='aging', damping=0.0, mass=0.0, load=1e-06, V=None, theta=None)")]
    #[expect(non_snake_case, reason = "names of the field")]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn new(
        py: Python<'_>,
        stiffness: f64,
        normal_stress: f64,
        a: Option<f64>,
        b: Option<f64>,
        Dc: Option<f64>,
        mu0: f64,
        V0: f64,
        friction: Option<&Bound<'_, PyAny>>,
        law: Option<&Bound<'_, PyAny>>,
        damping: f64,
        mass: f64,
        load: Load,
        V: Option<f64>,
        theta: Option<f64>,
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
            load: load.path()?,
        };
        let block = Self {
            slip_rate: non_negative("V", V.unwrap_or_else(|| slider.load.velocity(0.0)))?,
            theta: theta.map(|theta| positive("theta", theta)).transpose()?,
            friction: match friction {
                Some(friction) => Friction::of(friction, parameters)?,
                None => Friction::named("cut-off", parameters()?)?,
            },
            evolution: match law {
                Some(law) => Evolution::of(law, parameters)?,
                None => Evolution::named("aging", &parameters()?)?,
            },
            slider,
        };
        block.stepper(py, &Raised::default())?;
        Ok(block)
    }

    /// The stiffness below which steady sliding without inertia and damping is unstable, (b - a) sigma_n/Dc [Pa/m].
    #[staticmethod]
    #[pyo3(signature = (normal_stress, *, a, b, Dc))]
    #[expect(non_snake_case, reason = "names of the field")]
    fn critical_stiffness(normal_stress: f64, a: f64, b: f64, Dc: f64) -> PyResult<f64> {
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

    /// Slides from time 0 to `until` [s].
    ///
    /// Without mass by an explicit Runge-Kutta method of order 5, with mass by an implicit one of order 2. Every call
    /// starts at time 0. The interpreter's lock is free during the run; Ctrl-C ends it between two steps.
    ///
    /// Args:
    ///     until: end [s], > 0.
    ///     rtol: local error of a step in ln V and in the state, > 0.
    ///     max_steps: number of steps, accepted or not, after which the run fails.
    ///
    /// Returns:
    ///     SliderRun: arrays t, V, theta, mu and slip, one entry per step.
    ///
    /// Raises:
    ///     StepError: for a step that fails, such as a slip instability without mass and damping.
    #[pyo3(signature = (until, rtol=1e-6, max_steps=2_000_000))]
    fn run(&self, py: Python<'_>, until: f64, rtol: f64, max_steps: usize) -> PyResult<SliderRun> {
        let steps = Steps::adaptive(positive("rtol", rtol)?)
            .with_max_steps(count("max_steps", max_steps)?)
            .stopping_at(self.slider.load.kinks())
            .until(positive("until", until)?);
        let call = Call::begin()?;
        let raised = Raised::default();
        let mut stepper = self.stepper(py, &raised)?;
        let mut samples = Samples::of(&stepper.snapshot());
        let report = run((py, &call, &raised), &mut *stepper, &steps, |at| {
            samples.add(at);
            Ok(ControlFlow::Continue(()))
        });
        let error = match report {
            Ok(report) => {
                let taken_back = report.rejected + report.failed;
                return Ok(SliderRun::new(py, samples, taken_back));
            }
            Err(Ended::Raised(error)) => error,
            Err(Ended::Failed(failure)) => errors::failure(py, &failure),
        };
        let partial = SliderRun::new(py, samples, 0);
        error.value(py).setattr("partial", partial)?;
        Err(error)
    }
}

impl SpringSlider {
    /// The block at time 0, with an explicit method if it has no mass.
    fn stepper(&self, py: Python<'_>, raised: &Raised) -> PyResult<Box<dyn Stepper<1>>> {
        let evolution = self.evolution.law(raised);
        let state = match self.theta {
            Some(theta) => LogTheta::from(Theta(theta)),
            None => steady_state(&evolution, self.slider.load.velocity(0.0))
                .map_err(|error| raised.take().unwrap_or_else(|| errors::state(py, &error)))?,
        };
        let made = || -> Result<Box<dyn Stepper<1>>, _> {
            let friction = self.friction.law(raised);
            let scene = self
                .slider
                .scene(friction, evolution, self.slip_rate, state)?;
            Ok(if self.slider.mass == 0.0 {
                Box::new(RungeKutta::new(scene)?)
            } else {
                Box::new(Simulation::new(scene, Sdirk2, Point)?)
            })
        };
        made().map_err(|error| raised.take().unwrap_or_else(|| errors::scene(py, &error)))
    }
}
