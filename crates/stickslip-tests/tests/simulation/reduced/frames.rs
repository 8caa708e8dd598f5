//! Surfaces along no axis.

use nalgebra::{Matrix2, Rotation2, SVector, Vector2};
use stickslip::fem::{Mesh, P1, body_force, elasticity, mass};
use stickslip::problems::pipping_slider::{
    AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider, load_velocity,
};
use stickslip::reduced::Reduced;
use stickslip::state::LogTheta;
use stickslip::{
    BoundaryPart, Cholesky, Components, Contact, DenseNewton, Matrix, Newmark, Scene, Simulation,
};

use super::{Block, Full, Pair};
use crate::Outcome;
use crate::common::STEP;

const ANGLE: f64 = std::f64::consts::FRAC_PI_6;

/// The slider with everything turned.
fn turned(turn: Matrix2<f64>) -> Outcome<Full<2>> {
    let paper = PippingSlider::default();
    let coarse = P1::grid([5.0, 1.0], [5, 1])?;
    let vertices = coarse.mesh().vertices().iter().map(|x| turn * x).collect();
    let cells = coarse.mesh().cells().flatten().copied().collect();
    let space = P1::new(Mesh::new(vertices, cells)?).refined(2)?;
    let side = |value: f64| space.trace(|x| ((turn.transpose() * x)[1] - value).abs() < 1e-9);
    let weight = turn * Vector2::new(0.0, -paper.density * paper.gravity);
    let direction = turn.column(0).into_owned();
    let contact = Contact::new(&side(0.0)?, FRICTION, NORMAL_STRESS)
        .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
    Ok(Scene::new(elasticity(&space, &paper.elastic)?)
        .with_mass(mass(&space, paper.density)?)
        .with_load(body_force(&space, |_| weight))
        .prescribe_velocity(&side(1.0)?, Components::ALL, move |time| {
            (direction * load_velocity(time)).into()
        })
        .with_contact(contact)
        .in_equilibrium(Cholesky::new()))
}

fn reduced(turn: Matrix2<f64>) -> Outcome<Simulation<2>> {
    let body = Reduced::new(&turned(turn)?).up_to_frequency(100.0)?;
    let scene = body.reduce(turned(turn)?)?;
    let run = Simulation::new(scene, Newmark::default(), DenseNewton::new())?;
    Ok(run.with_absolute_tolerance(1e-13)?)
}

/// Turned by 30 degrees, the reduced slider has the history of the one that is not.
#[test]
fn a_turned_body_has_the_history_of_before() -> Outcome {
    let turn = *Rotation2::new(ANGLE).matrix();
    let (mut plain, mut oblique) = (reduced(Matrix2::identity())?, reduced(turn)?);
    let mut peak = 0.0_f64;
    for _ in 0..7000 {
        plain.step(STEP)?;
        oblique.step(STEP)?;
        let (plain, oblique) = (plain.snapshot(), oblique.snapshot());
        let (one, other) = (plain.contact(0), oblique.contact(0));
        for k in 0..one.len() {
            let slip = turn * one.slip_velocity(k) - other.slip_velocity(k);
            let stress = turn * one.traction(k) - other.traction(k);
            assert!(slip.amax() < 1e-9, "{slip:?} at {}", plain.time);
            assert!(
                stress.amax() < 1e-6 * NORMAL_STRESS,
                "{stress:?} at {}",
                plain.time
            );
            assert!((one.state(k) - other.state(k)).abs() < 1e-6);
            peak = peak.max(one.slip_rate(k));
        }
    }
    assert!(peak > 5e-3, "no event: {peak:e}");
    Ok(())
}

#[test]
fn with_all_modes_a_turned_body_is_the_whole_one() -> Outcome {
    let turn = *Rotation2::new(ANGLE).matrix();
    let mut pair = Pair::new(&|| turned(turn), f64::INFINITY)?;
    for _ in 0..700 {
        pair.step(10.0 * STEP)?;
    }
    let scene = turned(turn)?;
    let load = load_of(&scene)?;
    assert!(pair.apart(Some(&load))? < 1e-9);
    Ok(())
}

/// The turned weight of the body.
fn load_of(scene: &Full<2>) -> Outcome<Vec<SVector<f64, 2>>> {
    let density = PippingSlider::default();
    let turn = *Rotation2::new(ANGLE).matrix();
    let weight = turn * Vector2::new(0.0, -density.gravity);
    let mass = scene.mass().ok_or("no mass")?;
    let mut load = vec![SVector::zeros(); mass.vertex_count()];
    mass.multiply_add(1.0, &vec![weight; mass.vertex_count()], &mut load);
    Ok(load)
}

/// One direction of a side is moved, along no coordinate, the other is free.
#[test]
fn a_part_moved_along_axes_of_its_own() -> Outcome {
    let block = Block::new(2)?;
    let scene = || -> Outcome<_> {
        let side = block.space.trace(|x| x[0] == 0.0 && x[1] > 0.0)?;
        let (sin, cos) = ANGLE.sin_cos();
        let axes = [[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]];
        let part = BoundaryPart::from(&side).with_axes(|_| axes);
        Ok(block
            .with_inertia()?
            .prescribe_velocity(part, Components::X, |time| [2e-4 * (7.0 * time).sin(), 0.0]))
    };
    let mut pair = Pair::new(&scene, f64::INFINITY)?;
    for _ in 0..500 {
        pair.step(2e-3)?;
    }
    assert!(pair.full.snapshot().max_slip_rate() > 1e-6);
    assert!(pair.apart(None)? < 1e-9);
    Ok(())
}
