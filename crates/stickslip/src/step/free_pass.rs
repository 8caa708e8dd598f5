//! The work of an explicit step at a run of vertices, while they are in the cache.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

use nalgebra::SVector;
use stickslip_time::UpdateFormula;

use super::local_steps::weights_after;
use super::{Operators, Problem};
use crate::StepState;
use crate::scene::Loads;

/// What an explicit step knows of each vertex beside its force.
pub(super) struct Pass<'a, const C: usize> {
    /// The loads, unless functions fill whole fields, and the time at which they act \[s\].
    loads: Option<&'a Loads<C>>,
    time: f64,
    /// `m_i` \[kg\].
    mass: &'a [f64],
    /// The diagonals of the inverse blocks of `B` [m/(N s)].
    compliances: &'a [SVector<f64, C>],
    /// `c_a` [1/s].
    c_a: f64,
    /// The lowest level of the cells of each vertex; empty if all vertices have cells that act.
    lowest: &'a [u8],
    /// The highest level that acts.
    highest: u8,
    finite: AtomicBool,
}

/// Neighbouring vertices, of which all or none have cells that act in the step.
pub(super) struct Run {
    pub(super) vertices: Range<usize>,
    /// No cell acts: the load is that of the scene alone.
    pub(super) idle: bool,
}

impl Run {
    /// Its places in a part that begins at vertex `first`.
    pub(super) fn within(&self, first: usize) -> Range<usize> {
        self.vertices.start - first..self.vertices.end - first
    }
}

impl<'a, const C: usize> Pass<'a, C> {
    /// The pass, and the vertices that are not free; none for bodies whose steps are not of this kind.
    pub(super) fn new(
        p: &'a Problem<C>,
        operators: &'a mut Operators<C>,
        start: &StepState<C>,
        (formula, time): (&UpdateFormula, f64),
    ) -> Option<(Self, &'a [usize])> {
        let mass = p.matrices.mass()?.lumps()?;
        let product = p.matrices.stiffness().by_parts()?;
        let free = operators.body.free_vertices()?;
        let loads = (!p.loads.fill_fields()).then_some(&p.loads);
        let acts = weights_after(start.clock.step() + 1);
        let highest = acts.iter().rposition(|&weight| weight != 0.0);
        let pass = Self {
            loads,
            time,
            mass,
            compliances: free.compliances,
            c_a: formula.acceleration.new_velocity,
            lowest: loads.map_or(&[], |_| product.lowest_levels()),
            highest: highest.unwrap_or_default() as u8,
            finite: AtomicBool::new(true),
        };
        Some((pass, free.others))
    }

    /// The runs of a part of the vertices.
    pub(super) fn runs(&self, part: Range<usize>) -> impl Iterator<Item = Run> {
        let levels = self.lowest.get(part.clone()).unwrap_or_default();
        let whole = levels.is_empty().then_some(Run {
            vertices: part.clone(),
            idle: false,
        });
        let idle = |level: u8| level > self.highest;
        let mut begin = part.start;
        let runs = levels.chunk_by(move |&a, &b| idle(a) == idle(b));
        whole.into_iter().chain(runs.map(move |levels| {
            let vertices = begin..begin + levels.len();
            begin = vertices.end;
            Run {
                vertices,
                idle: idle(levels[0]),
            }
        }))
    }

    /// Fills the load of a run, unless functions fill whole fields.
    pub(super) fn begin(&self, run: &Run, load: &mut [SVector<f64, C>]) {
        if let Some(loads) = self.loads {
            loads.fill_range(self.time, run.vertices.clone(), load);
        }
    }

    /// `r -= M a^`, `v = B^-1 r`, `a = a^ + c_a v`.
    pub(super) fn finish(&self, run: &Run, [load, v, a]: [&mut [SVector<f64, C>]; 3]) {
        let vertices = run.vertices.clone();
        let (mass, compliances) = (&self.mass[vertices.clone()], &self.compliances[vertices]);
        let mut sum = SVector::<f64, C>::zeros();
        let fields = load.iter_mut().zip(v).zip(a).zip(mass).zip(compliances);
        for ((((load, v), a), mass), compliance) in fields {
            *load -= *a * *mass;
            *v = compliance.component_mul(load);
            *a += *v * self.c_a;
            sum += *v;
        }
        // Of a load that is not finite this is no velocity either.
        if !sum.sum().is_finite() {
            self.finite.store(false, Ordering::Relaxed);
        }
    }

    /// `m_i a` of a vertex.
    pub(super) fn inertia(&self, vertex: usize, acceleration: &SVector<f64, C>) -> SVector<f64, C> {
        acceleration * self.mass[vertex]
    }

    /// Whether all velocities so far are.
    pub(super) fn is_finite(&self) -> bool {
        self.finite.load(Ordering::Relaxed)
    }
}
