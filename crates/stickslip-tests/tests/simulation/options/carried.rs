//! The walk over all options.

use stickslip::fem::P1;
use stickslip::reduced::Reduced;
use stickslip::{DenseNewton, GeneralizedAlpha, Simulation, StateUpdate};

use super::cases::CASES;
use super::{Body, Case, Fate, apart, body, motion, simulation, slip_rates, space};
use crate::Outcome;

/// The motion of a scene, or its error.
fn moved(scene: Body) -> Result<Vec<f64>, String> {
    let moved = simulation(scene).and_then(|mut body| motion(&mut body));
    moved.map_err(|error| error.to_string())
}

/// The motion of a reduced scene, of all vertices of the body.
fn reduced(scene: Body) -> Outcome<Vec<f64>> {
    let body = Reduced::new(&scene).up_to_frequency(f64::INFINITY)?;
    let scene = body.reduce(scene)?;
    let simulation = Simulation::new(scene, GeneralizedAlpha::default(), DenseNewton::new())?;
    let mut simulation = simulation.with_state_update(StateUpdate::BackwardEuler);
    let mut numbers = slip_rates(&simulation);
    motion(&mut simulation)?;
    let at = simulation.snapshot();
    let fields = [body.displacement(&at)?, body.velocity(&at)?];
    numbers.extend(fields.into_iter().flatten().flat_map(|v| [v.x, v.y]));
    Ok(numbers)
}

/// With an option a body moves otherwise than without, and as its copy and its reduction; or an error names the option.
#[test]
fn every_option_is_used_and_carried_or_refused() -> Outcome {
    for Case {
        name,
        scenes,
        whole,
        reduced: fate,
        ..
    } in &CASES
    {
        let [without, with] = scenes(&space()?)?;
        let (copy, to_reduce) = (with.clone(), with.clone());
        let (plain, own, copied) = (moved(without), moved(with), moved(copy));
        assert_eq!(own, copied, "{name}");
        match (whole, &own) {
            (Fate::Used, Ok(own)) => {
                let used = plain.map_or(f64::INFINITY, |plain| apart(own, &plain));
                assert!(used > 1e-7, "{name} is dropped: {used:.1e}");
            }
            (Fate::Refused(word), Err(error)) => assert!(error.contains(word), "{name}: {error}"),
            (Fate::Used, Err(error)) => panic!("{name}: {error}"),
            (Fate::Refused(_), Ok(_)) => panic!("{name} is taken"),
        }
        match (
            fate,
            reduced(to_reduce).map_err(|error| error.to_string()),
            own,
        ) {
            (Fate::Used, Ok(reduced), Ok(own)) => {
                let lost = apart(&own, &reduced);
                assert!(lost < 1e-6, "{name} is not carried: {lost:.1e}");
            }
            (Fate::Refused(word), Err(error), _) => {
                assert!(error.contains(word), "{name}: {error}");
            }
            (_, reduced, _) => panic!("{name}, reduced: {reduced:?}"),
        }
    }
    Ok(())
}

/// A checkpoint of a scene with an option is refused by one without, unless the state contains the option.
#[test]
fn checkpoints_know_every_option() -> Outcome {
    use stickslip::Checkpoint;
    use stickslip::record::FileError;

    let path = std::env::temp_dir().join(format!("stickslip-options-{}", std::process::id()));
    let file = Checkpoint::at(&path);
    for case in CASES.iter().filter(|case| matches!(case.whole, Fate::Used)) {
        let name = case.name;
        let [without, with] = (case.scenes)(&space()?)?;
        // What is refused without the option has no state to restore.
        let (Ok(mut without), mut with) = (simulation(without), simulation(with)?) else {
            continue;
        };
        // Later, when functions of time have other values.
        motion(&mut with)?;
        file.save(&with.snapshot(), &())?;
        let restored: Result<(), FileError> = file.restore(&mut without);
        if case.initial {
            restored?;
            assert_eq!(motion(&mut without)?, motion(&mut with)?, "{name}");
        } else {
            let refused = matches!(restored, Err(FileError::Mismatch { .. }));
            assert!(refused, "{name} is unknown to checkpoints: {restored:?}");
        }
    }
    std::fs::remove_file(&path)?;
    Ok(())
}

/// Quantities that do not add are refused if they are given twice.
#[test]
fn nothing_is_replaced_without_a_word() -> Outcome {
    let space = space()?;
    let own = || super::contact(&space);
    let twice = [
        ("cohesion", own()?.with_cohesion(1.0).with_cohesion(2.0)),
        (
            "shear stress",
            own()?
                .with_shear_stress(nalgebra::Vector2::x())
                .with_shear_stress(nalgebra::Vector2::x()),
        ),
        (
            "normal stress history",
            own()?
                .with_normal_stress_history(|_, _| ())
                .with_normal_stress_history(|_, _| ()),
        ),
        (
            "pre-stress",
            own()?
                .with_prestress(|_| [[0.0; 3]; 3])
                .with_prestress(|_| [[0.0; 3]; 3]),
        ),
        (
            "normal-stress effect",
            own()?
                .with_normal_stress_effect(0.1)
                .with_normal_stress_effect(0.2),
        ),
    ];
    for (name, contact) in twice {
        let error = moved(super::dynamic(&space)?.with_contact(contact)).err();
        assert_eq!(error, Some(format!("{name} given twice")));
    }
    let error = moved(body(&space)?.from_time(1.0).from_time(2.0)).err();
    assert_eq!(error.as_deref(), Some("initial time given twice"));
    Ok(())
}

/// The vertices and the memory of a reduction.
#[test]
fn options_of_a_reduction_are_used() -> Outcome {
    let space: P1<2> = space()?;
    let scene = body(&space)?;
    let inside = (0..space.vertex_count()).find(|&p| space.mesh().vertices()[p].y == 0.5);
    let inside = inside.ok_or("no vertex")?;
    let reduction = || Reduced::new(&scene);
    let kept = reduction().with_vertices([inside]).for_time_step(1e-2)?;
    assert!(kept.vertex(inside).is_some());
    assert!(reduction().for_time_step(1e-2)?.vertex(inside).is_none());
    let refused = reduction().with_memory_limit(1).for_time_step(1e-2);
    let error = refused.err().ok_or("taken")?.to_string();
    assert!(error.contains("1 are allowed"), "{error}");
    Ok(())
}
