//! The trait of all friction laws.

use stickslip_state::wright::omega;
use stickslip_state::{StateVariable, increasing_root};

use crate::{FrictionError, SlipRates, difference::slope_in_state};

/// A coefficient of friction and its derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Response {
    /// `mu`.
    pub coefficient: f64,
    /// `dmu/dV` \[s/m\].
    pub rate_slope: f64,
    /// `dmu/dalpha`, per unit of the value of the state.
    pub state_slope: f64,
}

/// A coefficient of friction `mu(V, alpha) >= 0`, non-decreasing in the slip rate `V >= 0`.
///
/// Implement the coefficient, its slope and its integral, all at fixed state, and [`validate`](Self::validate) if there
/// are parameters. Override [`slip_rate`](Self::slip_rate) if the local problem has a closed form,
/// [`coefficient_state_slope`](Self::coefficient_state_slope) if there is a state, and
/// [`coefficient_and_rate_slope`](Self::coefficient_and_rate_slope) and [`response`](Self::response) if they share
/// work.
///
/// At `V = 0` every function is its limit from the right: `mu(0) > 0` means that the contact can stick. For `V > 0` the
/// coefficient is continuous. Normal stress does not enter the law: the frictional force is `mu` times a nodal normal
/// force.
///
/// ```
/// use stickslip_friction::{FrictionError, FrictionLaw, check_friction_law};
///
/// /// mu = (V/V1)^n, 0 < n < 1: viscous sliding over a soft bed
/// struct PowerLaw {
///     rate_at_one: f64, // V1 [m/s]
///     exponent: f64,
/// }
///
/// impl FrictionLaw for PowerLaw {
///     type State = ();
///
///     fn coefficient(&self, slip_rate: f64, (): ()) -> f64 {
///         (slip_rate / self.rate_at_one).powf(self.exponent)
///     }
///
///     fn coefficient_rate_slope(&self, slip_rate: f64, (): ()) -> f64 {
///         self.exponent / self.rate_at_one
///             * (slip_rate / self.rate_at_one).powf(self.exponent - 1.0)
///     }
///
///     fn potential(&self, slip_rate: f64, (): ()) -> f64 {
///         slip_rate * self.coefficient(slip_rate, ()) / (1.0 + self.exponent)
///     }
///
///     fn validate(&self) -> Result<(), FrictionError> {
///         FrictionError::check_positive("rate_at_one", self.rate_at_one)?;
///         FrictionError::check_positive("exponent", self.exponent)
///     }
/// }
///
/// let law = PowerLaw { rate_at_one: 1e-6, exponent: 0.5 };
/// let rate = law.slip_rate(1e6, 2.0, ()); // 1e6 V + sqrt(1e6 V) = 2
/// assert!((rate - 1e-6).abs() < 1e-20);
///
/// check_friction_law(&law, &[()])?;
/// # Ok::<(), stickslip_friction::FrictionViolation>(())
/// ```
pub trait FrictionLaw: Send + Sync {
    /// The state variable of the law, `()` for none.
    type State: StateVariable;

    /// The coefficient of friction `mu(V, alpha)`.
    fn coefficient(&self, slip_rate: f64, state: Self::State) -> f64;

    /// `dmu/dV >= 0` \[s/m\]; infinite if it exceeds the floating point range.
    fn coefficient_rate_slope(&self, slip_rate: f64, state: Self::State) -> f64;

    /// The coefficient and its slope, evaluated together for a solver.
    ///
    /// The default calls both functions. Override it if they share costly work.
    fn coefficient_and_rate_slope(&self, slip_rate: f64, state: Self::State) -> (f64, f64) {
        (
            self.coefficient(slip_rate, state),
            self.coefficient_rate_slope(slip_rate, state),
        )
    }

    /// The coefficient and both of its slopes, evaluated together for a state that depends on the slip rate.
    ///
    /// The default calls [`coefficient_and_rate_slope`](Self::coefficient_and_rate_slope) and
    /// [`coefficient_state_slope`](Self::coefficient_state_slope). Override it if they share costly work.
    fn response(&self, slip_rate: f64, state: Self::State) -> Response {
        let (coefficient, rate_slope) = self.coefficient_and_rate_slope(slip_rate, state);
        Response {
            coefficient,
            rate_slope,
            state_slope: self.coefficient_state_slope(slip_rate, state),
        }
    }

    /// The integral of the coefficient over slip rates from 0 to `V` \[m/s\], convex in `V`.
    fn potential(&self, slip_rate: f64, state: Self::State) -> f64;

    /// `dmu/dalpha`, per unit of the value of the state, at fixed slip rate.
    ///
    /// The default is a central difference of the coefficient. Its relative error is about 1e-8, and larger by the size
    /// of the terms over the coefficient if that is a small difference of large terms. At a kink of the coefficient in
    /// the state, either of its slopes or a mean is accepted.
    fn coefficient_state_slope(&self, slip_rate: f64, state: Self::State) -> f64 {
        slope_in_state(state, |state| self.coefficient(slip_rate, state))
    }

    /// The local problem: the `V` with `viscosity V + mu(V, alpha) = drive`, 0 while it sticks.
    ///
    /// `viscosity > 0` \[s/m\] and `drive >= 0` are stiffness and force over the normal force. The default is a
    /// bracketed Newton method in `ln V`, from where friction that is linear in it would balance, and then two steps in
    /// `V`, which resolve the forces to some units in the last place; it is NaN if the coefficient is. An override must be as accurate as 1e-9 relative to `V`:
    /// [`Radial`](crate::Radial) brackets the vector problem with it.
    fn slip_rate(&self, viscosity: f64, drive: f64, state: Self::State) -> f64 {
        let strength = self.coefficient(0.0, state);
        if drive <= strength {
            return 0.0;
        }
        let bound = (drive - strength) / viscosity;
        if bound == 0.0 {
            return 0.0;
        }
        // To the rounding of the forces, which two steps in `V` resolve.
        let residual = |(rate, coefficient): (f64, f64)| {
            let missing = viscosity * rate + coefficient - drive;
            let resolved = missing.abs() <= f64::EPSILON * drive;
            if resolved { 0.0 } else { missing }
        };
        let start = first_guess(bound, [viscosity, drive], |rate| {
            self.coefficient_and_rate_slope(rate, state)
        });
        let log_rate = increasing_root(start, |log_rate| {
            let rate = log_rate.exp();
            let (coefficient, slope) = self.coefficient_and_rate_slope(rate, state);
            (residual((rate, coefficient)), rate * (viscosity + slope))
        });
        let mut rate = log_rate.map_or(f64::NAN, f64::exp);
        // The exponential of a rounded logarithm has fewer digits than the rate.
        let missing = |rate| {
            let (coefficient, slope) = self.coefficient_and_rate_slope(rate, state);
            (viscosity * rate + coefficient - drive, viscosity + slope)
        };
        let (mut remaining, mut stiffness) = missing(rate);
        for _ in 0..2 {
            let polished = rate - remaining / stiffness;
            if polished == rate {
                break;
            }
            let (less, next) = missing(polished);
            if !(polished > 0.0 && less.abs() < remaining.abs()) {
                break;
            }
            (rate, remaining, stiffness) = (polished, less, next);
        }
        rate
    }

    /// Passes over the local problems of many nodes, by the laws of the nodes, or by one law of all; `None` for a loop
    /// over [`slip_rate`](Self::slip_rate). Override it where several nodes can be computed per instruction.
    fn slip_rates(_laws: &[Self]) -> Option<Box<dyn SlipRates<Self::State>>>
    where
        Self: Sized,
    {
        None
    }

    /// Checks the parameters; called once, when a scene is built.
    ///
    /// # Errors
    ///
    /// A parameter outside the range of the law.
    fn validate(&self) -> Result<(), FrictionError> {
        Ok(())
    }
}

/// The logarithm of a slip rate near the balance, from one above it: with viscosity as it is, and friction linear in the
/// logarithm of the rate, as rate- and state-dependent friction nearly is.
///
/// ```text
/// viscosity V + mu + m ln(V/V1) = drive,   m = V1 dmu/dV;   w + ln(w) = ln(viscosity V1/m) + (drive - mu)/m,   V = w m/viscosity
/// ```
fn first_guess(
    bound: f64,
    [viscosity, drive]: [f64; 2],
    friction: impl Fn(f64) -> (f64, f64),
) -> f64 {
    let bound = bound.min(1e300);
    let (coefficient, slope) = friction(bound);
    let along = bound * slope;
    let rate = along * omega((viscosity * bound / along).ln() + (drive - coefficient) / along);
    let log_rate = (rate / viscosity).ln();
    if log_rate.is_finite() {
        log_rate
    } else {
        bound.ln()
    }
}

macro_rules! forward {
    ($pointer:ty) => {
        impl<T: FrictionLaw + ?Sized> FrictionLaw for $pointer {
            type State = T::State;

            fn coefficient(&self, slip_rate: f64, state: Self::State) -> f64 {
                (**self).coefficient(slip_rate, state)
            }

            fn coefficient_rate_slope(&self, slip_rate: f64, state: Self::State) -> f64 {
                (**self).coefficient_rate_slope(slip_rate, state)
            }

            fn coefficient_and_rate_slope(&self, slip_rate: f64, state: Self::State) -> (f64, f64) {
                (**self).coefficient_and_rate_slope(slip_rate, state)
            }

            fn response(&self, slip_rate: f64, state: Self::State) -> Response {
                (**self).response(slip_rate, state)
            }

            fn potential(&self, slip_rate: f64, state: Self::State) -> f64 {
                (**self).potential(slip_rate, state)
            }

            fn coefficient_state_slope(&self, slip_rate: f64, state: Self::State) -> f64 {
                (**self).coefficient_state_slope(slip_rate, state)
            }

            fn slip_rate(&self, viscosity: f64, drive: f64, state: Self::State) -> f64 {
                (**self).slip_rate(viscosity, drive, state)
            }

            fn validate(&self) -> Result<(), FrictionError> {
                (**self).validate()
            }
        }
    };
}

forward!(&T);
forward!(Box<T>);
