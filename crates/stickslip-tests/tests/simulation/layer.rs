//! The layer that waves solve exactly: the exact solution against an independent one, and the
//! finite elements against both.

use crate::common::onsets::Onsets;
use stickslip::problems::antiplane_layer::{
    AGING, AntiplaneLayer, END, ExactSample, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS,
};
use stickslip::state::{LogTheta, StateLaw};
use stickslip::{Contact, FixedPoint, Newmark, Simulation, StateUpdate, StepError, Tnnmg};

use crate::Outcome;
use crate::common::relative;

/// Independent values: the first times of 1e-3 m/s of the five events [s], and their peaks [m/s].
const EVENTS: [f64; 5] = [10.06626, 11.52372, 12.39249, 13.30089, 14.22048];
const PEAKS: [f64; 5] = [1.25707e-2, 4.4253e-3, 4.9326e-3, 5.0450e-3, 5.3074e-3];
/// `u(T)` [m].
const DISPLACEMENT_END: f64 = 1.119264e-3;

/// Rows of an independent solution: time [s], slip rate [m/s], displacement [m].
const ROWS: [(f64, f64, f64); 14] = [
    (1.027937863, 8.019128159e-31, 4.086238805e-30),
    (3.023346656, 7.446078766e-28, 1.432527842e-28),
    (5.018755448, 1.251005094e-21, 1.660504321e-22),
    (7.014164241, 4.724230548e-15, 6.198450580e-16),
    (9.009573034, 2.025919439e-8, 2.640560972e-9),
    (10.00727743, 1.103103440e-4, 8.669615924e-6),
    (10.06774436, 1.144937303e-3, 2.837553179e-5),
    (10.08286110, 9.472464203e-3, 8.295533676e-5),
    (10.09797783, 1.158746608e-2, 2.649078890e-4),
    (11.00498183, 5.977515891e-7, 3.889449228e-4),
    (11.53406751, 2.713194061e-3, 4.485980635e-4),
    (12.00268622, 5.509363262e-6, 5.641861942e-4),
    (13.00039062, 8.212524773e-6, 7.458760686e-4),
    (14.99579941, 2.485466744e-5, 1.119131461e-3),
];

fn exact(transit_steps: usize, observe: impl FnMut(ExactSample)) -> Result<(), StepError> {
    let initial = LogTheta(INITIAL_LOG_THETA);
    AntiplaneLayer::default().exact(&FRICTION, &AGING, initial, transit_steps, observe)
}

#[test]
fn exact_solution_agrees_with_an_independent_one() -> Outcome {
    let mut events = Onsets::new(1e-3, 2e-4);
    let mut slips = Onsets::new(2e-4, 2e-4);
    let mut peaks = Vec::new();
    let mut rows = ROWS.iter().peekable();
    let mut worst = (0_f64, 0_f64);
    let mut last: Option<ExactSample> = None;
    let mut end = f64::NAN;
    exact(1600, |at| {
        events.record(at.time, at.slip_rate);
        slips.record(at.time, at.slip_rate);
        if peaks.len() < events.times().len() {
            peaks.push(0.0);
        }
        if let Some(peak) = peaks.last_mut() {
            *peak = at.slip_rate.max(*peak);
        }
        if let Some(last) = last {
            let blend = |time: f64, a: f64, b: f64| {
                a + (b - a) * (time - last.time) / (at.time - last.time)
            };
            while let Some(&&(time, slip_rate, displacement)) = rows.peek() {
                if time > at.time {
                    break;
                }
                let rate = blend(time, last.slip_rate.ln(), at.slip_rate.ln()).exp();
                let place = blend(time, last.displacement, at.displacement);
                worst.0 = worst.0.max(relative(rate, slip_rate));
                // The independent solution floors the slip rate at 1e-30 m/s in the beginning.
                if displacement > 1e-26 {
                    worst.1 = worst.1.max(relative(place, displacement));
                }
                rows.next();
            }
            if last.time < END && at.time >= END {
                end = blend(END, last.displacement, at.displacement);
            }
        }
        last = Some(at);
    })?;
    assert!(rows.next().is_none());
    assert!((slips.times()[0] - 10.03274).abs() < 1.5e-5, "{slips:?}");
    assert_eq!(events.times().len(), EVENTS.len(), "{events:?}");
    for (k, (time, expected)) in events.times().iter().zip(EVENTS).enumerate() {
        let tolerance = if k == 0 { 1.5e-5 } else { 1e-4 };
        assert!((time - expected).abs() < tolerance, "{events:?}");
    }
    for (peak, expected) in peaks.iter().zip(PEAKS) {
        assert!(relative(*peak, expected) < 1e-4, "{peaks:?}");
    }
    assert!(relative(end, DISPLACEMENT_END) < 1e-5, "{end:e}");
    assert!(worst.0 < 1e-5 && worst.1 < 1e-6, "{worst:?}");
    Ok(())
}

/// `ln V` where the layer is about to slip, 9.997 s: all grids contain the multiples of the transit time, of which
/// this is number 620.
fn before_slip(law: &impl StateLaw<State = LogTheta>, transit_steps: usize) -> Outcome<f64> {
    let (mut n, mut logarithm) = (0, f64::NAN);
    let initial = LogTheta(INITIAL_LOG_THETA);
    AntiplaneLayer::default().exact(&FRICTION, law, initial, transit_steps, |at| {
        n += 1;
        if n == 620 * transit_steps {
            logarithm = at.slip_rate.ln();
        }
    })?;
    Ok(logarithm)
}

fn is_of_second_order(logarithms: [f64; 4]) {
    let changes = [0, 1, 2].map(|k| logarithms[k + 1] - logarithms[k]);
    for pair in changes.windows(2) {
        let ratio = pair[0] / pair[1];
        assert!((3.8..4.2).contains(&ratio), "{logarithms:?}, {changes:?}");
    }
}

/// The state is advanced exactly at the midpoint rate.
#[test]
fn exact_solution_converges_with_second_order() -> Outcome {
    let at = |steps| before_slip(&AGING, steps);
    is_of_second_order([at(25)?, at(50)?, at(100)?, at(200)?]);
    Ok(())
}

/// The aging law, with nothing known but its evolution.
struct Hidden;

impl StateLaw for Hidden {
    type State = LogTheta;

    fn evolution(&self, state: LogTheta, slip_rate: f64) -> f64 {
        AGING.evolution(state, slip_rate)
    }

    fn evolution_state_slope(&self, state: LogTheta, slip_rate: f64) -> f64 {
        AGING.evolution_state_slope(state, slip_rate)
    }
}

/// A law without closed forms is integrated to 1e-12 a step. The layer is stable until it slips, so that the errors of
/// its steps add up at most.
#[test]
fn exact_solution_needs_no_closed_form() -> Outcome {
    let (coarse, fine) = (before_slip(&Hidden, 13)?, before_slip(&Hidden, 26)?);
    let sum = |steps: f64| FRICTION.b / FRICTION.a * 620.0 * steps * 1e-12;
    assert!((coarse - before_slip(&AGING, 13)?).abs() < sum(13.0));
    assert!((fine - before_slip(&AGING, 26)?).abs() < sum(26.0));
    is_of_second_order([
        coarse,
        fine,
        before_slip(&Hidden, 52)?,
        before_slip(&Hidden, 104)?,
    ]);
    Ok(())
}

/// The error of the paper's coupling is that of the state, backward Euler with the final rate.
#[test]
fn first_event_is_met_with_first_order_in_the_step() -> Outcome {
    let error = |steps: usize| -> Outcome<f64> {
        let layer = AntiplaneLayer::default();
        assert_eq!(layer.cells, 64);
        let space = layer.space()?;
        let base = AntiplaneLayer::base(&space)?;
        let contact = Contact::new(&base, FRICTION, NORMAL_STRESS)
            .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
        let scene = layer.scene(&space)?.with_contact(contact);
        let solver = Tnnmg::new(space.transfers());
        let mut layer = Simulation::new(scene, Newmark::default(), solver)?
            .with_coupling(FixedPoint::paper())
            .with_state_update(StateUpdate::BackwardEuler);
        let vertex = base.vertices()[0];
        let mut events = Onsets::new(1e-3, 2e-4);
        let dt = END / steps as f64;
        while events.times().is_empty() {
            layer.step(dt)?;
            let at = layer.snapshot();
            assert!(at.time < 10.2, "no event");
            events.record(at.time, at.velocity[vertex][0]);
        }
        Ok(events.times()[0] - EVENTS[0])
    };
    let (coarse, fine) = (error(10_000)?, error(20_000)?);
    assert!(coarse.abs() < 5e-3, "{coarse:e}");
    let ratio = coarse / fine;
    assert!((1.9..2.1).contains(&ratio), "{coarse:e}, {fine:e}");
    Ok(())
}
