//! A velocity problem, its minimiser, and how far from it a field is.

use nalgebra::{DMatrix, DVector, SVector};
use stickslip_fem::{Assembled, Constraints, FemError, P1, Trace};
use stickslip_friction::{DieterichRuina, Radial};
use stickslip_solvers::{
    BlockMatrix, Energy, Matrix, NonsmoothSolver, Operator, SolveError, SolveReport, Stopping,
    Transfers,
};
use stickslip_state::LogTheta;

use super::{LAW, NORMAL_STRESS, Numbers, Regime, TIME_STEP, coefficient, dense};

/// `J` and the field that minimises it.
pub(crate) struct Problem<const C: usize> {
    pub(crate) stiffness: BlockMatrix<C>,
    pub(crate) mass: BlockMatrix<C>,
    pub(crate) operator: BlockMatrix<C>,
    pub(crate) norm: BlockMatrix<C>,
    pub(crate) equivalence: f64,
    pub(crate) load: Vec<SVector<f64, C>>,
    pub(crate) potentials: Vec<Radial<DieterichRuina>>,
    pub(crate) vertices: Vec<usize>,
    pub(crate) fixed: Vec<[bool; C]>,
    pub(crate) transfers: Transfers,
    pub(crate) exact: Vec<SVector<f64, C>>,
}

impl<const C: usize> Problem<C> {
    /// The top moves at 2e-4 m/s along component 0; at the bottom the components in `closed` are zero.
    pub(crate) fn new<const D: usize>(
        space: &P1<D>,
        (stiffness, mass): (Assembled<C>, Assembled<C>),
        (top, bottom): (Trace<D>, Trace<D>),
        closed: [bool; C],
        regime: Regime,
        seed: u64,
    ) -> Result<Self, FemError> {
        let [stiffness, mass] = [stiffness, mass].map(Assembled::into_matrix);
        let mut constraints = Constraints::none(space);
        constraints.fix(&top, [true; C])?;
        constraints.fix(&bottom, closed)?;
        let mut numbers = Numbers(seed);
        let mut exact: Vec<SVector<f64, C>> = (0..space.vertex_count())
            .map(|_| {
                SVector::from_fn(|c, _| {
                    let steady = if c == 0 && matches!(regime, Regime::Slip | Regime::Fresh) {
                        1e-3
                    } else {
                        0.0
                    };
                    steady + 2e-4 * numbers.next()
                })
            })
            .collect();
        for &p in top.vertices() {
            exact[p] = SVector::from_fn(|c, _| if c == 0 { 2e-4 } else { 0.0 });
        }
        let mut potentials = Vec::new();
        for (k, (&p, weight)) in bottom.vertices().iter().zip(bottom.weights()).enumerate() {
            let stuck = regime == Regime::Stick || (regime == Regime::Mixed && k % 2 == 0);
            for c in 0..C {
                if closed[c] {
                    exact[p][c] = 0.0;
                } else if stuck {
                    exact[p][c] = numbers.logarithmic(1e-30, 1e-20);
                } else if regime == Regime::Creep {
                    exact[p][c] = numbers.logarithmic(1e-13, 1e-4);
                }
            }
            let alpha = if stuck {
                2.0
            } else if regime == Regime::Fresh {
                let ln_cutoff = exact[p].norm().ln() + 2.0 * numbers.next();
                let aging = (LAW.reference_velocity.ln() - ln_cutoff) * LAW.a;
                (aging - LAW.reference_friction) / LAW.b
                    - (LAW.reference_velocity / LAW.slip_distance).ln()
            } else {
                (LAW.slip_distance / exact[p].norm()).ln() + 0.5 * numbers.next()
            };
            potentials.push(Radial {
                law: LAW,
                force: weight * NORMAL_STRESS,
                state: LogTheta(alpha),
            });
        }
        let mut problem = Self {
            norm: BlockMatrix::combination(&[(1.0, &stiffness), (1.0, &mass)]),
            operator: BlockMatrix::combination(&[(1.0, &stiffness), (1.0, &mass)]),
            stiffness,
            mass,
            equivalence: 0.0,
            load: Vec::new(),
            potentials,
            vertices: bottom.vertices().to_vec(),
            fixed: constraints.as_slice().to_vec(),
            transfers: space.transfers().into(),
            exact,
        };
        problem.set_time_step(TIME_STEP);
        Ok(problem)
    }

    /// The operator of Newmark's scheme for a time step, and the load that keeps the minimiser.
    pub(crate) fn set_time_step(&mut self, tau: f64) {
        self.operator
            .set_combination(&[(0.5 * tau, &self.stiffness), (2.0 / tau, &self.mass)]);
        self.equivalence = (0.5 * tau).min(2.0 / tau).recip();
        self.set_load();
    }

    /// `r = B v + grad Phi(v)` at the minimiser.
    pub(crate) fn set_load(&mut self) {
        let mut load = vec![SVector::zeros(); self.exact.len()];
        self.operator.multiply_add(1.0, &self.exact, &mut load);
        for (potential, &p) in self.potentials.iter().zip(&self.vertices) {
            let speed = self.exact[p].norm();
            let friction = potential.force * coefficient(speed, potential.state.0);
            load[p] += self.exact[p] * (friction / speed);
        }
        self.load = load;
    }

    /// Leaves the second of every three frictional vertices without friction.
    pub(crate) fn drop_every_third_friction(&mut self) {
        let keep: Vec<usize> = (0..self.vertices.len()).filter(|k| k % 3 != 1).collect();
        self.potentials = keep.iter().map(|&k| self.potentials[k]).collect();
        self.vertices = keep.iter().map(|&k| self.vertices[k]).collect();
        self.set_load();
    }

    /// Holds the first component of the first vertex that is free.
    pub(crate) fn hold_one_more(&mut self) -> Result<(), &'static str> {
        let free = self.fixed.iter().position(|fixed| fixed == &[false; C]);
        self.fixed[free.ok_or("no free vertex")?][0] = true;
        Ok(())
    }

    pub(crate) fn energy(&self) -> Energy<'_, BlockMatrix<C>, C> {
        Energy {
            operator: &self.operator,
            load: &self.load,
            potentials: &self.potentials,
            vertices: &self.vertices,
            fixed: &self.fixed,
        }
    }

    pub(crate) fn stopping(&self, tolerance: f64) -> Stopping<'_, BlockMatrix<C>> {
        Stopping {
            norm: &self.norm,
            tolerance,
            relative: 1e-14,
            equivalence: self.equivalence,
            max_iterations: 100_000,
        }
    }

    /// Prepares and minimises from `v`.
    pub(crate) fn solve(
        &self,
        solver: &mut impl NonsmoothSolver<BlockMatrix<C>, C>,
        tolerance: f64,
        v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError> {
        solver.prepare(&self.energy())?;
        solver.minimize(&self.energy(), &self.stopping(tolerance), v)
    }

    /// One iteration of a prepared solver, which knows no tolerance it could meet.
    pub(crate) fn iterate(
        &self,
        solver: &mut impl NonsmoothSolver<BlockMatrix<C>, C>,
        v: &mut [SVector<f64, C>],
    ) -> Result<(), SolveError> {
        self.iterate_often(solver, 1, v)
    }

    /// So many of them, as one minimisation.
    pub(crate) fn iterate_often(
        &self,
        solver: &mut impl NonsmoothSolver<BlockMatrix<C>, C>,
        count: usize,
        v: &mut [SVector<f64, C>],
    ) -> Result<(), SolveError> {
        let stopping = Stopping {
            tolerance: f64::MIN_POSITIVE,
            relative: 0.0,
            equivalence: f64::INFINITY,
            max_iterations: count,
            norm: &self.norm,
        };
        match solver.minimize(&self.energy(), &stopping, v) {
            Ok(_) | Err(SolveError::NotConverged { .. }) => Ok(()),
            Err(error) => Err(error),
        }
    }

    /// The distance of two fields in the norm of the stopping criterion.
    pub(crate) fn distance(&self, v: &[SVector<f64, C>], w: &[SVector<f64, C>]) -> f64 {
        let difference: Vec<_> = v.iter().zip(w).map(|(v, w)| v - w).collect();
        self.norm.norm(&difference)
    }

    pub(crate) fn error(&self, v: &[SVector<f64, C>]) -> f64 {
        self.distance(v, &self.exact)
    }

    pub(crate) fn size(&self) -> f64 {
        self.norm.norm(&self.exact)
    }

    /// The data on fixed components and `value` on the others.
    pub(crate) fn field(&self, mut value: impl FnMut() -> f64) -> Vec<SVector<f64, C>> {
        self.exact
            .iter()
            .zip(&self.fixed)
            .map(|(exact, fixed)| {
                SVector::from_fn(|c, _| {
                    let value = value();
                    if fixed[c] { exact[c] } else { value }
                })
            })
            .collect()
    }

    /// The body at rest.
    pub(crate) fn at_rest(&self) -> Vec<SVector<f64, C>> {
        self.field(|| 0.0)
    }

    /// The minimiser moved on all scales, by up to `size` a component.
    pub(crate) fn nearby(&self, size: f64, seed: u64) -> Vec<SVector<f64, C>> {
        let mut numbers = Numbers(seed);
        let count = self.exact.len() as f64;
        let mut v = self.exact.clone();
        for (i, (v, fixed)) in v.iter_mut().zip(&self.fixed).enumerate() {
            let wave = (3.0 * i as f64 / count).sin();
            for c in (0..C).filter(|&c| !fixed[c]) {
                v[c] += size * (0.5 * wave + 0.5 * numbers.next());
            }
        }
        v
    }

    /// A bound of the distance to the minimiser, from the gradient alone and without the known one:
    /// `norm(v - v*)_B <= norm(grad J(v))_(B^-1)`, because `J - v.Bv/2` is convex. Everything dense.
    pub(crate) fn certified_error(&self, v: &[SVector<f64, C>]) -> f64 {
        let (matrix, free) = self.dense();
        let position = |i: usize, c: usize| free.iter().position(|&dof| dof == (i, c));
        let all = DVector::from_iterator(C * v.len(), v.iter().flat_map(|v| v.iter().copied()));
        let mut gradient = DVector::from_iterator(
            free.len(),
            free.iter()
                .map(|&(i, c)| (matrix.row(C * i + c) * &all)[0] - self.load[i][c]),
        );
        for (potential, &p) in self.potentials.iter().zip(&self.vertices) {
            let speed = v[p].norm();
            let friction = potential.force * coefficient(speed, potential.state.0);
            for c in 0..C {
                if let Some(k) = position(p, c)
                    && speed > 0.0
                {
                    gradient[k] += friction * v[p][c] / speed;
                }
            }
        }
        let reduced = DMatrix::from_fn(free.len(), free.len(), |k, l| {
            matrix[(C * free[k].0 + free[k].1, C * free[l].0 + free[l].1)]
        });
        let image = reduced
            .cholesky()
            .expect("the operator is positive definite")
            .solve(&gradient);
        (self.equivalence * gradient.dot(&image)).sqrt()
    }

    /// The operator with all its components, and the free ones.
    pub(crate) fn dense(&self) -> (DMatrix<f64>, Vec<(usize, usize)>) {
        let free = (0..self.fixed.len())
            .flat_map(|i| (0..C).map(move |c| (i, c)))
            .filter(|&(i, c)| !self.fixed[i][c])
            .collect();
        (dense(&self.operator), free)
    }
}
