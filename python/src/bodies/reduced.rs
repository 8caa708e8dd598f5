//! Bodies after a Craig-Bampton reduction to their contacts.

use stickslip::nalgebra::SVector;
use stickslip::reduced::{Reduced, ReducedBody};
use stickslip::{BlockMatrix, Scene, SceneError, Snapshot};

/// The modes of a reduced body.
#[derive(Clone, Copy)]
pub(super) enum Modes {
    /// Those up to a frequency \[Hz\].
    UpTo(f64),
    /// Those that steps of a size \[s\] resolve.
    ForStep(f64),
}

impl Modes {
    /// The reduction of a scene.
    pub(super) fn reduced<const C: usize>(
        self,
        scene: &Scene<BlockMatrix<C>, C>,
    ) -> Result<ReducedBody<C>, SceneError> {
        let reduced = Reduced::new(scene);
        match self {
            Self::UpTo(frequency) => reduced.up_to_frequency(frequency),
            Self::ForStep(dt) => reduced.for_time_step(dt),
        }
    }
}

/// The way back to the whole body.
pub(super) struct Whole<const C: usize> {
    body: ReducedBody<C>,
    /// Constant forces \[N\], empty if there are none.
    load: Vec<SVector<f64, C>>,
    /// The vertices of the mesh, by those of the reduced body.
    vertices: Vec<usize>,
}

/// A vector per vertex.
pub(super) type Field<const C: usize> = Vec<SVector<f64, C>>;

impl<const C: usize> Whole<C> {
    /// That of a body with so many vertices.
    pub(super) fn new(body: ReducedBody<C>, load: Field<C>, count: usize) -> Self {
        let mut pairs: Vec<_> = (0..count)
            .filter_map(|vertex| body.vertex(vertex).map(|reduced| (reduced, vertex)))
            .collect();
        pairs.sort_unstable();
        Self {
            body,
            load,
            vertices: pairs.into_iter().map(|(_, vertex)| vertex).collect(),
        }
    }

    /// Displacements \[m\] and velocities [m/s] of all vertices.
    pub(super) fn fields(&self, at: &Snapshot<'_, C>) -> Result<(Field<C>, Field<C>), SceneError> {
        let displacement = if self.load.is_empty() {
            self.body.displacement(at)?
        } else {
            self.body.displacement_under(&self.load, at)?
        };
        Ok((displacement, self.body.velocity(at)?))
    }

    /// The vertex of the mesh of a reduced one.
    pub(super) fn vertex(&self, reduced: usize) -> usize {
        self.vertices[reduced]
    }

    /// The frequencies of the modes \[Hz\].
    pub(super) fn frequencies(&self) -> Vec<f64> {
        self.body.frequencies().collect()
    }
}
