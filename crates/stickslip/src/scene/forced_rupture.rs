//! The option of a contact that weakens by the larger of slip and time.

use stickslip_friction::{ForcedRupture, Nodal};
use stickslip_state::{StateLaw, Weakening};

use super::Contact;

impl<L, S: StateLaw<State = Weakening>, const C: usize> Contact<L, S, C> {
    /// Weakens friction by the larger of the state and a forced rupture (uniform or per vertex), as in TPV24, TPV26 and
    /// TPV29 of SCEC: with slip `D`, a rupture time `T` \[s\] of each vertex, and a duration `t_0` \[s\],
    ///
    /// ```text
    /// mu = mu_s - (mu_s - mu_d) max(f_1, f_2),   f_1 = min(D/D_c, 1),   f_2 = min(max((t - T)/t_0, 0), 1)
    /// ```
    ///
    /// The state remains the slip over `D_c`: friction alone reads the larger of both, `f_2` at the very time that it is
    /// evaluated for. Simulations have it at the ends of steps and stages, and [`RungeKutta`](crate::RungeKutta) at its
    /// stages. A vertex with an infinite rupture time is not forced. The initial state must be at least 0. An adaptive
    /// step at rest can be longer than the ramp: let it end at the first rupture time
    /// ([`Steps::stopping_at`](crate::Steps::stopping_at)).
    ///
    /// A duration that is not finite and positive is refused, and a rupture time that is NaN
    /// ([`SceneError::Friction`](crate::SceneError::Friction)).
    ///
    /// ```
    /// use nalgebra::SMatrix;
    /// use stickslip::friction::{ForcedRupture, LinearWeakening};
    /// use stickslip::state::{SlipWeakening, Weakening};
    /// use stickslip::{BoundaryPart, Contact, GeneralizedAlpha, Point, Scene, Simulation, Steps};
    ///
    /// // A drive of 0.15 MPa holds at 0.18 MPa: the forced rupture, from 1 s on, lets the block go at half of its ramp.
    /// let law = LinearWeakening { static_friction: 0.18, dynamic_friction: 0.12 };
    /// let fault = Contact::new(BoundaryPart::point(1.0), law, 1e6)
    ///     .with_state(SlipWeakening { slip_distance: 0.3 }, Weakening(0.0))
    ///     .with_forced_rupture(ForcedRupture { rupture_time: 1.0, duration: 0.5 });
    /// let scene = Scene::new(SMatrix::<f64, 1, 1>::zeros())
    ///     .with_mass(SMatrix::<f64, 1, 1>::new(1e6))
    ///     .with_contact(fault)
    ///     .with_load_history(|_, load| load[0][0] = 0.15e6);
    /// let mut simulation = Simulation::new(scene, GeneralizedAlpha::default(), Point)?;
    /// simulation.run(&Steps::constant(0.01).until(1.24), |_| ())?;
    /// let block = simulation.snapshot().contact(0);
    /// assert!(block.slip(0) == 0.0 && (block.coefficient(0) - 0.1512).abs() < 1e-12);
    /// simulation.run(&Steps::constant(0.01).until(1.5), |_| ())?;
    /// let block = simulation.snapshot().contact(0);
    /// assert!(block.slip(0) > 0.0 && (block.coefficient(0) - 0.12).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    #[doc(alias("forced nucleation", "TPV24", "time weakening"))]
    pub fn with_forced_rupture(mut self, forced: impl Into<Nodal<ForcedRupture>>) -> Self {
        self.repeat("forced rupture", self.strength.forced.is_some());
        self.strength.forced = Some(forced.into());
        self
    }
}
