//! The state of motion at the start.

use nalgebra::SVector;
use stickslip_solvers::{LinearSolver, Operator};

use super::Scene;

/// An empty field is zero.
pub(crate) struct Initial<Op, const C: usize> {
    pub(crate) time: f64,
    /// What finds the displacement that balances the load, if it is asked for.
    pub(crate) equilibrium: Option<Box<dyn LinearSolver<Op, C>>>,
    pub(crate) displacement: Vec<SVector<f64, C>>,
    /// Slip rates are those that stresses and states imply.
    pub(crate) balanced: bool,
    pub(crate) velocity: Vec<SVector<f64, C>>,
    pub(crate) acceleration: Vec<SVector<f64, C>>,
}

impl<Op, const C: usize> Default for Initial<Op, C> {
    fn default() -> Self {
        Self {
            time: 0.0,
            equilibrium: None,
            displacement: Vec::new(),
            balanced: false,
            velocity: Vec::new(),
            acceleration: Vec::new(),
        }
    }
}

/// A field that was given, or zero.
pub(crate) fn or_zeros<const C: usize>(
    field: &[SVector<f64, C>],
    size: usize,
) -> Vec<SVector<f64, C>> {
    if field.is_empty() {
        vec![SVector::zeros(); size]
    } else {
        field.to_vec()
    }
}

/// The start of a scene.
impl<Op: Operator<C>, const C: usize> Scene<Op, C> {
    /// Starts from the displacement that balances the load of the first time without friction, with fixed and driven
    /// components at zero, as `solver` finds it. If nothing but friction constrains the body, contacts are stuck in it.
    /// [`ErrorControl`](crate::ErrorControl) measures motion from there.
    #[must_use]
    pub fn in_equilibrium(mut self, solver: impl LinearSolver<Op, C> + 'static) -> Self {
        let given = self.initial.equilibrium.is_some() || !self.initial.displacement.is_empty();
        self.repeat("initial displacement", given);
        self.initial.equilibrium = Some(Box::new(solver));
        self
    }

    /// Starts from this displacement, one vector a vertex \[m\].
    #[must_use]
    pub fn with_displacement(mut self, displacement: Vec<SVector<f64, C>>) -> Self {
        let given = self.initial.equilibrium.is_some() || !self.initial.displacement.is_empty();
        self.repeat("initial displacement", given);
        self.initial.displacement = displacement;
        self
    }

    /// Starts from this velocity, one vector a vertex [m/s].
    #[must_use]
    pub fn with_velocity(mut self, velocity: Vec<SVector<f64, C>>) -> Self {
        self.repeat("initial velocity", !self.initial.velocity.is_empty());
        self.initial.velocity = velocity;
        self
    }

    /// Starts, without inertia, from the slip rates that balance friction and viscosity against load and stiffness at each
    /// frictional vertex, instead of those given. Without this a start whose rates, states and stresses disagree is
    /// refused ([`SceneError::Unbalanced`](crate::SceneError::Unbalanced)).
    #[must_use]
    pub fn with_balanced_rates(mut self) -> Self {
        self.initial.balanced = true;
        self
    }

    /// Starts from this acceleration, one vector a vertex [m/s^2], instead of the one that the forces give,
    /// `M a = l - C v - A u - friction`; no use without mass.
    #[must_use]
    pub fn with_acceleration(mut self, acceleration: Vec<SVector<f64, C>>) -> Self {
        self.repeat(
            "initial acceleration",
            !self.initial.acceleration.is_empty(),
        );
        self.initial.acceleration = acceleration;
        self
    }

    /// Starts from zero acceleration, as the paper does, instead of the consistent one. Newmark's scheme is of first
    /// order then, unless the forces give none. Accelerations behind declared stops are consistent all the same.
    #[must_use]
    pub fn with_zero_acceleration(self) -> Self {
        let size = self.stiffness.vertex_count();
        self.with_acceleration(vec![SVector::zeros(); size])
    }

    /// Starts at this time \[s\]; 0 unless told otherwise.
    #[must_use]
    pub fn from_time(mut self, time: f64) -> Self {
        self.initial.time = time;
        self
    }
}
