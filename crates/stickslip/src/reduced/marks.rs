//! The fingerprint of operators.

use stickslip_solvers::{BlockMatrix, Operator};

use crate::Scene;

/// The fingerprint of the operators of a scene.
pub(super) fn marks<const C: usize>(scene: &Scene<BlockMatrix<C>, C>) -> u64 {
    let mass = scene.mass.as_ref();
    let mass = mass.map(|mass| BlockMatrix::combination_with(&[], Some((1.0, mass))));
    let operators = std::iter::once(&scene.stiffness)
        .chain(&mass)
        .chain(&scene.viscosity);
    mix(operators.flat_map(|operator| {
        let columns = operator.indices().iter().map(|&column| u64::from(column));
        let entries = operator.data().iter().flat_map(|block| block.iter());
        columns.chain(entries.map(|entry| entry.to_bits()))
    }))
}

/// Mixes words to one, by the multiplications of splitmix64.
pub(super) fn mix(words: impl Iterator<Item = u64>) -> u64 {
    words.fold(0x9e37_79b9_7f4a_7c15, |state: u64, word| {
        let state = (state ^ word).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        (state ^ (state >> 29)).wrapping_mul(0x94d0_49bb_1331_11eb)
    })
}
