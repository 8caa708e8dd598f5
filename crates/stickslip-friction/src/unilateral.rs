//! Friction of a contact that can open: a bound of the normal velocity.

use nalgebra::{SMatrix, SVector};

use crate::{ConvexPotential, Interval, LocalModel};

/// The potential `phi(v) - p v_n + I(v_n <= b)` of a contact that can open, with the velocity `v_n = outward * v[axis]`
/// into the opposite side, a force `p` into it and the bound `b` at which the gap closes.
///
/// The normal reaction is `p` less the force that is left along the normal: 0 below the bound, positive on it
/// (Signorini's conditions). `phi` does not depend on the component `axis`. Its minimiser with a bound is that without
/// one, or, if that lies beyond, the one on the bound.
///
/// ```
/// use nalgebra::{SMatrix, SVector};
/// use stickslip_friction::{ConvexPotential, Radial, Sliding, Tresca, Unilateral};
///
/// let friction = Radial { law: Tresca { coefficient: 0.5 }, force: 2.0, state: () };
/// let sliding = Sliding { friction, slides: [true, false], prescribed: SVector::zeros() };
/// let contact = Unilateral { potential: sliding, axis: 1, outward: -1.0, bound: 0.0, pull: 0.0 };
/// let block = SMatrix::<f64, 2, 2>::new(4.0, 1.0, 1.0, 2.0);
/// // Pressed against a surface below, it slides; lifted, it moves off.
/// let pressed = contact.minimize(&block, &SVector::from([3.0, -2.0]));
/// assert_eq!(pressed, SVector::from([0.5, 0.0]));
/// let lifted = contact.minimize(&block, &SVector::from([3.0, 2.0]));
/// assert!(lifted[1] > 0.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unilateral<P, const C: usize> {
    /// `phi`.
    pub potential: P,
    /// The normal component.
    pub axis: usize,
    /// The outward normal along it, 1 or -1.
    pub outward: f64,
    /// `b` [m/s]; infinite without an opposite side.
    pub bound: f64,
    /// `p` \[N\].
    pub pull: f64,
}

impl<P, const C: usize> Unilateral<P, C> {
    /// Whether a velocity is on the bound, or beyond it by rounding.
    #[inline]
    pub fn is_closed(&self, v: &SVector<f64, C>) -> bool {
        self.outward * v[self.axis] >= self.bound
    }

    #[inline]
    fn limit(&self) -> f64 {
        self.outward * self.bound
    }
}

impl<P: ConvexPotential<C>, const C: usize> ConvexPotential<C> for Unilateral<P, C> {
    fn value(&self, v: &SVector<f64, C>) -> f64 {
        let into = self.outward * v[self.axis];
        if into > self.bound {
            return f64::INFINITY;
        }
        self.potential.value(v) - self.pull * into
    }

    fn slope_along(&self, v: &SVector<f64, C>, d: &SVector<f64, C>) -> Interval {
        let Interval { lower, upper } = self.potential.slope_along(v, d);
        let into = self.outward * d[self.axis];
        let linear = -self.pull * into;
        let (mut lower, mut upper) = (lower + linear, upper + linear);
        if self.is_closed(v) && into > 0.0 {
            upper = f64::INFINITY;
        }
        if self.is_closed(v) && into < 0.0 {
            lower = f64::NEG_INFINITY;
        }
        Interval { lower, upper }
    }

    fn local_model(&self, v: &SVector<f64, C>) -> LocalModel<C> {
        let mut model = self.potential.local_model(v);
        if self.is_closed(v) {
            model.smooth[self.axis] = false;
        } else {
            model.gradient[self.axis] -= self.outward * self.pull;
        }
        model
    }

    fn minimize(&self, block: &SMatrix<f64, C, C>, force: &SVector<f64, C>) -> SVector<f64, C> {
        let n = self.axis;
        let mut pulled = *force;
        pulled[n] += self.outward * self.pull;
        let free = self.potential.minimize(block, &pulled);
        if self.outward * free[n] <= self.bound {
            return free;
        }
        let (mut rest, mut left) = (*block, force - block.column(n) * self.limit());
        rest.column_mut(n).fill(0.0);
        rest.row_mut(n).fill(0.0);
        rest[(n, n)] = 1.0;
        left[n] = 0.0;
        let mut v = self.potential.minimize(&rest, &left);
        v[n] = self.limit();
        v
    }

    /// No further than to the bound.
    fn keep_smooth(&self, v: &SVector<f64, C>, d: &SVector<f64, C>) -> SVector<f64, C> {
        let mut kept = self.potential.keep_smooth(v, d);
        let n = self.axis;
        if self.outward * (v[n] + kept[n]) > self.bound {
            kept[n] = self.limit() - v[n];
        }
        kept
    }
}
