//! Truncated nonsmooth Newton multigrid.

mod system;

use nalgebra::SVector;

use stickslip_core::compiled;

use crate::block::check_blocks;
use crate::linear_step::{LinearStep, LinearSystem};
use crate::multigrid::Multigrid;
use crate::newton::{self, Ending, Friction, Models};
use crate::parts::inside;
use crate::sweep::Sweep;
use crate::{
    Basis, BlockMatrix, Counters, Energy, Matrix, MeshId, NonsmoothSolver, SolveError, SolveReport,
    Stopping, Transfers,
};
use system::SparseSystem;

/// Truncated nonsmooth Newton multigrid on a hierarchy of levels.
///
/// One iteration on `v`:
///
/// 1. a nonlinear block Gauss-Seidel sweep, each local problem solved exactly;
/// 2. truncation: the components near which the potentials are twice differentiable, with a
///    curvature below `truncation` times the operator's diagonal, stay unknowns;
/// 3. a linear multigrid step for the Newton system on these, see [`LinearStep`];
/// 4. projection of the correction to where the second-order model holds;
/// 5. a line search, by which the energy never grows.
///
/// The first part alone converges, so the whole does from every start; near the solution it is as
/// fast as linear multigrid. See C. Gräser, O. Sander, "Truncated nonsmooth Newton multigrid
/// methods for block-separable minimization problems", IMA J. Numer. Anal. 39 (2019).
///
/// Cells may be stretched. From an aspect ratio of about 2.5 on, the cycle uses a line smoother, over the lines or
/// planes of strongly coupled vertices. On cells of 1e4 : 1 a problem takes no more cycles than on squares. Poisson's
/// ratios near one half cost cycles, some 400 per step at 0.4999 on a slider of 1400 vertices, since coarse meshes of
/// linear elements are the stiffer the less they can be compressed. If the finest level has at most 20 000 unknowns, a
/// factor of it replaces such slow cycles, up to the end of the minimisation: some 20 are left, its solves included.
/// Its memory is allocated at first use.
///
/// The levels are nested meshes, or, below a mesh without coarser ones, some of its vertices: auxiliary levels, which
/// were measured to take the same numbers of cycles. A cycle takes about 1.2 times as long in the plane and 1.6 times
/// in space, since coarse vertices have more neighbours. On such meshes, too, [`Condensed`](crate::Condensed) is faster
/// in the plane, at 24 000 vertices by a factor of 4 to 7. In space from some 8000 vertices on, and with thousands of
/// frictional vertices, multigrid is as fast or faster on a sliding body, and is prepared in a thirtieth of the time.
///
/// It fails with [`SolveError::NotConverged`] if thousands of further iterations would be needed, or if there is no
/// minimum. [`Condensed`](crate::Condensed) depends on neither shapes nor materials.
///
/// The default is conjugate gradients with V(1, 1). On a slipping slider of 83 000 vertices it was measured at 147 ms
/// per time step and 27 cycles; V(2, 2) at 174 ms and 21, V(3, 3) at 202 ms and 19.
#[derive(Debug)]
#[doc(alias = "truncated nonsmooth Newton multigrid")]
pub struct Tnnmg<const C: usize> {
    linear_step: LinearStep,
    truncation: f64,
    sweep: Sweep<C>,
    multigrid: Multigrid<C>,
    linear: LinearSystem<C>,
    models: Models<C>,
    /// Minus the change of the iterate by the sweep; at the end of an iteration, by all of it.
    moved: Vec<SVector<f64, C>>,
    /// Whether the operator does not resist a translation, so that friction alone can support the body.
    unsupported: bool,
    counters: Counters,
}

impl<const C: usize> Tnnmg<C> {
    /// A solver for the finest of the levels that `transfers` connect: nested meshes, or auxiliary levels below a
    /// finest mesh.
    pub fn new(transfers: impl Into<Transfers>) -> Self {
        let transfers = transfers.into();
        Self {
            linear_step: LinearStep::ConjugateGradients {
                reduction: 1e-2,
                max_cycles: 1000,
            },
            truncation: 1e4,
            sweep: Sweep::default(),
            multigrid: Multigrid::new(&transfers, 1, 1),
            linear: LinearSystem::default(),
            models: Models::default(),
            moved: Vec::new(),
            unsupported: false,
            counters: Counters::default(),
        }
    }

    /// Sets the number of smoothing sweeps before and after the coarse correction.
    #[must_use]
    pub fn with_cycle(mut self, pre: usize, post: usize) -> Self {
        (self.multigrid.pre, self.multigrid.post) = (pre, post);
        self
    }

    /// Keeps the blocks that cycles read in single precision: for large bodies, whose steps are bound by memory traffic.
    ///
    /// Residuals, friction and energies stay in double precision, so that the iteration converges to the same minimiser.
    /// Blocks are relative to a power of two per row, and diagonal blocks take up what the others lose: the energy
    /// of a rounded matrix differs by a small multiple of 6e-8, on fine meshes as on coarse ones, in any unit and with
    /// stiffnesses that differ by orders of magnitude. The error estimate counts that difference. Where a linear step
    /// would reduce an error by more than it allows, an iteration more is taken.
    ///
    /// In a body of 1.2e6 unknowns in space a velocity problem was measured to take 0.8 of the time, with as many cycles, on
    /// a machine that was busy with other work. Preparation takes longer, by a third to a half.
    ///
    /// Levels with a line smoother, and a factor that replaces slow cycles, stay in double precision.
    #[must_use]
    pub fn in_single_precision(mut self) -> Self {
        self.multigrid.single = true;
        self
    }

    /// Sets the linear step.
    #[must_use]
    pub fn with_linear_step(mut self, linear_step: LinearStep) -> Self {
        self.linear_step = linear_step;
        self
    }

    /// Sets the curvature, relative to the operator's diagonal block, from which a component is left to the sweep
    /// alone. The default is `1e4`. Convergence hardly depends on it.
    #[must_use]
    pub fn with_truncation(mut self, ratio: f64) -> Self {
        self.truncation = ratio;
        self
    }
}

impl<const C: usize> NonsmoothSolver<BlockMatrix<C>, C> for Tnnmg<C> {
    fn boxed_clone(&self) -> Box<dyn NonsmoothSolver<BlockMatrix<C>, C>> {
        Box::new(Self {
            linear_step: self.linear_step,
            truncation: self.truncation,
            multigrid: self.multigrid.unprepared(),
            ..Self::new(Transfers::default())
        })
    }

    fn change_basis(&mut self, basis: &Basis<C>) {
        self.multigrid.change_basis(basis);
    }

    fn prepare(&mut self, energy: &Energy<'_, BlockMatrix<C>, C>) -> Result<(), SolveError> {
        self.counters.preparations += 1;
        self.models.resize(energy.vertices.len());
        self.sweep.prepare(energy)?;
        check_blocks(energy.operator, energy.fixed)?;
        inside(energy.operator.rows(), || {
            (self.multigrid).prepare(energy.operator, energy.fixed, energy.vertices)
        })?;
        let size = energy.operator.rows();
        self.moved.resize(size, SVector::zeros());
        let basis = self.multigrid.basis();
        let (directions, count) = basis.free_translations(energy.fixed);
        self.unsupported = (directions[..count].iter())
            .any(|direction| basis.moves_freely(energy.operator, direction, &mut self.moved));
        self.linear.resize(size);
        Ok(())
    }

    fn minimize(
        &mut self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        stopping: &Stopping<'_, BlockMatrix<C>>,
        v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError> {
        self.sweep.check(energy, stopping.norm, v)?;
        self.multigrid.cycle_again();
        let relative = stopping.relative * stopping.norm.norm(v);
        let mut system = SparseSystem {
            energy,
            stopping,
            linear_step: self.linear_step,
            reduction: match self.linear_step {
                LinearStep::Cycle => 0.0,
                LinearStep::ConjugateGradients { reduction, .. } => reduction,
            },
            tolerance: stopping.tolerance.max(relative),
            previous: f64::INFINITY,
            cycles: 0,
            linear_error: 0.0,
            curvature: 0.0,
            sweep: &self.sweep,
            multigrid: &mut self.multigrid,
            linear: &mut self.linear,
            moved: &mut self.moved,
            unsupported: self.unsupported,
        };
        let friction = Friction {
            potentials: energy.potentials,
            vertices: energy.vertices,
            fixed: energy.fixed,
        };
        let (models, limit) = (&mut self.models, stopping.max_iterations);
        let ratio = self.truncation;
        let ending = inside(v.len(), || {
            newton::minimize(&mut system, models, &friction, ratio, limit, v)
        });
        let cycles = system.cycles;
        let Ending { iterations, error } = ending?;
        Ok(SolveReport {
            iterations,
            cycles,
            error,
        })
    }

    fn mesh(&self) -> Option<MeshId> {
        self.multigrid.mesh
    }

    fn counters(&self) -> Counters {
        self.counters
    }

    fn into_object(self) -> Box<dyn NonsmoothSolver<BlockMatrix<C>, C>> {
        object(self)
    }
}

compiled! {
    fn object<C>(solver: Tnnmg<C>) -> Box<dyn NonsmoothSolver<BlockMatrix<C>, C>> {
        Box::new(solver)
    }
}
