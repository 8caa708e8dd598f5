//! Initial conditions.

use nalgebra::SVector;
use stickslip_solvers::{LinearSolver, Operator};

use super::Scene;

/// The initial conditions; an empty field is zero.
#[derive(Clone, Default)]
pub(crate) struct Initial<const C: usize> {
    pub(crate) time: f64,
    pub(crate) displacement: Vec<SVector<f64, C>>,
    /// The slip rates follow from stresses and states.
    pub(crate) balanced: bool,
    pub(crate) velocity: Vec<SVector<f64, C>>,
    pub(crate) acceleration: Vec<SVector<f64, C>>,
}

/// The given field, or zero.
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

/// Initial conditions of a scene.
impl<Op: Operator<C>, const C: usize> Scene<Op, C> {
    /// Starts from the static equilibrium under the load of the first time without friction, with fixed and driven
    /// components at zero, computed by `solver`. If only friction constrains the body, the contacts are stuck in it.
    /// [`ErrorControl`](crate::ErrorControl) measures motion from this equilibrium.
    #[must_use]
    pub fn in_equilibrium(mut self, solver: impl LinearSolver<Op, C> + 'static) -> Self {
        let given = self.equilibrium.is_some() || !self.conditions.initial.displacement.is_empty();
        self.repeat("initial displacement", given);
        self.equilibrium = Some(Box::new(solver));
        self
    }

    /// Starts from this displacement, one vector per vertex \[m\].
    #[must_use]
    pub fn with_displacement(mut self, displacement: Vec<SVector<f64, C>>) -> Self {
        let given = self.equilibrium.is_some() || !self.conditions.initial.displacement.is_empty();
        self.repeat("initial displacement", given);
        self.conditions.initial.displacement = displacement;
        self
    }

    /// Starts from this velocity, one vector per vertex [m/s].
    #[must_use]
    pub fn with_velocity(mut self, velocity: Vec<SVector<f64, C>>) -> Self {
        self.repeat(
            "initial velocity",
            !self.conditions.initial.velocity.is_empty(),
        );
        self.conditions.initial.velocity = velocity;
        self
    }

    /// Starts, without inertia, from the slip rates at which friction and viscosity balance load and stiffness at each
    /// frictional vertex, instead of the given ones. Without this option, initial rates, states and stresses out of
    /// balance are refused ([`SceneError::Unbalanced`](crate::SceneError::Unbalanced)). A scene with mass is refused with
    /// this option: any slip rate is in balance with some acceleration.
    #[must_use]
    pub fn with_balanced_rates(mut self) -> Self {
        self.conditions.initial.balanced = true;
        self
    }

    /// Starts from this acceleration, one vector per vertex [m/s^2], instead of that of the forces, `M a = l - C v - A
    /// u - friction`. A scene without mass is refused with it.
    #[must_use]
    pub fn with_acceleration(mut self, acceleration: Vec<SVector<f64, C>>) -> Self {
        self.repeat(
            "initial acceleration",
            !self.conditions.initial.acceleration.is_empty(),
        );
        self.conditions.initial.acceleration = acceleration;
        self
    }

    /// Starts from zero acceleration, as the paper does, instead of the consistent one. Newmark's scheme is then of
    /// first order, unless the forces are in static balance. Accelerations after declared stops are consistent
    /// regardless.
    #[must_use]
    pub fn with_zero_acceleration(self) -> Self {
        let size = self.stiffness.vertex_count();
        self.with_acceleration(vec![SVector::zeros(); size])
    }

    /// Starts at this time \[s\]; 0 by default.
    #[must_use]
    pub fn from_time(mut self, time: f64) -> Self {
        self.repeat("initial time", self.conditions.initial.time != 0.0);
        self.conditions.initial.time = time;
        self
    }
}
