//! Normal stress from the deformation, on a rigid surface.

use nalgebra::{DMatrix, SVector, Vector2};
use stickslip::fem::{Elastic, GridDiagonal, Mesh, P1, body_force, elasticity, lumped_mass, mass};
use stickslip::friction::Tresca;
use stickslip::{
    BoundaryPart, CentralDifferences, Components, Condensed, Contact, Diagonal, GeneralizedAlpha,
    Matrix, Newmark, NormalStress, Scene, Simulation, StepError, Steps,
};

use crate::Outcome;

const NU: f64 = 0.3;

/// A block of 5 x 1 with a clamped top that moves along its base as fast as that slides, but for a shear stress that is
/// not uniform: all slide, and the pressure changes by little.
fn block(coefficient: f64, refinements: usize) -> Outcome<Simulation<2>> {
    block_on(&[[0.0, 5.0]], coefficient, refinements)
}

/// The block, with a contact on each part of its base from one place to another.
fn block_on(parts: &[[f64; 2]], coefficient: f64, refinements: usize) -> Outcome<Simulation<2>> {
    let space = P1::grid([5.0, 1.0], [5, 1])?.refined(refinements)?;
    let elastic = Elastic {
        young_modulus: 1.0,
        poisson_ratio: NU,
    };
    let top = space.trace(|x| x[1] == 1.0)?;
    let mut scene =
        Scene::new(elasticity(&space, &elastic)?)
            .prescribe_velocity(&top, Components::ALL, |_| [0.1, 0.0]);
    for &[from, to] in parts {
        let base = space.trace(|x| x[1] == 0.0 && (from..=to).contains(&x[0]))?;
        let shear =
            base.map(|x| Vector2::new(coefficient * (1.0 + 1e-3 * (x[0] * x[0]).sin()), 0.0));
        let contact = Contact::new(&base, Tresca { coefficient }, NormalStress::from_body(1.0))
            .with_shear_stress(shear);
        scene = scene.with_contact(contact);
    }
    Ok(Simulation::new(
        scene,
        GeneralizedAlpha::default(),
        Condensed::new(),
    )?)
}

/// `mu rho(S_tt^-1 S_tn)` of the Schur complement of the base.
fn expected(refinements: usize) -> Outcome<f64> {
    let space = P1::grid([5.0, 1.0], [5, 1])?.refined(refinements)?;
    let elastic = Elastic {
        young_modulus: 1.0,
        poisson_ratio: NU,
    };
    let stiffness = elasticity(&space, &elastic)?;
    let size = space.vertex_count();
    let mut dense = DMatrix::zeros(2 * size, 2 * size);
    for (block, (i, j)) in stiffness.iter() {
        dense
            .fixed_view_mut::<2, 2>(2 * i as usize, 2 * j as usize)
            .copy_from(block);
    }
    let of = |y: f64| space.trace(move |x| x[1] == y);
    let (base, top) = (of(0.0)?, of(1.0)?);
    let at = |p: usize, c: usize| 2 * p + c;
    let tangential: Vec<usize> = base.vertices().iter().map(|&p| at(p, 0)).collect();
    let normal: Vec<usize> = base.vertices().iter().map(|&p| at(p, 1)).collect();
    let inner: Vec<usize> = (0..size)
        .filter(|p| !base.vertices().contains(p) && !top.vertices().contains(p))
        .flat_map(|p| [at(p, 0), at(p, 1)])
        .collect();
    let part = |rows: &[usize], columns: &[usize]| {
        DMatrix::from_fn(rows.len(), columns.len(), |i, j| {
            dense[(rows[i], columns[j])]
        })
    };
    let solved = part(&inner, &inner)
        .lu()
        .solve(&part(&inner, &tangential))
        .ok_or("singular")?;
    let schur = |rows: &[usize]| part(rows, &tangential) - part(rows, &inner) * &solved;
    let map = schur(&tangential)
        .lu()
        .solve(&schur(&normal).transpose())
        .ok_or("singular")?;
    let eigenvalues = map.complex_eigenvalues();
    Ok(eigenvalues.iter().map(|q| q.norm()).fold(0.0, f64::max))
}

/// The contraction of a step is that of the Schur complement, and Anderson's acceleration converges up to near 1.
#[test]
fn the_contraction_is_that_of_the_schur_complement() -> Outcome {
    for refinements in [2, 3] {
        let per_unit = expected(refinements)?;
        for coefficient in [0.6, 1.5] {
            let report = block(coefficient, refinements)?.step(1.0)?;
            let ratio = report.contraction / (coefficient * per_unit);
            assert!((ratio - 1.0).abs() < 0.1, "{report:?} {per_unit}");
            assert!(report.reaction_iterations <= 40, "{report:?}");
        }
        let beyond = 1.05 / per_unit;
        let refused = block(beyond, refinements)?.step(1.0);
        let Err(refused) = refused else {
            return Err(format!("{refused:?}").into());
        };
        let StepError::NotContracting { contraction, .. } = refused.cause else {
            return Err(refused.into());
        };
        assert!((1.0..1.3).contains(&contraction), "{contraction}");
    }
    Ok(())
}

/// With `P` the momentum and all of the base sliding, `P_x + mu P_y = M g (sin - mu cos) t`: friction is `mu` times the
/// reaction, whatever waves run through the block.
#[test]
fn a_block_on_an_incline_slides_by_its_reaction() -> Outcome {
    let (density, gravity, coefficient) = (2.0, 10.0, 0.1);
    let space = P1::grid([5.0, 1.0], [5, 1])?.refined(2)?;
    let elastic = Elastic {
        young_modulus: 1e6,
        poisson_ratio: 0.0,
    };
    let base = space.trace(|x| x[1] == 0.0)?;
    let angle = 35_f64.to_radians();
    let weight = Vector2::new(angle.sin(), -angle.cos()) * density * gravity;
    // Under its own weight, without friction and Poisson's ratio: no waves that lift it.
    let pressed = |x: &SVector<f64, 2>| {
        let y = x[1];
        SVector::from([0.0, weight[1] * (y - 0.5 * y * y) / elastic.young_modulus])
    };
    let pressed = space.mesh().vertices().iter().map(pressed).collect();
    let contact = Contact::new(&base, Tresca { coefficient }, NormalStress::from_body(0.0));
    let inertia = mass::<2, 2>(&space, density)?;
    let scene = Scene::new(elasticity(&space, &elastic)?)
        .with_mass(inertia.clone())
        .with_load(body_force(&space, |_| weight))
        .with_velocity(vec![SVector::from([1.0, 0.0]); space.vertex_count()])
        .with_displacement(pressed)
        .with_contact(contact);
    let mut body = Simulation::new(scene, Newmark::default(), Condensed::new())?;
    let ones =
        |c: usize| vec![SVector::from_fn(|k, _| f64::from(u8::from(k == c))); space.vertex_count()];
    let momentum = |velocity: &[SVector<f64, 2>], c: usize| -> f64 {
        let mut product = vec![SVector::zeros(); velocity.len()];
        inertia.multiply_add(1.0, velocity, &mut product);
        product.iter().zip(ones(c)).map(|(a, b)| a.dot(&b)).sum()
    };
    let start = [0, 1].map(|c| momentum(body.snapshot().velocity, c));
    body.run(&Steps::constant(1e-3).count(200), |at| {
        assert!(at.contact(0).normal_stress(7) > 0.0);
    })?;
    let at = body.snapshot();
    let end = [0, 1].map(|c| momentum(at.velocity, c) - start[c]);
    let total = 5.0 * density * gravity * (angle.sin() - coefficient * angle.cos()) * at.time;
    let error = (end[0] + coefficient * end[1]) / total - 1.0;
    assert!(error.abs() < 1e-6, "{error:e}");
    Ok(())
}

/// At the vertex where they meet, both have the normal stress of the whole reaction over both areas.
#[test]
fn contacts_that_meet_on_a_plane_share_the_reaction() -> Outcome {
    let mut whole = block(0.6, 2)?;
    let mut parted = block_on(&[[0.0, 2.0], [2.0, 5.0]], 0.6, 2)?;
    for _ in 0..3 {
        whole.step(0.1)?;
        parted.step(0.1)?;
    }
    let (whole, parted) = (whole.snapshot(), parted.snapshot());
    let of_whole = whole.contact(0);
    for contact in parted.contacts() {
        for k in 0..contact.len() {
            let place = of_whole.position_of(contact.vertex(k));
            let place = place.ok_or("not on the base")?;
            let stress = contact.normal_stress(k) / of_whole.normal_stress(place);
            let slip = contact.slip(k) / of_whole.slip(place);
            assert!((stress - 1.0).abs() < 1e-8, "{stress}");
            assert!((slip - 1.0).abs() < 1e-8, "{slip}");
        }
    }
    Ok(())
}

/// In a groove of a right angle, with the motion across it prescribed along its line, each face has the pressure of the
/// load: normals that share a vertex, and axes that are along neither.
#[test]
fn faces_of_a_groove_bear_their_own_reactions() -> Outcome {
    let grid = Mesh::<3>::grid([1.0, 1.0, 1.0], [2, 2, 2])?;
    let half = 0.5_f64.sqrt();
    let turned =
        |x: &SVector<f64, 3>| SVector::from([half * (x[0] - x[1]), half * (x[0] + x[1]), x[2]]);
    let points = grid.vertices().iter().map(turned).collect();
    let space = P1::new(Mesh::new(
        points,
        grid.cells().flatten().copied().collect(),
    )?);
    let across = |x: &SVector<f64, 3>| [half * (x[1] + x[0]), half * (x[1] - x[0])];
    let face = |side: usize, at: f64| space.trace(move |x| (across(x)[side] - at).abs() < 1e-12);
    let line = face(0, 0.0)?;
    let line: Vec<usize> = (line.vertices().iter().copied())
        .filter(|&p| across(&space.mesh().vertices()[p])[1].abs() < 1e-12)
        .collect();
    let line = BoundaryPart {
        weights: vec![0.0; line.len()],
        vertices: line,
        dimension: 3,
        mesh: BoundaryPart::from(&face(0, 0.0)?).mesh,
        ..BoundaryPart::point(1.0)
    };
    let pressure = 1e-3;
    let mut load = vec![SVector::<f64, 3>::zeros(); space.vertex_count()];
    for (side, sign) in [(0, 1.0), (1, -1.0)] {
        let loaded = face(side, 1.0)?;
        for (&p, weight) in loaded.vertices().iter().zip(loaded.weights()) {
            load[p] -= SVector::from([sign * half, half, 0.0]) * (pressure * weight);
        }
    }
    let elastic = Elastic {
        young_modulus: 1.0,
        poisson_ratio: NU,
    };
    let ends = |at: f64| space.trace(move |x| x[2] == at);
    let mut scene = Scene::new(elasticity(&space, &elastic)?)
        .fix(&ends(0.0)?, Components::Z)
        .fix(&ends(1.0)?, Components::Z)
        .fix(line, Components::X)
        .with_load(load);
    for side in 0..2 {
        let law = Tresca { coefficient: 0.0 };
        let from_body = NormalStress::from_body(0.0);
        scene = scene.with_contact(Contact::new(&face(side, 0.0)?, law, from_body));
    }
    let mut body = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;
    body.step(1.0)?;
    for face in body.snapshot().contacts() {
        for k in 0..face.len() {
            let stress = face.normal_stress(k) / pressure;
            assert!(
                (stress - 1.0).abs() < 1e-9,
                "{stress} at {:?}",
                face.point(k)
            );
        }
    }
    Ok(())
}

/// A fault that meets the free surface, with a pressure in proportion to depth: its zero at the surface is no tension.
/// With a pascal more it slides alike.
#[test]
fn a_pressure_that_vanishes_at_the_surface_is_no_tension() -> Outcome {
    let gradient = 7378.0;
    let slips = |more: f64| -> Outcome<Vec<f64>> {
        let mesh = Mesh::<2>::grid([8e3, 4e3], [8, 4], GridDiagonal::Rising)?
            .with_surface_where("fault", |x| x[1] == x[0] - 2e3 && x[1] >= 1e3)?
            .split("fault")?;
        let space = P1::new(mesh);
        let (plus, minus) = (space.part("fault+")?, space.part("fault-")?);
        let depth = |x: &SVector<f64, 2>| gradient * (4e3 - x[1]);
        let stress: Vec<f64> = plus.map(|x| 2_f64.sqrt() * depth(x) + more);
        let shear: Vec<SVector<f64, 2>> = plus.map(|x| SVector::from([-0.4 * depth(x); 2]));
        let law = Tresca { coefficient: 0.3 };
        let contact = Contact::between(&plus, &minus, law, NormalStress::from_body(stress));
        let elastic = Elastic {
            young_modulus: 75e9,
            poisson_ratio: 0.25,
        };
        let scene = Scene::new(elasticity(&space, &elastic)?)
            .with_mass(lumped_mass(&space, 2700.0)?)
            .with_contact(contact.with_shear_stress(shear))
            .fix(&space.trace(|x| x[1] == 0.0)?, Components::ALL);
        let mut body = Simulation::new(scene, CentralDifferences, Diagonal::new())?;
        body.step(1e-9)?;
        body.run(&Steps::constant(0.1).until(2.0), |_| ())?;
        let at = body.snapshot();
        let fault = at.contact(0);
        Ok((0..fault.len()).map(|k| fault.slip(k)).collect())
    };
    let [zero, one] = [slips(0.0)?, slips(1.0)?];
    for (zero, one) in zero.iter().zip(&one) {
        assert!(
            *zero > 0.1 && (zero / one - 1.0).abs() < 1e-5,
            "{zero} {one}"
        );
    }
    Ok(())
}
