//! The external forces.

use std::ops::Range;
use std::sync::Arc;

use nalgebra::SVector;
use stickslip_solvers::Basis;

/// Fills a load, one vector per vertex \[N\], for a time \[s\].
pub(crate) type LoadHistory<const C: usize> =
    Arc<dyn Fn(f64, &mut [SVector<f64, C>]) + Send + Sync>;

/// A factor at a time \[s\].
pub(crate) type Factor = Arc<dyn Fn(f64) -> f64 + Send + Sync>;

/// A load in its given form.
#[derive(Clone)]
pub(crate) enum Load<const C: usize> {
    Constant(Vec<SVector<f64, C>>),
    /// A field times a factor that depends on time.
    Scaled(Vec<SVector<f64, C>>, Factor),
    History(LoadHistory<C>),
}

/// The sum of all loads.
#[derive(Clone)]
pub(crate) struct Loads<const C: usize> {
    /// The sum of the constant loads; empty without constant loads.
    constant: Vec<SVector<f64, C>>,
    scaled: Vec<Scaled<C>>,
    histories: Vec<LoadHistory<C>>,
    /// The basis of the loads; their functions use coordinates.
    basis: Basis<C>,
}

/// A load times a factor, at the vertices where it is not zero.
#[derive(Clone)]
struct Scaled<const C: usize> {
    /// The loaded vertices, increasing.
    vertices: Vec<usize>,
    forces: Vec<SVector<f64, C>>,
    factor: Factor,
}

impl<const C: usize> Scaled<C> {
    fn new(load: &[SVector<f64, C>], factor: Factor) -> Self {
        let loaded = load.iter().enumerate();
        let loaded = loaded.filter(|(_, force)| force.iter().any(|&component| component != 0.0));
        let (vertices, forces) = loaded.map(|(vertex, force)| (vertex, *force)).unzip();
        Self {
            vertices,
            forces,
            factor,
        }
    }

    /// The loaded vertices in a range, and their forces without the factor.
    fn within(&self, range: Range<usize>) -> impl Iterator<Item = (usize, &SVector<f64, C>)> {
        let place = |vertex| self.vertices.partition_point(|own| *own < vertex);
        let places = place(range.start)..place(range.end);
        let vertices = self.vertices[places.clone()].iter().copied();
        vertices.zip(&self.forces[places])
    }
}

impl<const C: usize> Loads<C> {
    /// Adds up the constant loads, and changes them to the basis of the body.
    pub(crate) fn new(loads: Vec<Load<C>>, basis: &Basis<C>) -> Self {
        let mut sum = Self {
            constant: Vec::new(),
            scaled: Vec::new(),
            histories: Vec::new(),
            basis: basis.clone(),
        };
        for load in loads {
            match load {
                Load::History(history) => sum.histories.push(history),
                Load::Scaled(mut load, factor) => {
                    basis.forces_to_basis(&mut load);
                    sum.scaled.push(Scaled::new(&load, factor));
                }
                Load::Constant(load) if sum.constant.is_empty() => sum.constant = load,
                Load::Constant(load) => {
                    for (sum, load) in sum.constant.iter_mut().zip(load) {
                        *sum += load;
                    }
                }
            }
        }
        if !sum.constant.is_empty() {
            basis.forces_to_basis(&mut sum.constant);
        }
        sum
    }

    /// Memory for [`fill`](Self::fill): a field where several histories add up, else nothing.
    pub(crate) fn scratch(&self, size: usize) -> Vec<SVector<f64, C>> {
        let several = self.histories.len() > 1;
        vec![SVector::zeros(); if several { size } else { 0 }]
    }

    /// Whether any of the loads depends on time.
    pub(crate) fn vary(&self) -> bool {
        self.fill_fields() || !self.scaled.is_empty()
    }

    /// Whether functions fill whole fields.
    pub(crate) fn fill_fields(&self) -> bool {
        !self.histories.is_empty()
    }

    /// Writes the load at a time to a range of vertices; without functions that [fill fields](Self::fill_fields).
    pub(crate) fn fill_range(
        &self,
        time: f64,
        range: Range<usize>,
        target: &mut [SVector<f64, C>],
    ) {
        match self.constant.get(range.clone()) {
            Some(constant) => target.copy_from_slice(constant),
            None => target.fill(SVector::zeros()),
        }
        self.add_scaled(time, range, target);
    }

    fn add_scaled(&self, time: f64, range: Range<usize>, target: &mut [SVector<f64, C>]) {
        let first = range.start;
        for (vertex, force) in self.scaled_in(time, range) {
            target[vertex - first] += force;
        }
    }

    /// The constant load of a vertex.
    pub(crate) fn constant_at(&self, vertex: usize) -> SVector<f64, C> {
        let constant = self.constant.get(vertex);
        constant.copied().unwrap_or_else(SVector::zeros)
    }

    /// The loads of fixed shape at a time on a range of vertices.
    pub(crate) fn scaled_in(
        &self,
        time: f64,
        range: Range<usize>,
    ) -> impl Iterator<Item = (usize, SVector<f64, C>)> {
        self.scaled.iter().flat_map(move |scaled| {
            let mut loaded = scaled.within(range.clone()).peekable();
            // The factor may be an expensive one, and the range without a force.
            let any = loaded.peek().is_some();
            let factor = if any { (scaled.factor)(time) } else { 0.0 };
            loaded.map(move |(vertex, force)| (vertex, force * factor))
        })
    }

    /// The work of the constant loads on the way to a displacement \[J\].
    pub(crate) fn constant_work(&self, displacement: &[SVector<f64, C>]) -> f64 {
        let vertices = self.constant.iter().zip(displacement);
        vertices.map(|(load, u)| load.dot(u)).sum()
    }

    /// Subtracts the constant loads from a load.
    pub(crate) fn take_constant(&self, load: &mut [SVector<f64, C>]) {
        for (load, constant) in load.iter_mut().zip(&self.constant) {
            *load -= constant;
        }
    }

    /// Writes the load at a time.
    pub(crate) fn fill(
        &self,
        time: f64,
        target: &mut [SVector<f64, C>],
        scratch: &mut [SVector<f64, C>],
    ) {
        match self.histories.split_first() {
            None if self.constant.is_empty() => target.fill(SVector::zeros()),
            None => target.copy_from_slice(&self.constant),
            Some((first, others)) => {
                target.fill(SVector::zeros());
                first(time, target);
                self.basis.forces_to_basis(target);
                for (target, constant) in target.iter_mut().zip(&self.constant) {
                    *target += constant;
                }
                for history in others {
                    scratch.fill(SVector::zeros());
                    history(time, scratch);
                    self.basis.forces_to_basis(scratch);
                    for (target, load) in target.iter_mut().zip(&*scratch) {
                        *target += load;
                    }
                }
            }
        }
        self.add_scaled(time, 0..target.len(), target);
    }
}
