//! The rates of many states at once, against each by itself.

use super::StateLawViolation;
use crate::{StateLaw, StateVariable};

/// Creep, laboratory and earthquake rates \[m/s\], and rest.
const SLIP_RATES: [f64; 5] = [1e-6, 1e-2, 1e-9, 1.0, 0.0];

/// The relative accuracy, of the larger of a rate and its change by slip.
const ROUNDING: f64 = 1e-9;

/// Checks the passes over many nodes that a law brings ([`StateLaw::evolutions`]) against each node by itself: the laws of
/// the nodes, or one of all, and the states of the nodes.
///
/// ```
/// use stickslip_state::{Dieterich, LogTheta, StateLawViolation, check_evolutions};
///
/// check_evolutions(&[Dieterich { slip_distance: 1e-5 }], &[LogTheta(1.0), LogTheta(20.0)])?;
/// # Ok::<(), StateLawViolation>(())
/// ```
///
/// # Errors
/// [`StateLawViolation::ManyNodes`] of a rate that is off by more than 1e-9.
///
/// # Panics
/// If there are other numbers of laws than 1 or one per state.
pub fn check_evolutions<L: StateLaw>(
    laws: &[L],
    states: &[L::State],
) -> Result<(), StateLawViolation> {
    let count = states.len();
    assert!(
        laws.len() == 1 || laws.len() == count,
        "one law, or one per state: {} laws, {count} states",
        laws.len()
    );
    let Some(many) = L::evolutions(laws) else {
        return Ok(());
    };
    let mut found = vec![0.0; count];
    for slip_rate in SLIP_RATES {
        many.evolutions(0, states, &vec![slip_rate; count], &mut found);
        for (k, (&state, &found)) in states.iter().zip(&found).enumerate() {
            let law = laws.get(k).unwrap_or(&laws[0]);
            let expected = law.evolution(state, slip_rate);
            let scale = expected
                .abs()
                .max((expected - law.evolution(state, 0.0)).abs());
            if !(found == expected || (found - expected).abs() <= ROUNDING * scale) {
                return Err(StateLawViolation::ManyNodes {
                    state: state.value(),
                    slip_rate,
                    found,
                    expected,
                });
            }
        }
    }
    Ok(())
}
