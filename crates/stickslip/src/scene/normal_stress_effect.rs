//! The option of a contact that makes its state depend on changes of the normal stress.

use stickslip_friction::Nodal;
use stickslip_state::{LogScale, StateLaw};

use crate::Contact;
use crate::laws::NormalStressEffect;

impl<L, S: StateLaw, const C: usize> Contact<L, S, C> {
    /// Makes the state depend on changes of the normal stress (M. Linker, J. Dieterich, J. Geophys. Res. 97 (1992)):
    /// with `kappa = zeta/b >= 0` (uniform or per vertex),
    ///
    /// ```text
    /// d(ln theta)/dt = (by the state law) - kappa sigma_n'/sigma_n
    /// ```
    ///
    /// A jump of the normal stress multiplies `theta` by `(sigma_n,o/sigma_n)^kappa`. It changes a coefficient that
    /// grows by `b ln theta` by `-zeta ln(sigma_n/sigma_n,o)`. The effect acts where the normal stress changes, see
    /// [`with_normal_stress_history`](Contact::with_normal_stress_history), and preserves the order in time of the
    /// method. The logarithm is undefined for an open contact: a step that begins or ends with a normal stress of zero,
    /// and not with both, fails with [`StepError::NormalStressEffect`](crate::StepError::NormalStressEffect).
    ///
    /// ```
    /// use nalgebra::SMatrix;
    /// use stickslip::problems::spring_slider::FRICTION;
    /// use stickslip::state::{LogTheta, Ruina};
    /// use stickslip::{Contact, GeneralizedAlpha, BoundaryPart, Point, Scene, Simulation};
    ///
    /// let contact = Contact::new(BoundaryPart::point(1.0), FRICTION, 1e6)
    ///     .with_state(Ruina { slip_distance: 1e-5 }, LogTheta(2.0))
    ///     .with_normal_stress_history(|time, stress| stress[0] = if time > 0.0 { 2e6 } else { 1e6 })
    ///     .with_normal_stress_effect(0.3);
    /// let scene = Scene::new(SMatrix::<f64, 1, 1>::new(1e9)).with_contact(contact);
    /// let mut at_rest = Simulation::new(scene, GeneralizedAlpha::default(), Point)?;
    /// at_rest.step(1.0)?;
    /// let state = at_rest.snapshot().contact(0).state(0);
    /// assert!((state - (2.0 - 0.3 * 2f64.ln())).abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn with_normal_stress_effect(mut self, kappa: impl Into<Nodal<f64>>) -> Self
    where
        S::State: LogScale,
    {
        self.repeat("normal-stress effect", self.effect.is_some());
        self.effect = Some(NormalStressEffect::new(kappa.into()));
        self
    }
}
