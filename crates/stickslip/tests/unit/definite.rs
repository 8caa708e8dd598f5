//! Definite operators against chains of springs.

use nalgebra::DMatrix;

use super::*;

/// A chain of `n` masses between walls resists a push at its first one by `1 + 1/n` springs.
#[test]
fn a_chain_bears_a_push_up_to_its_stiffness() {
    for n in [1_u8, 2, 7, 40, 200] {
        let size = usize::from(n);
        let chain = DMatrix::from_fn(size, size, |i, j| match i.abs_diff(j) {
            0 => 2.0,
            1 => -1.0,
            _ => 0.0,
        });
        let stiffness = 1.0 + f64::from(n).recip();
        let mut definite = Definite::<1>::new(&chain);
        let mut holds = |fixed: &[[bool; 1]], push: f64| {
            let mut pushed = chain.clone();
            pushed[(0, 0)] -= push;
            definite.is_positive_definite(&pushed, fixed)
        };
        let free = vec![[false]; size];
        assert!(
            holds(&free, 0.0) && holds(&free, stiffness * (1.0 - 1e-6)),
            "{n}"
        );
        assert!(!holds(&free, stiffness * (1.0 + 1e-6)), "{n}");
        // Held there it bears any.
        let mut held = free.clone();
        held[0] = [true];
        assert!(holds(&held, 1e9), "{n}");
    }
}
