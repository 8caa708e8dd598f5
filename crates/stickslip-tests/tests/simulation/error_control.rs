//! The error control measures what a scene has, and lets go what it does not need.

use std::f64::consts::TAU;

use nalgebra::{SMatrix, SVector, Vector1};
use stickslip::fem::{Elastic, P1, body_force, elasticity, mass};
use stickslip::friction::{DieterichRuina, Tresca};
use stickslip::integrate::RunReport;
use stickslip::problems::pipping_slider::{
    AGING, END, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider, load_velocity,
};
use stickslip::solvers::ConjugateGradients;
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{
    BackwardEuler, BlockMatrix, Cholesky, Components, Condensed, Contact, Coupling, ErrorControl,
    FixedPoint, Monolithic, Newmark, Point, RateScheme, Scene, SceneError, Sdirk2, Simulation,
    StateUpdate, StepError, Steps,
};

use crate::Outcome;
use crate::common::body;

/// Ten periods of an oscillator: what it misses in the end, and its steps.
fn ten_periods(tolerance: f64) -> Outcome<(f64, usize)> {
    let scene = Scene::new(SMatrix::<f64, 1, 1>::new(1.0))
        .with_mass(SMatrix::<f64, 1, 1>::new(1.0))
        .with_displacement(vec![Vector1::new(1.0)]);
    let mut oscillator = Simulation::new(scene, Newmark::default(), Point)?;
    let report = oscillator.run(&Steps::adaptive(tolerance).until(10.0 * TAU), |_| ())?;
    let at = oscillator.snapshot();
    let missed = (at.displacement[0][0] - 1.0).hypot(at.velocity[0][0]);
    Ok((missed, report.accepted))
}

/// Newmark's phase is behind by `dt^3/12` a step, and by a quarter of that in two halves: the estimate, a third of
/// the difference, is `dt^3/48`, and the result, that of the halves, is behind by `t dt^2/48`. Steps aim at 0.8 of
/// the tolerance.
#[test]
fn an_oscillator_is_followed() -> Outcome {
    for tolerance in [1e-3, 1e-4, 1e-5, 1e-6] {
        let (missed, steps) = ten_periods(tolerance)?;
        let step = (48.0 * 0.8 * tolerance).cbrt();
        let (phase, expected) = (10.0 * TAU * step * step / 48.0, 10.0 * TAU / step);
        // To leading order, and but for a beginning with a millionth of the run.
        assert!(
            (missed / phase - 1.0).abs() < 0.1,
            "{tolerance}: {missed}, {phase}"
        );
        let more = steps as f64 - expected;
        assert!(
            (0.0..0.05 * expected + 20.0).contains(&more),
            "{steps}, {expected}"
        );
    }
    Ok(())
}

/// An oscillator at rest is pushed after 100 s, by a ramp of a second or at once, with a stop there, also if it rests under
/// a weight of ten thousand times the push. It misses no more than the tolerance, of its largest motion, in every step;
/// and goes on with the same bits from the last step at rest.
#[test]
fn a_body_at_rest_is_followed_from_its_onset_on() -> Outcome {
    follows_an_onset(true)
}

/// A ramp without a stop, too. A jump needs one: what a step from rest misses of it is a fixed share of the motion.
#[test]
fn a_body_at_rest_is_followed_from_an_onset_that_nobody_tells() -> Outcome {
    follows_an_onset(false)
}

fn follows_an_onset(told: bool) -> Outcome {
    // The seconds that the load takes to rise, none for a jump, and where it leads.
    let rises = [
        (1.0, 1.0 - 30_f64.sin() + 29_f64.sin()),
        (0.0, 1.0 - 30_f64.cos()),
    ];
    for tolerance in [1e-3, 1e-4, 1e-5] {
        let steps = Steps::adaptive(tolerance).until(130.0);
        let weights = [0.0, 1e4];
        let rises = if told { &rises[..] } else { &rises[..1] };
        let cases = weights.map(|weight| {
            rises
                .iter()
                .map(move |&(rise, expected)| (weight, rise, expected))
        });
        for (weight, rise, expected) in cases.into_iter().flatten() {
            let load = move |since: f64| {
                if since <= 0.0 {
                    0.0
                } else {
                    (since / rise).min(1.0)
                }
            };
            let steps = if told {
                steps.clone().stopping_at([100.0])
            } else {
                steps.clone()
            };
            {
                let make = || {
                    let scene = Scene::new(SMatrix::<f64, 1, 1>::new(1.0))
                        .with_mass(SMatrix::<f64, 1, 1>::new(1.0))
                        .with_load_history(move |time, at| at[0][0] = weight + load(time - 100.0))
                        .in_equilibrium(ConjugateGradients::default());
                    Simulation::new(scene, Newmark::default(), Point)
                };
                let (mut oscillator, mut again) = (make()?, make()?);
                let mut kept = again.state().clone();
                let mut largest = 0_f64;
                let report = oscillator.run(&steps, |at| {
                    let moved = at.displacement[0][0] - weight;
                    largest = largest.max(moved.hypot(at.velocity[0][0]));
                    if at.time < 100.0 {
                        kept = at.state().clone();
                    }
                })?;
                again.restore(&kept)?;
                again.run(&steps, |_| ())?;
                assert_eq!(again.state(), oscillator.state());
                let moved = oscillator.snapshot().displacement[0][0] - weight;
                let missed = (moved - expected).abs();
                // The floor of the motion: `motion_floor` times that of the equilibrium, whose stiffness is 1.
                let floor = ErrorControl::default().motion_floor * weight;
                let allowed = tolerance * report.accepted as f64 * (largest + floor);
                assert!(missed < allowed, "{tolerance}: {missed}, {allowed}");
                assert!(allowed < 0.4, "{} steps", report.accepted);
            }
        }
    }
    Ok(())
}

/// A body in the equilibrium of its weight stays there: what rounding leaves of it is no motion.
#[test]
fn an_equilibrium_asks_for_no_steps() -> Outcome {
    let slider = PippingSlider {
        recurrent: false,
        ..body(2)
    };
    let space = slider.space()?;
    let weight = SVector::from([0.0, -slider.density * slider.gravity]);
    let scene = Scene::new(elasticity(&space, &slider.elastic)?)
        .with_mass(mass(&space, slider.density)?)
        .with_load(body_force(&space, |_| weight))
        .fix(&PippingSlider::bottom(&space)?, Components::ALL)
        .in_equilibrium(Cholesky::new());
    let mut simulation = Simulation::new(scene, Newmark::default(), Condensed::new())?;
    let start = simulation.snapshot().displacement.to_vec();
    let report = simulation.run(
        &Steps::adaptive(1e-6)
            .with_first_step(1e-3)
            .with_max_steps(1000)
            .until(100.0),
        |_| (),
    )?;
    assert!(report.accepted + report.rejected < 50, "{report:?}");
    let end = simulation.snapshot().displacement;
    let most = |x: &[SVector<f64, 2>]| x.iter().map(SVector::amax).fold(0.0, f64::max);
    let pairs = end.iter().zip(&start);
    let moved: Vec<_> = pairs.map(|(end, start)| end - start).collect();
    assert!(most(&moved) <= 1e-8 * most(&start));
    Ok(())
}

/// A body swings in its lowest mode: shear waves up and down a column, of which every period returns to the start.
#[test]
fn a_body_without_contact_is_followed() -> Outcome {
    check_column(&P1::grid([0.25, 1.0], [1, 8])?)?;
    check_column(&P1::grid([0.25, 0.25, 1.0], [1, 1, 8])?)
}

fn check_column<const D: usize>(space: &P1<D>) -> Outcome {
    let bottom = space.trace(|x| x[D - 1] == 0.0)?;
    let sides = space.trace(|x| x[0] == 0.0 || x[0] == 0.25)?;
    let elastic = Elastic {
        young_modulus: 1.0,
        poisson_ratio: 0.0,
    };
    let run = |tolerance: f64| -> Outcome<(Vec<SVector<f64, D>>, usize)> {
        let start = space.interpolate(|x| {
            let across = (0.25 * TAU * x[D - 1]).sin();
            SVector::<f64, D>::from_fn(|c, _| if c == 0 { across } else { 0.0 })
        });
        let scene = Scene::new(elasticity(space, &elastic)?)
            .with_mass(mass(space, 1.0)?)
            .fix(&bottom, [true; D])
            .fix(&sides, std::array::from_fn(|c| c != 0))
            .with_displacement(start);
        let mut column = Simulation::new(scene, Newmark::default(), Condensed::new())?;
        let report = column.run(&Steps::adaptive(tolerance).until(20.0), |_| ())?;
        Ok((column.snapshot().displacement.to_vec(), report.accepted))
    };
    let distance = |a: &[SVector<f64, D>], b: &[SVector<f64, D>]| {
        let pairs = a.iter().zip(b);
        pairs.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
    };
    let (exact, _) = run(1e-7)?;
    let [coarse, fine] = [run(1e-5)?, run(1e-6)?];
    let errors = [distance(&coarse.0, &exact), distance(&fine.0, &exact)];
    // The error goes with the square of the step, the step with the cube root of the tolerance.
    assert!(
        errors[0] < 0.05 && errors[1] < 0.4 * errors[0],
        "{errors:?}"
    );
    assert!(fine.1 > 18 * coarse.1 / 10, "{} {}", coarse.1, fine.1);
    Ok(())
}

/// The slider, loaded a thousand times as slowly as the paper's and without viscosity.
fn slow_slider(
    slider: &PippingSlider,
    space: &P1<2>,
) -> Result<Scene<BlockMatrix<2>, 2>, SceneError> {
    let weight = SVector::from([0.0, -slider.density * slider.gravity]);
    let contact = Contact::new(&PippingSlider::bottom(space)?, FRICTION, NORMAL_STRESS);
    Ok(Scene::new(elasticity(space, &slider.elastic)?)
        .with_mass(mass(space, slider.density)?)
        .with_load(body_force(space, |_| weight))
        .with_contact(contact.with_state(AGING, LogTheta(INITIAL_LOG_THETA)))
        .prescribe_velocity(&PippingSlider::top(space)?, Components::ALL, |time| {
            [load_velocity(1e-3 * time) * 1e-3, 0.0]
        })
        .in_equilibrium(Cholesky::new()))
}

/// Waves of an event that nothing damps do not bound the steps after it: a wave crosses a cell in 8 ms, and a
/// run of 65 000 s would take 10^7 steps of that size.
#[test]
fn an_elastic_body_gets_past_its_events() -> Outcome {
    let slider = body(1);
    let space = slider.space()?;
    let scene = slow_slider(&slider, &space)?;
    let solver = Condensed::new().with_cached_factors(24);
    let mut simulation = Simulation::new(scene, Sdirk2, solver)?;
    let steps = Steps::adaptive(1e-2)
        .with_first_step(1.5)
        .in_powers_of_two()
        .stopping_at([1e3 * END / 4.0])
        .with_max_steps(20_000)
        .until(65_000.0);
    let (mut peak, mut slow) = (0.0_f64, f64::INFINITY);
    simulation.run(&steps, |at| {
        peak = peak.max(at.max_slip_rate());
        if peak > 1e-6 {
            slow = slow.min(at.max_slip_rate());
        }
    })?;
    // It slipped, and rested again.
    assert!(peak > 1e-6 && slow < 1e-7, "{peak:e}, {slow:e}");
    Ok(())
}

/// A body under Coulomb's friction lets go with a front that no step resolves: steps stay those of the motion.
#[test]
fn a_body_under_tresca_gets_past_its_first_slip() -> Outcome {
    let slider = PippingSlider {
        recurrent: false,
        ..body(1)
    };
    let space = slider.space()?;
    let run = |scheme: Box<dyn RateScheme>| -> Outcome<(f64, RunReport)> {
        let law = Tresca { coefficient: 0.6 };
        let contact = Contact::new(&PippingSlider::bottom(&space)?, law, 0.02 * NORMAL_STRESS);
        let scene = slider.scene(&space)?.with_contact(contact);
        let mut simulation = Simulation::new(scene, scheme, Condensed::new())?;
        let steps = Steps::adaptive(1e-3)
            .with_first_step(1e-3)
            .stopping_at([END / 4.0])
            .until(END);
        let report = simulation.run(&steps, |_| ())?;
        let centre = PippingSlider::centre(&space).ok_or("no centre")?;
        Ok((simulation.snapshot().displacement[centre][0], report))
    };
    let (newmark, report) = run(Box::<Newmark>::default())?;
    assert!(report.accepted + report.rejected < 5_000, "{report:?}");
    let (damped, report) = run(Box::new(Sdirk2))?;
    assert!(report.accepted + report.rejected < 2_000, "{report:?}");
    // Both followed the top, which has moved by 2.6 mm.
    assert!((newmark / damped - 1.0).abs() < 0.05, "{newmark} {damped}");
    assert!(damped > 2e-3, "{damped}");
    Ok(())
}

/// A slider of few vertices whose density is far below the paper's.
fn light(density: f64, young_modulus: f64, poisson_ratio: f64) -> PippingSlider {
    PippingSlider {
        refinements: 1,
        density,
        elastic: Elastic {
            young_modulus,
            poisson_ratio,
        },
        recurrent: false,
        ..PippingSlider::default()
    }
}

/// A light and soft body that hardly moves yet: its slip rates of 6e-18 m/s are what the solver leaves.
#[test]
fn rates_of_rounding_noise_ask_for_no_steps() -> Outcome {
    let slider = light(2.2266, 196_006.0, 0.3);
    let space = slider.space()?;
    let friction = DieterichRuina {
        a: 0.0232,
        b: 0.0,
        slip_distance: 0.0024,
        ..FRICTION
    };
    let law = Dieterich {
        slip_distance: 0.0024,
    };
    let contact = Contact::new(&PippingSlider::bottom(&space)?, friction, 189.2);
    let scene = (slider.scene(&space)?).with_contact(contact.with_state(law, LogTheta(2.19)));
    let mut simulation = Simulation::new(scene, Newmark::default(), Condensed::new())?;
    let steps = Steps::adaptive(1e-2)
        .with_first_step(END / 1e4)
        .in_powers_of_two();
    let report = simulation.run(&steps.until(0.006 * END), |_| ())?;
    assert!(report.accepted + report.rejected < 100, "{report:?}");
    assert!(simulation.snapshot().max_slip_rate() < 1e-16);
    Ok(())
}

/// One rounding of a slip rate moves the forces of a stiff body by more than the weak friction on it leaves unexplained:
/// no step is refused for that, and none made smaller.
#[test]
fn weak_friction_on_a_stiff_body_is_in_balance_up_to_rounding() -> Outcome {
    let slider = PippingSlider {
        refinements: 2,
        mirrored: true,
        ..light(5.0, 1e12, 0.4999)
    };
    let space = slider.space()?;
    let friction = DieterichRuina {
        reference_velocity: 1e-12,
        ..FRICTION
    };
    let contact = Contact::new(&PippingSlider::bottom(&space)?, friction, 1.0);
    let contact = contact.with_state(AGING, LogTheta(INITIAL_LOG_THETA));
    let scene = slider.scene(&space)?.with_contact(contact);
    let mut simulation = Simulation::new(scene, Newmark::default(), Condensed::new())?
        .with_coupling(FixedPoint::paper())
        .with_absolute_tolerance(1e-14)?;
    let steps = Steps::adaptive(1e-2)
        .with_first_step(END / 1e3)
        .in_powers_of_two();
    let steps = steps.with_max_steps(1000).until(0.5 * END);
    let report = simulation.run(&steps, |_| ())?;
    assert!(report.accepted + report.rejected < 300, "{report:?}");
    Ok(())
}

/// Where friction grows by 1e-4 of the pressure while the rate does e-fold, a rounding error of the state that it reads
/// moves the rate by more than an absolute tolerance far below both: a fixed point ends at what is left, and follows
/// the run that solves for both at once.
#[test]
fn rates_that_friction_hardly_tells_apart_are_coupled_up_to_rounding() -> Outcome {
    let slider = light(5e-3, 1e12, 0.0);
    let space = slider.space()?;
    let (a, slip_distance) = (1e-4, 1e-7);
    let friction = DieterichRuina {
        a,
        slip_distance,
        ..FRICTION
    };
    let run = |coupling: Box<dyn Coupling>| -> Outcome<(RunReport, f64)> {
        let contact = Contact::new(&PippingSlider::bottom(&space)?, friction, NORMAL_STRESS)
            .with_state(Dieterich { slip_distance }, LogTheta(100.0));
        let scene = slider.scene(&space)?.with_contact(contact);
        let mut simulation = Simulation::new(scene, Newmark::default(), Condensed::new())?
            .with_coupling(coupling)
            .with_state_update(StateUpdate::Midpoint)
            .with_absolute_tolerance(1e-12)?;
        let steps = Steps::adaptive(0.1).with_first_step(END).in_powers_of_two();
        let report = simulation.run(&steps.until(0.1 * END), |_| ())?;
        Ok((report, simulation.snapshot().max_slip_rate()))
    };
    let (at_once, expected) = run(Box::<Monolithic>::default())?;
    let (in_turn, rate) = run(Box::new(FixedPoint::paper()))?;
    let tried = |report: &RunReport| report.accepted + report.rejected + report.failed;
    let (one, other) = (tried(&at_once), tried(&in_turn));
    assert!(one.abs_diff(other) <= one / 10, "{at_once:?}, {in_turn:?}");
    assert!((rate / expected - 1.0).abs() < 1e-6, "{rate} {expected}");
    Ok(())
}

#[test]
fn extrapolation_is_refused_where_waves_would_grow() -> Outcome {
    let slider = body(1);
    let space = slider.space()?;
    let make = |scheme: Box<dyn RateScheme>| -> Outcome<_> {
        let scene = slow_slider(&slider, &space)?;
        Ok(Simulation::new(scene, scheme, Condensed::new())?)
    };
    let steps = Steps::adaptive(1e-2).with_error_control(ErrorControl::extrapolated(2));
    let mut newmark = make(Box::<Newmark>::default())?;
    let failure = newmark
        .run(&steps.clone().count(1), |_| ())
        .err()
        .ok_or("taken")?;
    let StepError::Extrapolation { order: 2 } = failure.cause else {
        return Err(failure.into());
    };
    assert_eq!(newmark.snapshot().step, 0);
    make(Box::new(BackwardEuler))?.run(&steps.count(1), |_| ())?;
    Ok(())
}
