//! Normal stress that follows the displacement.

use std::sync::Arc;

use nalgebra::SVector;
use stickslip_friction::Nodal;
use stickslip_solvers::{NormalStressChange, Operator};

use super::Scene;
use super::clamping::{Clamping, NORMAL_STRESS_CHANGE};

impl<Op: Operator<C>, const C: usize> Scene<Op, C> {
    /// Lets the normal stress of all contacts follow the displacement: `N (u - V_p t)` adds to the normal stress of each
    /// contact, with the plate velocity `V_p` [m/s] (uniform or per vertex) beyond a fault by boundary integrals; zero
    /// without a plate. A contact that comes to tension ends the run, or opens if it may
    /// ([`Contact::allow_opening`](crate::Contact::allow_opening)): its strength is then its cohesion. States with a
    /// [normal stress effect](crate::Contact::with_normal_stress_effect) follow the change, too.
    ///
    /// An implicit step finds the normal stress with the displacement of its end, as one that comes
    /// [from the body](crate::NormalStress::from_body), and refuses it where that iteration does not contract, for a vertex
    /// where `q = abs(mu N)/(K + (eta + w sigma_n dmu/dV)/c_u)` is 1 or more. The displacement is along the axes, and normal
    /// velocities are fixed.
    ///
    /// ```
    /// # #[cfg(feature = "bie")] {
    /// use stickslip::bie::{Cells, DippingFault, Medium, Sense};
    /// use stickslip::nalgebra::Vector1;
    /// use stickslip::Scene;
    ///
    /// let rock = Medium { shear_modulus: 32.04e9, shear_wave_speed: 3464.0 };
    /// let fault = DippingFault::new(Cells::new([0.0, 40e3], 400)?, rock, 0.25, 60.0, Sense::Thrust)?;
    /// let scene = Scene::new(fault.stiffness())
    ///     .with_viscosity(fault.radiation_damping())
    ///     .with_load_history(fault.plate_loading(1e-9))
    ///     .with_normal_stress_change(fault.normal_stiffness(), Vector1::new(1e-9));
    /// # }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    #[doc(alias("clamping", "unclamping"))]
    pub fn with_normal_stress_change(
        mut self,
        change: impl NormalStressChange<C> + 'static,
        plate_velocity: impl Into<Nodal<SVector<f64, C>>>,
    ) -> Self {
        self.repeat(NORMAL_STRESS_CHANGE, self.conditions.clamping.is_some());
        let mesh = change.mesh();
        (self.conditions.assembled).extend(mesh.map(|mesh| (NORMAL_STRESS_CHANGE, mesh)));
        let size = self.stiffness.vertex_count();
        match Clamping::new(Arc::new(change), &plate_velocity.into(), size) {
            Ok(clamping) => self.conditions.clamping = Some(clamping),
            Err(error) => {
                self.conditions.wrong.get_or_insert(error);
            }
        }
        self
    }
}
