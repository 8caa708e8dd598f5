//! Dense problems with friction.

mod estimate;
mod factor;
mod system;
mod unknowns;
mod workspace;

pub(crate) use unknowns::Unknowns;
pub(crate) use workspace::{Goal, Workspace};

use nalgebra::{DMatrix, SVector};

use crate::block::check_blocks;
use crate::newton::Friction;
use crate::{Energy, NonsmoothSolver, Operator, SolveError, SolveReport, Stopping};

/// The nonsmooth Newton method for a dense matrix `S`: `min y.Sy/2 - g.y + sum_k phi_k(y_k)`.
///
/// For bodies that are their surface: a Schur complement, a kernel. One iteration is a nonlinear
/// Gauss-Seidel sweep, each local problem solved exactly; Newton's method on the components that are
/// smooth, with a dense factorisation that serves for further steps while they shrink; and a line search, so
/// that it converges from every start. [`Condensed`](crate::Condensed) is a sparse factorisation and this.
///
/// ```
/// use nalgebra::{DMatrix, SVector};
/// use stickslip_friction::{Radial, Tresca};
/// use stickslip_tnnmg::{DenseNewton, Energy, NonsmoothSolver, Stopping};
///
/// // Two vertices, coupled; a force of 3 N moves the first one, the second sticks.
/// let matrix = DMatrix::from_row_slice(2, 2, &[2.0, -1.0, -1.0, 2.0]);
/// let friction = vec![Radial { law: Tresca { coefficient: 0.5 }, force: 2.0, state: () }; 2];
/// let energy = Energy {
///     operator: &matrix,
///     load: &[SVector::from([3.0]), SVector::from([0.0])],
///     potentials: &friction,
///     vertices: &[0, 1],
///     fixed: &[[false], [false]],
/// };
/// let mut y = [SVector::from([0.0]); 2];
/// let mut solver = DenseNewton::<1>::new();
/// solver.prepare(&energy)?;
/// solver.minimize(&energy, &Stopping::in_energy_norm(&matrix, 1e-12), &mut y)?;
/// assert!((y[0][0] - 1.0).abs() < 1e-12 && y[1][0] == 0.0);
/// # Ok::<(), stickslip_tnnmg::SolveError>(())
/// ```
#[derive(Debug)]
pub struct DenseNewton<const C: usize> {
    truncation: f64,
    /// `S` on the free components, by columns.
    matrix: Vec<f64>,
    fixed: Vec<[bool; C]>,
    vertices: Vec<usize>,
    work: Option<Workspace<C>>,
    change: Vec<SVector<f64, C>>,
}

impl<const C: usize> Default for DenseNewton<C> {
    fn default() -> Self {
        Self {
            truncation: 1e4,
            matrix: Vec::new(),
            fixed: Vec::new(),
            vertices: Vec::new(),
            work: None,
            change: Vec::new(),
        }
    }
}

impl<const C: usize> DenseNewton<C> {
    /// A solver that has not yet seen an operator.
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets the curvature, relative to the diagonal of the matrix, from which a component is left to the
    /// sweep alone. The default is `1e4`; convergence hardly depends on it.
    #[must_use]
    pub fn with_truncation(mut self, ratio: f64) -> Self {
        self.truncation = ratio;
        self
    }
}

impl<const C: usize> NonsmoothSolver<DMatrix<f64>, C> for DenseNewton<C> {
    fn prepare(&mut self, energy: &Energy<'_, DMatrix<f64>, C>) -> Result<(), SolveError> {
        energy.check()?;
        let same = self.fixed == energy.fixed && self.vertices == energy.vertices;
        if self.work.is_none() || !same {
            let unknowns = Unknowns::of_free(energy.fixed);
            let count = unknowns.count();
            self.work = None;
            self.matrix = vec![0.0; count * count];
            self.fixed = energy.fixed.to_vec();
            self.vertices = energy.vertices.to_vec();
            self.change = vec![SVector::zeros(); energy.fixed.len()];
            let work = Workspace::new(unknowns, energy.vertices.len());
            self.work = Some(work.ok_or(SolveError::Analysis {
                unknowns: count,
                entries: count * count,
            })?);
        }
        let Some(work) = &mut self.work else {
            return Ok(());
        };
        let unknowns = &work.unknowns;
        for j in 0..unknowns.count() {
            let (q, d) = unknowns.owner(j);
            for i in 0..unknowns.count() {
                let (p, c) = unknowns.owner(i);
                self.matrix[j * unknowns.count() + i] = energy.operator[(C * p + c, C * q + d)];
            }
        }
        check_blocks(energy.operator, energy.fixed)
    }

    fn minimize(
        &mut self,
        energy: &Energy<'_, DMatrix<f64>, C>,
        stopping: &Stopping<'_, DMatrix<f64>>,
        v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError> {
        let (size, frictional) = (self.fixed.len(), self.vertices.len());
        energy.check_sizes(size, frictional, stopping.norm, v)?;
        let Some(work) = &mut self.work else {
            return Ok(SolveReport::default());
        };
        let prescribed = &mut self.change;
        for ((prescribed, v), fixed) in prescribed.iter_mut().zip(&*v).zip(&self.fixed) {
            *prescribed = SVector::from_fn(|c, _| if fixed[c] { v[c] } else { 0.0 });
        }
        for (p, load) in energy.load.iter().enumerate() {
            let left = load - energy.operator.product_at(p, prescribed);
            for (c, i) in work.unknowns.free(p) {
                work.force[i] = left[c];
            }
        }
        let spoiled: f64 = energy.load.iter().flatten().map(|load| 0.0 * load).sum();
        if spoiled != 0.0 {
            return Err(SolveError::NotFinite {
                iteration: 1,
                change: f64::NAN,
            });
        }
        let goal = Goal {
            tolerance: stopping.at(v),
            equivalence: stopping.equivalence,
            rounding: stopping.relative > 0.0,
            max_iterations: stopping.max_iterations,
        };
        let friction = Friction {
            potentials: energy.potentials,
            vertices: energy.vertices,
            fixed: energy.fixed,
        };
        let mut norm = |change: &[SVector<f64, C>]| Operator::norm(stopping.norm, change);
        work.minimize(
            &self.matrix,
            &friction,
            self.truncation,
            &goal,
            &mut norm,
            v,
        )
    }
}
