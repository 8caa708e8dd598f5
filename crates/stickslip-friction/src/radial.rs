//! Extension of a scalar friction law to vectors.

use nalgebra::{SMatrix, SVector};

use crate::{
    ConvexPotential, FrictionLaw, Interval, LocalModel, jacobi,
    local_problem::{decoupled_direction, softest},
    modulus,
};

/// The potential `phi(v) = k varphi(abs(v), alpha)` of one vertex, with `varphi' = mu`.
///
/// It depends on the speed alone, in any number of components: gradient `k mu e` and Hessian
/// `k (mu' e e^T + mu/V (I - e e^T))`, with `e = v/V`. At rest it has a kink if `mu(0) > 0`.
///
/// Minimisation against a block `S` is exact. A force along a decoupled component (always so for `C = 1`) is the law's
/// scalar problem. Otherwise, with `S` diagonalised, the speed solves `sum_i (g_i / (lambda_i V + k mu(V)))^2 = 1`,
/// which decreases in `V` and is bracketed by two scalar problems. A component that is fixed at zero has zero force,
/// zero couplings and any positive diagonal.
///
/// ```
/// use nalgebra::{SMatrix, SVector};
/// use stickslip_friction::{ConvexPotential, DieterichRuina, Radial};
/// use stickslip_state::LogTheta;
///
/// let law = DieterichRuina {
///     a: 0.010,
///     b: 0.015,
///     reference_friction: 0.6,
///     reference_velocity: 1e-6,
///     slip_distance: 1e-5,
/// };
/// let potential = Radial { law, force: 100.0, state: LogTheta(2.0) };
/// let block = SMatrix::<f64, 2, 2>::new(2e5, 1e5, 1e5, 3e5);
/// let force = SVector::from([60.0, 20.0]);
/// let v = potential.minimize(&block, &force);
/// let residual = block * v - force + potential.local_model(&v).gradient;
/// assert!(residual.norm() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Radial<L: FrictionLaw> {
    /// The friction law.
    pub law: L,
    /// `k`, the modulus of the normal stress times the weight of the vertex \[N\], non-negative.
    pub force: f64,
    /// The state at the vertex.
    pub state: L::State,
}

impl<L: FrictionLaw, const C: usize> ConvexPotential<C> for Radial<L> {
    fn value(&self, v: &SVector<f64, C>) -> f64 {
        self.force * self.law.potential(modulus(v), self.state)
    }

    fn slope_along(&self, v: &SVector<f64, C>, d: &SVector<f64, C>) -> Interval {
        let speed = modulus(v);
        let friction = self.friction(speed);
        if speed == 0.0 {
            let upper = friction * modulus(d);
            return Interval {
                lower: -upper,
                upper,
            };
        }
        let slope = friction * (v / speed).dot(d);
        Interval {
            lower: slope,
            upper: slope,
        }
    }

    #[inline]
    fn local_model(&self, v: &SVector<f64, C>) -> LocalModel<C> {
        let speed = modulus(v);
        let (friction, along) = self.friction_and_slope(speed);
        let (gradient, across, direction) = if speed > 0.0 {
            let e = v / speed;
            (e * friction, if C > 1 { friction / speed } else { 0.0 }, e)
        } else if friction > 0.0 {
            (SVector::zeros(), f64::INFINITY, SVector::zeros())
        } else {
            (SVector::zeros(), along, SVector::zeros())
        };
        let smooth = along.is_finite() && across.is_finite();
        let hessian = if smooth {
            let projection = direction * direction.transpose();
            projection * along + (SMatrix::identity() - projection) * across
        } else {
            SMatrix::zeros()
        };
        LocalModel {
            gradient,
            hessian,
            smooth: [smooth; C],
        }
    }

    /// Keeps at least a tenth of the speed along `v`, since the kink lies at rest.
    fn keep_smooth(&self, v: &SVector<f64, C>, d: &SVector<f64, C>) -> SVector<f64, C> {
        // Not through v.v, which underflows first.
        let speed = modulus(v);
        let along = if speed > 0.0 { (v / speed).dot(d) } else { 0.0 };
        if along < -0.9 * speed {
            d * (-0.9 * speed / along)
        } else {
            *d
        }
    }

    #[inline]
    fn minimize(&self, block: &SMatrix<f64, C, C>, force: &SVector<f64, C>) -> SVector<f64, C> {
        if let Some(i) = decoupled_direction(block, force) {
            let mut v = SVector::zeros();
            v[i] = self.speed(block[(i, i)], force[i].abs()).copysign(force[i]);
            return v;
        }
        let pull = modulus(force);
        // Friction that falls with the slip rate may leave a choice between rest and slip: that of the law.
        let rests = || pull == 0.0 || self.speed(softest(block), pull) == 0.0;
        if pull <= self.friction(0.0) && rests() {
            return SVector::zeros();
        }
        let (lambda, q) = jacobi::eigen(block);
        q * self.minimize_diagonal(&lambda, &q.tr_mul(force), pull)
    }
}
