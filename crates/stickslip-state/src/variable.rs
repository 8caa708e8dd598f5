//! What a state law integrates, as types, so that a wrong pairing does not compile.

use std::fmt::Debug;

/// The unknown of a state law: one number with a meaning, or nothing.
///
/// Implement it for a newtype around `f64`; `from_value` inverts `value`. Where a friction law
/// reads another variable than the state law integrates, `From` converts.
pub trait StateVariable: Copy + Debug + PartialEq + Send + Sync + 'static {
    /// The number inside.
    fn value(self) -> f64;
    /// The variable with that number inside.
    fn from_value(value: f64) -> Self;

    /// How far two values are apart, on the scale on which the state matters: by default the modulus
    /// of their difference.
    fn distance(self, other: Self) -> f64 {
        (self.value() - other.value()).abs()
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

    /// Relative: friction reads the logarithm.
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

/// No state: the value is 0 and ignored.
impl StateVariable for () {
    fn value(self) -> f64 {
        0.0
    }

    fn from_value(_: f64) -> Self {}
}

/// Takes the logarithm: not a number for a negative `theta`, negative infinity for 0.
impl From<Theta> for LogTheta {
    fn from(Theta(theta): Theta) -> Self {
        Self(theta.ln())
    }
}

/// Takes the exponential: 0 for `alpha` below -745, infinite above 709.
impl From<LogTheta> for Theta {
    fn from(LogTheta(alpha): LogTheta) -> Self {
        Self(alpha.exp())
    }
}
