//! A run that is stopped anywhere, kept and gone on with elsewhere ends with the same bits.

use std::ops::ControlFlow;

use stickslip::fem::P1;
use stickslip::integrate::Stepper;
use stickslip::problems::pipping_slider::{
    AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider,
};
use stickslip::problems::spring_slider::{LoadPath, SpringSlider};
use stickslip::state::{Dieterich, LogTheta};
use stickslip::time::QuasiStatic;
use stickslip::{
    BackwardEuler, CentralDifferences, Contact, Coupling, Diagonal, ErrorControl, FixedPoint,
    GeneralizedAlpha, Monolithic, Newmark, Point, RateScheme, Run, RungeKutta, Sdirk2, Simulation,
    Staggered, StateUpdate, Steps,
};

use crate::Outcome;
use crate::common::{Solver, bits, body};

type Body = Simulation<2>;

/// So little that the slider slides after a second \[Pa\].
const LIGHT: f64 = 0.03 * NORMAL_STRESS;

/// The slider with two contacts, of which the right half forgets its state sooner.
fn slider(
    space: &P1<2>,
    scheme: Box<dyn RateScheme>,
    coupling: Box<dyn Coupling>,
    solver: Solver,
) -> Outcome<Body> {
    let left = space.trace(|x| x[1] == 0.0 && x[0] <= 2.5)?;
    let right = space.trace(|x| x[1] == 0.0 && x[0] >= 2.5)?;
    let sooner = Dieterich {
        slip_distance: 0.5 * AGING.slip_distance,
    };
    let initial = LogTheta(INITIAL_LOG_THETA);
    let scene = body(1)
        .scene(space)?
        .with_contact(Contact::new(&left, FRICTION, LIGHT).with_state(AGING, initial))
        .with_contact(Contact::new(&right, FRICTION, LIGHT).with_state(sooner, initial));
    Ok(Simulation::new(scene, scheme, solver.on(space))?.with_coupling(coupling))
}

/// The same, with changes measured in another norm than that of the operator.
fn absolute(slider: Body) -> Outcome<Body> {
    Ok(slider.with_absolute_tolerance(1e-10)?)
}

/// Schemes with and without inertia, of one and of two stages, with and without numbers of their own.
fn scheme(number: usize) -> Box<dyn RateScheme> {
    match number % 5 {
        0 => Box::new(Newmark::default()),
        1 => Box::new(GeneralizedAlpha {
            spectral_radius: 0.6,
        }),
        2 => Box::new(Sdirk2),
        3 => Box::new(BackwardEuler),
        _ => Box::new(QuasiStatic(Newmark::default())),
    }
}

fn coupling(number: usize) -> Box<dyn Coupling> {
    match number % 4 {
        0 => Box::new(FixedPoint::paper()),
        1 => Box::new(FixedPoint::default()),
        2 => Box::new(Monolithic::default()),
        _ => Box::new(Staggered::default()),
    }
}

/// Goes by `steps`, which are counted by the observer, up to `stop` of them.
fn go<const C: usize>(stepper: &mut dyn Stepper<C>, steps: &Steps, stop: usize) -> Outcome {
    let mut taken = 0;
    if stop > 0 {
        stepper.run(steps, |_| {
            taken += 1;
            if taken < stop {
                ControlFlow::Continue(())
            } else {
                ControlFlow::Break(())
            }
        })?;
    }
    Ok(())
}

/// Compares a run in one piece with one in several, each of another simulation.
fn same<const C: usize, S: Stepper<C>>(
    make: impl Fn() -> Outcome<S>,
    steps: &Steps,
    pieces: &[usize],
) -> Outcome<bool> {
    let mut whole = make()?;
    let mut peak = 0_f64;
    whole.run(steps, |at| peak = peak.max(at.max_slip_rate()))?;
    if peak < 1e-6 {
        return Err(format!("sticks: {peak:e}").into());
    }
    let mut kept = make()?.snapshot().state().clone();
    for &piece in pieces {
        let mut next = make()?;
        next.restore(&kept)?;
        go(&mut next, steps, piece)?;
        kept = next.snapshot().state().clone();
    }
    let mut last = make()?;
    last.restore(&kept)?;
    last.run(steps, |_| ())?;
    let (whole, last) = (whole.snapshot(), last.snapshot());
    Ok(bits(&whole) == bits(&last) && whole.state() == last.state())
}

fn check(same: Outcome<bool>, what: impl std::fmt::Debug) -> Outcome {
    match same {
        Ok(same) => {
            assert!(same, "other bits: {what:?}");
            Ok(())
        }
        Err(error) => Err(format!("{what:?}: {error}").into()),
    }
}

/// Ten ways to cut a run into up to `most` pieces of less than `longest` steps and a last one: the number of the way,
/// and the pieces.
fn cuts(most: usize, longest: usize) -> impl Iterator<Item = (usize, Vec<usize>)> {
    (0..10).map(move |n| {
        let piece = |k: usize| {
            // Digits of multiples of the golden ratio.
            let part = ((most * n + k) as f64 * 0.618_033_988_749_895).fract();
            (part * longest as f64) as usize
        };
        (n, (0..=n % most).map(piece).collect())
    })
}

/// Every coupling with every solver, through the first event.
#[test]
fn constant_steps() -> Outcome {
    for (first, pieces) in cuts(3, 250) {
        let space = body(1).space()?;
        // Ends of runs are times: rounding must not tell the pieces apart.
        let steps = Steps::constant(4e-3).until(2.0).stopping_at([0.5, 1.333]);
        for (k, solver) in Solver::ALL.into_iter().enumerate() {
            for number in 0..4 {
                let which = first + 4 * k + number;
                let make = || slider(&space, scheme(which), coupling(number), solver);
                check(same(make, &steps, &pieces), (which % 5, number, solver))?;
                if solver == Solver::Condensed {
                    let make = || absolute(make()?);
                    check(same(make, &steps, &pieces), (which % 5, number, "absolute"))?;
                }
            }
        }
    }
    Ok(())
}

/// Adaptive steps, whose size and errors go on as well.
#[test]
fn adaptive_steps() -> Outcome {
    for (n, pieces) in cuts(3, 40) {
        let (which, number) = (n % 5, n % 3);
        let space = body(1).space()?;
        for quantised in [false, true] {
            let steps = Steps::adaptive(1e-2)
                .with_first_step(1e-3)
                .with_error_control(ErrorControl {
                    slip_rate_floor: 1e-12,
                    ..ErrorControl::default()
                })
                .until(1.6);
            let steps = if quantised {
                steps.in_powers_of_two()
            } else {
                steps
            };
            let make = || slider(&space, scheme(which), coupling(number), Solver::Condensed);
            check(same(make, &steps, &pieces), (which, number, quantised))?;
            let make = || absolute(make()?);
            check(
                same(make, &steps, &pieces),
                (which, number, quantised, "absolute"),
            )?;
        }
    }
    Ok(())
}

/// A block on a spring by all of its methods, the explicit one included, through stick-slip cycles.
#[test]
fn springs() -> Outcome {
    for (number, pieces) in cuts(4, 60) {
        let block = SpringSlider {
            stiffness: 2.5e8,
            normal_stress: 1e6,
            mass: 0.0,
            damping: 5e6,
            load: LoadPath::steady(1e-6).then(40.0, 3e-6),
        };
        let scene = || block.steady(FRICTION, AGING, 1.01e-6);
        let steps = Steps::adaptive(1e-3)
            .until(300.0)
            .stopping_at(block.load.kinks());
        let explicit = || Ok(RungeKutta::new(scene()?)?);
        check(same(explicit, &steps, &pieces), "Runge-Kutta")?;
        let implicit = || Ok(Simulation::new(scene()?, scheme(number), Point)?);
        check(same(implicit, &steps, &pieces), number)?;
    }
    Ok(())
}

/// Central differences, half a pass a step.
#[test]
fn explicit_steps() -> Outcome {
    for (_, pieces) in cuts(3, 300) {
        let space = body(1).space()?;
        let steps = Steps::constant(2e-3).until(2.0);
        let make = || -> Outcome<Body> {
            let slider = PippingSlider {
                lumped: true,
                ..body(1)
            };
            let contact = Contact::new(&PippingSlider::bottom(&space)?, FRICTION, LIGHT);
            let scene = slider
                .scene(&space)?
                .with_contact(contact.with_state(AGING, LogTheta(INITIAL_LOG_THETA)));
            Ok(Simulation::new(scene, CentralDifferences, Diagonal::new())?
                .with_coupling(Staggered::default())
                .with_state_update(StateUpdate::Midpoint))
        };
        check(same(make, &steps, &pieces), "central differences")?;
    }
    Ok(())
}
