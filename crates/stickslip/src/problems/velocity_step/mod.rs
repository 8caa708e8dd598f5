//! A velocity step: friction against the displacement of the load point, and the estimation of its parameters.

mod fit;

pub use fit::VelocityStepFit;

use stickslip_friction::DieterichRuina;
use stickslip_lab::{BoxedLaw, Evolution, LabError, LoadHistory, Parameters};
use stickslip_state::{LogTheta, StateLaw};

/// A block in steady sliding whose load point changes its velocity at displacement 0.
///
/// It has neither inertia nor damping, so that the spring force measures friction:
///
/// ```text
/// mu(V, theta) = mu_before + (K / sigma_n) (x - slip),   x the displacement of the load point
/// ```
///
/// The state law is given as a function of the friction law, with which it shares the characteristic slip distance:
/// [`DieterichRuina::aging`], [`DieterichRuina::slip`], or one of the caller's own.
///
/// ```
/// use stickslip::friction::DieterichRuina;
/// use stickslip::problems::spring_slider::FRICTION;
/// use stickslip::problems::velocity_step::VelocityStep;
///
/// let step = VelocityStep { stiffness: 1e10, normal_stress: 5e6, before: 1e-6, after: 1e-5 };
/// let displacements = (-10..=190).map(|n| f64::from(n) * 1e-6);
/// let curve = step.curve(&FRICTION, DieterichRuina::slip, displacements)?;
/// // Steady before, and steady again in the end.
/// assert_eq!(curve[0].1, FRICTION.steady_coefficient(1e-6));
/// assert!((curve[200].1 - FRICTION.steady_coefficient(1e-5)).abs() < 1e-6);
///
/// let guess = DieterichRuina { a: 0.015, b: 0.02, slip_distance: 2e-5, ..FRICTION };
/// let fit = step.fit(&curve, &guess, DieterichRuina::slip)?;
/// assert!((fit.friction.slip_distance / FRICTION.slip_distance - 1.0).abs() < 1e-6);
/// # Ok::<(), stickslip::lab::LabError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VelocityStep {
    /// `K` of the machine and the sample, > 0 [Pa/m].
    pub stiffness: f64,
    /// `sigma_n` > 0 \[Pa\].
    pub normal_stress: f64,
    /// The velocity of the load point before the step, > 0 [m/s].
    pub before: f64,
    /// The velocity of the load point after it, > 0 [m/s].
    pub after: f64,
}

impl VelocityStep {
    /// The coefficient of friction at each displacement \[m\] of the load point: pairs of the displacement and the
    /// coefficient, in the given order.
    ///
    /// # Errors
    /// [`LabError::Value`] for parameters out of range; [`LabError::Unstable`] on too soft a spring.
    pub fn curve<S: StateLaw<State = LogTheta> + 'static>(
        &self,
        friction: &DieterichRuina,
        state_law: impl Fn(&DieterichRuina) -> S + Sync,
        displacements: impl IntoIterator<Item = f64>,
    ) -> Result<Vec<(f64, f64)>, LabError> {
        let mut curve: Vec<_> = displacements.into_iter().map(|x| (x, 0.0)).collect();
        for (position, &(x, _)) in curve.iter().enumerate() {
            LabError::check_finite("displacement", position, x)?;
        }
        let (stiffness, load) = self.machine()?;
        let mut ascending: Vec<usize> = (0..curve.len()).collect();
        ascending.sort_by(|&i, &j| curve[i].0.total_cmp(&curve[j].0));
        let times: Vec<f64> = ascending.iter().map(|&k| load.time(curve[k].0)).collect();
        let law = |friction: &DieterichRuina| -> BoxedLaw { Box::new(state_law(friction)) };
        let parameters = Parameters::one_state(friction, stiffness);
        let coefficients = parameters.curve(&[Evolution::Custom(&law)], &load, &times)?;
        for (k, coefficient) in ascending.into_iter().zip(coefficients) {
            curve[k].1 = coefficient;
        }
        Ok(curve)
    }

    /// `K/sigma_n` [1/m], and the load point with the step at time and displacement 0.
    fn machine(&self) -> Result<(f64, LoadHistory), LabError> {
        let &Self {
            stiffness,
            normal_stress,
            before,
            after,
        } = self;
        for (what, value) in [
            ("stiffness", stiffness),
            ("normal stress", normal_stress),
            ("velocity before the step", before),
            ("velocity after the step", after),
        ] {
            LabError::check_positive(what, 0, value)?;
        }
        let load = LoadHistory::new(before, &[(0.0, after)])?;
        Ok((stiffness / normal_stress, load))
    }
}
