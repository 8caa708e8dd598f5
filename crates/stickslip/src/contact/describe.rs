//! The marks of a contact in a checkpoint.

use super::DiscreteContact;
use crate::marks::Fingerprint;
use crate::scene::Source;

impl<const C: usize> DiscreteContact<C> {
    /// Marks normal stress and strength of the contact at a time \[s\], and its tractions beside friction.
    pub(crate) fn describe(
        &self,
        time: f64,
        of: &dyn Fn(&str) -> String,
        fingerprint: &mut Fingerprint,
    ) {
        let strength = &self.strength;
        let places = 0..self.part.vertices.len();
        let mut stress: Vec<f64> = (places.clone())
            .map(|k| *strength.normal_stress.at(k))
            .collect();
        if let Some(mut history) = strength.history.clone() {
            history.set(time, &mut stress);
        }
        fingerprint.function(&of("normal stress"), &stress);
        fingerprint.count(&of("right to open"), usize::from(strength.opens));
        if let Some(least) = strength.least {
            fingerprint.bits(&of("least normal stress"), &[least]);
        }
        if let Some(largest) = strength.largest {
            fingerprint.bits(&of("largest normal stress"), &[largest]);
        }
        if strength.source != Source::Given {
            let is_change = usize::from(strength.source == Source::Change);
            fingerprint.count(&of("normal stress from the body"), is_change);
        }
        if strength.relaxation.delays() {
            let scales = strength.relaxation.scales();
            fingerprint.bits(&of("relaxation of the normal stress"), &scales);
        }
        let cohesion = places.clone().map(|k| strength.cohesion.at(k));
        fingerprint.bits(&of("cohesion"), cohesion);
        if let Some(shear) = &strength.shear {
            let shear = places.flat_map(|k| shear.at(k).iter());
            fingerprint.bits(&of("shear stress"), shear);
        }
        if let Some(forced) = &strength.forced {
            let each = (0..self.part.vertices.len()).map(|k| forced.at(k));
            let times = each.flat_map(|forced| [forced.rupture_time, forced.duration]);
            fingerprint.bits(&of("forced rupture"), times.collect::<Vec<_>>().iter());
        }
        if let Some(caps) = &strength.cap {
            let each = (0..self.part.vertices.len()).map(|k| caps.at(k));
            let numbers = each.flat_map(|cap| {
                let times = [cap.rupture_time, cap.duration];
                [times, [cap.static_friction, cap.dynamic_friction]].concat()
            });
            fingerprint.bits(&of("cap of friction"), numbers.collect::<Vec<_>>().iter());
        }
        if let Some(fields) = &self.fields {
            fields.describe(time, of, fingerprint);
        }
    }
}
