//! Friction on some components of a velocity: next to a free normal component, or a prescribed tangential one.

use nalgebra::{SMatrix, SVector};

use crate::{ConvexPotential, FrictionLaw, Interval, LocalModel, Radial, jacobi, modulus};

/// The potential `phi(v) = k varphi(abs(v_s))` of the sliding components `v_s` of a contact.
///
/// The potential is constant in the other components, and minimisation eliminates them from the block. Some of the
/// sliding components may be prescribed, with the velocity `prescribed`: they add to the slip rate,
/// `abs(v_s)^2 = abs(t)^2 + p^2`, and the unknown is the rest, `t`. In a minimisation a prescribed component has zero
/// force and zero couplings, and its result is zero.
///
/// ```
/// use nalgebra::{SMatrix, SVector};
/// use stickslip_friction::{ConvexPotential, Radial, Sliding, Tresca};
///
/// // A contact that slides along x and is free to lift.
/// let friction = Radial { law: Tresca { coefficient: 0.5 }, force: 2.0, state: () };
/// let potential = Sliding { friction, slides: [true, false], prescribed: SVector::zeros() };
/// let block = SMatrix::<f64, 2, 2>::new(4.0, 1.0, 1.0, 2.0);
/// let v = potential.minimize(&block, &SVector::from([3.0, 2.0]));
/// let left = SVector::from([3.0, 2.0]) - block * v;
/// assert!((left - SVector::from([1.0, 0.0])).norm() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sliding<L: FrictionLaw, const C: usize> {
    /// The friction of the sliding components.
    pub friction: Radial<L>,
    /// Whether a component slides.
    pub slides: [bool; C],
    /// The velocity of prescribed sliding components [m/s], zero for the others.
    pub prescribed: SVector<f64, C>,
}

/// Number of halvings from an interval of slip rates to the rounding of its ends.
const HALVINGS: usize = 1100;

impl<L: FrictionLaw, const C: usize> Sliding<L, C> {
    /// The sliding components, zero elsewhere.
    #[inline]
    fn slip(&self, v: &SVector<f64, C>) -> SVector<f64, C> {
        SVector::from_fn(|c, _| if self.slides[c] { v[c] } else { 0.0 })
    }

    /// Minimises with prescribed components: `(S + k mu(V)/V) t = g` with `V^2 = abs(t)^2 + p^2`, by bisection of `V`.
    fn minimize_beside(
        &self,
        block: &SMatrix<f64, C, C>,
        force: &SVector<f64, C>,
        p: f64,
    ) -> SVector<f64, C> {
        let (lambda, q) = jacobi::eigen(block);
        let force = q.tr_mul(force);
        let rest = |rate: f64| {
            let resistance = self.friction.friction(rate) / rate;
            force.zip_map(
                &lambda,
                |g, l| if g == 0.0 { 0.0 } else { g / (l + resistance) },
            )
        };
        // Without friction the rate would be the largest; friction makes it fall short.
        let free = force.zip_map(&lambda, |g, l| if g == 0.0 { 0.0 } else { g / l });
        let (mut low, mut high) = (p, p.hypot(modulus(&free)));
        for _ in 0..HALVINGS {
            let middle = if high > 4.0 * low {
                low.sqrt() * high.sqrt()
            } else {
                0.5 * (low + high)
            };
            if !(low < middle && middle < high) {
                break;
            }
            if p.hypot(modulus(&rest(middle))) > middle {
                low = middle;
            } else {
                high = middle;
            }
        }
        q * rest(high)
    }
}

impl<L: FrictionLaw, const C: usize> ConvexPotential<C> for Sliding<L, C> {
    fn value(&self, v: &SVector<f64, C>) -> f64 {
        self.friction.value(&self.slip(v))
    }

    fn slope_along(&self, v: &SVector<f64, C>, d: &SVector<f64, C>) -> Interval {
        self.friction.slope_along(&self.slip(v), &self.slip(d))
    }

    fn local_model(&self, v: &SVector<f64, C>) -> LocalModel<C> {
        let model = self.friction.local_model(&self.slip(v));
        let slides = self.slides;
        LocalModel {
            gradient: self.slip(&model.gradient),
            hessian: SMatrix::from_fn(|r, c| {
                if slides[r] && slides[c] {
                    model.hessian[(r, c)]
                } else {
                    0.0
                }
            }),
            smooth: std::array::from_fn(|c| model.smooth[c] || !slides[c]),
        }
    }

    fn minimize(&self, block: &SMatrix<f64, C, C>, force: &SVector<f64, C>) -> SVector<f64, C> {
        // Eliminate what does not slide, one component after the other.
        let (mut reduced, mut pull) = (*block, *force);
        for n in (0..C).filter(|&n| !self.slides[n]) {
            let pivot = reduced[(n, n)];
            let row = reduced.row(n).transpose();
            let share = pull[n] / pivot;
            pull -= row * share;
            reduced -= row * row.transpose() / pivot;
            for c in 0..C {
                reduced[(n, c)] = 0.0;
                reduced[(c, n)] = 0.0;
            }
            reduced[(n, n)] = 1.0;
            pull[n] = 0.0;
        }
        let p = modulus(&self.prescribed);
        let mut v = if p > 0.0 {
            self.minimize_beside(&reduced, &pull, p)
        } else {
            self.friction.minimize(&reduced, &pull)
        };
        // Then the eliminated ones follow, against the whole block.
        if self.slides.contains(&false) {
            let left = force - block * self.slip(&v);
            let normal =
                SMatrix::<f64, C, C>::from_fn(|r, c| match (self.slides[r], self.slides[c]) {
                    (false, false) => block[(r, c)],
                    _ => f64::from(u8::from(r == c)),
                });
            if let Some(factor) = normal.cholesky() {
                let follow = factor.solve(&left);
                for c in (0..C).filter(|&c| !self.slides[c]) {
                    v[c] = follow[c];
                }
            }
        }
        v
    }

    fn keep_smooth(&self, v: &SVector<f64, C>, d: &SVector<f64, C>) -> SVector<f64, C> {
        let kept = self.friction.keep_smooth(&self.slip(v), &self.slip(d));
        SVector::from_fn(|c, _| if self.slides[c] { kept[c] } else { d[c] })
    }
}
