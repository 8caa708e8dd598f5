//! The source of a snapshot.

use nalgebra::SVector;
use stickslip_solvers::MeshId;

use super::GlobalFields;
use crate::StepState;
use crate::body::Matrices;
use crate::contact::ContactSet;
use crate::placement::Constraints;
use crate::scene::Loads;

/// The data from which a snapshot is taken.
pub(crate) trait StepView<const C: usize> {
    fn state(&self) -> &StepState<C>;

    fn contacts(&self) -> &ContactSet<C>;

    fn loads(&self) -> &Loads<C>;

    fn constraints(&self) -> &Constraints<C>;

    fn matrices(&self) -> &dyn Matrices<C>;

    /// The body's mesh, if it is known.
    fn mesh(&self) -> Option<MeshId>;

    /// The fields in coordinates; without local axes and links they are those of the state.
    fn fields(&self) -> &GlobalFields<C>;

    /// The time at which its data were evaluated: on the left side of a stop \[s\].
    fn data_time(&self) -> f64;

    /// How long before its end the last step saw the velocity of lagged viscosities \[s\]: they resist `v - lag a`.
    fn lag(&self) -> f64 {
        0.0
    }

    /// The change of the force on a vertex per change of its velocity [N s/m].
    fn diagonal_stiffness(&self, vertex: usize) -> f64;

    /// `l - M a - C v - A u` at each of `vertices`: the forces in balance with friction and reactions \[N\].
    fn unbalanced_at(&self, vertices: &[usize], forces: &mut [SVector<f64, C>]);

    /// The same at one vertex.
    fn unbalanced(&self, vertex: usize) -> SVector<f64, C> {
        let mut force = [SVector::zeros()];
        self.unbalanced_at(&[vertex], &mut force);
        force[0]
    }

    /// The share of the force at the end of the last step in the mean force that did its work.
    fn work_share(&self) -> f64 {
        0.5
    }

    /// The forces of [`unbalanced_at`](Self::unbalanced_at) from which the next step starts, if an impact parts both.
    fn unbalanced_behind_impact(&self, _vertices: &[usize], _forces: &mut [SVector<f64, C>]) {}

    /// Rotates a vector at a vertex from its local frame to coordinates.
    fn to_coordinates(&self, vertex: usize, vector: SVector<f64, C>) -> SVector<f64, C> {
        self.fields().basis().axes.to_coordinates(vertex, vector)
    }

    /// Whether a component has a Dirichlet condition.
    fn is_fixed(&self, vertex: usize, component: usize) -> bool {
        self.constraints().fixed[vertex][component]
    }

    /// Whether a component has a prescribed velocity.
    fn is_moved(&self, vertex: usize, component: usize) -> bool {
        self.constraints().is_moved(vertex, component)
    }

    /// Kinetic and elastic energy, `v . M v / 2` and `u . A u / 2` [J; J/m in 2D].
    fn energies(&self) -> [f64; 2] {
        let state = self.state();
        self.matrices()
            .energies(&state.velocity, &state.displacement)
    }
}
