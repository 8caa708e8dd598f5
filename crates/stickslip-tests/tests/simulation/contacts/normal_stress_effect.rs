//! A body that slides under a swinging normal stress which its states follow.

use std::f64::consts::TAU;

use stickslip::problems::pipping_slider::{
    AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider,
};
use stickslip::state::{LogTheta, StateLaw};
use stickslip::{Condensed, Contact, Coupling, FixedPoint, Monolithic, Newmark, Simulation};

use crate::Outcome;
use crate::common::{body, distance};

const KAPPA: f64 = 0.3;
const DT: f64 = 2e-3;
const COUNT: usize = 1000;

/// So light that the body slides from the beginning; the swing grows along the bottom.
fn normal_stress(x: f64, time: f64) -> f64 {
    0.02 * NORMAL_STRESS * (1.0 + 0.1 * x * (TAU * time).sin())
}

fn sliding(coupling: impl Coupling + 'static) -> Outcome<Simulation<2>> {
    let space = body(1).space()?;
    let bottom = PippingSlider::bottom(&space)?;
    let places: Vec<f64> = bottom.points().iter().map(|point| point[0]).collect();
    let contact = Contact::new(&bottom, FRICTION, 0.02 * NORMAL_STRESS)
        .with_state(AGING, LogTheta(INITIAL_LOG_THETA))
        .with_normal_stress_history(move |time, stress| {
            for (stress, &x) in stress.iter_mut().zip(&places) {
                *stress = normal_stress(x, time);
            }
        })
        .with_normal_stress_effect(KAPPA);
    let scene = body(1).scene(&space)?.with_contact(contact);
    Ok(
        Simulation::new(scene, Newmark::default(), Condensed::new())?
            .with_coupling(coupling)
            .with_absolute_tolerance(1e-13)?,
    )
}

/// Each state is the law's exact solution at the rate in the middle of a step between the two halves of what the
/// normal stress does; the couplings agree on it.
#[test]
fn states_of_a_body_follow_the_normal_stress() -> Outcome {
    let mut at_once = sliding(Monolithic::without_fallback())?;
    let mut in_turns = sliding(FixedPoint::paper())?;
    let mut fastest = 0.0_f64;
    for _ in 0..COUNT {
        let before = at_once.state().clone();
        at_once.step(DT)?;
        in_turns.step(DT)?;
        let left = at_once.residuals(&before);
        assert!(left.state < 1e-12, "{left:?}");
        let (now, seen) = (at_once.snapshot(), at_once.snapshot().contact(0));
        fastest = fastest.max(now.max_slip_rate());
        for k in 0..seen.len() {
            let ends = [before.clock.time(), now.time].map(|t| normal_stress(seen.point(k)[0], t));
            assert!((seen.normal_stress(k) / ends[1] - 1.0).abs() < 1e-14);
            let half =
                LogTheta(before.contacts[0].states[k] - 0.5 * KAPPA * (ends[1] / ends[0]).ln());
            let rates = [before.velocity[seen.vertex(k)][0].abs(), seen.slip_rate(k)];
            let exact = AGING.advance_exact(half, 0.5 * (rates[0] + rates[1]), DT);
            let LogTheta(alpha) = exact.ok_or("no closed form")?;
            let expected = alpha - 0.5 * KAPPA * (ends[1] / ends[0]).ln();
            assert!((seen.state(k) - expected).abs() < 1e-12);
        }
    }
    assert!(fastest > 1e-5, "{fastest:e}");
    let [a, b] = [at_once.state(), in_turns.state()];
    assert!(distance(&a.velocity, &b.velocity) < 1e-6 * fastest);
    for (a, b) in a.contacts[0].states.iter().zip(&b.contacts[0].states) {
        assert!((a - b).abs() < 1e-6, "{a} {b}");
    }
    Ok(())
}
