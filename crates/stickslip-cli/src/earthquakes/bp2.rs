//! BP2-QD: BP1-QD with half its slip distance. Large and small events alternate where cells resolve them, at 100 m and
//! less; longer cells add small events of their own.

use serde_json::json;
use stickslip::bie::Fault;
use stickslip::problems::bp1::{MEDIUM, PLATE_RATE};

use super::antiplane::{antiplane, off_fault};
use super::bp1::{self, ENDS};
use super::line::Line;
use super::{Arguments, Failed};
use crate::cli::expect;

/// The characteristic slip distance \[m\].
pub const SLIP_DISTANCE: f64 = 4e-3;

/// The prediction of `V theta^(b/a) = const` at the surface at constant stress, that of BP1 in half the time: time
/// \[s\], log10 V.
const START: [[f64; 2]; 2] = [[127.5, -9.020_421], [2047.5, -9.269_075]];

/// Takes the steps, writes and prints the results, and checks the start: tables of events are not published.
pub(super) fn run(arguments: &Arguments) -> Result<(), Failed> {
    let fault = Fault::half_space(arguments.cells(ENDS)?, MEDIUM)?;
    let contact = bp1::contact(&fault, &fault.cells().map(|z| z), SLIP_DISTANCE);
    let mut motion = antiplane(arguments, &fault, contact, [PLATE_RATE; 2])?;
    let starts = START.map(|[time, _]| time);
    let mut line = Line::new(arguments, fault.cells(), &starts).with_off_fault(off_fault(&fault)?);
    line.run(arguments, json!({}), &mut *motion)?;
    if arguments.is_accurate() {
        for ([time, exact], found) in START.iter().zip(&line.start) {
            expect(&format!("log10 V after {time} s"), *found, *exact, 1e-5)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks the published states; the stress is that of BP1.
    #[test]
    fn the_fault_starts_as_published() {
        for (z, published) in [(7e3, 3.602_060), (30e3, 6.602_060)] {
            let log = bp1::state(z, SLIP_DISTANCE) / std::f64::consts::LN_10;
            assert!((log - published).abs() < 1e-6, "{z} {log}");
        }
    }
}
