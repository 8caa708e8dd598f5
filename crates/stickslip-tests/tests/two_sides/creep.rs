//! Faults that creep at a prescribed rate between two sides that deform freely.

use nalgebra::SVector;
use stickslip::fem::{GridDiagonal, Mesh, P1, antiplane_by_cell, elasticity, mass};
use stickslip::friction::Tresca;
use stickslip::{
    BoundaryCondition, Components, Condensed, Contact, GeneralizedAlpha, NormalStress, Scene,
    SceneError, Simulation, Steps, Tnnmg,
};

use crate::random_block::Random;
use crate::{ELASTIC, Outcome, largest, mirrored, square};

/// Two layers of random thickness and moduli in series, one plate driven: the shear stress is
/// `(driven way - slip)/(h_1/G_1 + h_2/G_2)`, linear in time where both rates are constant, and quadratic under a rate
/// that grows linearly. Both sides bear it with opposite signs.
#[test]
fn creep_relaxes_two_layers_linearly() -> Outcome {
    for seed in 0..12 {
        let random = &mut Random(100 + seed);
        let cells = [2 + random.below(3), 2 + random.below(3)];
        let (width, heights) = (
            random.between(1.0, 3.0),
            [(); 2].map(|()| random.between(0.5, 2.0)),
        );
        let shear = [(); 2].map(|()| random.between(10e9, 40e9));
        let rows = cells[0] + cells[1];
        let grid = Mesh::<2>::grid([width, rows as f64], [3, rows], GridDiagonal::Rising)?;
        let level = cells[0] as f64;
        let height = |y: f64| match y <= level {
            true => (y - level) * heights[0] / level,
            false => (y - level) * heights[1] / cells[1] as f64,
        };
        let points = grid
            .vertices()
            .iter()
            .map(|x| SVector::from([x[0], height(x[1])]));
        let mesh = Mesh::new(points.collect(), grid.cells().flatten().copied().collect())?
            .with_surface_where("fault", |x| x[1] == 0.0)?
            .split("fault")?;
        let space = P1::new(mesh);
        let (plus, minus) = (space.part("fault+")?, space.part("fault-")?);
        let [first, growth, drive] = [(); 3].map(|()| random.between(-2e-9, 2e-9));
        let top = space.trace(|x| x[1] > 0.999 * heights[1])?;
        let scene = Scene::new(antiplane_by_cell(&space, |x, _| {
            shear[usize::from(x[1] > 0.0)]
        })?)
        .fix(
            &space.trace(|x| x[1] < -0.999 * heights[0])?,
            Components::ALL,
        )
        .prescribe_velocity(&top, Components::ALL, move |_| [drive])
        .prescribe_slip_rate(
            &plus,
            &minus,
            Components::ALL,
            move |t| [first + growth * t],
        );
        let mut layers = match seed % 2 {
            0 => Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?,
            _ => Simulation::new(
                scene,
                GeneralizedAlpha::default(),
                Tnnmg::new(space.transfers()),
            )?,
        };
        let compliance = heights[0] / shear[0] + heights[1] / shear[1];
        for _ in 0..5 {
            layers.step(random.between(0.5, 3.0))?;
            let at = layers.snapshot();
            let slip = first * at.time + 0.5 * growth * at.time.powi(2);
            let stress = (drive * at.time - slip) / compliance;
            let scale =
                (first.abs() + growth.abs() + drive.abs()) * at.time.powi(2).max(1.0) / compliance;
            let forces = [&plus, &minus, &top].map(|part| at.reaction(part).map(|force| force[0]));
            let [above, below, driven] = forces;
            for (force, sign) in [(above?, -1.0), (below?, 1.0), (driven?, 1.0)] {
                assert!(
                    (force - sign * stress * width).abs() < 1e-9 * scale * width,
                    "{seed}: {force} {stress}"
                );
            }
            let opposite = plus.opposite().ok_or("no side")?;
            for (&p, &q) in plus.vertices().iter().zip(opposite) {
                let jump = at.displacement[p] - at.displacement[q];
                assert!((jump[0] - slip).abs() < 1e-12 * scale * compliance);
            }
        }
    }
    Ok(())
}

/// In a body that is its mirror image each side of a creeping fault moves by half of the rate.
#[test]
fn creep_moves_each_side_of_a_mirrored_body_by_half() -> Outcome {
    for (refinements, inertia) in [(1, false), (2, true)] {
        let space = mirrored(refinements)?;
        let (plus, minus) = (space.part("plus")?, space.part("minus")?);
        let body = || -> Outcome<_> {
            let walls = space.trace(|x| x[1].abs() == 1.0)?;
            let scene = Scene::new(elasticity(&space, &ELASTIC)?).fix(&walls, Components::ALL);
            Ok(if inertia {
                scene.with_mass(mass(&space, 1.0)?)
            } else {
                scene
            })
        };
        let rate = |time: f64| 1e-3 * (1.0 - (-time).exp());
        let jump =
            body()?.prescribe_slip_rate(&plus, &minus, Components::ALL, move |t| [rate(t), 0.0]);
        let frictionless = Tresca { coefficient: 0.0 };
        let halves = body()?
            .prescribe_velocity(&plus, Components::X, move |t| [0.5 * rate(t), 0.0])
            .prescribe_velocity(&minus, Components::X, move |t| [-0.5 * rate(t), 0.0])
            .with_contact(Contact::between(&plus, &minus, frictionless, 1.0));
        let mut bodies = [jump, halves]
            .map(|scene| Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new()));
        let steps = Steps::constant(0.05).count(20);
        for body in &mut bodies {
            body.as_mut()
                .map_err(|error| error.clone())?
                .run(&steps, |_| ())?;
        }
        let [Ok(jump), Ok(halves)] = &bodies else {
            return Err("refused".into());
        };
        let (jump, halves) = (jump.snapshot(), halves.snapshot());
        let size = largest(halves.displacement.iter().copied());
        let difference = jump
            .displacement
            .iter()
            .zip(halves.displacement)
            .map(|(a, b)| a - b);
        let difference = largest(difference);
        assert!(
            size > 1e-5 && difference < 1e-9 * size,
            "{difference} {size}"
        );
        let forces = [&plus, &minus].map(|side| [jump.reaction(side), halves.reaction(side)]);
        for [one, other] in forces {
            let (one, other) = (one?, other?);
            assert!(
                (one[0] - other[0]).abs() < 1e-8 * other[0].abs(),
                "{one} {other}"
            );
        }
    }
    Ok(())
}

/// A group creeps beside one that friction resists: pairs of the first slip at the rate, and so does the joint; a pair of
/// the second slips less, the less the stronger it is. Forces on each pair are opposite.
#[test]
fn a_group_creeps_beside_one_with_friction() -> Outcome {
    let mesh = square(8)?
        .with_surface_where("locked", |x| x[1] == 0.0 && x[0] <= 0.0)?
        .with_surface_where("creeping", |x| x[1] == 0.0 && x[0] >= 0.0)?
        .split_all(["locked", "creeping"])?;
    let space = P1::new(mesh).refined(1)?;
    let part = |name: &str| space.part(name);
    let mut slips = Vec::new();
    for pressure in [1e3, 1.0, 1e-4] {
        let contact = Contact::between(
            &part("locked+")?,
            &part("locked-")?,
            Tresca { coefficient: 0.5 },
            pressure,
        );
        let (plus, minus) = (part("creeping+")?, part("creeping-")?);
        let scene = Scene::new(elasticity(&space, &ELASTIC)?)
            .fix(&space.trace(|x| x[1].abs() == 2.0)?, Components::ALL)
            .prescribe_slip_rate(&plus, &minus, Components::ALL, |_| [1e-3, 0.0])
            .with_contact(contact);
        let mut body = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;
        body.run(&Steps::constant(0.1).count(10), |_| ())?;
        let at = body.snapshot();
        for (&p, &q) in plus
            .vertices()
            .iter()
            .zip(plus.opposite().ok_or("no side")?)
        {
            let jump = at.displacement[p] - at.displacement[q];
            assert!((jump - SVector::from([1e-3, 0.0])).amax() < 1e-14, "{jump}");
            // The joint has the forces of both groups.
            if space.mesh().vertices()[p][0] > 0.0 {
                let (one, other) = (at.reaction_at(p)?, at.reaction_at(q)?);
                assert!((one + other).norm() < 1e-10 * one.norm(), "{one} {other}");
            }
        }
        let locked = at.contact(0);
        let of_locked: Vec<f64> = (0..locked.len())
            .filter(|&k| locked.point(k)[0] < 0.0)
            .map(|k| locked.slip_vector(k)[0])
            .collect();
        assert!(
            of_locked.iter().all(|&slip| (-1e-12..1e-3).contains(&slip)),
            "{of_locked:?}"
        );
        slips.push(of_locked.iter().sum::<f64>());
    }
    assert!(
        slips[0].abs() < 1e-12 && slips[1] >= slips[0] && slips[2] > 1e-3,
        "{slips:?}"
    );
    Ok(())
}

#[test]
fn slip_rates_that_contradict_are_refused() -> Outcome {
    let space = mirrored(1)?;
    let (plus, minus) = (space.part("plus")?, space.part("minus")?);
    let body = || -> Outcome<_> { Ok(Scene::new(elasticity(&space, &ELASTIC)?)) };
    let build = |scene| Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new()).err();
    let both = body()?
        .fix(&plus, Components::X)
        .fix(&minus, Components::X)
        .prescribe_slip_rate(&plus, &minus, Components::ALL, |_| [1.0, 0.0]);
    let (first, second) = (BoundaryCondition::Fixed(1), BoundaryCondition::SlipRate(1));
    assert!(matches!(
        build(both),
        Some(SceneError::Contradiction { first: a, second: b, component: 0, .. }) if a == first && b == second
    ));
    let other = space.trace(|x| x[1] == 1.0)?;
    let apart = body()?.prescribe_slip_rate(&plus, &other, Components::ALL, |_| [1.0, 0.0]);
    assert!(matches!(build(apart), Some(SceneError::NotPaired { .. })));
    // One side is fixed: the other moves at the rate.
    let one = body()?.fix(&plus, Components::ALL).prescribe_slip_rate(
        &plus,
        &minus,
        Components::ALL,
        |_| [1e-3, 0.0],
    );
    let mut body = Simulation::new(one, GeneralizedAlpha::default(), Condensed::new())?;
    body.step(1.0)?;
    let at = body.snapshot();
    let moved = minus
        .vertices()
        .iter()
        .map(|&q| at.displacement[q] + SVector::from([1e-3, 0.0]));
    assert!(largest(moved) < 1e-15);
    Ok(())
}

/// A fault that branches, in one group: each sheet is a contact, and slips as the fault and the splay in two groups.
#[test]
fn a_branch_in_one_group_slips_as_one_of_its_own() -> Outcome {
    for seed in 0..6 {
        let random = &mut Random(300 + seed);
        let slope = random.between(0.3, 1.5);
        let grid = square(8)?;
        let points = grid
            .vertices()
            .iter()
            .map(|x| SVector::from([x[0], slope * x[1]]));
        let mesh = Mesh::new(points.collect(), grid.cells().flatten().copied().collect())?;
        let level = |x: &SVector<f64, 2>| x[1] == 0.0 && x[0].abs() <= 1.0;
        let oblique = |x: &SVector<f64, 2>| x[1] == slope * x[0] && (0.0..=1.0).contains(&x[0]);
        let named = mesh
            .with_surface_where("level", level)?
            .with_surface_where("oblique", oblique)?;
        let faces = named.surfaces().flat_map(|(_, faces)| faces.to_vec());
        let all: Vec<[u32; 2]> = faces.collect();
        let one = named.clone().with_surface("fault", &all)?.split("fault")?;
        let two = named.split_all(["level", "oblique"])?;
        let stress = nalgebra::Matrix2::new(-0.5, 1.0, 1.0, -0.5);
        let slips = |mesh: Mesh<2>, names: &[&str]| -> Outcome<Vec<f64>> {
            let space = P1::new(mesh).refined(1)?;
            let from_body = NormalStress::from_body(0.0);
            let mut body = crate::stressed(&space, stress, (names, 0.1), &from_body, false)?;
            body.step(1.0)?;
            let at = body.snapshot();
            Ok(at
                .contacts()
                .flat_map(|own| (0..own.len()).map(move |k| own.slip(k)))
                .collect())
        };
        let (one, two) = (
            slips(one, &["fault", "fault.1"])?,
            slips(two, &["level", "oblique"])?,
        );
        let size = two.iter().fold(0.0_f64, |size, slip| size.max(slip.abs()));
        assert!(size > 0.1 && one.len() == two.len());
        assert!(
            one.iter()
                .zip(&two)
                .all(|(a, b)| (a - b).abs() <= 1e-9 * size)
        );
    }
    Ok(())
}
