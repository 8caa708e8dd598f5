//! The fields of the whole body, recovered from those of the reduced one.

use nalgebra::SVector;

use super::ReducedBody;
use super::projector::add;
use crate::{MeshMismatch, SceneError, Snapshot};

impl<const C: usize> ReducedBody<C> {
    /// The displacement of the whole body, one vector per vertex \[m\], for a load that is zero or acts on retained
    /// vertices; otherwise use [`displacement_under`](Self::displacement_under).
    ///
    /// # Errors
    /// [`SceneError::Mesh`] or [`SceneError::Length`] for a snapshot of another body.
    pub fn displacement(&self, at: &Snapshot<'_, C>) -> Result<Vec<SVector<f64, C>>, SceneError> {
        self.check_seen(at)?;
        self.whole(at.displacement, None)
    }

    /// The displacement of the whole body under the load of a scene at the time of the snapshot \[m\].
    ///
    /// # Errors
    /// [`SceneError::Mesh`] or [`SceneError::Length`] for a snapshot of another body.
    pub fn displacement_under(
        &self,
        load: &[SVector<f64, C>],
        at: &Snapshot<'_, C>,
    ) -> Result<Vec<SVector<f64, C>>, SceneError> {
        self.check_seen(at)?;
        self.whole(at.displacement, Some(load))
    }

    /// The velocity of the whole body, one vector per vertex [m/s], under a load that changes slowly.
    ///
    /// # Errors
    /// [`SceneError::Mesh`] or [`SceneError::Length`] for a snapshot of another body.
    pub fn velocity(&self, at: &Snapshot<'_, C>) -> Result<Vec<SVector<f64, C>>, SceneError> {
        self.check_seen(at)?;
        self.whole(at.velocity, None)
    }

    /// Refuses a snapshot of another body.
    fn check_seen(&self, at: &Snapshot<'_, C>) -> Result<(), SceneError> {
        MeshMismatch::check("snapshot", Some(self.mesh), at.source().mesh())?;
        Ok(())
    }

    fn whole(
        &self,
        field: &[SVector<f64, C>],
        load: Option<&[SVector<f64, C>]>,
    ) -> Result<Vec<SVector<f64, C>>, SceneError> {
        let mut whole = self.projector.combine(&self.coordinates(field)?)?;
        if let Some(load) = load {
            crate::scene::check_field("load", load, whole.len())?;
            let mut load = load.to_vec();
            self.support.basis.forces_to_basis(&mut load);
            add(&mut whole, 1.0, &self.projector.offset(&load)?);
        }
        self.support.basis.field_to_coordinates(&mut whole);
        Ok(whole)
    }
}
