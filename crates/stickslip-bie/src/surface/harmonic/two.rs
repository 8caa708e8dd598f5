//! Numbers of both ends of an edge, which a processor computes at once.

use std::ops::{Add, Mul, Neg, Sub};

/// A number for each end.
#[derive(Clone, Copy)]
pub(super) struct Two(pub(super) [f64; 2]);

impl Two {
    #[inline(always)]
    pub(super) fn both(value: f64) -> Self {
        Self([value; 2])
    }

    #[inline(always)]
    pub(super) fn recip(self) -> Self {
        Self(self.0.map(|x| 1.0 / x))
    }

    #[inline(always)]
    pub(super) fn sqrt(self) -> Self {
        Self(self.0.map(f64::sqrt))
    }

    #[inline(always)]
    pub(super) fn map(self, function: impl Fn(f64) -> f64) -> Self {
        Self(self.0.map(function))
    }

    #[inline(always)]
    pub(super) fn squared(self) -> Self {
        self * self
    }

    /// This if `choice` is not negative, else the other.
    #[inline(always)]
    pub(super) fn or(self, other: Self, choice: Self) -> Self {
        Self([0, 1].map(|n| {
            if choice.0[n] < 0.0 {
                other.0[n]
            } else {
                self.0[n]
            }
        }))
    }

    /// The first less the second.
    #[inline(always)]
    pub(super) fn drop(self) -> f64 {
        self.0[0] - self.0[1]
    }
}

impl Add for Two {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self([self.0[0] + other.0[0], self.0[1] + other.0[1]])
    }
}

impl Sub for Two {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self([self.0[0] - other.0[0], self.0[1] - other.0[1]])
    }
}

impl Mul for Two {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self([self.0[0] * other.0[0], self.0[1] * other.0[1]])
    }
}

impl Mul<Two> for f64 {
    type Output = Two;
    #[inline(always)]
    fn mul(self, other: Two) -> Two {
        Two([self * other.0[0], self * other.0[1]])
    }
}

impl Neg for Two {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self([-self.0[0], -self.0[1]])
    }
}
