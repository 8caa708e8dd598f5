//! BP1-QD: earthquake cycles on a fault in a half space.

use serde_json::json;
use stickslip::bie::Fault;
use stickslip::friction::RegularizedDieterichRuina;
use stickslip::nalgebra::Vector1;
use stickslip::problems::bp1::{self, AGING, DEPTH, MEDIUM, NORMAL_STRESS, PLATE_RATE};
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{BoundaryPart, Contact};

use super::antiplane::{Friction, antiplane, off_fault};
use super::line::Line;
use super::{Arguments, Failed, YEAR};
use crate::cli::expect;

/// The ends of the fault \[m\].
pub(super) const ENDS: [f64; 2] = [0.0, DEPTH];

/// The time of the first event by boundary element codes in a half space \[years\].
const FIRST_EVENT: f64 = 196.1;
/// The prediction of `V theta^(b/a) = const` at the surface at constant stress: time \[s\], log10 V.
const START: [[f64; 2]; 2] = [[255.0, -9.020_421], [4095.0, -9.269_075]];

/// The friction law at a depth \[m\] with another slip distance \[m\].
pub(super) fn law(depth: f64, slip_distance: f64) -> RegularizedDieterichRuina {
    RegularizedDieterichRuina {
        slip_distance,
        ..bp1::friction(depth)
    }
}

/// The initial state at a depth \[m\], `ln(theta / 1 s)`: `theta` over the slip distance is that of BP1.
pub(super) fn state(depth: f64, slip_distance: f64) -> f64 {
    bp1::initial_log_theta(depth) + (slip_distance / AGING.slip_distance).ln()
}

/// The contact of cells at these depths with a slip distance \[m\], under the initial stress and state.
pub(super) fn contact(
    part: impl Into<BoundaryPart>,
    depths: &[f64],
    slip_distance: f64,
) -> Friction {
    let laws = depths.iter().map(|&depth| law(depth, slip_distance));
    let states = depths
        .iter()
        .map(|&depth| LogTheta(state(depth, slip_distance)));
    Contact::per_vertex(part, laws, NORMAL_STRESS)
        .with_state(Dieterich { slip_distance }, states.collect::<Vec<_>>())
        .with_shear_stress(Vector1::new(bp1::shear_stress()))
}

/// Takes the steps, writes and prints the results, and checks them.
pub(super) fn run(arguments: &Arguments) -> Result<(), Failed> {
    let fault = Fault::half_space(arguments.cells(ENDS)?, MEDIUM)?;
    let contact = contact(&fault, &fault.cells().map(|z| z), AGING.slip_distance);
    let mut motion = antiplane(arguments, &fault, contact, [PLATE_RATE; 2])?;
    let starts = START.map(|[time, _]| time);
    let mut line = Line::new(arguments, fault.cells(), &starts).with_off_fault(off_fault(&fault)?);
    line.run(arguments, json!({}), &mut *motion)?;
    check(arguments, &line)
}

/// Checks the initial state for any cells, the first event for cells that resolve it, and cycles, which repeat from the
/// third event on.
fn check(arguments: &Arguments, line: &Line<'_>) -> Result<(), Failed> {
    if !arguments.is_accurate() {
        return Ok(());
    }
    let (times, middle) = (line.times(), line.slip_per_event(1));
    for ([time, exact], found) in START.iter().zip(&line.start) {
        expect(&format!("log10 V after {time} s"), *found, *exact, 1e-5)?;
    }
    if fine(arguments) && arguments.end() >= 200.0 * YEAR {
        let first = times.first().copied().unwrap_or(f64::NAN);
        expect("years to the first event", first, FIRST_EVENT, 0.7)?;
    }
    for (n, pair) in times.windows(2).enumerate().skip(2) {
        let plate = PLATE_RATE * (pair[1] - pair[0]) * YEAR;
        expect("slip of an event", middle[n], plate, 0.005 * plate)?;
    }
    Ok(())
}

/// Whether cells are at most a third of the cohesive zone length `mu L/(b sigma)`.
fn fine(arguments: &Arguments) -> bool {
    3.0 * arguments.cell() <= MEDIUM.shear_modulus * AGING.slip_distance / (0.015 * NORMAL_STRESS)
}
