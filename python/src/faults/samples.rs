//! Samples of a run of a fault.

use stickslip::{ContactView, Snapshot};

use super::receivers::Receivers;

/// Samples of a run of a fault with so many cells.
pub(super) struct Record<'a> {
    pub(super) cells: usize,
    pub(super) times: Vec<f64>,
    /// V, slip and shear stress, of as many components as slip.
    pub(super) vectors: [Vec<f64>; 3],
    /// theta and normal stress.
    pub(super) scalars: [Vec<f64>; 2],
    /// The pore pressure and the effective normal stress, of a fault with fields.
    pub(super) pressures: Option<[Vec<f64>; 2]>,
    /// The readings of fields per cell, by name.
    pub(super) readings: Vec<(&'static str, Vec<f64>)>,
    /// The totals of fields, by name.
    pub(super) totals: Vec<(&'static str, Vec<f64>)>,
    pub(super) components: usize,
    /// Points off the fault.
    pub(super) receivers: Option<&'a Receivers>,
    /// Their displacement and velocity.
    pub(super) moved: [Vec<f64>; 2],
}

impl<'a> Record<'a> {
    /// No samples yet of a fault, and of points off it.
    pub(super) fn of<const C: usize>(
        fault: &Snapshot<'_, C>,
        receivers: Option<&'a Receivers>,
    ) -> Self {
        let contact = fault.contact(0);
        let readings = contact.readings();
        let totals = contact.totals();
        Self {
            cells: contact.len(),
            times: Vec::new(),
            vectors: Default::default(),
            scalars: Default::default(),
            pressures: contact.field(0).map(|_| Default::default()),
            readings: by_name(readings.iter().map(|reading| reading.name)),
            totals: by_name(totals.iter().map(|(total, _)| total.name)),
            components: C,
            receivers,
            moved: Default::default(),
        }
    }

    /// Sets the times of the samples to those asked for, which clocks meet to rounding.
    pub(super) fn at(&mut self, times: &[f64]) {
        let count = self.times.len();
        self.times.copy_from_slice(&times[..count]);
    }

    /// Appends a sample.
    pub(super) fn add<const C: usize>(&mut self, at: &Snapshot<'_, C>) {
        self.times.push(at.time);
        let contact = at.contact(0);
        let [v, slip, shear] = &mut self.vectors;
        let [theta, normal] = &mut self.scalars;
        for k in 0..contact.len() {
            v.extend(&at.velocity[k]);
            slip.extend(&at.displacement[k]);
            shear.extend(&contact.traction(k));
            theta.push(contact.state(k).exp());
            normal.push(contact.normal_stress(k));
        }
        self.add_fields(&contact);
        if let Some(receivers) = self.receivers {
            let motion = [at.displacement, at.velocity];
            receivers.sample(at.time, motion, &mut self.moved);
        }
    }

    /// Appends the pressures, readings and totals of fields.
    fn add_fields<const C: usize>(&mut self, contact: &ContactView<'_, C>) {
        let Some([pore, effective]) = &mut self.pressures else {
            return;
        };
        for k in 0..contact.len() {
            pore.push(contact.pore_pressure(k));
            effective.push(contact.effective_normal_stress(k));
        }
        for (name, values) in &mut self.readings {
            values.extend(contact.reading(name).unwrap_or_default());
        }
        let now = contact.totals();
        for (name, values) in &mut self.totals {
            let own = now.iter().filter(|(total, _)| total.name == *name);
            values.push(own.map(|(_, value)| value).sum());
        }
    }
}

/// No values yet, of each name once.
fn by_name(names: impl Iterator<Item = &'static str>) -> Vec<(&'static str, Vec<f64>)> {
    let mut values: Vec<(&str, Vec<f64>)> = Vec::new();
    for name in names {
        if values.iter().all(|(own, _)| *own != name) {
            values.push((name, Vec::new()));
        }
    }
    values
}
