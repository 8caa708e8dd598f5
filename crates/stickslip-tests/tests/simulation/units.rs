//! The same scene in other units takes the same steps.

use nalgebra::SVector;
use stickslip::fem::{Elastic, P1, body_force, elasticity, mass};
use stickslip::friction::DieterichRuina;
use stickslip::problems::pipping_slider::{
    END, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, load_velocity,
};
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{
    Cholesky, Condensed, Contact, ErrorControl, FixedPoint, Newmark, Scene, Simulation, Snapshot,
    Steps, Tnnmg,
};

use crate::Outcome;

/// So many metres are a unit of length, so many kilograms one of mass. The second stays.
#[derive(Clone, Copy)]
struct Units {
    length: f64,
    mass: f64,
}

const SI: Units = Units {
    length: 1.0,
    mass: 1.0,
};

/// The method of a run.
#[derive(Clone, Copy)]
struct Way {
    multigrid: bool,
    alternating: bool,
    steps: usize,
    tolerance: Option<f64>,
}

/// `ln V` of all frictional vertices of a box after the run, in SI, and the cycles and sweeps of the solver.
fn rates<const D: usize>(
    (size, refinements): ([f64; D], usize),
    units: Units,
    way: Way,
) -> Outcome<(Vec<f64>, usize)> {
    let Units {
        length,
        mass: kilograms,
    } = units;
    // In the plane a stress is a force over a length, and a density a mass over an area.
    let stress = length.powi(D as i32 - 2) / kilograms;
    let cells = size.map(|size| size as usize);
    let space = P1::<D>::grid(size.map(|size| size / length), cells)?.refined(refinements)?;
    let bottom = space.trace(|x| x[D - 1] == 0.0)?;
    let top = space.trace(|x| x[D - 1] == 1.0 / length)?;
    let friction = DieterichRuina {
        reference_velocity: FRICTION.reference_velocity / length,
        slip_distance: FRICTION.slip_distance / length,
        ..FRICTION
    };
    let elastic = Elastic {
        young_modulus: 5e7 * stress,
        poisson_ratio: 0.3,
    };
    let density = 5e3 * length.powi(D as i32) / kilograms;
    let mut weight = SVector::<f64, D>::zeros();
    weight[D - 1] = -density * 9.81 / length;
    let law = Dieterich {
        slip_distance: friction.slip_distance,
    };
    let contact = Contact::new(&bottom, friction, NORMAL_STRESS * stress)
        .with_state(law, LogTheta(INITIAL_LOG_THETA));
    let scene = Scene::new(elasticity(&space, &elastic)?)
        .with_mass(mass(&space, density)?)
        .with_load(body_force(&space, |_| weight))
        .with_contact(contact)
        .prescribe_velocity(&top, [true; D], move |time| {
            let mut velocity = [0.0; D];
            velocity[0] = load_velocity(time) / length;
            velocity
        })
        .in_equilibrium(Cholesky::new());
    let scheme = Newmark::default();
    let mut slider = if way.multigrid {
        Simulation::new(scene, scheme, Tnnmg::new(space.transfers()))?
    } else {
        Simulation::new(scene, scheme, Condensed::new())?
    };
    if way.alternating {
        slider.set_coupling(FixedPoint::paper());
    }
    let mut work = 0;
    let observe = |at: Snapshot<'_, D>| work += at.report.solver_iterations;
    match way.tolerance {
        None => slider.run(&Steps::constant(END / 1e4).count(way.steps), observe)?,
        Some(tolerance) => {
            let default = ErrorControl::default();
            let control = ErrorControl {
                slip_rate_floor: default.slip_rate_floor / length,
                slip_floor: default.slip_floor / length,
                ..default
            };
            let steps = Steps::adaptive(tolerance)
                .with_error_control(control)
                .with_first_step(END / 1e4);
            slider.run(&steps.until(END / 1e4 * way.steps as f64), observe)?
        }
    };
    let at = slider.snapshot();
    let contact = at.contact(0);
    let rates = (0..contact.len()).map(|k| (contact.slip_rate(k) * length).ln());
    Ok((rates.collect(), work))
}

#[test]
fn kilometres_and_megatonnes_change_nothing() -> Outcome {
    check_units(([5.0, 1.0], 2))?;
    check_units(([2.0, 1.0, 1.0], 1))
}

fn check_units<const D: usize>(body: ([f64; D], usize)) -> Outcome {
    let large = Units {
        length: 1e3,
        mass: 1e9,
    };
    let small = Units {
        length: 1e-3,
        mass: 1e-6,
    };
    let mut slowest = f64::INFINITY;
    for multigrid in [false, true] {
        for (alternating, tolerance) in [(false, None), (true, None), (false, Some(1e-3))] {
            let way = Way {
                multigrid,
                alternating,
                steps: 300,
                tolerance,
            };
            let (expected, work) = rates(body, SI, way)?;
            slowest = expected
                .iter()
                .fold(slowest, |least, rate| least.min(*rate));
            for units in [large, small] {
                let (found, by) = rates(body, units, way)?;
                for (found, expected) in found.iter().zip(&expected) {
                    let off = (found - expected).abs();
                    assert!(
                        off < 1e-11,
                        "{multigrid} {alternating} {tolerance:?}: {off:e}"
                    );
                }
                // Rounding may decide for an iteration more here and there.
                assert!(by.abs_diff(work) <= 1 + work / 50, "{by}, {work}");
            }
        }
    }
    // Also where contacts creep.
    assert!(slowest < 1e-12_f64.ln(), "{slowest}");
    Ok(())
}
