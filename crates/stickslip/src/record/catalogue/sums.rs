//! The sums over the extent of an event.

use super::EventCatalogue;
use crate::{ContactView, Event};

impl<const C: usize> EventCatalogue<C> {
    /// Adds up slip, stress drop and extent since the beginning of the event.
    pub(super) fn add_up(&self, contact: &ContactView<'_, C>, event: &mut Event) {
        let (mut potency, mut drop, mut pressure) = (0.0, 0.0, 0.0);
        for k in 0..contact.len() {
            let weight = contact.weight(k);
            let slip = (contact.slip_vector(k) - self.slips[1][k]).norm();
            let [after, before] = [0, 1].map(|n| self.tractions[n][k]);
            let size = before.norm();
            let left = if size > 0.0 {
                after.dot(&before) / size
            } else {
                after.norm()
            };
            event.released += weight * 0.5 * (size + left) * slip;
            event.largest_slip = event.largest_slip.max(slip);
            if self.passed[k] {
                event.vertices += 1;
                event.area += weight;
                potency += weight * slip;
                drop += weight * (size - left);
                let before = self.pressures[1].get(k).copied().unwrap_or_default();
                pressure += weight * (contact.pore_pressure(k) - before);
                for (c, x) in contact.point(k).into_iter().enumerate() {
                    event.low[c] = event.low[c].min(x);
                    event.high[c] = event.high[c].max(x);
                }
            }
        }
        event.mean_slip = potency / event.area;
        event.stress_drop = drop / event.area;
        event.pressure_change = pressure / event.area;
        event.moment = self.shear_modulus * potency;
    }
}
