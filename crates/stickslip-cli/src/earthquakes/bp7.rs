//! BP7-QD-A: small repeating earthquakes of a circular patch on a plane in a whole space, started by an overstress.

use stickslip::friction::RegularizedDieterichRuina;
use stickslip::problems::bp1::PLATE_RATE;

use super::plane::Setting;
use super::{Arguments, Failed, YEAR};

/// Normal stress \[Pa\].
pub const NORMAL: f64 = 25e6;
/// The radius of the velocity-weakening patch \[m\].
pub const RADIUS: f64 = 200.0;
/// The overstress \[Pa\], its radius and centre \[m\], and the time in which it grows \[s\].
pub const OVERSTRESS: f64 = 1.75e6;
const REACH: f64 = 150.0;
const CENTRE: [f64; 2] = [-50.0, -50.0];
const GROWTH: f64 = 1.0;

const SETTING: Setting = Setting {
    ends: [[-400.0, 400.0]; 2],
    half_space: false,
    normal: NORMAL,
    law,
    state,
    rate: |_| PLATE_RATE,
    overstress: Some((overstress, GROWTH)),
    lines: [0.0, 0.0],
    stations: &[
        [0.0, 0.0],
        [-100.0, 0.0],
        [100.0, 100.0],
        [0.0, 200.0],
        [300.0, 0.0],
    ],
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

/// The overstress at a position \[m\] and a time \[s\], smooth in both: it grows in the first second, and stays.
pub fn overstress([x, y]: [f64; 2], time: f64) -> f64 {
    let [r, t] = [(x - CENTRE[0]).hypot(y - CENTRE[1]) / REACH, time / GROWTH];
    if r >= 1.0 || t <= 0.0 {
        return 0.0;
    }
    let place = (r * r / (r * r - 1.0)).exp();
    let growth = if t < 1.0 {
        ((t - 1.0).powi(2) / (t * (t - 2.0))).exp()
    } else {
        1.0
    };
    OVERSTRESS * place * growth
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

    /// The overstress is that of its centre after a second, half way there `exp(-1/3)` of it, and ends at its radius.
    #[test]
    fn the_overstress_is_smooth() {
        assert_eq!(overstress(CENTRE, 1.0), OVERSTRESS);
        assert_eq!(overstress(CENTRE, 1e9), OVERSTRESS);
        assert_eq!(overstress(CENTRE, 0.0), 0.0);
        assert_eq!(overstress([100.0, -50.0], 2.0), 0.0);
        assert!((overstress(CENTRE, 0.5) / OVERSTRESS - (-1.0_f64 / 3.0).exp()).abs() < 1e-15);
        assert!(overstress([99.0, -50.0], 2.0) < 1e-20 * OVERSTRESS);
        assert!((overstress(CENTRE, 1.0 - 1e-9) / OVERSTRESS - 1.0).abs() < 1e-15);
    }
}
