//! Linear slip weakening: the stresses and the friction of TPV5, TPV6 and TPV205.

use std::f64::consts::PI;

use stickslip::friction::LinearWeakening;

/// The initial normal stress \[Pa\].
pub(super) const NORMAL: f64 = 120e6;
/// The initial shear stress beside the patches \[Pa\].
pub const SHEAR: f64 = 70e6;
/// The patches of other initial shear stress, 3 km wide: middle along strike \[m\] and stress \[Pa\]; nucleation first.
pub const PATCHES: [(f64, f64); 3] = [(0.0, 81.6e6), (-7.5e3, 78e6), (7.5e3, 62e6)];
/// Half the width of a patch \[m\].
pub const PATCH: f64 = 1.5e3;
/// The distance from the middle up to which the fault slips \[m\].
pub(super) const EXTENT: f64 = 15e3;
/// The slip across the fault over which friction weakens \[m\].
pub const SLIP_DISTANCE: f64 = 0.4;

/// The share of an interval of a length about a place that is within a patch about 0.
fn covered(place: f64, length: f64) -> f64 {
    let [low, high] = [place - 0.5 * length, place + 0.5 * length];
    ((high.min(PATCH) - low.max(-PATCH)) / length).clamp(0.0, 1.0)
}

/// The initial shear stress of a vertex, the mean over an interval of a length about it, of which a share is as deep as the
/// patches \[Pa\].
pub(super) fn prestress(patches: &[(f64, f64)], x: f64, length: f64, share: f64) -> f64 {
    let mean = patches
        .iter()
        .map(|&(middle, stress)| covered(x - middle, length) * share * (stress - SHEAR));
    SHEAR + mean.sum::<f64>()
}

/// Friction where the fault slips or does not.
pub fn friction(slips: bool) -> LinearWeakening {
    LinearWeakening {
        static_friction: if slips { 0.677 } else { 1e4 },
        dynamic_friction: 0.525,
    }
}

/// The length at the front over which friction weakens \[m\], in an infinite fault at rest:
/// `9 pi/32 G^ D_c/(tau_s - tau_d)`, `G^` the [stiffness](super::Rock::stiffness) that resists slip (S. Day et al.,
/// J. Geophys. Res. 110 (2005)).
pub fn cohesive_zone(stiffness: f64) -> f64 {
    let friction = friction(true);
    let drop = (friction.static_friction - friction.dynamic_friction) * NORMAL;
    9.0 * PI / 32.0 * stiffness * SLIP_DISTANCE / drop
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Vertices at an edge have the mean of both sides, and any spacing has the force of the patches.
    #[test]
    fn jumps_of_stress_are_averaged() {
        assert!((prestress(&PATCHES, 1.5e3, 100.0, 1.0) - 75.8e6).abs() < 1.0);
        for spacing in [100.0, 93.75, 370.0] {
            let count = (12e3 / spacing) as i32;
            let places = (-count..=count).map(|k| f64::from(k) * spacing);
            let force: f64 = places
                .map(|x| (prestress(&PATCHES, x, spacing, 1.0) - SHEAR) * spacing)
                .sum();
            let exact = 3e3 * (11.6e6 + 8e6 - 8e6);
            assert!((force / exact - 1.0).abs() < 1e-12, "{spacing}: {force}");
        }
    }
}
