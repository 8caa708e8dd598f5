//! Marks of fields, functions and operators.

use nalgebra::SVector;
use stickslip_solvers::Matrix;
use xxhash_rust::xxh3::Xxh3Default;

use super::mark::{Mark, Value};

/// The marks of a scene.
#[derive(Default)]
pub(crate) struct Fingerprint {
    marks: Vec<Mark>,
}

impl Fingerprint {
    pub(crate) fn into_marks(self) -> Vec<Mark> {
        self.marks
    }

    pub(crate) fn mark(&mut self, name: &str, value: Value) {
        self.marks.push(Mark {
            name: name.into(),
            value,
        });
    }

    pub(crate) fn tag(&mut self, name: &str, value: &str) {
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
    pub(crate) fn operator<const C: usize>(&mut self, name: &str, operator: &dyn Matrix<C>) {
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
}

/// The sum of all finite values with distinct weights.
pub(crate) fn mixed(values: impl Iterator<Item = f64>) -> f64 {
    let finite = values.zip(shares()).filter(|(value, _)| value.is_finite());
    finite.map(|(value, share)| share * value).sum()
}

/// Pseudorandom weights from 1 to 2. Source: G. Steele, D. Lea, C. Flood, "Fast splittable pseudorandom number
/// generators", OOPSLA 2014 (SplitMix64).
pub(crate) fn shares() -> impl Iterator<Item = f64> {
    (1_u64..).map(|k| {
        let mut z = k.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        1.0 + ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    })
}
