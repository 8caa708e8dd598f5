//! The external forces.

use std::sync::Arc;

use nalgebra::SVector;
use stickslip_solvers::Basis;

/// Fills a load, one vector per vertex \[N\], for a time \[s\].
pub(crate) type LoadHistory<const C: usize> =
    Arc<dyn Fn(f64, &mut [SVector<f64, C>]) + Send + Sync>;

/// A load in its given form.
#[derive(Clone)]
pub(crate) enum Load<const C: usize> {
    Constant(Vec<SVector<f64, C>>),
    History(LoadHistory<C>),
}

/// The sum of all loads.
#[derive(Clone)]
pub(crate) struct Loads<const C: usize> {
    /// The sum of the constant loads; empty without constant loads.
    constant: Vec<SVector<f64, C>>,
    histories: Vec<LoadHistory<C>>,
    /// The basis of the loads; their functions use coordinates.
    basis: Basis<C>,
}

impl<const C: usize> Loads<C> {
    /// Adds up the constant loads, and changes them to the basis of the body.
    pub(crate) fn new(loads: Vec<Load<C>>, basis: &Basis<C>) -> Self {
        let mut sum = Self {
            constant: Vec::new(),
            histories: Vec::new(),
            basis: basis.clone(),
        };
        for load in loads {
            match load {
                Load::History(history) => sum.histories.push(history),
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
        !self.histories.is_empty()
    }

    /// The work of the constant loads on the way to a displacement \[J\].
    pub(crate) fn constant_work(&self, displacement: &[SVector<f64, C>]) -> f64 {
        let vertices = self.constant.iter().zip(displacement);
        vertices.map(|(load, u)| load.dot(u)).sum()
    }

    /// The constant loads from a vertex on; empty without any.
    pub(crate) fn constant_from(&self, first: usize) -> &[SVector<f64, C>] {
        self.constant.get(first..).unwrap_or_default()
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
    }
}
