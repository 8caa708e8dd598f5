//! The memory and the goal of a dense system.

use std::sync::Arc;

use nalgebra::SVector;

use crate::newton::{self, Ending, Friction, Models};
use crate::{SolveError, SolveReport};

use super::factor::Factor;
use super::gradients::Gradients;
use super::matrix::DenseMatrix;
use super::system::DenseSystem;
use super::unknowns::Unknowns;

/// The goal of the iteration.
pub(crate) struct Goal {
    pub(crate) tolerance: f64,
    /// A bound of the squared stopping norm by the squared energy norm.
    pub(crate) equivalence: f64,
    /// Whether a field at the level of its rounding errors is accepted.
    pub(crate) rounding: bool,
    pub(crate) max_iterations: usize,
}

/// The memory of a dense system.
#[derive(Debug)]
pub(crate) struct Workspace<const C: usize> {
    pub(crate) unknowns: Arc<Unknowns<C>>,
    models: Models<C>,
    /// The velocities at the start of an iteration.
    pub(super) start: Vec<SVector<f64, C>>,
    pub(super) direction: Vec<SVector<f64, C>>,
    /// `g`.
    pub(crate) force: Vec<f64>,
    /// `g - S y`.
    pub(super) residual: Vec<f64>,
    /// Minus the gradient of the energy on the kept unknowns.
    pub(super) descent: Vec<f64>,
    pub(super) correction: Vec<f64>,
    pub(super) factor: Factor,
    pub(super) gradients: Gradients<C>,
}

impl<const C: usize> Workspace<C> {
    /// Allocates, with `frictional` potentials; `None` without the memory.
    pub(crate) fn new(unknowns: Unknowns<C>, frictional: usize) -> Option<Self> {
        let (size, count) = (unknowns.vertices(), unknowns.count());
        let mut models = Models::default();
        models.resize(frictional);
        Some(Self {
            models,
            start: vec![SVector::zeros(); size],
            direction: vec![SVector::zeros(); size],
            force: vec![0.0; count],
            residual: vec![0.0; count],
            descent: vec![0.0; count],
            correction: vec![0.0; count],
            factor: Factor::new(count)?,
            gradients: Gradients::new(&unknowns),
            unknowns: Arc::new(unknowns),
        })
    }

    /// Scratch memory for a matrix of all unknowns, free between minimisations.
    pub(crate) fn scratch(&mut self) -> &mut [f64] {
        self.factor.scratch()
    }

    /// Whether `matrix` stays positive definite with `slopes` on the diagonal at the frictional `vertices`.
    pub(crate) fn is_definite_with(
        &mut self,
        matrix: &DenseMatrix,
        vertices: &[usize],
        slopes: &[f64],
    ) -> bool {
        (self.factor).is_definite_with(matrix, &self.unknowns, vertices, slopes)
    }

    /// Moves `y` to the minimiser; `norm` measures a change of `y` in the stopping norm.
    pub(crate) fn minimize(
        &mut self,
        matrix: &DenseMatrix,
        friction: &Friction<'_, C>,
        ratio: f64,
        goal: &Goal,
        norm: &mut dyn FnMut(&[SVector<f64, C>]) -> f64,
        y: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError> {
        let mut models = std::mem::take(&mut self.models);
        let mut system = DenseSystem::new(matrix, friction, goal, norm, self, y);
        let limit = goal.max_iterations;
        let ending = newton::minimize(&mut system, &mut models, friction, ratio, limit, y);
        self.models = models;
        let Ending { iterations, error } = ending?;
        Ok(SolveReport {
            iterations,
            cycles: 0,
            error,
        })
    }
}
