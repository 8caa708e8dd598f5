//! Minimisation of a radial potential against a diagonal block.

use nalgebra::{SMatrix, SVector};

use crate::{FrictionLaw, Radial, modulus};

/// Largest number of evaluations for the equation of the speed; some 6 are typical.
const EVALUATIONS: usize = 100;

/// Number of corrections for friction below the resolution of the sum; the method is of second order.
const CORRECTIONS: usize = 3;

/// Number of chords that bound a speed from above, and the relative step of the last one and of the last one of Newton.
const CHORDS: usize = 200;
const CLOSE: f64 = 1e-12;

/// The relative difference of forces from which friction is taken to decrease, above the error of the scalar problems.
const FALL: f64 = 1e-6;

/// The relative error of the scalar problems that bracket it.
const SLACK: f64 = 1e-9;

impl<L: FrictionLaw> Radial<L> {
    /// `k mu(V)` \[N\].
    #[inline]
    pub(crate) fn friction(&self, speed: f64) -> f64 {
        self.force * self.law.coefficient(speed, self.state)
    }

    /// `k mu(V)` \[N\] and its slope.
    #[inline]
    pub(crate) fn friction_and_slope(&self, speed: f64) -> (f64, f64) {
        let (coefficient, slope) = self.law.coefficient_and_rate_slope(speed, self.state);
        // 0 times an infinite slope is no curvature.
        let slope = if self.force > 0.0 {
            self.force * slope
        } else {
            0.0
        };
        (self.force * coefficient, slope)
    }

    /// The `V` with `stiffness V + k mu(V) = pull`.
    #[inline]
    pub(crate) fn speed(&self, stiffness: f64, pull: f64) -> f64 {
        let (viscosity, drive) = (stiffness / self.force, pull / self.force);
        if viscosity.is_finite() && drive.is_finite() {
            self.law.slip_rate(viscosity, drive, self.state)
        } else {
            // No normal force, or one too small to matter.
            pull / stiffness
        }
    }

    /// The minimiser for `S = diag(lambda)`; `pull` is the norm of `force`.
    pub(crate) fn minimize_diagonal<const C: usize>(
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
        let mut upper = self.speed(soft, pull);
        if upper == 0.0 || soft == stiff {
            return force * (upper / pull);
        }
        // The ends are no better than ln V is resolved.
        let alone = self.speed(stiff, pull);
        // What each leaves to friction, which is less at the larger speed only where friction falls.
        let falls = soft * upper > stiff * alone * (1.0 + FALL);
        let lower = if alone > 0.0 && !falls {
            alone
        } else if alone == 0.0 && pull > self.friction(0.0) {
            // It underflows; friction that grows with the speed does not lead below the ratio of stiffness.
            upper * (soft / stiff)
        } else if let Some(ends) = self.slides_on(lambda, force, pull, upper) {
            upper = ends[1];
            ends[0]
        } else {
            return SVector::zeros();
        };
        let speed = self.balance(lambda, force, lower * (1.0 - SLACK), upper * (1.0 + SLACK));
        let friction = supporting(lambda, force, speed, self.friction(speed).min(pull));
        let direction = force.zip_map(lambda, |g, l| g / (l * speed + friction));
        let length = modulus(&direction);
        if length.is_finite() {
            direction / length * speed
        } else {
            // Resistances that underflow are friction not resolved at all: it acts along the force.
            force / pull * speed
        }
    }

    /// A bracket of the speed for friction that decreases with the speed, where several speeds or rest balance the
    /// forces; `None` for rest.
    ///
    /// The friction that balances the force at a speed `V`, see [`balancing`], is a convex function of it up to the
    /// speed at which none is needed. Its chords lie above: their scalar problems lead down to the solution. Its
    /// tangents lie below: their solutions are lower bounds. The scalar problem of a law may return rest although rest
    /// is no solution here. Two speeds between which friction changes from less than the balancing one to more are
    /// therefore a bracket in any case.
    fn slides_on<const C: usize>(
        &self,
        lambda: &SVector<f64, C>,
        force: &SVector<f64, C>,
        pull: f64,
        mut upper: f64,
    ) -> Option<[f64; 2]> {
        let frictionless = force.zip_map(lambda, |g, l| if g == 0.0 { 0.0 } else { g / l });
        upper = upper.min(modulus(&frictionless));
        let mut left = 0.5 * upper;
        for _ in 0..CHORDS {
            let (friction, fall) = balancing(lambda, force, upper);
            let lower = self.speed(fall, friction + fall * upper);
            if lower > 0.0 {
                return Some([lower.min(upper), upper]);
            }
            if self.speed((pull - friction) / upper, pull) == 0.0 {
                return None;
            }
            let (more, _) = balancing(lambda, force, left);
            let fall = (more - friction) / (upper - left);
            let next = if fall > 0.0 {
                self.speed(fall, friction + fall * upper)
            } else {
                0.0
            };
            if next <= left && more > self.friction(left) {
                return Some([left, upper]);
            }
            let next = next.max(left).min(upper);
            if next >= upper * (1.0 - CLOSE) {
                return Some([next, upper]);
            }
            left = (next - 4.0 * (upper - next)).max(0.5 * next);
            upper = next;
        }
        None
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
            let (friction, stiffening) = self.friction_and_slope(speed);
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
                // A long step is of rounding alone, where friction has no slope, and may pass a kink.
                let resolved = (newton - speed).abs() <= CLOSE * speed;
                return if resolved {
                    newton.max(lower).min(upper)
                } else {
                    speed
                };
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

/// A lower bound of the eigenvalues of a block: `det S/(tr S)^(C - 1)`.
pub(crate) fn softest<const C: usize>(block: &SMatrix<f64, C, C>) -> f64 {
    let trace = block.trace();
    let pivots = block.cholesky().map(|factor| factor.l().diagonal());
    pivots.map_or(0.0, |pivots| {
        let scaled: f64 = pivots.iter().map(|pivot| pivot * (pivot / trace)).product();
        scaled * trace
    })
}

/// The single component with a force, if it is decoupled.
#[inline]
pub(crate) fn decoupled_direction<const C: usize>(
    block: &SMatrix<f64, C, C>,
    force: &SVector<f64, C>,
) -> Option<usize> {
    let mut forced = (0..C).filter(|&i| force[i] != 0.0);
    let i = forced.next().unwrap_or(0);
    let alone = forced.next().is_none() && (0..C).all(|j| j == i || block[(j, i)] == 0.0);
    alone.then_some(i)
}

/// The friction `f` with `sum_i (g_i / (lambda_i V + f))^2 = 1` at a speed `V`, or 0 without a positive one, and its
/// decrease with the speed: the mean of the stiffnesses with the weights `g_i^2/(lambda_i V + f)^3`.
///
/// Newton's method for the reciprocal of the root of the sum, which is concave in `f`: from 0 it never passes the
/// solution.
fn balancing<const C: usize>(
    lambda: &SVector<f64, C>,
    force: &SVector<f64, C>,
    speed: f64,
) -> (f64, f64) {
    let mut friction = 0.0;
    for _ in 0..EVALUATIONS {
        let (mut sum, mut decay, mut fall) = (0.0, 0.0, 0.0);
        for (&l, &g) in lambda.iter().zip(force) {
            let resistance = l * speed + friction;
            let share = (g / resistance) * (g / resistance);
            sum += share;
            decay += share / resistance;
            fall += share / resistance * l;
        }
        let next = friction + (sum.sqrt() - 1.0) * (sum / decay);
        if next > friction * (1.0 + f64::EPSILON) {
            friction = next;
        } else {
            return (friction, fall / decay);
        }
    }
    (friction, f64::NAN)
}

/// The friction that makes the direction `g_i / (lambda_i V + friction)` of unit length, by Newton's method for the
/// reciprocal of its length, from friction at that speed.
///
/// If friction is small compared with the logarithms in its difference, the speed is the more accurate of the two:
/// scaling a direction of another length would leave forces out of balance.
fn supporting<const C: usize>(
    lambda: &SVector<f64, C>,
    force: &SVector<f64, C>,
    speed: f64,
    mut friction: f64,
) -> f64 {
    for _ in 0..CORRECTIONS {
        let (mut sum, mut decay) = (0.0, 0.0);
        for (&l, &g) in lambda.iter().zip(force) {
            let resistance = l * speed + friction;
            let share = (g / resistance) * (g / resistance);
            sum += share;
            decay += share / resistance;
        }
        let excess = sum.sqrt() - 1.0;
        let next = friction + excess * (sum / decay);
        if excess.abs() <= 4.0 * f64::EPSILON || !(next.is_finite() && next >= 0.0) {
            break;
        }
        friction = next;
    }
    friction
}
