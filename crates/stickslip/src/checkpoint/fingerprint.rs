//! The fingerprint of a scene.

use nalgebra::SVector;
use stickslip_solvers::Operator;
use xxhash_rust::xxh3::Xxh3Default;

use super::mark::{Mark, Value};
use crate::Snapshot;
use crate::contact::DiscreteContact;

/// The slip rates at which laws are sampled [m/s].
const RATES: [f64; 4] = [1e-9, 1e-6, 1e-3, 1.0];
/// The normal stresses between which the effect of a change is sampled \[Pa\].
const STRESSES: [f64; 2] = [1e6, 2e6];

/// The marks of a scene.
#[derive(Default)]
pub(crate) struct Fingerprint {
    marks: Vec<Mark>,
}

impl Fingerprint {
    pub(crate) fn into_marks(self) -> Vec<Mark> {
        self.marks
    }

    fn mark(&mut self, name: &str, value: Value) {
        self.marks.push(Mark {
            name: name.into(),
            value,
        });
    }

    pub(super) fn tag(&mut self, name: &str, value: &str) {
        self.mark(name, Value::Tag(value.into()));
    }

    pub(crate) fn count(&mut self, name: &str, count: usize) {
        self.mark(name, Value::Count(count as u64));
    }

    /// Marks words, bit by bit.
    pub(crate) fn words(&mut self, name: &str, words: impl IntoIterator<Item = u64>) {
        let mut hash = Xxh3Default::new();
        for word in words {
            hash.update(&word.to_le_bytes());
        }
        self.mark(name, Value::Bits(hash.digest()));
    }

    /// Marks numbers, bit by bit.
    pub(crate) fn bits<'a>(&mut self, name: &str, values: impl IntoIterator<Item = &'a f64>) {
        self.words(name, values.into_iter().map(|value| value.to_bits()));
    }

    /// Marks the values of a function up to its rounding: by their sum with distinct weights.
    pub(crate) fn function<'a>(&mut self, name: &str, values: impl IntoIterator<Item = &'a f64>) {
        let sum = mixed(values.into_iter().copied());
        self.mark(name, Value::Numbers(vec![sum]));
    }

    /// Marks an operator by its diagonal and by a product with distinct weights per entry.
    pub(crate) fn operator<Op: Operator<C>, const C: usize>(&mut self, name: &str, operator: &Op) {
        let size = operator.vertex_count();
        let mut shares = shares();
        let field: Vec<_> = (0..size)
            .map(|_| SVector::<f64, C>::from_fn(|_, _| shares.next().unwrap_or(1.0)))
            .collect();
        let rows = (0..size).flat_map(|i| {
            let (product, diagonal) = (operator.product_at(i, &field), operator.diagonal_block(i));
            let numbers = diagonal.iter().chain(product.iter()).copied();
            numbers.map(f64::to_bits).collect::<Vec<_>>()
        });
        self.words(name, rows);
    }

    /// Marks a whole scene, with its functions of time at `time` \[s\].
    pub(super) fn scene<const C: usize>(&mut self, at: &Snapshot<'_, C>, time: f64) {
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
        source.matrices().describe(self);
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
        let (laws, count) = (contact.trial.laws(), part.vertices.len());
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

/// The sum of all finite values with distinct weights.
fn mixed(values: impl Iterator<Item = f64>) -> f64 {
    let finite = values.zip(shares()).filter(|(value, _)| value.is_finite());
    finite.map(|(value, share)| share * value).sum()
}

/// Pseudorandom weights from 1 to 2. Source: G. Steele, D. Lea, C. Flood, "Fast splittable pseudorandom number
/// generators", OOPSLA 2014 (SplitMix64).
fn shares() -> impl Iterator<Item = f64> {
    (1_u64..).map(|k| {
        let mut z = k.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        1.0 + ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    })
}
