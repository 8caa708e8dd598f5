//! Implicit steps of a constant size, their equations checked.

use nalgebra::{SMatrix, SVector};
use stickslip::friction::{FrictionLaw, Nodal};
use stickslip::state::{Dieterich, Discontinuous, LogTheta, Ruina, StateLaw, Theta};
use stickslip::{FixedPoint, Monolithic, Newmark, Point, SceneError, Simulation, StateUpdate};

use super::{SECTION, STEPS, slider};
use crate::case::{Case, Verdict};
use crate::check::{Equations, march};
use crate::method::{METHODS, Method, friction};
use crate::setup::Setup;

/// All laws and methods for a setup.
pub(crate) fn add(cases: &mut Vec<Case>, name: &str, prefix: &str, setup: Setup, quick: bool) {
    for (method, update, label) in METHODS {
        let (cut_off, regularised, with_state) =
            friction(setup.a, setup.ratio, setup.slip_distance);
        let slip_distance = setup.slip_distance;
        let (alpha, theta) = (LogTheta(setup.alpha), Theta(setup.alpha.exp()));
        macro_rules! case {
            ($member:expr, $friction:expr, $law:expr, $initial:expr) => {
                let run = move || step(&setup, method, update, $friction, $law, $initial);
                cases.push(Case::new(
                    SECTION,
                    name,
                    label,
                    format!("{prefix}{}", $member),
                    run,
                ));
            };
        }
        case!(
            "Dieterich, cut off",
            cut_off,
            Dieterich { slip_distance },
            alpha
        );
        case!("Ruina, cut off", cut_off, Ruina { slip_distance }, alpha);
        case!("discontinuous, cut off", cut_off, Discontinuous, theta);
        if !quick {
            case!(
                "Dieterich, regularised",
                regularised,
                Dieterich { slip_distance },
                alpha
            );
            case!(
                "Ruina, regularised",
                regularised,
                Ruina { slip_distance },
                alpha
            );
            case!(
                "discontinuous, regularised",
                regularised,
                Discontinuous,
                theta
            );
            case!(
                "Dieterich, Tresca with state",
                with_state,
                Dieterich { slip_distance },
                alpha
            );
            case!(
                "Ruina, Tresca with state",
                with_state,
                Ruina { slip_distance },
                alpha
            );
            case!(
                "discontinuous, Tresca with state",
                with_state,
                Discontinuous,
                theta
            );
        }
    }
}

fn simulation<L, S>(
    setup: &Setup,
    (method, update): (Method, StateUpdate),
    friction: L,
    law: S,
    initial: S::State,
) -> Result<Simulation<SMatrix<f64, 1, 1>, L, S, Newmark, 1>, SceneError>
where
    L: FrictionLaw + Copy + 'static,
    S: StateLaw + Copy + 'static,
    L::State: From<S::State>,
{
    let scene = slider(setup).scene(friction, law, setup.slip_rate, initial)?;
    let simulation = Simulation::new(scene, Newmark::default(), Point)?.with_state_update(update);
    Ok(match method {
        Method::FixedPoint => simulation.with_coupling(FixedPoint::default()),
        Method::Monolithic => simulation.with_coupling(Monolithic::default()),
    })
}

fn equations<L: FrictionLaw, S: StateLaw>(
    setup: &Setup,
    update: StateUpdate,
    friction: L,
    law: S,
) -> Equations<SMatrix<f64, 1, 1>, L, S, 1> {
    let matrix = |value: f64| SMatrix::<f64, 1, 1>::new(value);
    let some = |value: f64| (value > 0.0).then(|| matrix(value));
    let (stiffness, velocity) = (setup.stiffness, setup.velocity);
    let norm = setup.stiffness + setup.mass;
    Equations {
        stiffness: matrix(stiffness),
        mass: some(setup.mass),
        viscosity: some(setup.damping),
        moduli: [some(stiffness), some(setup.mass), some(setup.damping)],
        load: Box::new(move |time| vec![SVector::from([stiffness * velocity * time])]),
        friction: Nodal::Uniform(friction),
        law: Nodal::Uniform(law),
        normal_stress: Nodal::Uniform(setup.normal_stress),
        vertices: vec![0],
        weights: vec![1.0],
        fixed: vec![[false]],
        update,
        tolerance: 1e-10,
        norm: matrix(norm),
        compliance: norm.recip(),
    }
}

fn step<L, S>(
    setup: &Setup,
    method: Method,
    update: StateUpdate,
    friction: L,
    law: S,
    initial: S::State,
) -> Verdict
where
    L: FrictionLaw + Copy + 'static,
    S: StateLaw + Copy + 'static,
    L::State: From<S::State>,
{
    let mut simulation = match simulation(setup, (method, update), friction, law, initial) {
        Ok(simulation) => simulation,
        Err(error) => return Verdict::refused(error),
    };
    let equations = equations(setup, update, friction, law);
    march(&mut simulation, STEPS, setup.dt, &|from, to, dt| {
        equations.check(from, to, dt)
    })
}
