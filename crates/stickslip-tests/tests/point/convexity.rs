//! Whether a step has a single solution, against a dense scan of the friction law.

use nalgebra::SMatrix;
use stickslip::friction::{DieterichRuina, FrictionLaw};
use stickslip::problems::spring_slider::{AGING, FRICTION};
use stickslip::state::LogTheta;
use stickslip::{
    BackwardEuler, BoundaryPart, Contact, Point, Scene, Sdirk2, Simulation, StateUpdate, StepError,
};

use crate::Outcome;

const NORMAL_STRESS: f64 = 1e6;
const STIFFNESS: f64 = 1e8;
const DAMPING: f64 = 5e6;

fn block(mass: f64, state: f64) -> Outcome<Simulation<1>> {
    let contact = Contact::new(BoundaryPart::point(1.0), FRICTION, NORMAL_STRESS)
        .with_state(AGING, LogTheta(state));
    let scene = Scene::new(SMatrix::from([[STIFFNESS]]))
        .with_mass(SMatrix::from([[mass]]))
        .with_viscosity(SMatrix::from([[DAMPING]]))
        .with_contact(contact);
    Ok(Simulation::new(scene, BackwardEuler, Point)?.with_state_update(StateUpdate::BackwardEuler))
}

/// `-min sigma_n (a/V - b (dt/L)/(1 + omega))` over slip rates above the cut-off, where `omega = dt exp(-alpha)` and
/// `alpha` solves `alpha - dt (exp(-alpha) - V/L) = alpha_o`.
fn steepest(dt: f64, start: f64, fastest: f64) -> f64 {
    let DieterichRuina {
        a,
        b,
        slip_distance,
        ..
    } = FRICTION;
    let mut least = 0.0_f64;
    for n in 0..400_000 {
        let rate = fastest * (-1e-4 * f64::from(n)).exp();
        // Convex from below: Newton's method from a point below the root rises to it.
        let drive = start - dt * rate / slip_distance;
        let mut alpha = drive;
        for _ in 0..200 {
            let omega = (dt.ln() - alpha).min(600.0).exp();
            let step = (drive + omega - alpha) / (1.0 + omega);
            alpha += step;
            if step.abs() < 1e-14 * alpha.abs() {
                break;
            }
        }
        if rate.ln() < FRICTION.ln_cutoff_rate(LogTheta(alpha)) {
            continue;
        }
        let omega = (dt.ln() - alpha).exp();
        least = least.min(a / rate - b * dt / slip_distance / (1.0 + omega));
    }
    -NORMAL_STRESS * least
}

#[test]
fn a_block_is_convex_up_to_the_mass_that_bears_the_steepest_weakening() -> Outcome {
    for (dt, state) in [(1e-3, 2.0), (1e-2, 12.0), (0.3, -3.0)] {
        let found = block(1.0, state)?.convexity(dt, 0.1)?;
        let weakening = steepest(dt, state, 0.1);
        // The scan of the slope is 1e-4 apart in ln V: its minimum is right to some 1e-8.
        assert!(
            (found.weakening / weakening - 1.0).abs() < 1e-6,
            "{found:?}, {weakening:e}"
        );
        assert!(found.weakening < FRICTION.b * dt / FRICTION.slip_distance * NORMAL_STRESS);
        assert!((found.b_over_a - 1.5).abs() < 1e-12);
        // c_a m + c + c_u k
        let resistance = 1.0 / dt + DAMPING + dt * STIFFNESS;
        assert!((found.diagonal_stiffness / resistance - 1.0).abs() < 1e-14);
        let critical = (weakening - DAMPING - dt * STIFFNESS) * dt;
        for (factor, convex) in [(1.0 - 1e-5, false), (1.0 + 1e-5, true)] {
            let mut block = block((factor * critical).max(1e-9), state)?;
            assert_eq!(block.convexity(dt, 0.1)?.convex, convex || critical < 0.0);
        }
    }
    Ok(())
}

/// While the slip of a step is below `a/b` of `L`, friction strengthens, its state following.
#[test]
fn friction_strengthens_while_a_step_slips_less_than_a_over_b_of_the_slip_distance() -> Outcome {
    let dt = 1e-2;
    let rate = FRICTION.a / FRICTION.b * FRICTION.slip_distance / dt;
    let mut block = block(1.0, 20.0)?;
    let slow = block.convexity(dt, rate)?;
    assert_eq!((slow.weakening, slow.convex), (0.0, true));
    assert!(block.convexity(dt, 1.01 * rate)?.weakening > 0.0);
    Ok(())
}

/// The bound of Dieterich's law from any state, `b c w sigma_n/L`, is reached by old contacts: half of it at the midpoint.
#[test]
fn an_old_contact_weakens_by_the_bound() -> Outcome {
    let dt = 1e-2;
    let bound = FRICTION.b * dt / FRICTION.slip_distance * NORMAL_STRESS;
    let mut block = block(1.0, 1e4)?;
    assert!((block.convexity(dt, 1e3)?.weakening / bound - 1.0).abs() < 1e-3);
    let mut midpoint = block.with_state_update(StateUpdate::Midpoint);
    assert!((midpoint.convexity(dt, 1e3)?.weakening / (0.5 * bound) - 1.0).abs() < 1e-3);
    // A stage of Sdirk2 is backward Euler over its share.
    midpoint.set_scheme(Sdirk2)?;
    let share = 1.0 - 0.5_f64.sqrt();
    assert!((midpoint.convexity(dt, 1e3)?.weakening / (share * bound) - 1.0).abs() < 1e-3);
    Ok(())
}

#[test]
fn asking_changes_nothing() -> Outcome {
    let (mut asked, mut other) = (block(1e4, 2.0)?, block(1e4, 2.0)?);
    for _ in 0..3 {
        asked.convexity(0.3, 1.0)?;
        asked.step(1e-3)?;
        asked.convexity(1e-5, 1e2)?;
        other.step(1e-3)?;
        assert_eq!(asked.state(), other.state());
    }
    Ok(())
}

#[test]
fn wrong_numbers_are_refused() -> Outcome {
    let mut block = block(1.0, 0.0)?;
    for dt in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(
            block.convexity(dt, 1.0),
            Err(StepError::StepSize { .. })
        ));
        assert!(matches!(
            block.convexity(1.0, dt),
            Err(StepError::Control { .. })
        ));
    }
    Ok(())
}

/// A law that weakens nowhere is convex.
#[test]
fn a_law_without_state_is_convex() -> Outcome {
    let law = stickslip::friction::Tresca { coefficient: 0.6 };
    assert_eq!(law.coefficient_rate_slope(1.0, ()), 0.0);
    let scene = Scene::new(SMatrix::<f64, 1, 1>::new(1e3)).with_contact(Contact::new(
        BoundaryPart::point(1.0),
        law,
        1e5,
    ));
    let found = Simulation::new(scene, BackwardEuler, Point)?.convexity(1e6, 1e3)?;
    assert!(found.convex && found.weakening == 0.0 && found.b_over_a == 0.0);
    Ok(())
}
