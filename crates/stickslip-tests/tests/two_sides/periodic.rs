//! Periodic boundaries: bodies without ends, alone, on a rigid base and with a fault.

use nalgebra::{Vector2, Vector3};
use stickslip::fem::{Mesh, P1, body_force, elasticity};
use stickslip::friction::{RegularizedDieterichRuina, Tresca};
use stickslip::reduced::Reduced;
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{
    BlockMatrix, BoundaryCondition, BoundaryPart, Components, Condensed, Contact, DenseNewton,
    GeneralizedAlpha, Newmark, NonsmoothSolver, NormalStress, OppositeSide, RungeKutta, Scene,
    SceneError, Simulation, Steps, Tnnmg,
};

use crate::{ELASTIC, Outcome, largest, square};

type Body = Simulation<2>;

/// A column under a uniform force along it deforms by the parabola of a shear beam, at each vertex.
#[test]
fn a_uniform_force_shears_the_body_uniformly() -> Outcome {
    let space = P1::grid([2.0, 1.0], [4, 4])?.refined(1)?;
    let edge = |axis: usize, at: f64| space.trace(move |x| x[axis] == at);
    let scene = Scene::new(elasticity(&space, &ELASTIC)?)
        .with_periodic(&edge(0, 0.0)?, &edge(0, 2.0)?)
        .fix(&edge(1, 0.0)?, Components::ALL)
        .with_load(body_force(&space, |_| Vector2::new(1e-3, 0.0)));
    let mut body = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;
    body.step(1.0)?;
    let at = body.snapshot();
    let shear_modulus = ELASTIC.young_modulus / (2.0 * (1.0 + ELASTIC.poisson_ratio));
    let exact =
        |x: &Vector2<f64>| Vector2::new(1e-3 * (x[1] - 0.5 * x[1] * x[1]) / shear_modulus, 0.0);
    let points = space.mesh().vertices().iter();
    let errors = points.zip(at.displacement).map(|(x, u)| u - exact(x));
    let error = largest(errors);
    assert!(error < 1e-15, "{error:e}");
    let force = at.reaction(&edge(1, 0.0)?)?;
    assert!((force - Vector2::new(-2e-3, 0.0)).amax() < 1e-15, "{force}");
    Ok(())
}

/// The square with a fault through its middle, without ends, pressed and sheared at its top, where a wave of shear is
/// shifted by some cells.
fn layers(
    shift: usize,
    solver: impl FnOnce(&P1<2>) -> Box<dyn NonsmoothSolver<BlockMatrix<2>, 2>>,
) -> Outcome<(Body, P1<2>)> {
    layers_with(&[[-2.0, 2.0]], shift, solver)
}

/// The vertices of a side from one place to another, with half of the area at an end inside.
fn section(side: &BoundaryPart, [from, to]: [f64; 2]) -> BoundaryPart {
    let at = |k: usize| side.points[k][0];
    let kept = || (0..side.vertices.len()).filter(|&k| (from..=to).contains(&at(k)));
    let ends_inside = |k: usize| at(k).abs() < 2.0 && (at(k) == from || at(k) == to);
    let weight = |k: usize| side.weights[k] * if ends_inside(k) { 0.5 } else { 1.0 };
    BoundaryPart {
        vertices: kept().map(|k| side.vertices[k]).collect(),
        weights: kept().map(weight).collect(),
        points: kept().map(|k| side.points[k]).collect(),
        normals: kept().map(|k| side.normals[k]).collect(),
        axes: Vec::new(),
        opposite: side.opposite.as_ref().map(|other| OppositeSide {
            vertices: kept().map(|k| other.vertices[k]).collect(),
            beside_tip: kept().map(|k| other.beside_tip[k]).collect(),
        }),
        ..side.clone()
    }
}

/// The layers, with a contact on each section of the fault.
fn layers_with(
    sections: &[[f64; 2]],
    shift: usize,
    solver: impl FnOnce(&P1<2>) -> Box<dyn NonsmoothSolver<BlockMatrix<2>, 2>>,
) -> Outcome<(Body, P1<2>)> {
    let mesh = square(8)?
        .with_surface_where("fault", |x| x[1] == 0.0)?
        .split("fault")?;
    let space = P1::new(mesh).refined(1)?;
    let edge = |axis: usize, at: f64| space.trace(move |x| x[axis] == at);
    let top = edge(1, 2.0)?;
    let mut load = vec![Vector2::zeros(); space.vertex_count()];
    for ((&p, weight), x) in top.vertices().iter().zip(top.weights()).zip(top.points()) {
        let phase = 0.5 * std::f64::consts::PI * (x[0] - 0.25 * shift as f64);
        load[p] += Vector2::new(
            4.3e-3 + 3e-3 * phase.cos() + 2e-3 * (2.0 * phase).sin(),
            -1e-2,
        ) * *weight;
    }
    let (plus, minus) = (space.part("fault+")?, space.part("fault-")?);
    let (plus, minus) = (BoundaryPart::from(&plus), BoundaryPart::from(&minus));
    let mut scene = Scene::new(elasticity(&space, &ELASTIC)?);
    for &ends in sections {
        let (plus, minus) = (section(&plus, ends), section(&minus, ends));
        let law = Tresca { coefficient: 0.3 };
        let from_body = NormalStress::from_body(5e-3);
        scene = scene.with_contact(Contact::between(plus, minus, law, from_body));
    }
    let scene = scene
        .with_periodic(&edge(0, -2.0)?, &edge(0, 2.0)?)
        .fix(&edge(1, -2.0)?, Components::ALL)
        .with_load_history(move |time, sum| {
            for (sum, load) in sum.iter_mut().zip(&load) {
                *sum += load * time;
            }
        });
    let mut body = Simulation::new(scene, GeneralizedAlpha::default(), solver(&space))?;
    body.run(&Steps::constant(0.5).count(2), |_| ())?;
    Ok((body, space))
}

/// No cell of the fault is the first: slips and normal stresses move with the load, and both sides press on each other.
#[test]
fn results_move_with_the_load() -> Outcome {
    let condensed =
        |_: &P1<2>| -> Box<dyn NonsmoothSolver<BlockMatrix<2>, 2>> { Box::new(Condensed::new()) };
    let profile = |body: &Body| -> Vec<[f64; 3]> {
        let at = body.snapshot();
        let fault = at.contact(0);
        let values = |k| [fault.point(k)[0], fault.slip(k), fault.normal_stress(k)];
        let mut values: Vec<_> = (0..fault.len()).map(values).collect();
        values.sort_by(|a, b| a[0].total_cmp(&b[0]));
        values
    };
    let (first, space) = layers(0, condensed)?;
    let straight = profile(&first);
    assert_eq!(straight.len(), 16);
    let slips = || straight.iter().map(|row| row[1]);
    let [least, most] = [
        slips().fold(f64::MAX, f64::min),
        slips().fold(0.0, f64::max),
    ];
    assert!(least == 0.0 && most > 5e-5, "{straight:?}");
    for shift in [1, 5, 11] {
        let moved = profile(&layers(shift, condensed)?.0);
        for (k, row) in straight.iter().enumerate() {
            let [_, slip, stress] = moved[(k + shift) % 16];
            assert!(
                (slip - row[1]).abs() < 1e-9 * most,
                "{shift} {k}: {slip:e} {row:?}"
            );
            assert!(
                (stress - row[2]).abs() < 1e-9 * 1e-2,
                "{shift} {k}: {stress:e} {row:?}"
            );
        }
    }
    let (multigrid, _) = layers(0, |space| Box::new(Tnnmg::new(space.transfers())))?;
    for (row, other) in straight.iter().zip(profile(&multigrid)) {
        assert!((row[1] - other[1]).abs() < 1e-7 * most, "{row:?} {other:?}");
    }
    let at = first.snapshot();
    for (x, u) in space.mesh().vertices().iter().zip(at.displacement) {
        // At the seam each vertex has its image, the copies of the fault in turn.
        if x[0] == 2.0 && x[1] != 0.0 {
            let image = space.vertex_at([-2.0, x[1]]).ok_or("no image")?;
            assert_eq!(*u, at.displacement[image]);
        }
    }
    let [plus, minus] = ["fault+", "fault-"].map(|side| space.part(side));
    let [plus, minus] = [at.reaction(&plus?)?, at.reaction(&minus?)?];
    assert!(
        (plus[1] - 4e-2).abs() < 1e-12 && (plus + minus)[1].abs() < 1e-12,
        "{plus} {minus}"
    );
    Ok(())
}

/// Two contacts that meet at the seam and in the middle are one.
#[test]
fn a_fault_without_ends_may_have_several_contacts() -> Outcome {
    let condensed =
        |_: &P1<2>| -> Box<dyn NonsmoothSolver<BlockMatrix<2>, 2>> { Box::new(Condensed::new()) };
    let (whole, _) = layers(3, condensed)?;
    let (parted, _) = layers_with(&[[-2.0, 0.0], [0.0, 2.0]], 3, condensed)?;
    let (whole, parted) = (whole.snapshot(), parted.snapshot());
    let of_whole = whole.contact(0);
    for contact in parted.contacts() {
        assert_eq!(contact.len(), 9);
        for k in 0..contact.len() {
            let place = of_whole.position_of(contact.vertex(k));
            let place = place.ok_or("another vertex")?;
            assert!((contact.slip(k) - of_whole.slip(place)).abs() < 1e-12);
            let stress = contact.normal_stress(k) - of_whole.normal_stress(place);
            assert!(stress.abs() < 1e-10, "{stress:e}");
        }
    }
    Ok(())
}

/// A block in space that is periodic in two directions deforms alike wherever it is pulled.
#[test]
fn a_block_in_space_without_sides() -> Outcome {
    let space = P1::grid([1.0, 1.0, 1.0], [4, 4, 2])?;
    let edge = |axis: usize, at: f64| space.trace(move |x| x[axis] == at);
    let pulled = |at: [f64; 3]| -> Outcome<Vec<Vector3<f64>>> {
        let mut load = vec![Vector3::zeros(); space.vertex_count()];
        load[space.vertex_at(at).ok_or("no vertex")?] = Vector3::new(1e-3, 2e-3, 3e-3);
        let base = Contact::new(&edge(2, 0.0)?, Tresca { coefficient: 1.0 }, 4e-3);
        let scene = Scene::new(elasticity(&space, &ELASTIC)?)
            .with_periodic(&edge(0, 0.0)?, &edge(0, 1.0)?)
            .with_periodic(&edge(1, 0.0)?, &edge(1, 1.0)?)
            .with_load(load)
            .with_contact(base);
        let mut body = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;
        body.step(1.0)?;
        let at = body.snapshot();
        assert_eq!(at.contact(0).len(), 16);
        let area: f64 = (0..16).map(|k| at.contact(0).weight(k)).sum();
        assert!((area - 1.0).abs() < 1e-15);
        Ok(at.displacement.to_vec())
    };
    let first = pulled([0.25, 0.5, 1.0])?;
    let size = largest(first.iter().copied());
    for by in [[1.0, 0.25], [0.5, 0.5], [0.75, 0.0]] {
        let moved = |x: f64, by: f64| (x + by) % 1.0;
        let second = pulled([moved(0.25, by[0]), moved(0.5, by[1]), 1.0])?;
        for (x, u) in space.mesh().vertices().iter().zip(&first) {
            let image = space.vertex_at([moved(x[0], by[0]), moved(x[1], by[1]), x[2]]);
            let apart = u - second[image.ok_or("no vertex")?];
            assert!(apart.amax() < 1e-8 * size, "{by:?} {x}: {apart}");
        }
    }
    Ok(())
}

/// A strip that creeps along a rigid base with laws and states of each vertex, and is driven at its top.
fn creeping(
    shift: usize,
    normal_stress: impl Into<NormalStress>,
) -> Outcome<Scene<BlockMatrix<2>, 2>> {
    let space = P1::new(square(8)?);
    let edge = |axis: usize, at: f64| space.trace(move |x| x[axis] == at);
    let base = edge(1, -2.0)?;
    let wave = |x: &Vector2<f64>| {
        let phase = 0.5 * std::f64::consts::PI * (x[0] - 0.5 * shift as f64);
        phase.cos() + (2.0 * phase).sin()
    };
    let law = |wave: f64| RegularizedDieterichRuina {
        a: 0.02 + 0.005 * wave,
        b: 0.015,
        reference_friction: 0.6 + 0.2 * wave,
        reference_velocity: 1e-3,
        slip_distance: 1e-3,
    };
    let laws = base.map(|x| law(wave(x)));
    let states = base.map(|x| LogTheta(0.1 * wave(x)));
    let contact = Contact::per_vertex(&base, laws, normal_stress).with_state(
        Dieterich {
            slip_distance: 1e-3,
        },
        states,
    );
    Ok(Scene::new(elasticity(&space, &ELASTIC)?)
        .with_periodic(&edge(0, -2.0)?, &edge(0, 2.0)?)
        .prescribe_velocity(&edge(1, 2.0)?, Components::ALL, |_| [1e-3, 0.0])
        .with_contact(contact))
}

/// Laws, states and normal stresses of a rigid base are those of each vertex, with its area; and so is its reduction.
#[test]
fn a_base_without_ends() -> Outcome {
    let slips = |body: &Body| -> Vec<f64> {
        let at = body.snapshot();
        (0..8).map(|k| at.contact(0).slip(k)).collect()
    };
    let steps = Steps::constant(0.5).count(20);
    for from_body in [false, true] {
        let stress = || match from_body {
            true => NormalStress::from_body(1e-3),
            false => 1e-3.into(),
        };
        let run = |shift| -> Outcome<Vec<f64>> {
            let mut body = Simulation::new(
                creeping(shift, stress())?,
                Newmark::default(),
                Condensed::new(),
            )?;
            body.run(&steps, |_| ())?;
            Ok(slips(&body))
        };
        let (first, moved) = (run(0)?, run(3)?);
        assert!(
            first[0] > 1e-4 && (first[0] / first[4] - 1.0).abs() > 1e-2,
            "{first:?}"
        );
        for k in 0..8 {
            assert!(
                (moved[(k + 3) % 8] / first[k] - 1.0).abs() < 1e-8,
                "{first:?} {moved:?}"
            );
        }
    }
    let body = Reduced::new(&creeping(3, 1e-3)?).up_to_frequency(0.0)?;
    let reduced = body.reduce(creeping(3, 1e-3)?)?;
    let mut small = Simulation::new(reduced, Newmark::default(), DenseNewton::new())?;
    let mut whole = Simulation::new(creeping(3, 1e-3)?, Newmark::default(), Condensed::new())?;
    small.run(&steps, |_| ())?;
    whole.run(&steps, |_| ())?;
    let at = small.snapshot();
    for (k, slip) in slips(&whole).into_iter().enumerate() {
        assert!((at.contact(0).slip(k) / slip - 1.0).abs() < 1e-8);
    }
    Ok(())
}

#[test]
fn sides_that_do_not_match_are_refused() -> Outcome {
    let space = P1::new(square(4)?);
    let edge = |axis: usize, at: f64| space.trace(move |x| x[axis] == at);
    let [left, right] = [edge(0, -2.0)?, edge(0, 2.0)?].map(|side| BoundaryPart::from(&side));
    let elastic = |space: &P1<2>| -> Outcome<Scene<BlockMatrix<2>, 2>> {
        Ok(Scene::new(elasticity(space, &ELASTIC)?))
    };
    let refused = |scene: Scene<BlockMatrix<2>, 2>| {
        Simulation::new(scene, Newmark::default(), Condensed::new()).err()
    };
    let scene = || elastic(&space);
    // The same part, another number of vertices, another mesh.
    let error = refused(scene()?.with_periodic(&left, &left));
    assert!(matches!(
        error,
        Some(SceneError::NotPeriodic {
            translation: [0.0, 0.0, 0.0],
            ..
        })
    ));
    let lower = space.trace(|x| x[0] == 2.0 && x[1] <= 0.0)?;
    let error = refused(scene()?.with_periodic(&left, &lower));
    assert!(matches!(
        error,
        Some(SceneError::Length {
            expected: 5,
            found: 3,
            ..
        })
    ));
    let other = P1::new(square(2)?);
    let error = refused(scene()?.with_periodic(&left, &other.trace(|x| x[0] == 2.0)?));
    assert!(matches!(error, Some(SceneError::Mesh(_))), "{error:?}");
    // One vertex at another height, by position.
    let mut bent = right.clone();
    bent.points[2][1] += 1e-3;
    let error = refused(scene()?.with_periodic(&left, &bent));
    let vertex = right.vertices[2];
    let at = [2.0, 1e-3, 0.0];
    let translation = [4.0, 0.0, 0.0];
    assert!(
        matches!(error, Some(SceneError::NotPeriodic { vertex: v, at: a, translation: t, .. })
        if (v, a, t) == (vertex, at, translation)),
        "{error:?}"
    );
    // Infinite, and too near each other for their rounding.
    let mut far = right.clone();
    far.points[2][1] = f64::INFINITY;
    let error = refused(scene()?.with_periodic(&left, &far));
    assert!(matches!(error, Some(SceneError::NotPeriodic { .. })));
    let mut near = left.clone();
    near.points.iter_mut().for_each(|x| x[0] += 1e-15);
    let error = refused(scene()?.with_periodic(&left, &near));
    assert!(
        matches!(error, Some(SceneError::NotPeriodic { .. })),
        "{error:?}"
    );
    // A vertex of the second side has no motion of its own.
    let contact = Contact::new(&edge(1, -2.0)?, Tresca { coefficient: 0.3 }, 1e-3);
    let body = scene()?.with_periodic(&left, &right).with_contact(contact);
    let kept = right.vertices[2];
    let error = Reduced::new(&body)
        .with_vertices([kept])
        .up_to_frequency(0.0);
    assert!(matches!(error.err(), Some(SceneError::Vertex { vertex, .. }) if vertex == kept));
    let error = RungeKutta::new(body).err();
    assert!(matches!(error, Some(SceneError::Unsupported { .. })));
    // Both sides driven, and not alike.
    let error = refused(
        scene()?
            .with_periodic(&left, &right)
            .prescribe_velocity(&left, Components::X, |_| [1.0, 0.0])
            .prescribe_velocity(&right, Components::X, |_| [2.0, 0.0]),
    );
    let [first, second] = [1, 2].map(BoundaryCondition::Prescribed);
    assert!(
        matches!(error, Some(SceneError::Contradiction { first: f, second: s, .. })
        if (f, s) == (first, second)),
        "{error:?}"
    );
    // A cut without a contact has two vertices at one place.
    let mesh: Mesh<2> = square(4)?
        .with_surface_where("cut", |x| x[1] == 0.0)?
        .split("cut")?;
    let space = P1::new(mesh);
    let edge = |axis: usize, at: f64| space.trace(move |x| x[axis] == at);
    let periodic = || -> Outcome<Scene<BlockMatrix<2>, 2>> {
        Ok(elastic(&space)?.with_periodic(&edge(0, -2.0)?, &edge(0, 2.0)?))
    };
    let error = refused(periodic()?.with_open_walls());
    let Some(SceneError::NotPeriodic { at, .. }) = error else {
        return Err(format!("{error:?}").into());
    };
    assert_eq!(at, [2.0, 0.0, 0.0]);
    // The plus side of its end is prescribed, the minus side is not.
    let upper = space.trace(|x| x[0] == 2.0 && x[1] >= 0.0)?;
    let (plus, minus) = (space.part("cut+")?, space.part("cut-")?);
    let contact = Contact::between(&plus, &minus, Tresca { coefficient: 0.6 }, 1.0);
    let error = refused(periodic()?.fix(&upper, Components::X).with_contact(contact));
    assert!(
        matches!(error, Some(SceneError::Vertex { .. })),
        "{error:?}"
    );
    Ok(())
}
