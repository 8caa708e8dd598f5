//! The local problem.

use stickslip_state::StateVariable;

use super::{FrictionViolation, coefficient_terms, worst};
use crate::FrictionLaw;

/// Stiffness over normal force \[s/m\].
const VISCOSITIES: [f64; 6] = [1e-12, 1e-6, 1.0, 1e6, 1e12, 1e20];

/// Forces over normal force, besides those of the slip rates of the checks.
const DRIVES: [f64; 9] = [0.0, 1e-12, 1e-6, 1e-2, 0.1, 0.6, 1.0, 10.0, 1e4];

/// Checks problems with a given slip rate as their solution.
pub(super) fn check<L: FrictionLaw + ?Sized>(
    law: &L,
    state: L::State,
    rate: f64,
) -> Result<(), FrictionViolation> {
    let coefficient = law.coefficient(rate, state);
    worst::of(
        VISCOSITIES
            .into_iter()
            .map(|viscosity| check_problem(law, state, viscosity, viscosity * rate + coefficient)),
    )
}

/// Checks problems whose solution may be any rate, or rest.
pub(super) fn check_drives<L: FrictionLaw + ?Sized>(
    law: &L,
    state: L::State,
) -> Result<(), FrictionViolation> {
    let problems = VISCOSITIES
        .into_iter()
        .flat_map(|viscosity| DRIVES.map(|drive| (viscosity, drive)));
    worst::of(problems.map(|(viscosity, drive)| check_problem(law, state, viscosity, drive)))
}

fn check_problem<L: FrictionLaw + ?Sized>(
    law: &L,
    state: L::State,
    viscosity: f64,
    drive: f64,
) -> Result<(), FrictionViolation> {
    let slip_rate = law.slip_rate(viscosity, drive, state);
    check_solution(law, state, [viscosity, drive], slip_rate, 4.0)
}

/// Checks that a slip rate solves a local problem to some roundings of its largest force.
pub(super) fn check_solution<L: FrictionLaw + ?Sized>(
    law: &L,
    state: L::State,
    [viscosity, drive]: [f64; 2],
    slip_rate: f64,
    roundings: f64,
) -> Result<(), FrictionViolation> {
    let value = state.value();
    let strength = law.coefficient(0.0, state);
    let wrong = |expected| FrictionViolation::SlipRate {
        state: value,
        viscosity,
        drive,
        strength,
        slip_rate,
        expected,
    };
    if drive <= strength && slip_rate != 0.0 {
        return Err(wrong(0.0));
    }
    let residual = |rate: f64| viscosity * rate + law.coefficient(rate, state) - drive;
    let balanced = slip_rate.is_finite() && slip_rate >= 0.0 && {
        let terms = drive
            .max(viscosity * slip_rate)
            .max(coefficient_terms(law, slip_rate, state));
        let spacing = (4.0 * f64::EPSILON * slip_rate).max(f64::MIN_POSITIVE);
        // Balanced, or as near to the root as numbers are, which also is all there is at rest.
        residual(slip_rate).abs() <= roundings * f64::EPSILON * terms
            || residual((slip_rate - spacing).max(0.0)) <= 0.0
                && residual(slip_rate + spacing) >= 0.0
            || drive <= strength
    };
    if balanced {
        return Ok(());
    }
    let (mut lower, mut upper) = (0.0, drive / viscosity);
    for _ in 0..1100 {
        let middle = if upper > 4.0 * lower && lower > 0.0 {
            lower.sqrt() * upper.sqrt()
        } else {
            f64::midpoint(lower, upper)
        };
        if residual(middle) < 0.0 {
            lower = middle;
        } else {
            upper = middle;
        }
    }
    Err(wrong(upper))
}
