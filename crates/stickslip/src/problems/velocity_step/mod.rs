//! A velocity step: friction against the displacement of the load point, and the estimation of its parameters.

mod fit;
mod least_squares;

pub use fit::{FitError, VelocityStepFit};

use nalgebra::SMatrix;
use stickslip_friction::{DieterichRuina, FrictionLaw};
use stickslip_state::{LogTheta, StateLaw};

use super::spring_slider::{LoadPath, SpringSlider, steady_state};
use crate::contact::check::{finite, require};
use crate::{RungeKutta, Steps};

/// The local error of a step in `ln V` and in the state.
const TOLERANCE: f64 = 1e-10;
/// The maximum number of steps, beside one per displacement: more indicate a slip instability.
const MAX_STEPS: usize = 10_000;

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
/// # Ok::<(), stickslip::problems::velocity_step::FitError>(())
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
    /// [`FitError::Scene`] for parameters out of range; [`FitError::Run`] for a slip instability on too soft a spring.
    pub fn curve<S: StateLaw<State = LogTheta> + 'static>(
        &self,
        friction: &DieterichRuina,
        state_law: impl Fn(&DieterichRuina) -> S,
        displacements: impl IntoIterator<Item = f64>,
    ) -> Result<Vec<(f64, f64)>, FitError> {
        let mut curve: Vec<_> = displacements.into_iter().map(|x| (x, 0.0)).collect();
        for (position, &(x, _)) in curve.iter().enumerate() {
            finite("displacement", position, x)?;
        }
        let mut ascending: Vec<usize> = (0..curve.len()).collect();
        ascending.sort_by(|&i, &j| curve[i].0.total_cmp(&curve[j].0));
        let law = state_law(friction);
        let steady = friction.coefficient(self.before, steady_state(&law, self.before)?);
        let mut block = self.block(friction, law)?;
        let mut steps_left = curve.len() + MAX_STEPS;
        for k in ascending {
            let (x, coefficient) = &mut curve[k];
            *coefficient = if *x > 0.0 {
                let steps = Steps::adaptive(TOLERANCE).with_max_steps(steps_left);
                let report = block.run(&steps.until(*x / self.after), |_| ())?;
                steps_left = steps_left.saturating_sub(report.accepted + report.rejected);
                block.snapshot().contact(0).coefficient(0)
            } else {
                steady
            };
        }
        Ok(curve)
    }

    /// The block at the step, at time 0.
    fn block<S: StateLaw<State = LogTheta> + 'static>(
        &self,
        friction: &DieterichRuina,
        law: S,
    ) -> Result<RungeKutta<SMatrix<f64, 1, 1>, 1>, FitError> {
        let &Self {
            stiffness,
            normal_stress,
            before,
            after,
        } = self;
        for (what, value) in [
            ("normal stress", normal_stress),
            ("velocity before the step", before),
            ("velocity after the step", after),
        ] {
            let legal = value > 0.0 && value.is_finite();
            require(what, "finite and positive", 0, value, legal)?;
        }
        let slider = SpringSlider {
            stiffness,
            normal_stress,
            mass: 0.0,
            damping: 0.0,
            load: LoadPath::steady(after),
        };
        Ok(RungeKutta::new(slider.steady(*friction, law, before)?)?)
    }
}
