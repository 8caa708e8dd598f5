//! The Linker-Dieterich effect: the dependence of the state on changes of the normal stress.

use stickslip_friction::Nodal;
use stickslip_state::{LogScale, StateLaw};

use super::check::{finite, length, require};
use super::{Contact, Places};
use crate::SceneError;

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

/// `ln theta` moves by `-kappa ln(sigma_n/sigma_n,o)`.
#[derive(Clone)]
pub(crate) struct NormalStressEffect<T> {
    kappa: Nodal<f64>,
    shifted: fn(T, f64) -> T,
    shift_slope: fn(T, f64) -> f64,
}

impl<T: LogScale> NormalStressEffect<T> {
    pub(super) fn new(kappa: Nodal<f64>) -> Self {
        Self {
            kappa,
            shifted: T::shifted,
            shift_slope: T::shift_slope,
        }
    }
}

impl<T: Copy> NormalStressEffect<T> {
    /// Checks the exponents.
    pub(super) fn check(&self, count: usize) -> Result<(), SceneError> {
        let what = "normal-stress effect";
        length(what, &self.kappa, count)?;
        for (k, &kappa) in self.kappa.iter().enumerate() {
            finite(what, k, kappa)?;
            require(what, "non-negative", k, kappa, kappa >= 0.0)?;
        }
        Ok(())
    }

    /// The effect at some of the vertices.
    pub(super) fn at(self, places: &Places) -> Result<Self, SceneError> {
        Ok(Self {
            kappa: places.select("normal-stress effect", self.kappa)?,
            ..self
        })
    }

    /// The state after a change of the normal stress, given by its logarithm, and its derivative in the old state.
    #[inline]
    pub(super) fn shifted(&self, k: usize, state: T, stress: f64) -> (T, f64) {
        let kappa = *self.kappa.at(k);
        if kappa == 0.0 || stress == 0.0 {
            return (state, 1.0);
        }
        let by = -kappa * stress;
        ((self.shifted)(state, by), (self.shift_slope)(state, by))
    }
}
