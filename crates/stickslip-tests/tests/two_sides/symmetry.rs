//! A body that is driven against its mirror image moves as its half, and one on a held half as on a rigid surface.

use nalgebra::Vector2;
use stickslip::fem::{GridDiagonal, Mesh, P1, elasticity, mass};
use stickslip::friction::DieterichRuina;
use stickslip::problems::pipping_slider::{
    AGING, END, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider, load_velocity,
};
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{
    BlockMatrix, BoundaryPart, Components, Condensed, Contact, Newmark, NonsmoothSolver,
    NormalStress, Scene, Simulation, Steps, Tnnmg,
};

use crate::{Outcome, largest, mirrored};

/// The time step of `N = 1e4` [s].
const STEP: f64 = END / 1e4;

type Body = Simulation<2>;

fn scene(space: &P1<2>) -> Outcome<Scene<BlockMatrix<2>, 2>> {
    let paper = PippingSlider::default();
    Ok(Scene::new(elasticity(space, &paper.elastic)?)
        .with_mass(mass(space, paper.density)?)
        .with_zero_acceleration())
}

fn solver(space: &P1<2>, multigrid: bool) -> Box<dyn NonsmoothSolver<BlockMatrix<2>, 2>> {
    if multigrid {
        Box::new(Tnnmg::new(space.transfers()))
    } else {
        Box::new(Condensed::new())
    }
}

/// A body of one side, with its normal velocity free or fixed.
fn half(refinements: usize, free: bool, multigrid: bool) -> Outcome<Body> {
    let space = P1::grid([5.0, 1.0], [5, 1])?.refined(refinements)?;
    let bottom = space.trace(|x| x[1] == 0.0)?;
    let top = space.trace(|x| x[1] == 1.0)?;
    let contact = Contact::new(&bottom, FRICTION, NORMAL_STRESS)
        .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
    let contact = if free {
        contact.with_free_normal()
    } else {
        contact
    };
    let mut scene = scene(&space)?
        .prescribe_velocity(&top, Components::ALL, |time| [load_velocity(time), 0.0])
        .with_contact(contact);
    if free {
        scene = scene.in_equilibrium(stickslip::Cholesky::new());
    }
    Ok(
        Simulation::new(scene, Newmark::default(), solver(&space, multigrid))?
            .with_tolerance(1e-12)?,
    )
}

/// Both sides.
#[derive(Clone, Copy, PartialEq)]
enum Lower {
    Driven,
    Held,
}

fn whole(
    refinements: usize,
    lower: Lower,
    multigrid: bool,
    exchanged: bool,
) -> Outcome<(Body, BoundaryPart)> {
    under(
        NORMAL_STRESS.into(),
        refinements,
        lower,
        multigrid,
        exchanged,
    )
}

fn under(
    normal_stress: NormalStress,
    refinements: usize,
    lower: Lower,
    multigrid: bool,
    exchanged: bool,
) -> Outcome<(Body, BoundaryPart)> {
    let space = mirrored(refinements)?;
    let mut sides = [space.part("plus")?, space.part("minus")?];
    let part = BoundaryPart::from(&sides[0]);
    if exchanged {
        sides.reverse();
    }
    let double = if lower == Lower::Driven { 2.0 } else { 1.0 };
    let friction = DieterichRuina {
        reference_velocity: double * FRICTION.reference_velocity,
        slip_distance: double * FRICTION.slip_distance,
        ..FRICTION
    };
    let aging = Dieterich {
        slip_distance: double * AGING.slip_distance,
    };
    let contact = Contact::between(&sides[0], &sides[1], friction, normal_stress)
        .with_state(aging, LogTheta(INITIAL_LOG_THETA));
    let top = space.trace(|x| x[1] == 1.0)?;
    let mut scene = scene(&space)?
        .prescribe_velocity(&top, Components::ALL, |time| [load_velocity(time), 0.0])
        .with_contact(contact);
    scene = if lower == Lower::Driven {
        let bottom = space.trace(|x| x[1] == -1.0)?;
        scene.prescribe_velocity(&bottom, Components::ALL, |time| [-load_velocity(time), 0.0])
    } else {
        let below: Vec<usize> = (0..space.mesh().vertex_count())
            .filter(|&p| space.mesh().vertices()[p][1] < 0.0)
            .collect();
        let minus = BoundaryPart::from(&space.part("minus")?).vertices;
        let mut held: Vec<usize> = below.into_iter().chain(minus).collect();
        held.sort_unstable();
        let held = BoundaryPart {
            weights: vec![1.0; held.len()],
            points: Vec::new(),
            normals: Vec::new(),
            vertices: held,
            ..part.clone()
        };
        scene.fix(held, Components::ALL)
    };
    let body = Simulation::new(scene, Newmark::default(), solver(&space, multigrid))?
        .with_tolerance(1e-12)?;
    Ok((body, part))
}

/// Steps until the event has ended.
const STEPS: usize = 7_200;

/// The largest differences of slip rate, slip and state over those of the half, through the first event.
fn difference(half: &mut Body, whole: &mut Body, factor: f64, steps: usize) -> Outcome<[f64; 3]> {
    let (mut apart, mut scale) = ([0.0_f64; 3], [0.0_f64; 3]);
    for _ in 0..steps {
        half.step(STEP)?;
        whole.step(STEP)?;
        let (one, two) = (half.snapshot(), whole.snapshot());
        let (one, two) = (one.contact(0), two.contact(0));
        assert_eq!(one.len(), two.len());
        for k in 0..one.len() {
            let pairs = [
                (factor * one.slip_velocity(k), two.slip_velocity(k)),
                (factor * one.slip_vector(k), two.slip_vector(k)),
            ];
            for (at, (one, two)) in pairs.into_iter().enumerate() {
                apart[at] = apart[at].max(largest([one - two].into_iter()));
                scale[at] = scale[at].max(one.amax());
            }
            apart[2] = apart[2].max((one.state(k) - two.state(k)).abs());
            scale[2] = 1.0;
        }
    }
    assert!(scale[0] > 1e-3, "no event: {scale:?}");
    Ok([0, 1, 2].map(|k| apart[k] / scale[k]))
}

#[test]
fn a_body_against_its_image_is_its_half_under_a_normal_traction() -> Outcome {
    for multigrid in [false, true] {
        let mut half = half(2, true, multigrid)?;
        let (mut whole, _) = whole(2, Lower::Driven, multigrid, false)?;
        let apart = difference(&mut half, &mut whole, 2.0, STEPS)?;
        assert!(apart.iter().all(|&apart| apart < 1e-9), "{apart:?}");
    }
    Ok(())
}

#[test]
fn a_held_half_is_a_rigid_surface() -> Outcome {
    for multigrid in [false, true] {
        let mut half = half(2, false, multigrid)?;
        let (mut whole, _) = whole(2, Lower::Held, multigrid, false)?;
        let apart = difference(&mut half, &mut whole, 1.0, STEPS)?;
        assert!(apart.iter().all(|&apart| apart < 1e-9), "{apart:?}");
    }
    Ok(())
}

/// With the sides exchanged the other one is the plus side, and everything else stays.
#[test]
fn the_sides_can_be_exchanged() -> Outcome {
    let (mut one, _) = whole(2, Lower::Driven, false, false)?;
    let (mut other, _) = whole(2, Lower::Driven, false, true)?;
    let mut scale = 0.0_f64;
    for _ in 0..STEPS {
        one.step(STEP)?;
        other.step(STEP)?;
        let (one, other) = (one.snapshot(), other.snapshot());
        let apart = one.velocity.iter().zip(other.velocity).map(|(a, b)| a - b);
        scale = scale.max(largest(one.velocity.iter().copied()));
        assert!(largest(apart) < 1e-9 * scale.max(1e-3));
    }
    Ok(())
}

/// The body against its image has an even normal displacement: its reaction does not change, and one iteration a step
/// finds that.
#[test]
fn the_pressure_between_images_stays() -> Outcome {
    for multigrid in [false, true] {
        let mut half = half(2, true, multigrid)?;
        let from_body = NormalStress::from_body(NORMAL_STRESS);
        let (mut whole, _) = under(from_body, 2, Lower::Driven, multigrid, false)?;
        let apart = difference(&mut half, &mut whole, 2.0, STEPS)?;
        assert!(apart.iter().all(|&apart| apart < 1e-9), "{apart:?}");
        let at = whole.snapshot();
        let contact = at.contact(0);
        for k in 0..contact.len() {
            assert!((contact.normal_stress(k) / NORMAL_STRESS - 1.0).abs() < 1e-9);
        }
        assert_eq!(at.report.reaction_iterations, 1);
    }
    Ok(())
}

/// With all diagonals alike the halves are no images of each other: the pressure follows the deformation. An independent
/// program has pressures of .97 to 1.05 of the first, a contraction of .09, and 2.15 iterations a step.
#[test]
fn the_pressure_between_unlike_halves_follows_the_deformation() -> Outcome {
    let grid = Mesh::<2>::grid([5.0, 2.0], [5, 2], GridDiagonal::Rising)?;
    let points = grid.vertices().iter().map(|x| x - Vector2::new(0.0, 1.0));
    let mesh = Mesh::new(points.collect(), grid.cells().flatten().copied().collect())?;
    let mesh = mesh
        .with_surface_where("fault", |x| x[1] == 0.0)?
        .split("fault")?;
    let space = P1::new(mesh).refined(2)?;
    let friction = DieterichRuina {
        reference_velocity: 2.0 * FRICTION.reference_velocity,
        slip_distance: 2.0 * FRICTION.slip_distance,
        ..FRICTION
    };
    let aging = Dieterich {
        slip_distance: 2.0 * AGING.slip_distance,
    };
    let contact = Contact::between(
        &space.part("fault+")?,
        &space.part("fault-")?,
        friction,
        NormalStress::from_body(NORMAL_STRESS),
    )
    .with_state(aging, LogTheta(INITIAL_LOG_THETA));
    let [top, bottom] = [1.0, -1.0].map(|y| space.trace(move |x| x[1] == y));
    let scene = scene(&space)?
        .prescribe_velocity(&top?, Components::ALL, |time| [load_velocity(time), 0.0])
        .prescribe_velocity(&bottom?, Components::ALL, |time| {
            [-load_velocity(time), 0.0]
        })
        .with_contact(contact);
    let mut body = Simulation::new(scene, Newmark::default(), Condensed::new())?;
    let (mut iterations, mut contraction) = (0, 0.0_f64);
    let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
    let steps = 6867;
    body.run(&Steps::constant(STEP).count(steps), |at| {
        iterations += at.report.reaction_iterations;
        contraction = contraction.max(at.report.contraction);
        let fault = at.contact(0);
        for k in 0..fault.len() {
            least = least.min(fault.normal_stress(k) / NORMAL_STRESS);
            most = most.max(fault.normal_stress(k) / NORMAL_STRESS);
        }
    })?;
    assert!(
        (0.96..0.98).contains(&least) && (1.04..1.06).contains(&most),
        "{least} {most}"
    );
    assert!((0.06..0.12).contains(&contraction), "{contraction}");
    assert!(iterations as f64 <= 2.15 * steps as f64, "{iterations}");
    Ok(())
}
