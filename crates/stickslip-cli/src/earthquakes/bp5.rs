//! BP5-QD: earthquake cycles on a vertical plane in a half space.

use stickslip::friction::RegularizedDieterichRuina;
use stickslip::problems::bp1::PLATE_RATE;

use super::plane::Setting;
use super::{Arguments, Failed, YEAR};
use crate::cli::expect;

/// Normal stress \[Pa\].
pub const NORMAL: f64 = 25e6;
/// The slip rate of the square in which the first event starts [m/s].
pub const FAST: f64 = 0.03;

/// The cell \[m\], the second event (the first one is under way at the start) and the interval of events from there on
/// \[years\], with tolerances.
const EVENTS: [(f64, [f64; 2], [f64; 2]); 2] = [
    (1000.0, [235.8, 0.3], [235.36, 0.1]),
    (500.0, [237.96, 0.5], [237.82, 0.2]),
];

const SETTING: Setting = Setting {
    ends: [[-50e3, 50e3], [0.0, 40e3]],
    half_space: true,
    normal: NORMAL,
    law,
    state,
    rate,
    overstress: None,
    lines: [10e3, 0.0],
    stations: &[
        [-24e3, 10e3],
        [0.0, 10e3],
        [16e3, 10e3],
        [0.0, 0.0],
        [36e3, 0.0],
        [0.0, 22e3],
        [-16e3, 10e3],
        [-36e3, 0.0],
        [-16e3, 0.0],
        [16e3, 0.0],
    ],
    blocks: &[
        [0.0, 8e3, 0.0],
        [0.0, 8e3, 10e3],
        [0.0, 16e3, 0.0],
        [0.0, 16e3, 10e3],
        [0.0, 32e3, 0.0],
        [0.0, 32e3, 10e3],
        [0.0, 48e3, 0.0],
        [16e3, 8e3, 0.0],
        [-16e3, 8e3, 0.0],
    ],
    names: (1e3, 2),
    intervals: [5.0 * YEAR, 2.0],
    labels: ["every 5 years", "every 2 seconds of events"],
    rupture: 0.1,
    shots: &[0.0, 10.0, 20.0, 30.0, 40.0, 50.0],
    unit: ("km", 1e3),
};

/// Whether a position along strike and down dip \[m\] is in the square in which the first event starts.
fn is_square([x, y]: [f64; 2]) -> bool {
    (-30e3..-18e3).contains(&x) && (4e3..16e3).contains(&y)
}

/// The friction law at a position along strike and down dip \[m\]: velocity weakening in 60 km x 12 km.
pub fn law([x, y]: [f64; 2]) -> RegularizedDieterichRuina {
    let beyond = (x.abs() - 30e3).max((y - 10e3).abs() - 6e3);
    let (inside, outside) = (0.004, 0.04);
    RegularizedDieterichRuina {
        a: inside + (outside - inside) * (beyond / 2e3).clamp(0.0, 1.0),
        b: 0.03,
        reference_friction: 0.6,
        reference_velocity: 1e-6,
        slip_distance: if is_square([x, y]) { 0.13 } else { 0.14 },
    }
}

/// The initial state, `ln(theta / 1 s)`, that of steady slip at the plate rate.
pub fn state(at: [f64; 2]) -> f64 {
    (law(at).slip_distance / PLATE_RATE).ln()
}

/// The initial slip rate [m/s].
pub fn rate(at: [f64; 2]) -> f64 {
    if is_square(at) { FAST } else { PLATE_RATE }
}

/// Takes the steps, writes and prints the results, and checks the events of cells of 1 km and 500 m.
pub(super) fn run(arguments: &Arguments) -> Result<(), Failed> {
    let events = SETTING.run(arguments)?;
    let known = EVENTS.iter().find(|known| known.0 == arguments.cell());
    let Some((_, second, interval)) = known.filter(|_| arguments.is_accurate()) else {
        return Ok(());
    };
    let years = events.years();
    if arguments.end() > (second[0] + 1.0) * YEAR {
        let found = years.get(1).copied().unwrap_or(f64::NAN);
        expect("years to the second event", found, second[0], second[1])?;
    }
    for pair in years.windows(2).skip(1) {
        expect(
            "years between events",
            pair[1] - pair[0],
            interval[0],
            interval[1],
        )?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks friction at the published corners, the state, and the stress: steady outside the square, and with the fast
    /// rate in it.
    #[test]
    fn the_fault_starts_as_published() {
        for (at, a) in [
            ([0.0, 10e3], 0.004),
            ([31e3, 10e3], 0.022),
            ([0.0, 3e3], 0.022),
            ([31e3, 1e3], 0.04),
            ([0.0, 39e3], 0.04),
        ] {
            assert!((law(at).a - a).abs() < 1e-15, "{at:?} {}", law(at).a);
        }
        assert_eq!(
            [
                law([-24e3, 10e3]).slip_distance,
                law([-17e3, 10e3]).slip_distance
            ],
            [0.13, 0.14]
        );
        assert!((state([0.0, 10e3]).exp() / 1.4e8 - 1.0).abs() < 1e-12);
        // f0 + (a - b) ln(V/V0), up to (V0/V) exp(-f0/a) of asinh.
        let damping = 0.5 * 32.038_120_320e9 / 3464.0;
        let steady = |a: f64| NORMAL * (0.6 + (a - 0.03) * 1e-3_f64.ln()) + damping * PLATE_RATE;
        for (at, a) in [([0.0, 10e3], 0.004), ([0.0, 39e3], 0.04)] {
            assert!((SETTING.shear(at) / steady(a) - 1.0).abs() < 1e-6, "{at:?}");
        }
        let fast = steady(0.004) + NORMAL * 0.004 * (FAST / PLATE_RATE).ln() + damping * FAST;
        assert!((SETTING.shear([-24e3, 10e3]) / fast - 1.0).abs() < 1e-6);
    }
}
