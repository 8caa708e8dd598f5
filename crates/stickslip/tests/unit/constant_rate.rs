//! The generic step of a state at constant rate against closed forms.

use stickslip_state::{Dieterich, Discontinuous, LogTheta, Ruina, Theta};

use super::*;

/// A law whose closed forms nobody knows.
struct Hidden<S>(S);

impl<S: StateLaw> StateLaw for Hidden<S> {
    type State = S::State;

    fn evolution(&self, state: S::State, slip_rate: f64) -> f64 {
        self.0.evolution(state, slip_rate)
    }

    fn evolution_state_slope(&self, state: S::State, slip_rate: f64) -> f64 {
        self.0.evolution_state_slope(state, slip_rate)
    }
}

const SLIP_DISTANCE: f64 = 1e-5;

/// From rest to a step of a thousand slip distances. Extrapolations agree to 1e-12 on each of some ten to a hundred
/// pieces; the laws contract what is wrong.
fn check<S: StateLaw + Copy>(
    law: S,
    states: impl Iterator<Item = S::State> + Clone,
) -> Result<(), StateError> {
    for slip_rate in [0.0, 1e-14, 1e-9, 1e-6, 1e-4, 1e-2] {
        for dt in [1e-6, 1e-3, 1.0] {
            for from in states.clone() {
                let Some(exact) = law.advance_exact(from, slip_rate, dt) else {
                    continue;
                };
                let found = advance_exactly(&Hidden(law), from, slip_rate, dt)?;
                let error = found.distance(exact);
                assert!(
                    error < 1e-10,
                    "{from:?}, {slip_rate:e}, {dt:e}: {found:?}, {exact:?}"
                );
            }
        }
    }
    Ok(())
}

#[test]
fn laws_without_closed_forms_are_integrated_like_those_with_one() -> Result<(), StateError> {
    let logarithms = [-15.0, -10.0, -1.0, 2.0, 12.0].map(LogTheta);
    let slip_distance = SLIP_DISTANCE;
    check(Dieterich { slip_distance }, logarithms.into_iter())?;
    check(Ruina { slip_distance }, logarithms.into_iter())?;
    // It jumps where theta V = 1.
    check(
        Discontinuous,
        [1e-3, 1.0, 1e2, 1e3, 1e6].map(Theta).into_iter(),
    )
}
