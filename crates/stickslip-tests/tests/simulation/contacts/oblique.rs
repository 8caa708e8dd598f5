//! Surfaces along no axis: a scene that is turned, mesh and loads, goes on as the one that is not.

use nalgebra::{Matrix2, Matrix3, Rotation2, Rotation3, SMatrix, SVector, Vector2, Vector3};
use stickslip::fem::{Mesh, P1, Trace, Viscous, body_force, elasticity, mass, viscosity};
use stickslip::integrate::Stepper;
use stickslip::problems::pipping_slider::{
    AGING, END, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider, load_velocity,
};
use stickslip::record::EnergyLedger;
use stickslip::state::LogTheta;
use stickslip::{
    BlockMatrix, BoundaryPart, Cholesky, Components, Condensed, Contact, ErrorControl,
    MultigridSolver, Newmark, NonsmoothSolver, Scene, Simulation, Steps, Tnnmg,
};

use crate::Outcome;
use crate::common::STEP;

type Body<const D: usize> = Simulation<D>;

/// A box of unit cells with a corner at the origin, turned, and refined.
fn turned<const D: usize>(
    coarse: P1<D>,
    turn: &SMatrix<f64, D, D>,
    refinements: usize,
) -> Outcome<P1<D>> {
    let vertices = coarse.mesh().vertices().iter().map(|x| turn * x);
    let cells = coarse.mesh().cells().flatten().copied().collect();
    Ok(P1::new(Mesh::new(vertices.collect(), cells)?).refined(refinements)?)
}

/// The side on which a coordinate has a value before it was turned.
fn side<const D: usize>(
    space: &P1<D>,
    turn: &SMatrix<f64, D, D>,
    (axis, value): (usize, f64),
) -> Outcome<Trace<D>> {
    Ok(space.trace(|x| ((turn.transpose() * x)[axis] - value).abs() < 1e-9)?)
}

/// The vertex at a place before it was turned.
fn vertex<const D: usize>(
    space: &P1<D>,
    turn: &SMatrix<f64, D, D>,
    place: [f64; D],
) -> Outcome<usize> {
    let place = turn * SVector::from(place);
    Ok(space.vertex_at(place.into()).ok_or("no vertex")?)
}

/// The paper's slider with everything turned.
fn slider(turn: &Matrix2<f64>, multigrid: bool, refinements: usize) -> Outcome<(P1<2>, Body<2>)> {
    let paper = PippingSlider::default();
    let space = turned(P1::grid([5.0, 1.0], [5, 1])?, turn, refinements)?;
    let weight = turn * Vector2::new(0.0, -paper.density * paper.gravity);
    let bottom = side(&space, turn, (1, 0.0))?;
    let top = side(&space, turn, (1, 1.0))?;
    let contact = Contact::new(&bottom, FRICTION, NORMAL_STRESS)
        .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
    let direction = turn.column(0).into_owned();
    let scene = Scene::new(elasticity(&space, &paper.elastic)?)
        .with_mass(mass(&space, paper.density)?)
        .with_load(body_force(&space, |_| weight))
        .prescribe_velocity(&top, Components::ALL, move |time| {
            (direction * load_velocity(time)).into()
        })
        .with_contact(contact)
        .with_zero_acceleration();
    let transfers = space.transfers();
    let scene = if multigrid {
        scene.in_equilibrium(MultigridSolver::new(transfers))
    } else {
        scene.in_equilibrium(Cholesky::new())
    };
    let solver: Box<dyn NonsmoothSolver<BlockMatrix<2>, 2>> = if multigrid {
        Box::new(Tnnmg::new(transfers))
    } else {
        Box::new(Condensed::new())
    };
    let simulation = Simulation::new(scene, Newmark::default(), solver)?;
    Ok((space, simulation))
}

/// Displacement and velocity in the directions of before, slip rate, state and traction at a place.
fn seen<const D: usize>(
    body: &Body<D>,
    turn: &SMatrix<f64, D, D>,
    vertex: usize,
) -> Outcome<Vec<f64>> {
    let at = body.snapshot();
    let contact = at.contact(0);
    let k = contact.position_of(vertex).ok_or("not on the contact")?;
    let back = turn.transpose();
    let mut numbers = vec![contact.state(k), contact.slip_rate(k).max(1e-12).ln()];
    for (vector, unit) in [
        (at.displacement[vertex], 1e-3),
        (contact.slip_vector(k), 1e-3),
        (contact.traction(k), 1e4),
        (at.reaction_at(vertex)?, 1e4),
    ] {
        numbers.extend((back * vector / unit).iter());
    }
    Ok(numbers)
}

/// The largest difference of two histories, steps of one kind after another.
fn difference<const D: usize>(
    mut runs: [(Body<D>, SMatrix<f64, D, D>, usize); 2],
    steps: usize,
    dt: f64,
) -> Outcome<f64> {
    let mut largest = 0.0_f64;
    for _ in 0..steps {
        let [one, other] = &mut runs;
        one.0.step(dt)?;
        other.0.step(dt)?;
        let [one, other] =
            [&runs[0], &runs[1]].map(|(body, turn, vertex)| seen(body, turn, *vertex));
        for (one, other) in one?.iter().zip(other?) {
            largest = largest.max((one - other).abs());
        }
    }
    Ok(largest)
}

/// Through the first events, by a direct solver.
#[test]
fn a_turned_slider_has_the_same_history() -> Outcome {
    let turn = Rotation2::new(30_f64.to_radians()).into_inner();
    let run = |turn: Matrix2<f64>| -> Outcome<_> {
        let (space, body) = slider(&turn, false, 2)?;
        Ok((body, turn, vertex(&space, &turn, [2.5, 0.0])?))
    };
    let runs = [run(Matrix2::identity())?, run(turn)?];
    let steps = (0.75 * END / STEP) as usize;
    assert!(difference(runs, steps, STEP)? < 1e-8);
    Ok(())
}

/// Fields in coordinates are those of the state, whatever way a simulation came to it: by a step, by one that was compared
/// with others, taken back, or refused.
#[test]
fn what_is_seen_is_the_last_accepted_step() -> Outcome {
    let turn = Rotation2::new(30_f64.to_radians()).into_inner();
    let [mut body, mut other] = [slider(&turn, false, 1)?.1, slider(&turn, false, 1)?.1];
    let control = ErrorControl::default();
    let ways: [&dyn Fn(&mut Body<2>) -> bool; 5] = [
        &|body| body.step(STEP).is_ok(),
        &|body| body.step_estimated(2.0 * STEP, &control).is_ok(),
        &|body| {
            body.undo();
            true
        },
        &|body| body.step_estimated(STEP, &control).is_ok(),
        &|body| body.step_estimated(f64::NAN, &control).is_err(),
    ];
    for (n, way) in ways.iter().enumerate() {
        assert!(way(&mut body), "{n}");
        other.restore(body.state())?;
        let (seen, expected) = (body.snapshot(), other.snapshot());
        assert_eq!(seen.time, expected.time, "{n}");
        assert_eq!(seen.displacement, expected.displacement, "{n}");
        assert_eq!(seen.velocity, expected.velocity, "{n}");
        assert_eq!(seen.acceleration, expected.acceleration, "{n}");
    }
    Ok(())
}

/// Transfers are turned with the body: as many cycles, and the same motion, stick and slip.
#[test]
fn multigrid_sees_a_turned_slider_as_the_other() -> Outcome {
    let turn = Rotation2::new(-1.1).into_inner();
    let mut cycles = [0, 0];
    let mut last = Vec::new();
    for (turn, cycles) in [Matrix2::identity(), turn].into_iter().zip(&mut cycles) {
        let (space, mut body) = slider(&turn, true, 2)?;
        // From where the slider is near its first event.
        let (_, mut other) = slider(&turn, false, 2)?;
        other.run(&Steps::constant(STEP).until(0.66 * END), |_| ())?;
        body.restore(other.state())?;
        body.run(&Steps::constant(STEP).count(200), |at| {
            *cycles += at.report.solver_iterations;
        })?;
        let centre = vertex(&space, &turn, [2.5, 0.0])?;
        last.push(seen(&body, &turn, centre)?);
    }
    for (one, other) in last[0].iter().zip(&last[1]) {
        assert!((one - other).abs() < 1e-8, "{one} {other}");
    }
    let [straight, oblique] = cycles.map(|cycles| cycles as f64);
    assert!(oblique < 1.25 * straight, "{oblique} cycles, {straight}");
    Ok(())
}

/// A block in space, turned about two axes, pulled obliquely, its energy in balance.
#[test]
fn a_turned_block_has_the_same_history() -> Outcome {
    let turn =
        Rotation3::from_euler_angles(0.5, 0.0, 0.3) * Rotation3::from_euler_angles(0.0, -0.7, 0.0);
    let run = |turn: Matrix3<f64>, multigrid: bool| -> Outcome<_> {
        let space = turned(P1::grid([1.0, 1.0, 1.0], [1, 1, 1])?, &turn, 1)?;
        let bottom = side(&space, &turn, (2, 0.0))?;
        let top = side(&space, &turn, (2, 1.0))?;
        let elastic = PippingSlider::default().elastic;
        let contact = Contact::new(&bottom, FRICTION, 2e4).with_state(AGING, LogTheta(-5.0));
        let pull = turn * Vector3::new(2e-3, 1e-3, 0.0);
        let viscous = Viscous {
            shear_viscosity: 1e4,
            bulk_viscosity: 1e4,
        };
        let scene = Scene::new(elasticity(&space, &elastic)?)
            .with_mass(mass(&space, 5e3)?)
            .with_viscosity(viscosity(&space, &viscous)?)
            .with_contact(contact)
            .with_load_history({
                let force = body_force(&space, |_| turn * Vector3::new(1e3, -2e3, 5e2));
                move |time, load| load.iter_mut().zip(&force).for_each(|(l, f)| *l = f * time)
            })
            .prescribe_velocity(&top, [true; 3], move |_| pull.into());
        let solver: Box<dyn NonsmoothSolver<BlockMatrix<3>, 3>> = if multigrid {
            Box::new(Tnnmg::new(space.transfers()))
        } else {
            Box::new(Condensed::new())
        };
        let body = Simulation::new(scene, Newmark::default(), solver)?.with_tolerance(1e-13)?;
        let corner = vertex(&space, &turn, [0.5, 0.5, 0.0])?;
        Ok((body, turn, corner))
    };
    for multigrid in [false, true] {
        let runs = [
            run(Matrix3::identity(), multigrid)?,
            run(turn.into_inner(), multigrid)?,
        ];
        let difference = difference(runs, 300, 2e-3)?;
        assert!(difference < 1e-8, "{multigrid} {difference:e}");
    }
    let (mut body, ..) = run(turn.into_inner(), false)?;
    let mut ledger = EnergyLedger::new(&body.snapshot());
    body.run(&Steps::constant(2e-3).count(300), |at| ledger.record(&at))?;
    let balance = ledger.balance(&body.snapshot());
    let work = balance.friction.abs() + balance.moved.abs() + balance.stored.abs();
    assert!(balance.left_over.abs() < 1e-9 * work, "{balance:?}");
    Ok(())
}

/// A body rolls along its sides: held along normals, it is compressed without shear, whichever way they point.
#[test]
fn rolling_sides_leave_a_plane_compression() -> Outcome {
    let turn = Rotation2::new(0.4).into_inner();
    let space = turned(P1::grid([2.0, 1.0], [2, 1])?, &turn, 1)?;
    let sides = |axis, value| side(&space, &turn, (axis, value));
    let rolling = |trace: &Trace<2>| BoundaryPart::from(trace).along_normals();
    let elastic = PippingSlider::default().elastic;
    let (bottom, top) = (sides(1, 0.0)?, sides(1, 1.0)?);
    let pushed = 1e-3;
    let scene = Scene::new(elasticity(&space, &elastic)?)
        .fix(rolling(&sides(0, 0.0)?), Components::X)
        .fix(rolling(&sides(0, 2.0)?), Components::X)
        .fix(rolling(&bottom), Components::X)
        .prescribe_velocity(rolling(&top), Components::X, move |_| [-pushed, 0.0]);
    let mut body = Simulation::new(scene, Newmark::default(), Condensed::new())?;
    body.step(1.0)?;
    let at = body.snapshot();
    for (x, u) in space.mesh().vertices().iter().zip(at.displacement) {
        let expected = turn * Vector2::new(0.0, -pushed * (turn.transpose() * x)[1]);
        assert!((u - expected).norm() < 1e-12 * pushed, "{u} {expected}");
    }
    let squeezed = at.displacement[vertex(&space, &turn, [1.0, 1.0])?].norm();
    let (young, nu) = (elastic.young_modulus, elastic.poisson_ratio);
    let modulus = young * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
    let force = turn.transpose() * at.reaction(&bottom)?;
    assert!(
        (force[1] / (2.0 * modulus * squeezed) - 1.0).abs() < 1e-9,
        "{force}"
    );
    assert!(force[0].abs() < 1e-9 * force[1]);
    Ok(())
}

/// Two contacts on one smooth surface have one normal where they meet, and slide there; around an edge of two
/// contacts in space a vertex slides along the edge alone.
#[test]
fn contacts_that_meet_share_a_normal_or_an_edge() -> Outcome {
    let turn = Rotation3::from_euler_angles(0.5, -0.7, 0.3).into_inner();
    let space = turned(P1::grid([1.0, 1.0, 1.0], [1, 1, 1])?, &turn, 1)?;
    let elastic = PippingSlider::default().elastic;
    let bottom = side(&space, &turn, (2, 0.0))?;
    let wall = side(&space, &turn, (1, 0.0))?;
    let top = side(&space, &turn, (2, 1.0))?;
    // Along the edge, off the wall and out of the bottom: only the first is possible there.
    let pull = turn * Vector3::new(1e-3, 2e-3, 3e-3);
    let weak = |trace: &Trace<3>| {
        Contact::new(trace, stickslip::friction::Tresca { coefficient: 0.6 }, 1.0)
    };
    let scene = Scene::new(elasticity(&space, &elastic)?)
        .with_contact(weak(&bottom))
        .with_contact(weak(&wall))
        .prescribe_velocity(&top, [true; 3], move |_| pull.into());
    let mut body = Simulation::new(scene, Newmark::default(), Condensed::new())?;
    body.run(&Steps::constant(0.1).count(3), |_| ())?;
    let at = body.snapshot();
    let edge = turn.transpose() * at.velocity[vertex(&space, &turn, [0.5, 0.0, 0.0])?];
    assert!(
        edge[0] > 1e-5 && edge[1].abs().max(edge[2].abs()) < 1e-14,
        "{edge}"
    );
    let on_bottom = turn.transpose() * at.velocity[vertex(&space, &turn, [0.5, 0.5, 0.0])?];
    assert!(
        on_bottom[1].abs() > 1e-5 && on_bottom[2].abs() < 1e-14,
        "{on_bottom}"
    );
    // The halves of a bent bottom.
    let bent = |x: &Vector2<f64>| Vector2::new(x[0], x[1] + 0.1 * (x[0] - 1.0).powi(2));
    let flat = P1::grid([2.0, 1.0], [8, 4])?;
    let vertices = flat.mesh().vertices().iter().map(bent).collect();
    let cells = flat.mesh().cells().flatten().copied().collect();
    let space = P1::new(Mesh::new(vertices, cells)?);
    let below = |x: &Vector2<f64>| (x[1] - bent(&Vector2::new(x[0], 0.0))[1]).abs() < 1e-9;
    let slides = |halves: &[Trace<2>]| -> Outcome<Vector2<f64>> {
        let top = space.trace(|x| (x[1] - bent(&Vector2::new(x[0], 1.0))[1]).abs() < 1e-9)?;
        let mut scene =
            Scene::new(elasticity(&space, &elastic)?)
                .prescribe_velocity(&top, [true; 2], |_| [1e-3, 0.0]);
        for half in halves {
            let law = stickslip::friction::Tresca { coefficient: 0.6 };
            scene = scene.with_contact(Contact::new(half, law, 1.0));
        }
        let mut body = Simulation::new(scene, Newmark::default(), Condensed::new())?;
        body.step(0.1)?;
        let middle = space.vertex_at([1.0, 0.0]).ok_or("no middle")?;
        Ok(body.snapshot().velocity[middle])
    };
    let halves = [
        space.trace(|x| below(x) && x[0] <= 1.0)?,
        space.trace(|x| below(x) && x[0] >= 1.0)?,
    ];
    let (one, two) = (slides(&[space.trace(below)?])?, slides(&halves)?);
    assert!(
        two[0] > 1e-5 && (two - one).norm() < 1e-12 * one.norm(),
        "{two} {one}"
    );
    Ok(())
}

/// Bent into a ring segment the slider tends to the straight one with the curvature.
#[test]
fn a_ring_segment_tends_to_the_straight_slider() -> Outcome {
    let history = |curvature: f64| -> Outcome<Vec<f64>> {
        // The bottom stays a circle through its middle; heights stay.
        let bend = |x: &Vector2<f64>| {
            let (along, radius) = (x[0] - 2.5, curvature.recip() - x[1]);
            if curvature == 0.0 {
                return *x;
            }
            let angle = along * curvature;
            Vector2::new(
                2.5 + radius * angle.sin(),
                curvature.recip() - radius * angle.cos(),
            )
        };
        let flat = PippingSlider {
            refinements: 2,
            ..PippingSlider::default()
        }
        .space()?;
        let vertices = flat.mesh().vertices().iter().map(bend).collect();
        let cells = flat.mesh().cells().flatten().copied().collect();
        let space = P1::new(Mesh::new(vertices, cells)?);
        let on = |height: f64| {
            let points: Vec<_> = (flat.mesh().vertices().iter())
                .filter(|x| x[1] == height)
                .map(bend)
                .collect();
            space.trace(move |x| points.contains(x))
        };
        let paper = PippingSlider::default();
        let contact = Contact::new(&on(0.0)?, FRICTION, NORMAL_STRESS)
            .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
        let scene = Scene::new(elasticity(&space, &paper.elastic)?)
            .with_mass(mass(&space, paper.density)?)
            .with_contact(contact)
            .prescribe_velocity(
                BoundaryPart::from(&on(1.0)?).along_normals(),
                Components::ALL,
                |time| [0.0, -load_velocity(time)],
            );
        let mut body = Simulation::new(scene, Newmark::default(), Condensed::new())?;
        let centre = space.vertex_at([2.5, 0.0]).ok_or("no centre")?;
        let mut slips = Vec::new();
        body.run(&Steps::constant(1.5e-2).count(600), |at| {
            slips.push(at.displacement[centre][0]);
        })?;
        Ok(slips)
    };
    let straight = history(0.0)?;
    let off = |curvature: f64| -> Outcome<f64> {
        let bent = history(curvature)?;
        let differences = bent.iter().zip(&straight).map(|(a, b)| (a - b).abs());
        Ok(differences.fold(0.0, f64::max))
    };
    let [far, near] = [off(2e-3)?, off(1e-3)?];
    // Of first order in the curvature: nothing is left at none.
    let ratio = far / near;
    assert!((1.6..2.4).contains(&ratio), "{far} {near}");
    Ok(())
}
