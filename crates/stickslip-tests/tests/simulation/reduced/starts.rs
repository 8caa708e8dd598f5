//! Loads that depend on time, starts that are given, vertices that are kept.

use nalgebra::{SVector, Vector2};
use stickslip::fem::body_force;
use stickslip::reduced::Reduced;
use stickslip::{Components, DenseNewton, Newmark, Scene, SceneError, Simulation, Symmetric};

use super::{Block, Pair};
use crate::Outcome;
use crate::common::{body, distance};

/// Weight that comes and goes, and its time \[s\].
fn weight(block: &Block, time: f64) -> Vec<SVector<f64, 2>> {
    let share = (5.0 * time).sin();
    body_force(&block.space, |_| Vector2::new(3e3 * share, -4e4))
}

#[test]
fn a_load_that_depends_on_time() -> Outcome {
    let block = Block::new(2)?;
    let scene = || -> Outcome<_> {
        let shares = body_force(&block.space, |_| Vector2::new(3e3, 0.0));
        let constant = body_force(&block.space, |_| Vector2::new(0.0, -4e4));
        Ok(block
            .with_inertia()?
            .with_load(constant)
            .with_load_history(move |time, load| {
                for (load, share) in load.iter_mut().zip(&shares) {
                    *load += share * (5.0 * time).sin();
                }
            }))
    };
    let mut pair = Pair::new(&scene, f64::INFINITY)?;
    for _ in 0..300 {
        pair.step(2e-3)?;
    }
    let load = weight(&block, pair.full.snapshot().time);
    assert!(pair.apart(Some(&load))? < 1e-9);
    Ok(())
}

/// With few modes loads that vary slowly are followed at once.
#[test]
fn slow_loads_are_followed_by_what_has_no_mode() -> Outcome {
    let block = Block {
        rate: [0.0; 2],
        ..Block::new(2)?
    };
    let scene = || -> Outcome<_> {
        let shares = body_force(&block.space, |_| Vector2::new(3e3, -1e3));
        let scene = block.with_inertia()?;
        Ok(scene.with_load_history(move |time, load| {
            for (load, share) in load.iter_mut().zip(&shares) {
                *load += share * (0.1 * time).powi(2);
            }
        }))
    };
    let mut pair = Pair::new(&scene, 60.0)?;
    for _ in 0..400 {
        pair.step(5e-3)?;
    }
    let share = (0.1 * pair.full.snapshot().time).powi(2);
    let load = body_force(&block.space, |_| Vector2::new(3e3, -1e3) * share);
    let (full, reduced) = (pair.full.snapshot(), pair.reduced.snapshot());
    let with = distance(
        &pair.body.displacement_under(&load, &reduced)?,
        full.displacement,
    );
    let without = distance(&pair.body.displacement(&reduced)?, full.displacement);
    assert!(with < 0.1 * without, "{with:e}, {without:e}");
    Ok(())
}

/// A field that is zero on the right side, which is moved, and has no normal component at the bottom.
fn field(block: &Block, scale: f64) -> Vec<SVector<f64, 2>> {
    let points = block.space.mesh().vertices().iter();
    let at = |x: &Vector2<f64>| {
        let share = scale * (2.0 - x[0]) * (0.3 + x[1]);
        Vector2::new(share, -0.5 * share * x[1])
    };
    points.map(at).collect()
}

#[test]
fn a_start_that_is_given() -> Outcome {
    let block = Block::new(2)?;
    let scene = || -> Outcome<_> {
        let displacement = field(&block, 1e-4);
        // Above a contact at rest: friction would stop a sliding one at once.
        let mut velocity = field(&block, -2e-3);
        for (velocity, x) in velocity.iter_mut().zip(block.space.mesh().vertices()) {
            *velocity *= x[1];
        }
        let scene = block.with_inertia()?;
        Ok(scene
            .with_displacement(displacement)
            .with_velocity(velocity))
    };
    let mut pair = Pair::new(&scene, f64::INFINITY)?;
    assert!(pair.apart(None)? < 1e-12);
    for _ in 0..200 {
        pair.step(2e-3)?;
    }
    assert!(pair.apart(None)? < 1e-9);
    Ok(())
}

/// Under a load, what is given is the whole displacement, of which the interior's answer to the load is a part.
#[test]
fn a_start_under_a_load() -> Outcome {
    let block = Block::new(2)?;
    let load = || body_force(&block.space, |_| Vector2::new(0.0, -4e4));
    let scene = || -> Outcome<_> {
        let scene = block.with_inertia()?.with_load(load());
        Ok(scene.with_displacement(field(&block, 1e-3)))
    };
    let mut pair = Pair::new(&scene, f64::INFINITY)?;
    for _ in 0..200 {
        pair.step(2e-3)?;
    }
    let apart = pair.apart(Some(&load()))?;
    assert!(apart < 1e-9, "{apart:e}");
    Ok(())
}

/// A side that moves from the start: the interior is at rest beside it.
#[test]
fn a_side_that_starts_at_once() -> Outcome {
    let block = Block {
        rate: [1e-3, 0.0],
        ..Block::new(2)?
    };
    let mut pair = Pair::new(&|| block.with_inertia(), f64::INFINITY)?;
    let at_rest = pair.body.velocity(&pair.reduced.snapshot())?;
    assert!(distance(&at_rest, pair.full.snapshot().velocity) < 1e-12 * block.rate[0]);
    for _ in 0..200 {
        pair.step(2e-3)?;
    }
    assert!(pair.apart(None)? < 1e-9);
    Ok(())
}

#[test]
fn vertices_that_are_kept_are_seen() -> Outcome {
    let block = Block::new(2)?;
    let kept = [[0.0, 1.0], [1.0, 0.5], [2.0, 0.5]]
        .map(|x| block.space.vertex_at(x).unwrap_or(usize::MAX));
    let scene = block.with_inertia()?;
    let body = Reduced::new(&scene)
        .with_vertices(kept)
        .up_to_frequency(f64::INFINITY)?;
    let mut pair = Pair::by(&|| block.with_inertia(), body)?;
    for _ in 0..300 {
        pair.step(2e-3)?;
    }
    assert!(pair.apart(None)? < 1e-9);
    let (full, reduced) = (pair.full.snapshot(), pair.reduced.snapshot());
    let whole = pair.body.displacement(&reduced)?;
    for vertex in kept {
        let place = pair.body.vertex(vertex).ok_or("not kept")?;
        assert_eq!(reduced.displacement[place], whole[vertex]);
        let size = full.displacement[vertex].norm();
        assert!((full.displacement[vertex] - whole[vertex]).norm() < 1e-9 * size);
    }
    let left_out = block.space.vertex_at([0.5, 0.5]).ok_or("no vertex")?;
    assert_eq!(pair.body.vertex(left_out), None);
    Ok(())
}

/// Without contacts what is kept is the surface.
#[test]
fn a_body_without_contacts_keeps_what_it_is_told_to() -> Outcome {
    let block = Block::new(1)?;
    let paper = body(1);
    let side = block.space.trace(|x| x[0] == 2.0)?;
    let end = block.space.vertex_at([0.0, 1.0]).ok_or("no vertex")?;
    let scene = || -> Outcome<_> {
        let stiffness = stickslip::fem::elasticity(&block.space, &paper.elastic)?;
        let inertia = stickslip::fem::mass(&block.space, paper.density)?;
        let hold = Scene::new(stiffness).with_mass(inertia);
        Ok(hold
            .fix(&side, Components::ALL)
            .with_velocity(field(&block, 1e-2)))
    };
    let body = Reduced::new(&scene()?)
        .with_vertices([end])
        .up_to_frequency(f64::INFINITY)?;
    let mut pair = Pair::by(&scene, body)?;
    for _ in 0..100 {
        pair.step(1e-3)?;
    }
    assert!(pair.apart(None)? < 1e-9);
    // A load on what is kept.
    let part = pair.body.part(stickslip::BoundaryPart::from(
        &block.space.trace(|x| x[0] == 0.0)?,
    ))?;
    assert_eq!(part.vertices, [0]);
    let mut load = vec![SVector::zeros(); pair.reduced.snapshot().displacement.len()];
    load[part.vertices[0]] = Vector2::new(1e3, 0.0);
    let loaded: Scene<Symmetric<2>, 2> = pair.body.reduce(scene()?)?.with_load(load);
    let mut loaded = Simulation::new(loaded, Newmark::default(), DenseNewton::new())?;
    let mut forces = vec![SVector::zeros(); block.space.vertex_count()];
    forces[end] = Vector2::new(1e3, 0.0);
    let scene = scene()?.with_load(forces);
    let mut full = Simulation::new(scene, Newmark::default(), stickslip::Condensed::new())?;
    for _ in 0..100 {
        loaded.step(1e-3)?;
        full.step(1e-3)?;
    }
    let whole = pair.body.displacement(&loaded.snapshot())?;
    let at = full.snapshot();
    let size = at.displacement[end].norm();
    assert!(distance(&whole, at.displacement) < 1e-9 * size);
    Ok(())
}

#[test]
fn starts_that_are_lost_are_refused() -> Outcome {
    let block = Block::new(2)?;
    let body = Reduced::new(&block.with_inertia()?).up_to_frequency(60.0)?;
    // From vertex to vertex up and down: no mode of a low frequency.
    let rough = |scale: f64| -> Vec<SVector<f64, 2>> {
        let points = block.space.mesh().vertices().iter();
        let sign = |x: &Vector2<f64>| {
            if ((x[0] + x[1]) * 4.0).round() % 2.0 == 0.0 {
                1.0
            } else {
                -1.0
            }
        };
        let inside = |x: &Vector2<f64>| x[0] < 2.0 && x[1] > 0.0;
        let at = |x: &Vector2<f64>| Vector2::repeat(if inside(x) { scale * sign(x) } else { 0.0 });
        points.map(at).collect()
    };
    for scene in [
        block.with_inertia()?.with_displacement(rough(1e-3)),
        block.with_inertia()?.with_velocity(rough(1e-3)),
        block.with_inertia()?.with_acceleration(rough(1e-3)),
    ] {
        let error = body.reduce(scene).err();
        let Some(SceneError::ReducedStart { share, .. }) = error else {
            return Err(format!("{error:?}").into());
        };
        assert!(share > 0.01 && share <= 1.0, "{share}");
    }
    // The moved side bent, and the bottom lifted: neither can ever change.
    for (place, component) in [([2.0, 0.5], 0), ([1.0, 0.0], 1)] {
        let mut bent = field(&block, 1e-4);
        let vertex = block.space.vertex_at(place).ok_or("no vertex")?;
        bent[vertex][component] = 1e-4;
        let error = body
            .reduce(block.with_inertia()?.with_displacement(bent))
            .err();
        let apart = matches!(error, Some(SceneError::HeldApart { .. }));
        assert!(apart, "{error:?}");
    }
    Ok(())
}
