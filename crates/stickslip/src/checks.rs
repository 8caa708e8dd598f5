//! Checks of nodal data and laws before the first step.

use stickslip_friction::{
    FrictionError, FrictionLaw, Nodal, check_slip_rates, sample_friction_law,
};
use stickslip_state::{
    Reads, StateError, StateLaw, StateVariable, check_evolutions, sample_state_law,
};

use crate::SceneError;

/// Refuses data whose length differs from the number of vertices.
pub(crate) fn length<T>(
    what: &'static str,
    nodal: &Nodal<T>,
    expected: usize,
) -> Result<(), SceneError> {
    match nodal.count() {
        Some(found) if found != expected => Err(SceneError::Length {
            what,
            expected,
            found,
        }),
        _ => Ok(()),
    }
}

/// Refuses infinities and NaN.
pub(crate) fn finite(what: &'static str, position: usize, value: f64) -> Result<(), SceneError> {
    require(what, "finite", position, value, value.is_finite())
}

/// Refuses a value that violates its requirement.
pub(crate) fn require(
    what: &'static str,
    requirement: &'static str,
    position: usize,
    value: f64,
    holds: bool,
) -> Result<(), SceneError> {
    if holds {
        return Ok(());
    }
    Err(SceneError::Value {
        what,
        requirement,
        position,
        value,
    })
}

/// Slip rates [m/s] and times [s] that lead from the initial state to other states of a run.
const PAST: [(f64, f64); 4] = [(0.0, 1e6), (1e-9, 1e6), (1e-5, 1e2), (1.0, 1e-2)];

/// Refuses laws that violate their contracts at sample rates, in the initial states and in the states that follow from
/// them. Uniform laws and states are sampled once.
pub(crate) fn laws<L, S>(
    friction: &Nodal<L>,
    evolution: &Nodal<S>,
    initial: &Nodal<S::State>,
) -> Result<(), SceneError>
where
    L: FrictionLaw,
    S: StateLaw,
    L::State: Reads<S::State>,
{
    let places = friction.iter().len().max(evolution.iter().len());
    let states = initial.iter().len();
    // Laws that are the same everywhere meet the smallest and the largest of the initial states.
    if places == 1 && states > 1 {
        let values = || initial.iter().map(|state| state.value());
        let extremes = [
            values().fold(f64::INFINITY, f64::min),
            values().fold(f64::NEG_INFINITY, f64::max),
        ];
        for value in extremes {
            sample(friction.at(0), evolution.at(0), S::State::from_value(value))?;
        }
    } else {
        for k in 0..places.max(states) {
            sample(friction.at(k), evolution.at(k), *initial.at(k))?;
        }
    }
    many_nodes(friction, evolution, initial)
}

/// Refuses laws that bring other passes over their nodes than each of them by itself.
fn many_nodes<L, S>(
    friction: &Nodal<L>,
    evolution: &Nodal<S>,
    initial: &Nodal<S::State>,
) -> Result<(), SceneError>
where
    L: FrictionLaw,
    S: StateLaw,
    L::State: Reads<S::State>,
{
    let count = friction.count().or(evolution.count()).or(initial.count());
    let states: Vec<_> = (0..count.unwrap_or(1)).map(|k| *initial.at(k)).collect();
    check_evolutions(evolution.iter().as_slice(), &states)?;
    let read: Vec<_> = states.into_iter().map(L::State::read).collect();
    check_slip_rates(friction.iter().as_slice(), &read)?;
    Ok(())
}

fn sample<L, S>(friction: &L, evolution: &S, initial: S::State) -> Result<(), SceneError>
where
    L: FrictionLaw,
    S: StateLaw,
    L::State: Reads<S::State>,
{
    sample_state_law(evolution, &[initial])?;
    let later = PAST.map(|(slip_rate, dt)| evolution.advance(initial, slip_rate, dt));
    let states: Vec<L::State> = std::iter::once(initial)
        .chain(later.into_iter().flatten())
        .map(L::State::read)
        .filter(|state| state.value().is_finite())
        .collect();
    sample_friction_law(friction, &states)?;
    Ok(())
}

impl From<FrictionError> for SceneError {
    fn from(error: FrictionError) -> Self {
        Self::Friction(error.into())
    }
}

impl From<StateError> for SceneError {
    fn from(error: StateError) -> Self {
        Self::State(error.into())
    }
}
