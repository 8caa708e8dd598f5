//! The laboratory's experiments: velocity steps and holds.

use stickslip::problems::spring_slider::{AGING, FRICTION, LoadPath, SpringSlider};
use stickslip::{Point, RungeKutta, Sdirk2, Simulation, Snapshot, Steps};

use super::{RUINA, SLIP_DISTANCE, STEPPED, implicit, stepped};
use crate::Outcome;

/// The coefficient of friction by the spring force.
fn spring_force(slider: &SpringSlider, at: &Snapshot<'_, 1>) -> f64 {
    let stretch = slider.load.position(at.time) - at.displacement[0][0];
    slider.stiffness * stretch / slider.normal_stress
}

/// The largest distance to the published coefficients at 11, 12, ... 17 s, and the coefficient at
/// 100 s.
fn velocity_step(steps_a_second: usize) -> Outcome<(f64, f64)> {
    const PUBLISHED: [f64; 7] = [
        0.60720485, 0.60186637, 0.5840091, 0.58563096, 0.58899543, 0.58998186, 0.58879751,
    ];
    let slider = stepped(1e9);
    let mut block = implicit(slider.steady(STEPPED, AGING, 1e-6)?)?;
    let (mut worst, mut last) = (0_f64, f64::NAN);
    let steps = Steps::constant(1.0 / steps_a_second as f64).count(100 * steps_a_second);
    block.run(&steps, |at| {
        last = spring_force(&slider, &at);
        let second = at.step / steps_a_second;
        if at.step.is_multiple_of(steps_a_second) && (11..=17).contains(&second) {
            worst = worst.max((last - PUBLISHED[second - 11]).abs());
        }
    })?;
    Ok((worst, last))
}

/// Against another code, which integrates stress and state adaptively; eight digits are published.
#[test]
fn a_velocity_step_gives_the_published_values() -> Outcome {
    let (coarse, _) = velocity_step(200)?;
    assert!(coarse < 5e-7, "{coarse:e}");
    let (fine, last) = velocity_step(4000)?;
    assert!(fine < 5e-9, "{fine:e}");
    let steady = 0.6 + (STEPPED.a - STEPPED.b) * 10f64.ln();
    assert!((last - steady).abs() < 1e-11, "{last}, {steady}");
    Ok(())
}

/// A spring so stiff that the block follows the load point: the coefficient jumps by `a ln(V2/V1)`,
/// and settles at `(a - b) ln(V2/V1)` from where it was.
///
/// The spring needs a slip of `d = a sigma ln(10)/K` and some to be loaded, over which the state
/// takes some `b d/L` from the jump.
#[test]
fn a_stiff_spring_shows_the_direct_effect_and_the_steady_one() -> Outcome {
    let stiffness = 1e13;
    let slider = stepped(stiffness);
    let (jump, change) = (STEPPED.a * 10f64.ln(), (STEPPED.a - STEPPED.b) * 10f64.ln());
    let lost = STEPPED.b * jump * 1e6 / stiffness / SLIP_DISTANCE;
    let mut block = Simulation::new(slider.steady(STEPPED, AGING, 1e-6)?, Sdirk2, Point)?;
    let (mut peak, mut last) = (0_f64, f64::NAN);
    let steps = Steps::adaptive(1e-6).stopping_at(slider.load.kinks());
    block.run(&steps.until(60.0), |at| {
        last = spring_force(&slider, &at) - 0.6;
        peak = peak.max(last);
    })?;
    assert!(peak < jump && peak > jump - 5.0 * lost, "{peak}, {jump}");
    assert!((last - change).abs() < 1e-8, "{last}, {change}");
    Ok(())
}

/// Friction after a hold. On a stiff spring the block stands still: by the aging law the state is
/// older by the hold, by the slip law it has not changed.
///
/// While it stands the spring relaxes, by a slip of about `a sigma/K ln(t V/(a sigma/K))`; its
/// share of `L` is what is allowed.
#[test]
fn a_hold_ages_the_contact() -> Outcome {
    let hold = 100.0;
    let slider = SpringSlider {
        stiffness: 1e14,
        normal_stress: 1e6,
        mass: 0.0,
        damping: 0.0,
        load: LoadPath::steady(1e-6)
            .then(10.0, 0.0)
            .then(10.0 + hold, 1e-6),
    };
    let relaxation = FRICTION.a * slider.normal_stress / slider.stiffness;
    let slip = relaxation * (1.0 + hold * 1e-6 / relaxation).ln();
    let until = 10.0 + hold;
    let steps = Steps::adaptive(1e-6).stopping_at(slider.load.kinks());
    let steps = steps.until(until);
    let run = |mut block: RungeKutta<1>| -> Outcome<(f64, f64)> {
        block.run(&steps, |_| ())?;
        let at = block.snapshot();
        assert_eq!(at.time, until);
        Ok((at.contact(0).state(0).exp(), at.velocity[0][0]))
    };
    let (aged, rate) = run(RungeKutta::new(slider.steady(FRICTION, AGING, 1e-6)?)?)?;
    let expected = SLIP_DISTANCE / 1e-6 + hold;
    assert!(aged < expected && aged > expected * (1.0 - 2.0 * slip / SLIP_DISTANCE));
    assert!(rate < 1e-3 * 1e-6, "{rate:e}");
    let (held, _) = run(RungeKutta::new(slider.steady(FRICTION, RUINA, 1e-6)?)?)?;
    let fresh = SLIP_DISTANCE / 1e-6;
    // ln(V theta/L) is down to -20 at the end; the state takes its share of that.
    assert!(held > fresh && held < fresh * (1.0 + 20.0 * slip / SLIP_DISTANCE));
    Ok(())
}
