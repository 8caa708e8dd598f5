//! Numbers in messages.

use std::fmt;

/// A number as messages show it: in plain decimals where its modulus is 0 or from 1e-3 to 1e6, in scientific notation
/// beyond.
///
/// ```
/// use stickslip_state::Number;
///
/// let shown = [90.0, -0.5, 0.0, 1e-3, 5e7, 1e-9].map(|x| Number(x).to_string());
/// assert_eq!(shown, ["90", "-0.5", "0", "0.001", "5e7", "1e-9"]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Number(pub f64);

impl fmt::Display for Number {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(value) = self;
        if *value == 0.0 || (1e-3..1e6).contains(&value.abs()) {
            write!(formatter, "{value}")
        } else {
            write!(formatter, "{value:e}")
        }
    }
}
