//! Sums of two numbers, with a significand of 106 bits.
//!
//! Source: T. J. Dekker, Numer. Math. 18 (1971), doi:10.1007/BF01397083.

use std::ops::{Add, Div, Mul, Sub};

#[derive(Clone, Copy, Debug)]
pub(super) struct Double(f64, f64);

impl Double {
    pub(super) fn value(self) -> f64 {
        self.0 + self.1
    }

    /// The exponential by Taylor's series to `x^30/30!` after a reduction by `ln 2`.
    pub(super) fn exp(self) -> Self {
        // The next parts of ln 2 after its double.
        let ln_2 = Self(std::f64::consts::LN_2, 2.319_046_813_846_299_6e-17);
        let n = (self.0 / ln_2.0).round();
        let r = self - ln_2 * Self::from(n);
        let mut sum = Self::from(1.0);
        for k in (1..=30).rev() {
            sum = Self::from(1.0) + sum * r / Self::from(f64::from(k));
        }
        // In two factors: the power itself may not be a number.
        let half = (0.5 * n).trunc();
        sum * Self::from(half.exp2()) * Self::from((n - half).exp2())
    }
}

impl From<f64> for Double {
    fn from(value: f64) -> Self {
        Self(value, 0.0)
    }
}

fn normal(high: f64, low: f64) -> Double {
    let sum = high + low;
    Double(sum, low - (sum - high))
}

impl Add for Double {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let sum = self.0 + other.0;
        let own = sum - other.0;
        let low = (self.0 - own) + (other.0 - (sum - own));
        normal(sum, low + (self.1 + other.1))
    }
}

impl Sub for Double {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + Self(-other.0, -other.1)
    }
}

impl Mul for Double {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let product = self.0 * other.0;
        let low = self.0.mul_add(other.0, -product);
        normal(product, low + (self.0 * other.1 + self.1 * other.0))
    }
}

impl Div for Double {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = Self::from(self.0 / other.0);
        let rest = self - first * other;
        let second = Self::from(rest.0 / other.0);
        let rest = rest - second * other;
        first + second + Self::from(rest.0 / other.0)
    }
}
