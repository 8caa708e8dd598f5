//! Loads of fixed shape beside functions that fill the same fields.

use nalgebra::Vector2;
use proptest::prelude::*;
use stickslip::fem::{Elastic, P1, elasticity, lumped_mass, mass};
use stickslip::problems::pipping_slider::{AGING, FRICTION};
use stickslip::record::EnergyLedger;
use stickslip::reduced::Reduced;
use stickslip::state::LogTheta;
use stickslip::{
    BlockMatrix, CentralDifferences, Components, Condensed, Contact, DenseNewton, Diagonal,
    Newmark, Scene, Simulation, Steps,
};

use crate::Outcome;

const ROCK: Elastic = Elastic {
    young_modulus: 5.0,
    poisson_ratio: 0.25,
};

/// The loads of a scene.
#[derive(Debug, Clone)]
struct Loads {
    weight: bool,
    /// The forces of two loads, of which the second one is one of fixed shape in every scene.
    forces: [Vec<Vector2<f64>>; 2],
    frequency: f64,
    /// A third load, which fills the field.
    filled: bool,
}

/// A block of `3 x 2` cells has so many vertices.
const VERTICES: usize = 12;

fn loads() -> impl Strategy<Value = Loads> {
    let force = prop_oneof![Just([0.0; 2]), prop::array::uniform2(-0.1..0.1)];
    let forces = prop::collection::vec(force.prop_map(Vector2::from), VERTICES);
    let fields = prop::array::uniform2(forces);
    (any::<bool>(), fields, 0.1..30.0, any::<bool>()).prop_map(
        |(weight, forces, frequency, filled)| Loads {
            weight,
            forces,
            frequency,
            filled,
        },
    )
}

/// A block that slides on its base; its mass is lumped or not.
fn scene(loads: &Loads, scaled: bool, lumped: bool) -> Outcome<Scene<BlockMatrix<2>, 2>> {
    let space = P1::grid([3.0, 2.0], [3, 2])?;
    let base = space.trace(|x| x[1] == 0.0)?;
    let inertia = match lumped {
        true => lumped_mass(&space, 1.0)?,
        false => mass(&space, 1.0)?,
    };
    let mut scene = Scene::new(elasticity(&space, &ROCK)?)
        .with_mass(inertia)
        .with_contact(Contact::new(&base, FRICTION, 0.1).with_state(AGING, LogTheta(0.0)))
        .fix(&space.trace(|x| x[0] == 3.0)?, Components::X)
        .with_velocity(space.interpolate(|x| Vector2::new(0.1 * (3.0 - x[0]), 0.0)));
    if loads.weight {
        scene = scene.with_load(space.interpolate(|x| Vector2::new(0.0, -0.01 * (1.0 + x[0]))));
    }
    let ([first, second], frequency) = (loads.forces.clone(), loads.frequency);
    let factor = move |time: f64| (frequency * time).sin();
    scene = if scaled {
        scene.with_scaled_load(first, factor)
    } else {
        scene.with_load_history(move |time, load| {
            for (load, force) in load.iter_mut().zip(&first) {
                *load = force * factor(time);
            }
        })
    };
    scene = scene.with_scaled_load(second, |time| time);
    if loads.filled {
        scene = scene.with_load_history(|time, load| load[5].x = 0.1 * time);
    }
    Ok(scene)
}

/// How far two bodies are apart after some steps, beside the distance that they went.
fn apart(mut bodies: [Simulation<2>; 2], dt: f64) -> Outcome<f64> {
    let start = bodies[0].state().velocity.clone();
    for body in &mut bodies {
        body.run(&Steps::constant(dt).count(6), |_| ())?;
    }
    let [a, b] = bodies.each_ref().map(|body| &body.state().velocity);
    let norm = |pairs: &mut dyn Iterator<Item = Vector2<f64>>| {
        pairs.fold(0.0, |most: f64, change| most.max(change.amax()))
    };
    let moved = norm(&mut a.iter().zip(&start).map(|(a, b)| a - b));
    Ok(norm(&mut a.iter().zip(b).map(|(a, b)| a - b)) / moved)
}

/// The order in which loads add up differs.
const ROUNDING: f64 = 1e-10;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn a_scaled_load_is_one_that_fills_its_field(loads in loads()) {
        let of = |scaled, lumped| scene(&loads, scaled, lumped).expect("a scene");
        let explicit = [true, false].map(|scaled| {
            Simulation::new(of(scaled, true), CentralDifferences, Diagonal::new()).expect("a body")
        });
        prop_assert!(apart(explicit, 0.05).expect("steps") < ROUNDING);
        let implicit = [true, false].map(|scaled| {
            Simulation::new(of(scaled, false), Newmark::default(), Condensed::new()).expect("a body")
        });
        prop_assert!(apart(implicit, 0.05).expect("steps") < ROUNDING);
        let balances = [true, false].map(|scaled| {
            let scene = of(scaled, false);
            let mut body = Simulation::new(scene, Newmark::default(), Condensed::new()).expect("a body");
            let mut ledger = EnergyLedger::new(&body.snapshot());
            body.run(&Steps::constant(0.05).count(6), |at| ledger.record(&at)).expect("steps");
            ledger.balance(&body.snapshot())
        });
        for balance in balances {
            // The work of the loads is that of the body.
            let done = balance.loads.abs() + balance.friction;
            prop_assert!(balance.left_over.abs() < 1e-9 * done, "{:?}", balance);
        }
        let [a, b] = balances.map(|balance| balance.loads);
        prop_assert!((a - b).abs() < ROUNDING * balances[0].friction, "{} {}", a, b);
    }
}

/// A reduced body takes the load of its coordinates.
#[test]
fn a_reduced_body_bears_scaled_loads() -> Outcome {
    let mut forces = vec![Vector2::zeros(); VERTICES];
    forces[7] = Vector2::new(0.05, -0.02);
    let loads = Loads {
        weight: true,
        forces: [forces.clone(), forces],
        frequency: 3.0,
        filled: false,
    };
    let bodies = [scene(&loads, true, false)?, scene(&loads, false, false)?];
    let [scaled, filled] = bodies.map(|scene| -> Outcome<Simulation<2>> {
        let body = Reduced::new(&scene).up_to_frequency(f64::INFINITY)?;
        let scene = body.reduce(scene)?;
        Ok(Simulation::new(
            scene,
            Newmark::default(),
            DenseNewton::new(),
        )?)
    });
    assert!(apart([scaled?, filled?], 0.05)? < ROUNDING);
    Ok(())
}

/// A field of another size, or with values that are no forces, is refused.
#[test]
fn a_field_that_does_not_fit_is_refused() -> Outcome {
    let space = P1::grid([3.0, 2.0], [3, 2])?;
    for (load, said) in [
        (vec![Vector2::zeros(); VERTICES - 1], "11"),
        (vec![Vector2::repeat(f64::NAN); VERTICES], "NaN"),
    ] {
        let scene = Scene::new(elasticity(&space, &ROCK)?)
            .with_mass(lumped_mass(&space, 1.0)?)
            .with_scaled_load(load, |_| 1.0);
        let refused = Simulation::new(scene, CentralDifferences, Diagonal::new());
        let error = refused.err().ok_or("refused")?.to_string();
        assert!(error.contains("load") && error.contains(said), "{error}");
    }
    Ok(())
}
