//! The energy ledger: what is left over is nothing by Newmark's scheme, and what a scheme damps by others.

use nalgebra::Vector2;
use stickslip::fem::{
    Elastic, Impedance, P1, Trace, Viscous, dashpot, elasticity, mass, viscosity,
};
use stickslip::friction::Tresca;
use stickslip::problems::pipping_slider::{
    AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider,
};
use stickslip::record::{Balance, EnergyLedger};
use stickslip::state::LogTheta;
use stickslip::{
    BackwardEuler, BlockMatrix, Components, Condensed, Contact, GeneralizedAlpha, Matrix, Newmark,
    Operator, RateScheme, Scene, Sdirk2, Simulation, Snapshot, Steps, Tnnmg,
};

use crate::Outcome;
use crate::common::{STEP, body, relative};

/// Steps until the first event of the slider is over.
const THROUGH_AN_EVENT: usize = 6900;

/// Runs a body and balances it at its end.
fn run<const C: usize>(
    simulation: &mut Simulation<C>,
    dt: f64,
    steps: usize,
) -> Outcome<(Balance, f64)> {
    let mut ledger = EnergyLedger::new(&simulation.snapshot());
    let mut peak = 0_f64;
    simulation.run(&Steps::constant(dt).count(steps), |at| {
        ledger.record(&at);
        peak = peak.max(at.max_slip_rate());
    })?;
    Ok((ledger.balance(&simulation.snapshot()), peak))
}

/// The slider with three refinements.
fn slider(
    recurrent: bool,
    change: impl FnOnce(&P1<2>, Scene<BlockMatrix<2>, 2>) -> Outcome<Scene<BlockMatrix<2>, 2>>,
    scheme: impl RateScheme + 'static,
    tolerance: f64,
) -> Outcome<Simulation<2>> {
    let slider = PippingSlider {
        recurrent,
        ..body(3)
    };
    let space = slider.space()?;
    let contact = Contact::new(&PippingSlider::bottom(&space)?, FRICTION, NORMAL_STRESS)
        .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
    let scene = change(&space, slider.scene(&space)?.with_contact(contact))?;
    let simulation = Simulation::new(scene, scheme, Condensed::new())?;
    Ok(simulation.with_absolute_tolerance(tolerance)?)
}

/// Friction takes nearly all that the moved top does, and nothing is left over: with the accelerations of the
/// paper, and with those that agree with the forces at the start, at the kink of the velocity of the top, and where
/// vertices come to rest.
#[test]
fn the_slider_loses_nothing() -> Outcome {
    for recurrent in [true, false] {
        for tolerance in [1e-10, 1e-13] {
            let mut slider = slider(
                recurrent,
                |_, scene| Ok(scene),
                Newmark::default(),
                tolerance,
            )?;
            let (balance, peak) = run(&mut slider, STEP, THROUGH_AN_EVENT)?;
            assert!(peak > 5e-3, "no event: {peak:e}");
            assert!(balance.friction > 0.1 * balance.moved, "{balance:?}");
            assert_eq!(balance.viscosity, 0.0);
            let share = balance.left_over / balance.moved;
            assert!(
                share.abs() < 1e-9,
                "{recurrent}, {tolerance:e}: {share:e}, {balance:?}"
            );
        }
    }
    Ok(())
}

/// Friction is that of the tractions shown, which are the law's, and the work at the top that of its reactions.
#[test]
fn friction_is_the_laws() -> Outcome {
    let mut slider = slider(true, |_, scene| Ok(scene), Newmark::default(), 1e-13)?;
    let top = PippingSlider::top(&body(3).space()?)?;
    slider.step(STEP)?;
    let mut ledger = EnergyLedger::new(&slider.snapshot());
    let forces = |at: &Snapshot<'_, 2>| -> Vec<(usize, Vector2<f64>, Vector2<f64>)> {
        let contact = at.contact(0);
        let bottom = (0..contact.len()).map(|k| {
            let force = contact.traction(k) * contact.weight(k);
            (contact.vertex(k), force, Vector2::zeros())
        });
        let top = top.vertices().iter();
        let top = top.map(|&vertex| {
            let reaction = at.reaction_at(vertex).expect("a vertex of the body");
            (vertex, Vector2::zeros(), reaction)
        });
        bottom.chain(top).collect()
    };
    let mut last = (
        forces(&slider.snapshot()),
        slider.state().displacement.clone(),
    );
    let (mut friction, mut moved) = (0.0, 0.0);
    slider.run(&Steps::constant(STEP).count(THROUGH_AN_EVENT), |at| {
        ledger.record(&at);
        let now = forces(&at);
        for (old, new) in last.0.iter().zip(&now) {
            let way = at.displacement[new.0] - last.1[new.0];
            friction += 0.5 * way.dot(&(old.1 + new.1));
            moved += 0.5 * way.dot(&(old.2 + new.2));
        }
        last = (now, at.displacement.to_vec());
    })?;
    let balance = ledger.balance(&slider.snapshot());
    assert!(
        (balance.friction / friction - 1.0).abs() < 1e-9,
        "{balance:?}, {friction:e}"
    );
    assert!(
        (balance.moved / moved - 1.0).abs() < 1e-9,
        "{balance:?}, {moved:e}"
    );
    Ok(())
}

/// A bar that is pulled and pushed with kinks of its velocity, and sticks in between: accelerations jump where a step
/// begins and where a vertex comes to rest, and nothing is left over.
#[test]
fn kinks_and_rest_lose_nothing() -> Outcome {
    let bar = Bar::new()?;
    let (dt, period) = (1e-3, 0.2);
    // A triangle wave: its corners are ends of steps.
    let wave = move |time: f64| {
        let phase = (time / period).fract();
        0.1 * (1.0 - 4.0 * (phase - 0.5).abs())
    };
    let elastic = Elastic {
        young_modulus: 5e7,
        poisson_ratio: 0.3,
    };
    let contact = Contact::new(&bar.bottom, Tresca { coefficient: 0.3 }, 1e4);
    let scene = Scene::new(elasticity(&bar.space, &elastic)?)
        .with_mass(mass(&bar.space, 5e3)?)
        .with_contact(contact)
        .prescribe_velocity(&bar.end, Components::ALL, move |time| {
            [wave(time) + 0.1, 0.0]
        });
    let mut simulation = Simulation::new(scene, Newmark::default(), Condensed::new())?;
    let (balance, _) = run(&mut simulation, dt, 1000)?;
    assert!(balance.friction > 0.1 * balance.moved, "{balance:?}");
    let share = balance.left_over / balance.moved;
    assert!(share.abs() < 1e-11, "{share:e}, {balance:?}");
    Ok(())
}

/// Viscosity and a load that comes and goes take and give their shares.
#[test]
fn viscosity_and_loads_in_time_are_counted() -> Outcome {
    let change = |space: &P1<2>, scene: Scene<BlockMatrix<2>, 2>| -> Outcome<_> {
        let damping = BlockMatrix::combination(&[(1e-3, &*elasticity(space, &body(3).elastic)?)]);
        let end = space.vertex_at([5.0, 0.5]).ok_or("no such vertex")?;
        Ok(scene
            .with_viscosity(damping)
            .with_load_history(move |time, load| load[end][0] = 100.0 * (2.0 * time).sin()))
    };
    let mut slider = slider(false, change, Newmark::default(), 1e-12)?;
    let (balance, _) = run(&mut slider, STEP, THROUGH_AN_EVENT)?;
    let share = balance.left_over / balance.moved;
    assert!(share.abs() < 1e-9, "{share:e}, {balance:?}");
    assert!(balance.viscosity > 1e-4 * balance.moved, "{balance:?}");
    Ok(())
}

/// A box whose bottom slides, whose top is shaken, and whose sides absorb waves, with a viscosity of its own: the ledger
/// closes, and what the sides take is what their dashpots do.
fn absorbs<const D: usize>(cells: [usize; D]) -> Outcome {
    let space = P1::<D>::grid(cells.map(|cells| 0.25 * cells as f64), cells)?;
    let height = D - 1;
    let bottom = space.trace(|x| x[height] == 0.0)?;
    let top = space.trace(|x| x[height] == 1.0)?;
    let sides =
        space.trace(|x| (0..height).any(|c| x[c] == 0.0 || x[c] == 0.25 * cells[c] as f64))?;
    let (density, elastic) = (5e3, Elastic::of_waves(5e3, 120.0, 60.0)?);
    let impedance = Impedance::of(&elastic, density)?;
    assert!((impedance.normal - density * 120.0).abs() < 1e-9 * impedance.normal);
    assert!((impedance.tangential - density * 60.0).abs() < 1e-9 * impedance.tangential);
    let absorbing = dashpot(&space, &sides, |_| impedance)?;
    let of_the_body = viscosity(
        &space,
        &Viscous {
            shear_viscosity: 1e4,
            bulk_viscosity: 1e4,
        },
    )?;
    let contact = Contact::new(&bottom, FRICTION, 2e4).with_state(AGING, LogTheta(-5.0));
    let scene = Scene::new(elasticity(&space, &elastic)?)
        .with_mass(mass(&space, density)?)
        .with_viscosity(of_the_body)
        .with_viscosity(absorbing.clone())
        .with_contact(contact)
        .prescribe_velocity(&top, [true; D], move |time| {
            let mut velocity = [0.0; D];
            velocity[0] = 2e-2;
            // Its corners are ends of steps.
            velocity[height] = 1e-3 * (1.0 - 4.0 * ((time / 0.05).fract() - 0.5).abs());
            velocity
        });
    let mut body = Simulation::new(scene, Newmark::default(), Condensed::new())?;
    let mut ledger = EnergyLedger::new(&body.snapshot());
    let (mut last, mut taken) = (body.state().velocity.clone(), 0.0);
    let dt = 5e-4;
    body.run(&Steps::constant(dt).count(400), |at| {
        ledger.record(&at);
        for (old, new) in last.iter_mut().zip(at.velocity) {
            *old = (*old + new) * 0.5;
        }
        taken += dt * absorbing.quadratic(&last);
        last.copy_from_slice(at.velocity);
    })?;
    let balance = ledger.balance(&body.snapshot());
    let share = balance.left_over / balance.moved;
    assert!(share.abs() < 1e-9, "{share:e}, {balance:?}");
    let &[own, sides] = ledger.viscosities() else {
        return Err("not two viscosities".into());
    };
    assert!(
        relative(own + sides, balance.viscosity) < 1e-12,
        "{balance:?}"
    );
    assert!(relative(sides, taken) < 1e-9, "{sides:e} {taken:e}");
    for part in [own, sides, balance.friction] {
        assert!(part > 1e-3 * balance.moved, "{part:e}, {balance:?}");
    }
    Ok(())
}

#[test]
fn absorbing_sides_of_a_plane_body_are_counted() -> Outcome {
    absorbs([8, 4])
}

#[test]
fn absorbing_sides_of_a_body_in_space_are_counted() -> Outcome {
    absorbs([4, 3, 4])
}

/// The block of the example, by multigrid.
#[test]
fn a_block_in_space_loses_nothing() -> Outcome {
    let space = P1::<3>::grid([1.0, 1.0, 1.0], [1, 1, 1])?.refined(2)?;
    let (bottom, top) = (space.trace(|x| x[2] == 0.0)?, space.trace(|x| x[2] == 1.0)?);
    let elastic = Elastic {
        young_modulus: 5e7,
        poisson_ratio: 0.3,
    };
    let contact = Contact::new(&bottom, FRICTION, 20e3).with_state(AGING, LogTheta(-5.0));
    let scene = Scene::new(elasticity(&space, &elastic)?)
        .with_mass(mass(&space, 5e3)?)
        .with_contact(contact)
        .prescribe_velocity(&top, [true; 3], |_| [2e-3, 2e-3, 0.0]);
    let solver = Tnnmg::new(space.transfers());
    let mut block = Simulation::new(scene, Newmark::default(), solver)?;
    let (balance, _) = run(&mut block, 2e-3, 500)?;
    assert!(balance.friction > 0.1 * balance.moved, "{balance:?}");
    let share = balance.left_over / balance.moved;
    assert!(share.abs() < 1e-9, "{share:e}, {balance:?}");
    Ok(())
}

/// A bar that is let go after being bent, without and with friction.
struct Bar {
    space: P1<2>,
    bottom: Trace<2>,
    end: Trace<2>,
}

impl Bar {
    fn new() -> Outcome<Self> {
        let space = P1::grid([4.0, 1.0], [8, 2])?;
        let (bottom, end) = (space.trace(|x| x[1] == 0.0)?, space.trace(|x| x[0] == 0.0)?);
        Ok(Self { space, bottom, end })
    }

    fn let_go(
        &self,
        scheme: impl RateScheme + 'static,
        coefficient: Option<f64>,
    ) -> Outcome<Simulation<2>> {
        let elastic = Elastic {
            young_modulus: 5e7,
            poisson_ratio: 0.3,
        };
        let bent = |x: &Vector2<f64>| Vector2::new(1e-3 * x[0], 0.0);
        let mut scene = Scene::new(elasticity(&self.space, &elastic)?)
            .with_mass(mass(&self.space, 5e3)?)
            .with_displacement(self.space.interpolate(bent))
            .fix(&self.end, Components::ALL);
        if let Some(coefficient) = coefficient {
            scene = scene.with_contact(Contact::new(&self.bottom, Tresca { coefficient }, 1e4));
        }
        Ok(Simulation::new(scene, scheme, Condensed::new())?)
    }
}

/// On a body that is free of friction and forces, what backward Euler leaves over is
/// `sum of (du . A du + dv . M dv)/2`, and not negative after any step; the other schemes' is positive over the
/// whole, and Newmark's zero.
#[test]
fn what_a_scheme_damps_is_left_over() -> Outcome {
    let bar = Bar::new()?;
    let dt = 5e-3;
    let mut simulation = bar.let_go(BackwardEuler, None)?;
    let mut ledger = EnergyLedger::new(&simulation.snapshot());
    let stiffness: Option<&BlockMatrix<2>> =
        (simulation.stiffness() as &dyn std::any::Any).downcast_ref();
    let stiffness = stiffness.ok_or("block rows")?.clone();
    let mass = mass(&bar.space, 5e3)?;
    let (mut last, mut expected) = (simulation.state().clone(), 0.0);
    for _ in 0..100 {
        simulation.step(dt)?;
        let at = simulation.snapshot();
        ledger.record(&at);
        let difference = |a: &[Vector2<f64>], b: &[Vector2<f64>]| -> Vec<Vector2<f64>> {
            a.iter().zip(b).map(|(a, b)| a - b).collect()
        };
        let moved = difference(at.displacement, &last.displacement);
        let changed = difference(at.velocity, &last.velocity);
        let damped = 0.5 * (stiffness.quadratic(&moved) + mass.quadratic(&changed));
        expected += damped;
        let balance = ledger.balance(&at);
        assert!(damped >= 0.0);
        assert!(
            (balance.left_over - expected).abs() < 1e-9 * expected,
            "{balance:?}, {expected:e}"
        );
        last = at.state().clone();
    }
    let energy = |scheme: Box<dyn RateScheme>| -> Outcome<[f64; 2]> {
        let mut simulation = bar.let_go(scheme, None)?;
        let start = EnergyLedger::new(&simulation.snapshot()).balance(&simulation.snapshot());
        let (balance, _) = run(&mut simulation, dt, 100)?;
        Ok([balance.left_over, start.elastic])
    };
    let damping: [Box<dyn RateScheme>; 2] = [
        Box::new(Sdirk2),
        Box::new(GeneralizedAlpha {
            spectral_radius: 0.5,
        }),
    ];
    for scheme in damping {
        let [left_over, start] = energy(scheme)?;
        assert!(
            left_over > 1e-3 * start && left_over < start,
            "{left_over:e} of {start:e}"
        );
    }
    let [left_over, start] = energy(Box::<Newmark>::default())?;
    assert!(
        left_over.abs() < 1e-12 * start,
        "{left_over:e} of {start:e}"
    );
    Ok(())
}

/// A block that is let go, rubs and comes to rest: all it had is what friction took and what stays in it.
#[test]
fn friction_takes_what_a_body_had() -> Outcome {
    let bar = Bar::new()?;
    let mut simulation = bar.let_go(Newmark::default(), Some(0.1))?;
    let (balance, _) = run(&mut simulation, 1e-3, 3000)?;
    assert_eq!((balance.moved, balance.loads), (0.0, 0.0));
    assert!(balance.friction > 0.0);
    let start = balance.kinetic + balance.elastic - balance.stored;
    assert!(balance.left_over.abs() < 1e-10 * start, "{balance:?}");
    Ok(())
}
