//! The local problems of many nodes at once, against each by itself.

use stickslip_state::StateVariable;

use super::FrictionViolation;
use super::slip_rate::check_solution;
use crate::FrictionLaw;

/// Creep, laboratory and earthquake rates \[m/s\].
const SLIP_RATES: [f64; 4] = [1e-6, 1e-2, 1e-9, 1.0];

/// Stiffness over normal force \[s/m\].
const VISCOSITY: f64 = 0.1;

/// The roundings of the largest force to which slip rates balance it.
const ROUNDINGS: f64 = 16.0;

/// The relative accuracy of slopes, which only enter error estimates.
const ROUGH: f64 = 1e-4;

/// Checks the passes over many nodes that a law brings ([`FrictionLaw::slip_rates`]) against each node by itself: the laws
/// of the nodes, or one of all, and the states of the nodes.
///
/// ```
/// use stickslip_friction::{FrictionViolation, RegularizedDieterichRuina, check_slip_rates};
/// use stickslip_state::LogTheta;
///
/// let law = RegularizedDieterichRuina {
///     a: 0.010,
///     b: 0.015,
///     reference_friction: 0.6,
///     reference_velocity: 1e-6,
///     slip_distance: 1e-5,
/// };
/// check_slip_rates(&[law], &[LogTheta(1.0), LogTheta(20.0)])?;
/// # Ok::<(), FrictionViolation>(())
/// ```
///
/// # Errors
/// [`SlipRate`](FrictionViolation::SlipRate) of a node whose forces are not balanced to 16 roundings of the largest, and
/// [`Differs`](FrictionViolation::Differs) of a slope that is off by more than 1e-4.
///
/// # Panics
/// If there are other numbers of laws than 1 or one per state.
pub fn check_slip_rates<L: FrictionLaw>(
    laws: &[L],
    states: &[L::State],
) -> Result<(), FrictionViolation> {
    let count = states.len();
    assert!(
        laws.len() == 1 || laws.len() == count,
        "one law, or one per state: {} laws, {count} states",
        laws.len()
    );
    let Some(many) = L::slip_rates(laws) else {
        return Ok(());
    };
    let law = |k: usize| laws.get(k).unwrap_or(&laws[0]);
    let viscosity = vec![VISCOSITY; count];
    let (mut found, mut by_rate, mut by_state) =
        (vec![0.0; count], vec![0.0; count], vec![0.0; count]);
    for rate in SLIP_RATES {
        let drive = |k| law(k).coefficient(rate, states[k]) + VISCOSITY * rate;
        let drive: Vec<f64> = (0..count).map(drive).collect();
        many.slip_rates(0, [&viscosity, &drive], states, &mut found);
        many.slopes(0, &found, states, [&mut by_rate, &mut by_state]);
        for (k, &state) in states.iter().enumerate() {
            let slip_rate = found[k];
            check_solution(law(k), state, [VISCOSITY, drive[k]], slip_rate, ROUNDINGS)?;
            let each = law(k).response(slip_rate, state);
            let slopes = [
                (
                    "slope in the slip rate, of many nodes",
                    by_rate[k],
                    each.rate_slope,
                ),
                (
                    "slope in the state, of many nodes",
                    by_state[k],
                    each.state_slope,
                ),
            ];
            for (what, found, expected) in slopes {
                let equal = found == expected || (found - expected).abs() <= ROUGH * expected.abs();
                if slip_rate > 0.0 && !equal {
                    return Err(FrictionViolation::Differs {
                        what,
                        requirement: "that alone,",
                        state: state.value(),
                        slip_rate,
                        found,
                        expected,
                    });
                }
            }
        }
    }
    Ok(())
}
