//! Earthquake cycles of one patch: the recurrence of independent codes.

use stickslip::friction::{FrictionLaw, RegularizedDieterichRuina};
use stickslip::problems::spring_slider::{LoadPath, SpringSlider};
use stickslip::state::{Reads, Sato, StateLaw};
use stickslip::{RungeKutta, Steps};

use crate::Outcome;

const YEAR: f64 = 365.25 * 86_400.0;
const PLATE: f64 = 1e-9;
const FRICTION: RegularizedDieterichRuina = RegularizedDieterichRuina {
    a: 0.010,
    b: 0.015,
    reference_friction: 0.6,
    reference_velocity: 1e-6,
    slip_distance: 8e-3,
};

/// The centre of a vertical strike-slip patch of 10 km by 10 km, 10 km deep in a half space.
fn patch() -> SpringSlider {
    SpringSlider {
        stiffness: 3.30904165e6,
        normal_stress: 50e6,
        mass: 0.0,
        damping: 32.04e9 / (2.0 * 3464.0),
        load: LoadPath::steady(PLATE),
    }
}

/// The last of some intervals between events in years, by the times at which the slip rate rises above 1 mm/s.
fn recurrence<L, S>(friction: L, law: S, tolerance: f64) -> Outcome<f64>
where
    L: FrictionLaw + 'static,
    S: StateLaw + 'static,
    L::State: Reads<S::State>,
{
    let mut block = RungeKutta::new(patch().steady(friction, law, 1.1 * PLATE)?)?;
    let (mut before, mut events) = ([0.0, PLATE.ln()], Vec::new());
    let threshold = 1e-3_f64.ln();
    block.run(&Steps::adaptive(tolerance).until(600.0 * YEAR), |at| {
        let now = [at.time, at.velocity[0][0].ln()];
        if before[1] < threshold && now[1] >= threshold {
            let share = (threshold - before[1]) / (now[1] - before[1]);
            events.push(before[0] + share * (now[0] - before[0]));
        }
        before = now;
    })?;
    let [.., last, end] = events[..] else {
        return Err("fewer than two events".into());
    };
    Ok((end - last) / YEAR)
}

#[test]
fn one_patch_recurs_as_in_independent_codes() -> Outcome {
    let distance = FRICTION.slip_distance;
    for (name, found, expected) in [
        (
            "aging",
            recurrence(FRICTION, FRICTION.aging(), 1e-7)?,
            66.6793,
        ),
        (
            "slip",
            recurrence(FRICTION, FRICTION.slip(), 1e-7)?,
            56.1492,
        ),
        (
            "Sato",
            recurrence(FRICTION, Sato::new(distance), 1e-7)?,
            62.9514,
        ),
    ] {
        println!("{name}: {found:.5} {expected}");
        assert!(
            (found - expected).abs() < 1e-4,
            "{name}: {found} {expected}"
        );
    }
    Ok(())
}

/// The state in units of friction is another variable of the same motion.
#[test]
fn states_in_units_of_friction_recur_alike() -> Outcome {
    let friction = FRICTION.in_psi();
    for (name, found, expected) in [
        (
            "aging",
            recurrence(friction, FRICTION.aging_in_psi(), 1e-7)?,
            66.6793,
        ),
        (
            "slip",
            recurrence(friction, FRICTION.slip_in_psi(), 1e-7)?,
            56.1492,
        ),
    ] {
        println!("{name}: {found:.5} {expected}");
        assert!(
            (found - expected).abs() < 1e-4,
            "{name}: {found} {expected}"
        );
    }
    Ok(())
}
