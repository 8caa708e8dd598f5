//! After the first step the time loop takes no memory: neither solver, coupling nor recorders.

use stickslip::integrate::Stepper;
use stickslip::problems::pipping_slider::{
    AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider,
};
use stickslip::problems::spring_slider::{LoadPath, SpringSlider, steady_state};
use stickslip::record::{EventCatalogue, PointHistories};
use stickslip::reduced::Reduced;
use stickslip::state::LogTheta;
use stickslip::{
    Contact, DenseNewton, ErrorControl, GeneralizedAlpha, Monolithic, Newmark, Point, RateScheme,
    Run, RungeKutta, Sdirk2, Simulation, StateUpdate, Steps,
};

use crate::Outcome;
use crate::common::{STEP, Sliding, Solver, body, centre, paper_slider, slide};

/// Through stick and slip no step of the paper's size takes memory but the first one.
fn allocates_nothing(slider: &mut Sliding, vertex: usize) -> Outcome {
    const STEPS: usize = 6800;
    let (mut slowest, mut fastest) = (f64::INFINITY, 0_f64);
    slider.step(STEP)?;
    let start = slider.snapshot();
    let mut history = PointHistories::new(&start, &[vertex], 1, std::io::sink())?;
    let mut catalogue = EventCatalogue::new(&start, 0, [1e-3, 1e-4], 2e7, 8)?;
    let steps = Steps::constant(STEP).count(STEPS - 1);
    let mut outcome = None;
    let info = allocation_counter::measure(|| {
        outcome = Some(slider.run(&steps, |at| {
            catalogue.record(&at);
            slowest = slowest.min(at.max_slip_rate());
            fastest = fastest.max(at.max_slip_rate());
            history.record(&at)
        }));
    });
    outcome.ok_or("not run")??;
    history.finish()?;
    assert!(!catalogue.events().is_empty() || catalogue.is_under_way());
    assert!(
        slowest < 1e-20 && fastest > 5e-3,
        "{slowest:e}, {fastest:e}"
    );
    assert_eq!(info.count_total, 0);
    Ok(())
}

/// The counter itself works.
#[test]
fn the_counter_counts() -> Outcome {
    let mut made = Vec::new();
    let info = allocation_counter::measure(|| made = vec![1.0; 1000]);
    assert_eq!((info.count_total, made.len()), (1, 1000));
    Ok(())
}

/// The paper's coupling, rate and state in turns.
fn in_turns(refinements: usize, solver: Solver) -> Outcome {
    let body = body(refinements);
    let space = body.space()?;
    let mut slider = paper_slider(&body, &space, solver, 1e-10)?;
    allocates_nothing(&mut slider, centre(&space)?)
}

#[test]
fn multigrid_allocates_nothing_in_stick_and_slip() -> Outcome {
    in_turns(3, Solver::Tnnmg)
}

#[test]
fn condensation_allocates_nothing_in_stick_and_slip() -> Outcome {
    in_turns(2, Solver::Condensed)
}

#[test]
fn gauss_seidel_allocates_nothing_in_stick_and_slip() -> Outcome {
    in_turns(1, Solver::GaussSeidel)
}

/// The paper's slider with the state eliminated.
fn eliminated(
    refinements: usize,
    solver: Solver,
    scheme: impl RateScheme + 'static,
    state_update: StateUpdate,
) -> Outcome<(Sliding, usize)> {
    let body = body(refinements);
    let space = body.space()?;
    let laws = (FRICTION, AGING, LogTheta(INITIAL_LOG_THETA));
    let slider = slide(&body, &space, laws, scheme, solver, 1e-10)?
        .with_coupling(Monolithic::default())
        .with_state_update(state_update);
    Ok((slider, centre(&space)?))
}

#[test]
fn elimination_and_condensation_allocate_nothing() -> Outcome {
    at_once(
        3,
        Solver::Condensed,
        [
            (
                Box::new(Newmark::default()) as Box<dyn RateScheme>,
                StateUpdate::BackwardEuler,
            ),
            (Box::new(Newmark::default()), StateUpdate::Midpoint),
            (Box::new(Sdirk2), StateUpdate::BackwardEuler),
            (
                Box::new(GeneralizedAlpha {
                    spectral_radius: 0.8,
                }),
                StateUpdate::Midpoint,
            ),
        ],
    )
}

#[test]
fn elimination_and_multigrid_allocate_nothing() -> Outcome {
    at_once(
        2,
        Solver::Tnnmg,
        [
            (
                Box::new(Newmark::default()) as Box<dyn RateScheme>,
                StateUpdate::Midpoint,
            ),
            (Box::new(Sdirk2), StateUpdate::BackwardEuler),
        ],
    )
}

/// Rate and state at once, by several schemes.
fn at_once<const N: usize>(
    refinements: usize,
    solver: Solver,
    schemes: [(Box<dyn RateScheme>, StateUpdate); N],
) -> Outcome {
    for (scheme, update) in schemes {
        let (mut slider, x0) = eliminated(refinements, solver, scheme, update)?;
        allocates_nothing(&mut slider, x0)?;
    }
    Ok(())
}

/// Estimated steps hold the ways they compare: memory is taken by the first step of as many levels.
#[test]
fn estimated_steps_allocate_nothing() -> Outcome {
    for solver in [Solver::Tnnmg, Solver::Condensed] {
        for levels in [2, 3] {
            let (mut slider, _) = eliminated(2, solver, Newmark::default(), StateUpdate::Midpoint)?;
            // Every operator is met once: those of the step, of its half and of its third.
            let control = ErrorControl::extrapolated(levels);
            slider.step_estimated(STEP, &control)?;
            let mut outcome = Ok(());
            let info = allocation_counter::measure(|| {
                for n in 0..300 {
                    let step = slider.step_estimated(STEP, &control);
                    outcome = outcome.clone().and(step.map(|_| ()));
                    if n % 3 == 0 {
                        slider.undo();
                    }
                }
            });
            outcome?;
            assert_eq!(info.count_total, 0, "{solver:?}, {levels} levels");
        }
    }
    Ok(())
}

/// Through the events of a spring slider, step-size control included.
#[test]
fn adaptive_runs_allocate_nothing() -> Outcome {
    let slider = SpringSlider {
        stiffness: 2.5e8,
        normal_stress: 1e6,
        mass: 0.0,
        damping: 5e6,
        load: LoadPath::steady(1e-6),
    };
    let scene = || slider.scene(FRICTION, AGING, 1.1e-6, steady_state(&AGING, 1e-6)?);
    let implicit = || -> Outcome<_> { Ok(Simulation::new(scene()?, Newmark::default(), Point)?) };
    let staged = Simulation::new(scene()?, Sdirk2, Point)?;
    let plain = ErrorControl::default();
    let blocks: Vec<(Box<dyn Stepper<1>>, ErrorControl)> = vec![
        (Box::new(RungeKutta::new(scene()?)?), plain),
        (Box::new(implicit()?), plain),
        (Box::new(implicit()?), ErrorControl::extrapolated(3)),
        (Box::new(staged), plain),
    ];
    for (mut block, control) in blocks {
        let steps = Steps::adaptive(1e-5)
            .with_error_control(control)
            .stopping_at([1.0, 500.0])
            .until(1000.0);
        // The first run takes memory.
        let start = block.state().clone();
        block.run(&steps, |_| ())?;
        block.restore(&start)?;
        let mut peak = 0_f64;
        let mut outcome = None;
        let info = allocation_counter::measure(|| {
            let report = block.run(&steps, |at| peak = peak.max(at.max_slip_rate()));
            outcome = Some(report);
        });
        let report = outcome.ok_or("not run")??;
        assert!(peak > 5e-3 && report.accepted > 100, "{peak:e}, {report:?}");
        assert_eq!(info.count_total, 0, "{control:?}");
    }
    Ok(())
}

/// A body reduced to its surface, with its loads, through stick and slip.
#[test]
fn reduced_bodies_allocate_nothing() -> Outcome {
    const STEPS: usize = 6800;
    let body = body(2);
    let space = body.space()?;
    let scene = || -> Outcome<_> {
        let contact = Contact::new(&PippingSlider::bottom(&space)?, FRICTION, NORMAL_STRESS)
            .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
        let size = space.vertex_count();
        let scene = body.scene(&space)?.with_contact(contact);
        Ok(scene.with_load_history(move |time, load| load[size / 2][0] += 10.0 * time.sin()))
    };
    let reduced = Reduced::new(&scene()?)
        .up_to_frequency(100.0)?
        .reduce(scene()?)?;
    let mut reduced = Simulation::new(reduced, Newmark::default(), DenseNewton::new())?;
    reduced.step(STEP)?;
    let mut peak = 0.0_f64;
    let mut outcome = None;
    let info = allocation_counter::measure(|| {
        outcome = Some(reduced.run(&Steps::constant(STEP).count(STEPS), |at| {
            peak = peak.max(at.max_slip_rate());
        }));
    });
    outcome.ok_or("not run")??;
    assert!(peak > 1e-3, "no event: {peak:e}");
    assert_eq!(info.count_total, 0);
    Ok(())
}
