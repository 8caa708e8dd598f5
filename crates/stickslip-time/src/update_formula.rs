//! The update formula of a step for one component of one vertex: weights.

use std::ops::{Add, Mul};

/// Displacement \[m\], velocity [m/s] and acceleration [m/s^2] of one component at one time.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Motion {
    /// `u` \[m\].
    pub displacement: f64,
    /// `v` [m/s].
    pub velocity: f64,
    /// `a` [m/s^2].
    pub acceleration: f64,
    /// The algorithmic variable of the scheme besides the motion; 0 for most.
    pub algorithmic: f64,
}

/// The weights of the old motion and of the new velocity in one quantity at the new time.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Weights {
    /// The weight of the old displacement.
    pub displacement: f64,
    /// The weight of the old velocity.
    pub velocity: f64,
    /// The weight of the old acceleration.
    pub acceleration: f64,
    /// The weight of the algorithmic variable.
    pub algorithmic: f64,
    /// The weight of the new velocity.
    pub new_velocity: f64,
}

impl Weights {
    /// Zero weights.
    pub const ZERO: Self = Self {
        displacement: 0.0,
        velocity: 0.0,
        acceleration: 0.0,
        algorithmic: 0.0,
        new_velocity: 0.0,
    };

    /// The old displacement.
    pub const STAY: Self = Self {
        displacement: 1.0,
        ..Self::ZERO
    };

    /// The contribution of the old motion.
    #[inline]
    pub fn of_old(&self, from: Motion) -> f64 {
        self.displacement * from.displacement
            + self.velocity * from.velocity
            + self.acceleration * from.acceleration
            + self.algorithmic * from.algorithmic
    }

    /// The quantity at the new time, with the velocity `v` there.
    #[inline]
    pub fn of(&self, from: Motion, v: f64) -> f64 {
        self.of_old(from) + self.new_velocity * v
    }

    /// The weights without the inertial terms.
    pub(crate) fn without_inertia(self) -> Self {
        Self {
            acceleration: 0.0,
            algorithmic: 0.0,
            ..self
        }
    }
}

impl Add for Weights {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            displacement: self.displacement + other.displacement,
            velocity: self.velocity + other.velocity,
            acceleration: self.acceleration + other.acceleration,
            algorithmic: self.algorithmic + other.algorithmic,
            new_velocity: self.new_velocity + other.new_velocity,
        }
    }
}

impl Mul<f64> for Weights {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self {
            displacement: self.displacement * factor,
            velocity: self.velocity * factor,
            acceleration: self.acceleration * factor,
            algorithmic: self.algorithmic * factor,
            new_velocity: self.new_velocity * factor,
        }
    }
}

/// One step of a scheme, for a given length: `u = c_u v + u^`, `a = c_a v + a^`, with `u^` and `a^` of the
/// old motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UpdateFormula {
    /// `u`; the weight of the new velocity, `c_u` \[s\], is the factor of the stiffness matrix, 0 in an
    /// explicit scheme.
    pub displacement: Weights,
    /// `a`; the weight of the new velocity, `c_a` [1/s], is the factor of the mass matrix, 0 without
    /// inertia.
    pub acceleration: Weights,
    /// The algorithmic variable besides the motion, a number per component; [`Weights::ZERO`] for none.
    pub algorithmic: Weights,
    /// `u` for a prescribed velocity. A scheme with an acceleration from before a jump of the data would move too far
    /// there, and the excess would remain forever. The mean velocity of both ends has no excess.
    pub prescribed: Weights,
}

impl UpdateFormula {
    /// `u = u_o + dt (v_o + v)/2`, for [`prescribed`](Self::prescribed).
    pub fn mean_velocity(dt: f64) -> Weights {
        Weights {
            velocity: 0.5 * dt,
            new_velocity: 0.5 * dt,
            ..Weights::STAY
        }
    }

    /// Whether the displacement is `u = u_o + c_u v`, by the new velocity alone.
    pub fn is_implicit_euler(&self) -> bool {
        let new_velocity = self.displacement.new_velocity;
        let implicit = Weights {
            new_velocity,
            ..Weights::STAY
        };
        new_velocity > 0.0 && self.displacement == implicit
    }

    /// The motion at the new time for the velocity `v` [m/s].
    #[inline]
    pub fn motion(&self, from: Motion, v: f64) -> Motion {
        Motion {
            displacement: self.displacement.of(from, v),
            velocity: v,
            acceleration: self.acceleration.of(from, v),
            algorithmic: self.algorithmic.of(from, v),
        }
    }
}
