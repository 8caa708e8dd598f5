//! The initial stress and states of BP1 as published.

use super::*;

#[test]
fn the_fault_starts_as_published() {
    let found = shear_stress();
    assert!((found / 26.546_122_365e6 - 1.0).abs() < 1e-9, "{found}");
    for (depth, published) in [(7e3, 3.903_090), (16.5e3, 5.403_090), (30e3, 6.903_090)] {
        let log = initial_log_theta(depth) / std::f64::consts::LN_10;
        assert!((log - published).abs() < 1e-6, "{depth} {log}");
    }
}
