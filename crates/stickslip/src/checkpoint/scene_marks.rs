//! The fingerprint of a scene.

use nalgebra::SVector;

use crate::Snapshot;
use crate::contact::DiscreteContact;
use crate::marks::{Fingerprint, Value, mixed, shares};

/// The slip rates at which laws are sampled [m/s].
const RATES: [f64; 4] = [1e-9, 1e-6, 1e-3, 1.0];
/// The normal stresses between which the effect of a change is sampled \[Pa\].
const STRESSES: [f64; 2] = [1e6, 2e6];

impl Fingerprint {
    /// Marks a whole scene, with its functions of time at `time` \[s\].
    pub(crate) fn scene<const C: usize>(&mut self, at: &Snapshot<'_, C>, time: f64) {
        let (source, size) = (at.source(), at.displacement.len());
        self.count("the number of components", C);
        self.count("the number of vertices", size);
        self.count("the number of contacts", at.contact_count());
        for (index, contact) in source.contacts().contacts.iter().enumerate() {
            self.count(
                &format!("the number of vertices of contact {index}"),
                contact.part.vertices.len(),
            );
        }
        self.words("the mesh", source.mesh().map(|mesh| mesh.fingerprint));
        let matrices = source.matrices();
        self.operator("the stiffness matrix", matrices.stiffness());
        let levels = matrices.stiffness().levels();
        if levels > 1 {
            self.count("the number of levels of local steps", levels);
        }
        if let Some(mass) = matrices.mass() {
            self.operator("the mass matrix", mass);
        }
        if let Some(viscosity) = matrices.viscosity() {
            self.operator("the viscosity matrix", viscosity);
        }
        source.constraints().describe(time, self);
        let components = (0..size).flat_map(|i| (0..C).map(move |c| (i, c)));
        self.words(
            "the set of prescribed components",
            components.map(|(i, c)| {
                u64::from(source.is_fixed(i, c)) + 2 * u64::from(source.is_moved(i, c))
            }),
        );
        let mut load = vec![SVector::zeros(); size];
        (source.loads()).fill(time, &mut load, &mut source.loads().scratch(size));
        self.function("the load", load.iter().flatten());
        for (index, contact) in source.contacts().contacts.iter().enumerate() {
            self.contact(index, contact, time);
        }
        if let Some(clamping) = source.contacts().clamping() {
            let mut shares = shares();
            let field: Vec<_> = (0..size)
                .map(|_| SVector::<f64, C>::from_fn(|_, _| shares.next().unwrap_or(1.0)))
                .collect();
            let mut change = vec![0.0; size];
            clamping.change_of(&field, &mut change);
            self.function("the normal stress change", &change);
            self.function("the plate's normal stress rate", clamping.loading());
        }
    }

    fn contact<const C: usize>(&mut self, index: usize, contact: &DiscreteContact<C>, time: f64) {
        let of = |what: &str| format!("the {what} of contact {index}");
        let part = &contact.part;
        let places = part.vertices.iter().map(|&vertex| vertex as u64);
        let numbers = (part.weights.iter())
            .chain(part.points.iter().flatten())
            .chain(part.normals.iter().flatten());
        let mesh = part.mesh.map_or(0, |mesh| mesh.fingerprint);
        let mesh = [mesh, u64::from(contact.bilateral)];
        self.words(
            &of("surface"),
            places.chain(numbers.map(|x| x.to_bits())).chain(mesh),
        );
        contact.describe(time, &of, self);
        let (laws, count) = (contact.trial.without_caps(), part.vertices.len());
        let initial = contact.trial.initial();
        let at_rates = |value: &dyn Fn(usize, f64) -> f64| {
            let sums = RATES.map(|rate| mixed((0..count).map(|k| value(k, rate))));
            Value::Numbers(sums.to_vec())
        };
        let friction = |k: usize, rate| laws.response(k, rate, initial[k]);
        self.mark(
            &of("coefficient of friction"),
            at_rates(&|k, rate| friction(k, rate).coefficient),
        );
        if !contact.trial.has_state() {
            return;
        }
        self.bits(&of("initial state"), initial);
        self.mark(
            &of("dependence of friction on the state"),
            at_rates(&|k, rate| friction(k, rate).state_slope),
        );
        self.mark(
            &of("evolution of the state"),
            at_rates(&|k, rate| laws.evolution(k, rate, initial[k])),
        );
        let stress = (STRESSES[1] / STRESSES[0]).ln();
        let moved = (0..count).map(|k| laws.shifted(k, initial[k], stress).0);
        let moved: Vec<f64> = moved.collect();
        self.function(&of("effect of the normal stress on the state"), &moved);
    }
}
