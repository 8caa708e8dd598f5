//! State variables as types: a wrong pairing of laws does not compile.

use std::fmt::Debug;

/// A state variable: one number with a meaning, or nothing.
///
/// Implement it for a newtype around `f64`; `from_value` inverts `value`. If a friction law reads another variable than
/// the state law integrates, [`Reads`] converts.
pub trait StateVariable: Copy + Debug + PartialEq + Send + Sync + 'static {
    /// The number inside.
    fn value(self) -> f64;
    /// The variable with that number inside.
    fn from_value(value: f64) -> Self;

    /// The distance of two values on the scale of the state: by default the modulus of their difference.
    fn distance(self, other: Self) -> f64 {
        (self.value() - other.value()).abs()
    }
}

/// Marks that a friction law with this state works with a state law that integrates `T`.
///
/// Every variable reads itself. Implement it for a variable of your own and for each variable it can be read from.
/// Without an implementation a pairing of laws does not compile.
///
/// ```
/// use stickslip_state::{LogTheta, Reads, Theta};
///
/// let alpha = LogTheta::read(Theta(1.0));
/// assert_eq!((alpha, LogTheta::slope(Theta(2.0))), (LogTheta(0.0), 0.5));
/// ```
#[diagnostic::on_unimplemented(
    message = "a friction law that reads `{Self}` has no use for the state `{T}`",
    label = "the friction law reads `{Self}`, the state is `{T}`",
    note = "a contact has no state, `()`, until `.with_state(law, initial)` gives it one that the friction law reads",
    note = "`Reads` converts between variables: implement `Reads<{T}>` for `{Self}` if one is a function of the other"
)]
pub trait Reads<T>: StateVariable {
    /// The variable that corresponds to `state`.
    fn read(state: T) -> Self;

    /// The derivative of its value in that of `state`.
    fn slope(state: T) -> f64;
}

impl<T: StateVariable> Reads<T> for T {
    #[inline]
    fn read(state: T) -> T {
        state
    }

    #[inline]
    fn slope(_: T) -> f64 {
        1.0
    }
}

impl Reads<Theta> for LogTheta {
    fn read(state: Theta) -> Self {
        state.into()
    }

    /// `1/theta`.
    fn slope(Theta(theta): Theta) -> f64 {
        theta.recip()
    }
}

impl Reads<LogTheta> for Theta {
    fn read(state: LogTheta) -> Self {
        state.into()
    }

    /// `exp(alpha)`.
    fn slope(LogTheta(alpha): LogTheta) -> f64 {
        alpha.exp()
    }
}

/// The state `theta` itself \[s\], positive.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Theta(pub f64);

/// The logarithm of the state, `alpha = ln(theta / 1 s)`, any finite number.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct LogTheta(pub f64);

impl StateVariable for Theta {
    fn value(self) -> f64 {
        self.0
    }

    fn from_value(value: f64) -> Self {
        Self(value)
    }

    /// The relative distance, since friction reads the logarithm.
    fn distance(self, other: Self) -> f64 {
        if self == other {
            0.0
        } else {
            (self.0 - other.0).abs() / self.0.abs().max(other.0.abs())
        }
    }
}

impl StateVariable for LogTheta {
    fn value(self) -> f64 {
        self.0
    }

    fn from_value(value: f64) -> Self {
        Self(value)
    }
}

/// A variable with a shift of the logarithm of `theta`: for a state that changes by other causes than slip and time.
///
/// ```
/// use stickslip_state::{LogScale, LogTheta, Theta};
///
/// assert_eq!(LogTheta(1.0).shifted(0.5), LogTheta(1.5));
/// let Theta(doubled) = Theta(3.0).shifted(2f64.ln());
/// assert!((doubled - 6.0).abs() < 1e-15);
/// ```
pub trait LogScale: StateVariable {
    /// The state whose `ln theta` is larger by `by`.
    #[must_use]
    fn shifted(self, by: f64) -> Self;

    /// The derivative of the value of [`shifted`](Self::shifted) in that of the state.
    fn shift_slope(self, by: f64) -> f64;
}

impl LogScale for LogTheta {
    fn shifted(self, by: f64) -> Self {
        Self(self.0 + by)
    }

    /// The slope 1.
    fn shift_slope(self, _: f64) -> f64 {
        1.0
    }
}

impl LogScale for Theta {
    fn shifted(self, by: f64) -> Self {
        Self(self.0 * by.exp())
    }

    /// `exp(by)`.
    fn shift_slope(self, by: f64) -> f64 {
        by.exp()
    }
}

/// No state: the value is 0 and ignored.
impl StateVariable for () {
    fn value(self) -> f64 {
        0.0
    }

    fn from_value(_: f64) -> Self {}
}

/// The logarithm: NaN for a negative `theta`, negative infinity for 0.
impl From<Theta> for LogTheta {
    fn from(Theta(theta): Theta) -> Self {
        Self(theta.ln())
    }
}

/// The exponential: 0 for `alpha` below -745, infinite above 709.
impl From<LogTheta> for Theta {
    fn from(LogTheta(alpha): LogTheta) -> Self {
        Self(alpha.exp())
    }
}
