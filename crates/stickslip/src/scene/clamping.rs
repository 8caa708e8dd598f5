//! A normal stress change with its loading by a plate.

use std::sync::Arc;

use nalgebra::SVector;
use stickslip_friction::Nodal;
use stickslip_solvers::NormalStressChange;

use crate::SceneError;
use crate::checks::{finite, length};

pub(crate) const NORMAL_STRESS_CHANGE: &str = "normal stress change";

/// A change with its loading by a plate, in a scene.
#[derive(Clone)]
pub(crate) struct Clamping<const C: usize> {
    change: Arc<dyn NormalStressChange<C>>,
    /// `-N V_p` [Pa/s].
    loading: Vec<f64>,
    /// The change of the normal stress in force at each vertex \[Pa\].
    pub(crate) values: Vec<f64>,
}

impl<const C: usize> Clamping<C> {
    pub(super) fn new(
        change: Arc<dyn NormalStressChange<C>>,
        plate: &Nodal<SVector<f64, C>>,
        size: usize,
    ) -> Result<Self, SceneError> {
        if change.vertex_count() != size {
            return Err(SceneError::Length {
                what: NORMAL_STRESS_CHANGE,
                expected: size,
                found: change.vertex_count(),
            });
        }
        length("plate velocity", plate, size)?;
        let moved: Vec<_> = (0..size).map(|k| *plate.at(k)).collect();
        for (k, velocity) in moved.iter().enumerate() {
            (velocity.iter()).try_for_each(|&value| finite("plate velocity", k, value))?;
        }
        let mut loading = vec![0.0; size];
        change.add(-1.0, &moved, &mut loading);
        for (k, &value) in loading.iter().enumerate() {
            finite(NORMAL_STRESS_CHANGE, k, value)?;
        }
        Ok(Self {
            change,
            loading,
            values: vec![0.0; size],
        })
    }

    /// Sets the values in force to those of a time and a displacement.
    pub(crate) fn follow(&mut self, time: f64, displacement: &[SVector<f64, C>]) {
        for (value, loading) in self.values.iter_mut().zip(&self.loading) {
            *value = loading * time;
        }
        self.change.add(1.0, displacement, &mut self.values);
    }

    /// The angle by which the fault bends at a vertex \[degrees\].
    pub(crate) fn bend(&self, vertex: usize) -> Option<f64> {
        self.change.bend(vertex)
    }

    /// The rate by the plate [Pa/s].
    #[cfg(feature = "checkpoint")]
    pub(crate) fn loading(&self) -> &[f64] {
        &self.loading
    }

    /// Writes the change due to a small displacement.
    pub(crate) fn change_of(&self, displacement: &[SVector<f64, C>], change: &mut [f64]) {
        change.fill(0.0);
        self.change.add(1.0, displacement, change);
    }
}
