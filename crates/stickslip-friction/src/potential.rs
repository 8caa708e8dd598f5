//! The interface of a nonsmooth convex function at one vertex for a minimiser.

use nalgebra::{SMatrix, SVector};

/// A closed interval of numbers, a point if `lower = upper`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The smaller end.
    pub lower: f64,
    /// The larger end.
    pub upper: f64,
}

/// A quadratic model of a convex function near a point, in its smooth components.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocalModel<const C: usize> {
    /// The gradient in the smooth components.
    pub gradient: SVector<f64, C>,
    /// The Hessian in the smooth components, symmetric and positive semidefinite.
    pub hessian: SMatrix<f64, C, C>,
    /// Component by component: whether the function is twice differentiable there, with a representable Hessian.
    /// Otherwise the entries of gradient and Hessian mean nothing.
    pub smooth: [bool; C],
}

/// A convex function `phi` of the velocity of one vertex, `C` components \[m/s\].
///
/// Implement all four methods. [`Radial`](crate::Radial) is the implementation for friction that depends on the speed
/// alone. A solver sees only this trait, never a friction law.
///
/// ```
/// use nalgebra::{SMatrix, SVector};
/// use stickslip_friction::{ConvexPotential, Interval, LocalModel, check_convex_potential};
///
/// /// phi(v) = c abs(v)
/// struct Modulus(f64);
///
/// impl ConvexPotential<1> for Modulus {
///     fn value(&self, v: &SVector<f64, 1>) -> f64 {
///         self.0 * v[0].abs()
///     }
///
///     fn slope_along(&self, v: &SVector<f64, 1>, d: &SVector<f64, 1>) -> Interval {
///         let slope = self.0 * d[0];
///         match v[0] {
///             0.0 => Interval { lower: -slope.abs(), upper: slope.abs() },
///             x => Interval { lower: slope * x.signum(), upper: slope * x.signum() },
///         }
///     }
///
///     fn local_model(&self, v: &SVector<f64, 1>) -> LocalModel<1> {
///         LocalModel {
///             gradient: SVector::from([self.0 * v[0].signum()]),
///             hessian: SMatrix::zeros(),
///             smooth: [v[0] != 0.0],
///         }
///     }
///
///     fn minimize(&self, block: &SMatrix<f64, 1, 1>, force: &SVector<f64, 1>) -> SVector<f64, 1> {
///         let excess = (force[0].abs() - self.0).max(0.0);
///         SVector::from([excess.copysign(force[0]) / block[(0, 0)]])
///     }
/// }
///
/// let v = Modulus(1.0).minimize(&SMatrix::from([[2.0]]), &SVector::from([-5.0]));
/// assert_eq!(v[0], -2.0);
///
/// check_convex_potential(&Modulus(1.0), 1e-6, 1.0)?;
/// # Ok::<(), stickslip_friction::FrictionViolation>(())
/// ```
pub trait ConvexPotential<const C: usize>: Send + Sync {
    /// `phi(v)` \[W\]; may be infinite.
    fn value(&self, v: &SVector<f64, C>) -> f64;

    /// The slopes of `t -> phi(v + t d)` at `t = 0`: from `-phi'(v; -d)` to `phi'(v; d)`.
    fn slope_along(&self, v: &SVector<f64, C>, d: &SVector<f64, C>) -> Interval;

    /// Gradient and Hessian at `v`, and the components that have them.
    fn local_model(&self, v: &SVector<f64, C>) -> LocalModel<C>;

    /// The minimiser of `v.S v/2 - g.v + phi(v)`, for `block` = `S` symmetric and positive definite
    /// and `force` = `g`.
    fn minimize(&self, block: &SMatrix<f64, C, C>, force: &SVector<f64, C>) -> SVector<f64, C>;

    /// The correction `d`, shortened so that the local model at `v` still holds at `v + d`.
    ///
    /// Override it if a kink lies at a known place; the default returns `d`.
    fn keep_smooth(&self, v: &SVector<f64, C>, d: &SVector<f64, C>) -> SVector<f64, C> {
        let _ = v;
        *d
    }
}
