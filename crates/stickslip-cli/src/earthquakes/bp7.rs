//! BP7-QD-A: small repeating earthquakes of a circular patch on a plane in a whole space, started by an overstress.

use stickslip::friction::RegularizedDieterichRuina;
use stickslip::problems::bp1::PLATE_RATE;

use super::plane::{Nucleation, Setting};
use super::{Arguments, Failed, YEAR};

/// Normal stress \[Pa\].
pub const NORMAL: f64 = 25e6;
/// The radius of the velocity-weakening patch \[m\].
pub const RADIUS: f64 = 200.0;
/// The overstress of the first second.
const NUCLEATION: Nucleation = Nucleation {
    centre: [-50.0, -50.0],
    amplitude: 1.75e6,
    radius: 150.0,
    rise_time: 1.0,
};

const SETTING: Setting = Setting {
    ends: [[-400.0, 400.0]; 2],
    half_space: false,
    normal: NORMAL,
    law,
    state,
    rate: |_| PLATE_RATE,
    overstress: Some(NUCLEATION),
    lines: [0.0, 0.0],
    stations: &[
        [0.0, 0.0],
        [-100.0, 0.0],
        [100.0, 100.0],
        [0.0, 200.0],
        [300.0, 0.0],
    ],
    blocks: &[
        [0.0, 200.0, 0.0],
        [0.0, 400.0, 0.0],
        [0.0, 400.0, 300.0],
        [300.0, 400.0, 0.0],
        [-300.0, 400.0, 0.0],
    ],
    names: (1.0, 3),
    intervals: [0.05 * YEAR, 0.02],
    labels: ["every 0.05 years", "every 0.02 seconds of events"],
    rupture: 0.01,
    shots: &[0.0, 0.2, 0.3, 0.4, 0.5, 0.6],
    unit: ("m", 1.0),
};

/// The friction law at a position \[m\].
pub fn law([x, y]: [f64; 2]) -> RegularizedDieterichRuina {
    RegularizedDieterichRuina {
        a: if x.hypot(y) < RADIUS { 0.004 } else { 0.016 },
        b: 0.01,
        reference_friction: 0.6,
        reference_velocity: 1e-6,
        slip_distance: 0.53e-3,
    }
}

/// The initial state, `ln(theta / 1 s)`, that of steady slip at the plate rate.
pub fn state(at: [f64; 2]) -> f64 {
    (law(at).slip_distance / PLATE_RATE).ln()
}

/// Takes the steps, writes and prints the results, and checks that the plane slides steadily for a year without the
/// overstress. (Later it does not: steady sliding is unstable, and errors of steps grow.)
pub(super) fn run(arguments: &Arguments) -> Result<(), Failed> {
    if !arguments.no_perturbation {
        return SETTING.run(arguments).map(|_| ());
    }
    let steady = Setting {
        overstress: None,
        ..SETTING
    };
    let events = steady.run(arguments)?.years();
    if arguments.is_accurate()
        && let Some(first) = events.first().filter(|&&first| first < 1.0)
    {
        return Err(format!("an event after {first} years of steady sliding").into());
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks the published stresses.
    #[test]
    fn the_fault_starts_as_published() {
        for (at, published) in [([0.0, 199.0], 16.036_163e6), ([0.0, 201.0], 13.964e6)] {
            let stress = SETTING.shear(at);
            assert!((stress / published - 1.0).abs() < 3e-5, "{at:?} {stress}");
        }
        assert!((SETTING.shear([0.0; 2]) / 16.036_163e6 - 1.0).abs() < 1e-7);
    }
}
