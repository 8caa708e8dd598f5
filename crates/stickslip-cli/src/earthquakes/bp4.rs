//! BP4-QD: earthquake cycles on a plane in a whole space, cut at 100 km along strike.

use stickslip::friction::RegularizedDieterichRuina;
use stickslip::problems::bp1::PLATE_RATE;

use super::plane::Setting;
use super::{Arguments, Failed, YEAR, state_for};

/// Normal stress \[Pa\].
pub const NORMAL: f64 = 50e6;
/// The slip rate of the square in which the first event starts [m/s].
pub const FAST: f64 = 0.03;
/// The characteristic slip distance \[m\].
pub const SLIP_DISTANCE: f64 = 0.04;

/// The direct effect where friction weakens, and far from there.
const DIRECT: [f64; 2] = [0.0065, 0.025];

const SETTING: Setting = Setting {
    ends: [[-50e3, 50e3], [-40e3, 40e3]],
    half_space: false,
    normal: NORMAL,
    law,
    state,
    rate,
    overstress: None,
    lines: [-7.5e3, 0.0],
    stations: &[
        [-22.5e3, -7.5e3],
        [0.0, 0.0],
        [16.5e3, 0.0],
        [0.0, 12e3],
        [36e3, 0.0],
    ],
    blocks: &[],
    names: (100.0, 3),
    intervals: [5.0 * YEAR, 2.0],
    labels: ["every 5 years", "every 2 seconds of events"],
    rupture: 0.1,
    shots: &[0.0, 10.0, 20.0, 30.0, 40.0, 50.0],
    unit: ("km", 1e3),
};

/// The friction law at a position along strike and down dip \[m\]: velocity weakening in 60 km x 30 km.
pub fn law([x, y]: [f64; 2]) -> RegularizedDieterichRuina {
    let beyond = (x.abs() - 30e3).max(y.abs() - 15e3);
    RegularizedDieterichRuina {
        a: DIRECT[0] + (DIRECT[1] - DIRECT[0]) * (beyond / 3e3).clamp(0.0, 1.0),
        ..far()
    }
}

fn far() -> RegularizedDieterichRuina {
    RegularizedDieterichRuina {
        a: DIRECT[1],
        b: 0.013,
        reference_friction: 0.6,
        reference_velocity: 1e-6,
        slip_distance: SLIP_DISTANCE,
    }
}

/// The initial state, `ln(theta / 1 s)`: friction at the plate rate balances the stress of steady slip far away.
pub fn state(at: [f64; 2]) -> f64 {
    let far = far();
    let strength = far.reference_friction + far.b * (far.reference_velocity / PLATE_RATE).ln();
    let argument = PLATE_RATE / (2.0 * far.reference_velocity) * (strength / far.a).exp();
    state_for(&law(at), far.a * argument.asinh(), PLATE_RATE)
}

/// The initial slip rate [m/s]: fast in a square of 12 km near a corner of the weakening patch.
pub fn rate([x, y]: [f64; 2]) -> f64 {
    let inside = (x + 22.5e3).abs() < 6e3 && (y + 7.5e3).abs() < 6e3;
    if inside { FAST } else { PLATE_RATE }
}

/// Takes the steps, and writes and prints the results: a table of events is not published.
pub(super) fn run(arguments: &Arguments) -> Result<(), Failed> {
    SETTING.run(arguments).map(|_| ())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks the published stress, the same everywhere outside the square, and the rates of the square's cells.
    #[test]
    fn the_fault_starts_as_published() {
        for at in [[0.0, 0.0], [31.5e3, 0.0], [0.0, 39e3], [-40e3, 10e3]] {
            let stress = SETTING.shear(at);
            assert!(
                (stress / 25.855_347e6 - 1.0).abs() < 1e-7,
                "{at:?} {stress}"
            );
        }
        let area = |cell: f64| {
            let places =
                |from: f64, count: usize| (0..count).map(move |k| from + (k as f64 + 0.5) * cell);
            let fast = places(-50e3, (100e3 / cell) as usize)
                .flat_map(|x| places(-40e3, (80e3 / cell) as usize).map(move |y| [x, y]))
                .filter(|&at| rate(at) == FAST);
            fast.count() as f64 * cell * cell
        };
        assert_eq!([area(500.0), area(250.0)], [144e6; 2]);
        // The stress of the square: friction from the same state at the fast rate.
        let jump = SETTING.shear([-22e3, -7e3]) - 25.855_347e6;
        let direct = NORMAL * DIRECT[0] * (FAST / PLATE_RATE).ln();
        let damping = 0.5 * 32.038_120_320e9 / 3464.0 * FAST;
        assert!((jump / (direct + damping) - 1.0).abs() < 1e-6, "{jump}");
    }
}
