//! The stress of a body before its deformation, on a contact.

use std::sync::Arc;

use nalgebra::{Matrix3, SVector, Vector3};
use stickslip_friction::Nodal;
use stickslip_state::StateLaw;

use super::contact::Contact;
use super::strength::Strength;
use crate::{BoundaryPart, SceneError};

/// The stress tensor at a position \[Pa\].
pub(crate) type StressField = Arc<dyn Fn(&[f64; 3]) -> [[f64; 3]; 3] + Send + Sync>;

impl<L, S: StateLaw, const C: usize> Contact<L, S, C> {
    /// Adds the tractions of a stress in the body that its displacement does not hold: a tensor by the position \[m\],
    /// tension positive \[Pa\], with three rows and columns (a plane body uses two, antiplane shear those with z).
    ///
    /// With the outward normal `n`, on a fault that of the plus side, the normal stress grows by `-n.S n`, and the shear
    /// stress by the tangential part of `-S n`: uniform stress with a shear `S_xy > 0` drives the upper side of a level
    /// fault to +x. A body in equilibrium under `S` does not deform as long as friction holds its faults.
    ///
    /// ```
    /// use stickslip::fem::P1;
    /// use stickslip::friction::Tresca;
    /// use stickslip::{Contact, NormalStress};
    ///
    /// let space = P1::grid([2.0, 1.0], [2, 1])?;
    /// let base = space.trace(|x| x[1] == 0.0)?;
    /// let law = Tresca { coefficient: 0.6 };
    /// let depth = |x: &[f64; 3]| 1.0 - x[1];
    /// let contact: Contact<_, _, 2> = Contact::new(&base, law, NormalStress::from_body(0.0))
    ///     .with_prestress(move |x| [[-27e3 * depth(x), 5e3, 0.0], [5e3, -27e3 * depth(x), 0.0], [0.0; 3]]);
    /// # let _ = contact;
    /// # Ok::<(), stickslip::fem::FemError>(())
    /// ```
    #[must_use]
    pub fn with_prestress(
        mut self,
        stress: impl Fn(&[f64; 3]) -> [[f64; 3]; 3] + Send + Sync + 'static,
    ) -> Self {
        self.repeat("pre-stress", self.prestress.is_some());
        self.prestress = Some(Arc::new(stress));
        self
    }
}

/// Adds the tractions of a stress to those of a contact: with the outward normal `n` of the body, the normal stress
/// `-n.S n`, and the tangential part of `-S n`, which the body exerts on the surface.
pub(crate) fn resolve<const C: usize>(
    stress: &StressField,
    part: &BoundaryPart,
    strength: &mut Strength<C>,
) -> Result<(), SceneError> {
    let count = part.vertices.len();
    let (mut pressures, mut shears) = (Vec::with_capacity(count), Vec::with_capacity(count));
    for (k, &vertex) in part.vertices.iter().enumerate() {
        let normal = part.normals.get(k).copied().unwrap_or_default();
        let (Some(point), true) = (part.points.get(k), normal != [0.0; 3]) else {
            return Err(SceneError::Normal {
                vertex,
                normal,
                requirement: "one to resolve a stress on",
            });
        };
        let tensor = stress(point);
        let tensor = Matrix3::from_fn(|r, c| tensor[r][c]);
        let normal = Vector3::from(normal);
        let traction = -(tensor * normal);
        (traction.iter()).try_for_each(|&value| crate::checks::finite("pre-stress", k, value))?;
        pressures.push(traction.dot(&normal));
        let shear = traction - normal * traction.dot(&normal);
        // Antiplane fields have the third component alone.
        let first = if C < part.dimension { 3 - C } else { 0 };
        shears.push(SVector::<f64, C>::from_fn(|c, _| shear[first + c]));
    }
    for (k, pressure) in pressures.iter_mut().enumerate() {
        *pressure += at(&strength.normal_stress, k, count, "normal stress")?;
    }
    if let Some(own) = &strength.shear {
        for (k, shear) in shears.iter_mut().enumerate() {
            *shear += at(own, k, count, "shear stress")?;
        }
    }
    strength.normal_stress = Nodal::PerVertex(pressures);
    strength.shear = Some(Nodal::PerVertex(shears));
    Ok(())
}

/// The value at a vertex, if there are as many as vertices.
fn at<T: Copy>(
    values: &Nodal<T>,
    k: usize,
    count: usize,
    what: &'static str,
) -> Result<T, SceneError> {
    crate::checks::length(what, values, count)?;
    Ok(*values.at(k))
}
