//! The nonsmooth part of an energy.

use nalgebra::{SMatrix, SVector};
use stickslip_friction::{ConvexPotential, Interval, LocalModel};

/// The potentials of all frictional vertices, by their position among these.
///
/// A solver sees friction through this trait. Every method is that of [`ConvexPotential`] for one vertex. A `Vec` or a
/// slice of potentials implements it. Implement it for composite potentials, such as contacts with common vertices.
///
/// ```
/// use nalgebra::SVector;
/// use stickslip_friction::{Radial, Tresca};
/// use stickslip_solvers::Potentials;
///
/// let friction = vec![Radial { law: Tresca { coefficient: 0.6 }, force: 10.0, state: () }; 3];
/// let potentials: &dyn Potentials<2> = &friction;
/// assert_eq!((potentials.len(), potentials.value(2, &SVector::from([3.0, 4.0]))), (3, 30.0));
/// ```
pub trait Potentials<const C: usize>: Send + Sync {
    /// The number of frictional vertices.
    fn len(&self) -> usize;

    /// Whether there are none.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// `phi_k(v)` \[W\].
    fn value(&self, k: usize, v: &SVector<f64, C>) -> f64;

    /// The slopes of `t -> phi_k(v + t d)` at `t = 0`.
    fn slope_along(&self, k: usize, v: &SVector<f64, C>, d: &SVector<f64, C>) -> Interval;

    /// Gradient and Hessian of `phi_k` at `v`, and the components that have them.
    fn local_model(&self, k: usize, v: &SVector<f64, C>) -> LocalModel<C>;

    /// The minimiser of `v.S v/2 - g.v + phi_k(v)`.
    fn minimize(
        &self,
        k: usize,
        block: &SMatrix<f64, C, C>,
        force: &SVector<f64, C>,
    ) -> SVector<f64, C>;

    /// The correction `d`, shortened so that the local model at `v` still holds at `v + d`.
    fn keep_smooth(&self, k: usize, v: &SVector<f64, C>, d: &SVector<f64, C>) -> SVector<f64, C>;
}

macro_rules! one_a_vertex {
    ($list:ty) => {
        impl<P: ConvexPotential<C>, const C: usize> Potentials<C> for $list {
            fn len(&self) -> usize {
                <[P]>::len(self)
            }

            fn value(&self, k: usize, v: &SVector<f64, C>) -> f64 {
                self[k].value(v)
            }

            fn slope_along(&self, k: usize, v: &SVector<f64, C>, d: &SVector<f64, C>) -> Interval {
                self[k].slope_along(v, d)
            }

            fn local_model(&self, k: usize, v: &SVector<f64, C>) -> LocalModel<C> {
                self[k].local_model(v)
            }

            fn minimize(
                &self,
                k: usize,
                block: &SMatrix<f64, C, C>,
                force: &SVector<f64, C>,
            ) -> SVector<f64, C> {
                self[k].minimize(block, force)
            }

            fn keep_smooth(
                &self,
                k: usize,
                v: &SVector<f64, C>,
                d: &SVector<f64, C>,
            ) -> SVector<f64, C> {
                self[k].keep_smooth(v, d)
            }
        }
    };
}

one_a_vertex!(Vec<P>);
one_a_vertex!(&[P]);
