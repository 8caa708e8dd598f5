//! The option of a contact whose friction stays below a cap that falls with time.

use stickslip_friction::{ForcedCap, Nodal};
use stickslip_state::StateLaw;

use super::Contact;

impl<L, S: StateLaw, const C: usize> Contact<L, S, C> {
    /// Forces a rupture by a cap of friction, `mu <= F(t)` (uniform or per vertex), with any friction law: where the front
    /// of a [`ForcedCap`] has passed, friction is at most its dynamic coefficient.
    ///
    /// The state evolves by its own law. Caps are those of the very time that friction is evaluated for: the ends of steps
    /// and stages of simulations, the stages of [`RungeKutta`](crate::RungeKutta). A vertex with an infinite rupture time is
    /// not forced. Below the cap friction opposes faster slip no more: it takes inertia, viscosity, radiation damping or a
    /// body to balance the forces. An adaptive step at rest can be longer than the ramp: let it end at the first rupture time
    /// ([`Steps::stopping_at`](crate::Steps::stopping_at)).
    ///
    /// Parameters out of range are refused ([`SceneError::Friction`](crate::SceneError::Friction)).
    ///
    /// ```
    /// use nalgebra::SMatrix;
    /// use stickslip::friction::{ForcedCap, StrongRateWeakening};
    /// use stickslip::{BoundaryPart, Contact, Point, RungeKutta, Scene, Steps};
    ///
    /// let law = StrongRateWeakening {
    ///     a: 0.01,
    ///     b: 0.014,
    ///     reference_friction: 0.6,
    ///     reference_velocity: 1e-6,
    ///     slip_distance: 0.4,
    ///     weakened_friction: 0.2,
    ///     weakening_velocity: 0.1,
    /// };
    /// // 40 of 120 MPa, creeping: the front of a rupture at 2 km/s arrives from a distance of 2 km.
    /// let (stress, creep, damping) = (40e6, 1e-16, 4.6e6);
    /// let contact = Contact::new(BoundaryPart::point(1.0), law, 120e6)
    ///     .with_state(law.evolution(), law.state_of_friction(stress / 120e6, creep))
    ///     .with_friction_cap(ForcedCap::behind_front(2e3, 2e3, 400.0, [0.5, 0.2]));
    /// let scene = Scene::new(SMatrix::<f64, 1, 1>::zeros())
    ///     .with_viscosity(SMatrix::<f64, 1, 1>::new(damping))
    ///     .with_contact(contact)
    ///     .with_load_history(move |_, load| load[0][0] = stress);
    /// let mut block = RungeKutta::new(scene)?;
    /// block.run(&Steps::adaptive(1e-6).until(1.0), |_| ())?;
    /// assert!(block.snapshot().contact(0).slip_rate(0) < 1e-12);
    /// block.run(&Steps::adaptive(1e-6).until(1.2), |_| ())?;
    /// let at = block.snapshot();
    /// assert!((at.contact(0).coefficient(0) - 0.2).abs() < 1e-12);
    /// // Radiation damping takes the rest.
    /// assert!((at.contact(0).slip_rate(0) / (16e6 / damping) - 1.0).abs() < 1e-9);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    #[doc(alias("forced nucleation", "time weakening", "Kostrov"))]
    pub fn with_friction_cap(mut self, caps: impl Into<Nodal<ForcedCap>>) -> Self {
        self.repeat("cap of friction", self.strength.cap.is_some());
        self.strength.cap = Some(caps.into());
        self
    }
}
