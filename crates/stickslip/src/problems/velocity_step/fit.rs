//! Estimation of friction parameters from a measured velocity step.

use stickslip_friction::DieterichRuina;
use stickslip_lab::{BoxedLaw, Evolution, Fit, LabError, Parameter, Parameters, Record, Warning};
use stickslip_state::{LogTheta, StateLaw};

use super::VelocityStep;

/// The fitted parameters, in the order of the standard errors.
const PARAMETERS: [Parameter; 4] = [
    Parameter::A,
    Parameter::B(0),
    Parameter::SlipDistance(0),
    Parameter::ReferenceFriction,
];

/// The result of a fit.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct VelocityStepFit {
    /// Friction with the best-fit parameters; `b` may be negative.
    pub friction: DieterichRuina,
    /// The standard errors of `a`, `b` and `L` relative to each, and that of `mu0`: for independent errors of the data
    /// with equal variance. Infinite if the data do not depend on the parameter.
    pub standard_errors: [f64; 4],
    /// The standard deviation of the residuals: the root of the sum of squares over the number of points minus 4.
    pub deviation: f64,
    /// The number of attempted steps.
    pub steps: usize,
    /// Warnings of parameters that the data do not determine.
    pub warnings: Vec<Warning>,
}

impl VelocityStep {
    /// The least-squares estimate of `a`, `b`, `L` and `mu0` from `data`, pairs of the displacement of the load point
    /// \[m\] and the coefficient of friction.
    ///
    /// The stiffness and the reference velocity of `start` are fixed. The method of Levenberg and Marquardt varies `ln
    /// a`, `b`, `ln L` and `mu0` from there. The data require points before the step or long after it, which
    /// determine `mu0`, and enough points after the step to resolve its peak and its decay. The spring must be stiffer
    /// than critical at `start`, [`Parameters::critical_stiffness`]: near the critical stiffness the curves oscillate, and the
    /// sum of squares has many minima. Prefer an initial characteristic slip distance that is too large.
    ///
    /// [`Fit`] needs no start, and takes any number of steps and holds, two states, a free stiffness and a trend.
    ///
    /// # Errors
    /// [`LabError::Value`] for less than 5 points, for values that are not finite and for `a` or `L` that is not
    /// positive; [`LabError::NoVelocityStep`] if all points are before the step; [`LabError::Unstable`] on a spring that
    /// is softer than critical for `start`; [`LabError::NotConverged`].
    pub fn fit<S: StateLaw<State = LogTheta> + 'static>(
        &self,
        data: &[(f64, f64)],
        start: &DieterichRuina,
        state_law: impl Fn(&DieterichRuina) -> S + Sync,
    ) -> Result<VelocityStepFit, LabError> {
        let points = data.len();
        let enough = points > PARAMETERS.len();
        LabError::check("number of points", "at least 5", 0, points as f64, enough)?;
        for (position, &(x, mu)) in data.iter().enumerate() {
            LabError::check_finite("displacement", position, x)?;
            LabError::check_finite("friction coefficient", position, mu)?;
        }
        for (what, value) in [("a", start.a), ("slip distance", start.slip_distance)] {
            LabError::check(what, "positive", 0, value, value > 0.0)?;
        }
        LabError::check_finite("b", 0, start.b)?;
        let (stiffness, load) = self.machine()?;
        let mut sorted = data.to_vec();
        sorted.sort_by(|one, two| one.0.total_cmp(&two.0));
        let record = Record::new(
            sorted.iter().map(|&(x, _)| load.time(x)).collect(),
            sorted.iter().map(|&(_, mu)| mu).collect(),
        )?;
        let law = |friction: &DieterichRuina| -> BoxedLaw { Box::new(state_law(friction)) };
        let fitted = Fit::new(&[Evolution::Custom(&law)])
            .with_stiffness(stiffness)
            .with_guess(Parameters::one_state(start, stiffness))
            .run(&record, &load)?;
        let standard_errors = PARAMETERS.map(|parameter| {
            let error = fitted.standard_error(parameter);
            if parameter == Parameter::ReferenceFriction {
                error
            } else {
                error / fitted.value(parameter).abs()
            }
        });
        Ok(VelocityStepFit {
            friction: fitted.parameters.friction(0),
            standard_errors,
            deviation: fitted.deviation,
            steps: fitted.steps,
            warnings: fitted.warnings,
        })
    }
}
