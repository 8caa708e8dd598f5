//! The lift of a scalar friction law to vectors.

use nalgebra::{SMatrix, SVector};

use crate::{ConvexPotential, FrictionLaw, Interval, LocalModel, jacobi};

/// The evaluations granted to the equation for the speed; some 6 are typical.
const EVALUATIONS: usize = 100;

/// The relative error granted to the scalar problems that bracket it.
const SLACK: f64 = 1e-9;

/// The potential `phi(v) = k varphi(abs(v), alpha)` of one vertex, with `varphi' = mu`.
///
/// It depends on the speed alone, in any number of components: gradient `k mu e` and Hessian
/// `k (mu' e e^T + mu/V (I - e e^T))`, with `e = v/V`. At rest it has a kink where `mu(0) > 0`.
///
/// Minimisation against a block `S` is exact. A force along a component that does not couple to
/// others (always so for `C = 1`) is the law's scalar problem. Otherwise, with `S` diagonalised, the
/// speed solves `sum_i (g_i / (lambda_i V + k mu(V)))^2 = 1`, which decreases in `V` and is
/// bracketed by two scalar problems. A component that is held at zero has zero force, zero
/// couplings and any positive diagonal.
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
        self.force * self.law.potential(norm(v), self.state)
    }

    fn slope_along(&self, v: &SVector<f64, C>, d: &SVector<f64, C>) -> Interval {
        let speed = norm(v);
        let friction = self.friction(speed);
        if speed == 0.0 {
            let upper = friction * norm(d);
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

    fn local_model(&self, v: &SVector<f64, C>) -> LocalModel<C> {
        let speed = norm(v);
        let friction = self.friction(speed);
        // 0 times an infinite slope is no curvature.
        let times_force = |slope: f64| {
            if self.force > 0.0 {
                self.force * slope
            } else {
                0.0
            }
        };
        let along = times_force(self.law.coefficient_slope(speed, self.state));
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

    /// The kink lies at rest: of the speed along `v` at least a tenth is kept.
    fn keep_smooth(&self, v: &SVector<f64, C>, d: &SVector<f64, C>) -> SVector<f64, C> {
        let (square, along) = (v.dot(v), v.dot(d));
        if along < -0.9 * square {
            d * (-0.9 * square / along)
        } else {
            *d
        }
    }

    fn minimize(&self, block: &SMatrix<f64, C, C>, force: &SVector<f64, C>) -> SVector<f64, C> {
        if let Some(i) = decoupled_direction(block, force) {
            let mut v = SVector::zeros();
            v[i] = self.speed(block[(i, i)], force[i].abs()).copysign(force[i]);
            return v;
        }
        let pull = norm(force);
        if pull <= self.friction(0.0) {
            return SVector::zeros();
        }
        let (lambda, q) = jacobi::eigen(block);
        q * self.minimize_diagonal(&lambda, &q.tr_mul(force), pull)
    }
}

impl<L: FrictionLaw> Radial<L> {
    /// `k mu(V)` \[N\].
    fn friction(&self, speed: f64) -> f64 {
        self.force * self.law.coefficient(speed, self.state)
    }

    /// The `V` with `stiffness V + k mu(V) = pull`.
    fn speed(&self, stiffness: f64, pull: f64) -> f64 {
        let (viscosity, drive) = (stiffness / self.force, pull / self.force);
        if viscosity.is_finite() && drive.is_finite() {
            self.law.slip_rate(viscosity, drive, self.state)
        } else {
            // No normal force, or one too small to matter.
            pull / stiffness
        }
    }

    /// The minimiser for `S = diag(lambda)`; `pull` is the norm of `force`.
    fn minimize_diagonal<const C: usize>(
        &self,
        lambda: &SVector<f64, C>,
        force: &SVector<f64, C>,
        pull: f64,
    ) -> SVector<f64, C> {
        // Directions without force stay at rest and do not count.
        let (mut soft, mut stiff) = (f64::INFINITY, 0.0);
        for (&l, &g) in lambda.iter().zip(force) {
            if g != 0.0 {
                (soft, stiff) = (l.min(soft), l.max(stiff));
            }
        }
        let upper = self.speed(soft, pull);
        if upper == 0.0 || soft == stiff {
            return force * (upper / pull);
        }
        // Speed times stiffness grows with the stiffness, which bounds the bracket by its ratio. The
        // ends are no better than ln V is resolved.
        let lower = self.speed(stiff, pull).max(upper * (soft / stiff));
        let speed = self.balance(lambda, force, lower * (1.0 - SLACK), upper * (1.0 + SLACK));
        let friction = self.friction(speed);
        // Of unit length, if friction were resolved. Where it is small beside the logarithms it is a
        // difference of, the speed is the better of the two.
        let direction = force.zip_map(lambda, |g, l| g / (l * speed + friction));
        direction * (speed / direction.norm())
    }

    /// The root of `sum_i (g_i / (lambda_i V + k mu(V)))^2 = 1` in a bracket: Newton's method in
    /// `ln V` on the reciprocal of the root of the sum, which is nearly linear in either `V` or `ln V`.
    fn balance<const C: usize>(
        &self,
        lambda: &SVector<f64, C>,
        force: &SVector<f64, C>,
        mut lower: f64,
        mut upper: f64,
    ) -> f64 {
        let mut speed = lower.sqrt() * upper.sqrt();
        for _ in 0..EVALUATIONS {
            let friction = self.friction(speed);
            let stiffening = self.force * self.law.coefficient_slope(speed, self.state);
            let (mut sum, mut decay) = (0.0, 0.0);
            for (&l, &g) in lambda.iter().zip(force) {
                let resistance = l * speed + friction;
                let share = (g / resistance) * (g / resistance);
                sum += share;
                decay += share * ((l + stiffening) * speed / resistance);
            }
            let norm = sum.sqrt();
            if norm > 1.0 {
                lower = speed;
            } else {
                upper = speed;
            }
            let newton = speed * ((norm - 1.0) * (sum / decay)).exp();
            if (norm - 1.0).abs() <= 4.0 * f64::EPSILON {
                return newton.max(lower).min(upper);
            }
            let next = if lower < newton && newton < upper {
                newton
            } else {
                lower.sqrt() * upper.sqrt()
            };
            if next == speed || upper <= lower.next_up() {
                return next;
            }
            speed = next;
        }
        speed
    }
}

/// The single component with a force, if it couples to no other.
fn decoupled_direction<const C: usize>(
    block: &SMatrix<f64, C, C>,
    force: &SVector<f64, C>,
) -> Option<usize> {
    let mut forced = (0..C).filter(|&i| force[i] != 0.0);
    let i = forced.next().unwrap_or(0);
    let alone = forced.next().is_none() && (0..C).all(|j| j == i || block[(j, i)] == 0.0);
    alone.then_some(i)
}

/// The Euclidean norm, also of vectors whose squares underflow or overflow.
fn norm<const C: usize>(v: &SVector<f64, C>) -> f64 {
    let largest = v.amax();
    if C == 1 || largest == 0.0 || !largest.is_finite() {
        return largest;
    }
    largest * (v / largest).norm()
}
