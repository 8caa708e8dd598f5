//! A fault in groups that continue one another slips as in one group.

use std::collections::BTreeMap;

use nalgebra::{Matrix2, SVector, Vector2, Vector3};
use stickslip::fem::{GridDiagonal, Mesh, P1, antiplane, elasticity};
use stickslip::friction::Tresca;
use stickslip::{BackwardEuler, Components, Condensed, Contact, NormalStress, Scene, Simulation};

use crate::{ELASTIC, Outcome, square, stressed};

/// By the position: the slip, the normal stress and the area of each vertex, of all contacts there.
type Slips = BTreeMap<Vec<i64>, [f64; 3]>;

/// Adds a vertex of a contact: where several meet they have one slip and one normal stress.
fn enter(all: &mut Slips, point: &[f64], [slip, stress, weight]: [f64; 3]) {
    let key = point.iter().map(|x| (x * 1e6).round() as i64).collect();
    let own = all.entry(key).or_insert([slip, stress, 0.0]);
    assert!(
        (own[0] - slip).abs() < 1e-12 && (own[1] - stress).abs() < 1e-9,
        "{point:?}"
    );
    own[2] += weight;
}

fn agree(one: &Slips, other: &Slips) {
    assert!(one.keys().eq(other.keys()));
    let largest = one
        .values()
        .fold(0.0, |largest: f64, own| largest.max(own[0]));
    assert!(largest > 0.0);
    for (at, [slip, stress, weight]) in other {
        let expected = &one[at];
        assert!(
            (slip - expected[0]).abs() < 1e-9 * largest,
            "{at:?}: {slip} {}",
            expected[0]
        );
        assert!(
            (stress - expected[1]).abs() < 1e-8,
            "{at:?}: {stress} {}",
            expected[1]
        );
        assert!((weight - expected[2]).abs() < 1e-12);
    }
}

/// The places below a number, in an order by a seed.
fn random(seed: &mut u64, below: usize) -> usize {
    *seed = seed
        .wrapping_mul(6_364_136_223_846_793_005)
        .wrapping_add(1_442_695_040_888_963_407);
    ((*seed >> 33) % below as u64) as usize
}

/// Names the faces of a fault at random, in a random order of the names.
fn scattered<const D: usize>(
    mesh: Mesh<D>,
    fault: &str,
    seed: &mut u64,
) -> Outcome<(Mesh<D>, Vec<String>)> {
    let (_, faces) = mesh
        .surfaces()
        .find(|(name, _)| *name == fault)
        .ok_or("no fault")?;
    let mut groups = vec![Vec::new(); 3];
    for face in faces.iter().copied() {
        groups[random(seed, 3)].push(face);
    }
    let (mut named, mut names) = (mesh, Vec::new());
    for (k, faces) in groups
        .iter()
        .enumerate()
        .filter(|(_, faces)| !faces.is_empty())
    {
        let name = format!("{fault}{k}");
        named = named.with_surface(name.as_str(), faces)?;
        names.insert(random(seed, names.len() + 1), name);
    }
    Ok((named, names))
}

/// The slips of faults in the plane under a pressure and shear, in two steps.
fn plane(mesh: &Mesh<2>, names: &[String], normal_stress: &NormalStress) -> Outcome<Slips> {
    let space = P1::new(mesh.clone().split_all(names)?).refined(1)?;
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let stress = Matrix2::new(-0.5, 1.0, 1.0, -0.5);
    let mut body = stressed(&space, stress, (&names, 0.1), normal_stress, false)?;
    body.step(0.5)?;
    body.step(0.5)?;
    let (at, mut all) = (body.snapshot(), Slips::new());
    for (contact, name) in at.contacts().zip(&names) {
        for k in (0..contact.len()).filter(|&k| contact.weight(k) > 0.0) {
            let point = contact.point(k);
            let which = if name.starts_with("level") { 0.0 } else { 1.0 };
            let values = [contact.slip(k), contact.normal_stress(k), contact.weight(k)];
            enter(&mut all, &[point[0], point[1], which], values);
        }
    }
    Ok(all)
}

#[test]
fn groups_in_the_plane_slip_as_one() -> Outcome {
    let level = |x: &SVector<f64, 2>| x[1] == 0.0 && x[0].abs() <= 1.0;
    let oblique = |x: &SVector<f64, 2>| x[0] == x[1] && (-1.0..=2.0).contains(&x[0]);
    let alone = square(8)?.with_surface_where("level", level)?;
    let crossed = alone.clone().with_surface_where("oblique", oblique)?;
    let mut seed = 1;
    for (mesh, faults) in [(alone, &["level"][..]), (crossed, &["level", "oblique"])] {
        for normal_stress in [NormalStress::from(0.5), NormalStress::from_body(0.0)] {
            let whole: Vec<String> = faults.iter().map(|&name| name.to_owned()).collect();
            let one = plane(&mesh, &whole, &normal_stress)?;
            for _ in 0..8 {
                let (mut named, mut names) = (mesh.clone(), Vec::new());
                for fault in faults {
                    let (after, own) = scattered(named, fault, &mut seed)?;
                    (named, names) = (after, [names, own].concat());
                }
                agree(&one, &plane(&named, &names, &normal_stress)?);
            }
        }
    }
    Ok(())
}

/// The slips of a fault in a cube, in which the sides x = 0, 4 move past one another.
fn solid(mesh: &Mesh<3>, names: &[String], normal_stress: &NormalStress) -> Outcome<Slips> {
    let space = P1::new(mesh.clone().split_all(names)?);
    let [bottom, top] = [space.trace(|x| x[2] == 0.0)?, space.trace(|x| x[2] == 4.0)?];
    let mut scene = Scene::new(elasticity(&space, &ELASTIC)?)
        .fix(&bottom, Components::ALL)
        .prescribe_velocity(&top, Components::ALL, |_| [2.0, 0.8, -1.0]);
    for name in names {
        let [plus, minus] = ["+", "-"].map(|side| space.part(&format!("{name}{side}")));
        let law = Tresca { coefficient: 0.2 };
        scene = scene.with_contact(Contact::between(
            &plus?,
            &minus?,
            law,
            normal_stress.clone(),
        ));
    }
    let mut body = Simulation::new(scene, BackwardEuler, Condensed::new())?;
    body.step(1.0)?;
    let (at, mut all) = (body.snapshot(), Slips::new());
    for contact in at.contacts() {
        for k in 0..contact.len() {
            let values = [contact.slip(k), contact.normal_stress(k), contact.weight(k)];
            enter(&mut all, &contact.point(k), values);
        }
    }
    Ok(all)
}

#[test]
fn groups_in_space_slip_as_one() -> Outcome {
    let grid = Mesh::<3>::grid([4.0; 3], [4; 3])?;
    // A fault that leaves the body at y = 0 and is bent across it.
    let on = |x: &Vector3<f64>| x[2] == 2.0 && (1.0..=3.0).contains(&x[0]) && x[1] <= 3.0;
    let flat = grid.with_surface_where("fault", on)?;
    let faces = flat.surfaces().next().ok_or("no fault")?.1.to_vec();
    let up = |x: &Vector3<f64>| 0.1 * (x[0] - 1.0) * (3.0 - x[0]) * (x[2] * (4.0 - x[2])) / 4.0;
    let points = flat
        .vertices()
        .iter()
        .map(|x| Vector3::new(x[0], x[1], x[2] + up(x)));
    let cells = flat.cells().flatten().copied().collect();
    let mesh = Mesh::new(points.collect(), cells)?.with_surface("fault", &faces)?;
    let mut seed = 2;
    for normal_stress in [NormalStress::from(0.5), NormalStress::from_body(0.0)] {
        let one = solid(&mesh, &["fault".to_owned()], &normal_stress)?;
        for _ in 0..6 {
            let (named, names) = scattered(mesh.clone(), "fault", &mut seed)?;
            agree(&one, &solid(&named, &names, &normal_stress)?);
        }
    }
    Ok(())
}

/// A layer above y = 0, or with its mirror image below, joined where x < 1.
fn layer(whole: bool, joint: f64) -> Outcome<P1<2>> {
    let upper = Mesh::<2>::grid([4.0, 1.0], [16, 4], GridDiagonal::Rising)?;
    if !whole {
        return Ok(P1::new(upper));
    }
    let mut vertices = upper.vertices().to_vec();
    let mut images = Vec::new();
    for (p, x) in (0..).zip(upper.vertices()) {
        if x[1] == 0.0 {
            images.push(p);
        } else {
            images.push(vertices.len() as u32);
            vertices.push(Vector2::new(x[0], -x[1]));
        }
    }
    let mut cells: Vec<u32> = upper.cells().flatten().copied().collect();
    for cell in upper.cells() {
        cells.extend([cell[0], cell[2], cell[1]].map(|p| images[p as usize]));
    }
    let mesh = Mesh::new(vertices, cells)?
        .with_surface_where("a", |x| x[1] == 0.0 && (1.0..=joint).contains(&x[0]))?
        .with_surface_where("b", |x| x[1] == 0.0 && x[0] >= joint)?;
    Ok(P1::new(mesh.split_all(["b", "a"])?))
}

/// Position and slip along a frictional group beside one that creeps, in antiplane shear.
fn beside_creep(whole: bool, joint: f64, creep: f64) -> Outcome<Vec<(f64, f64)>> {
    let space = layer(whole, joint)?;
    let law = Tresca { coefficient: 0.1 };
    let top = space.trace(|x| x[1] == 1.0)?;
    let scene =
        Scene::new(antiplane(&space, 1.0)?).prescribe_velocity(&top, Components::ALL, |_| [0.3]);
    let up = move |_: f64| [0.5 * creep];
    let scene = if whole {
        let [above, below] = [space.part("b+")?, space.part("b-")?];
        scene
            .prescribe_velocity(&space.trace(|x| x[1] == -1.0)?, Components::ALL, |_| [-0.3])
            .prescribe_velocity(&above, Components::ALL, up)
            .prescribe_velocity(&below, Components::ALL, move |_| [-0.5 * creep])
            .with_contact(Contact::between(
                &space.part("a+")?,
                &space.part("a-")?,
                law,
                1.0,
            ))
    } else {
        let on =
            |from: f64, to: f64| space.trace(move |x| x[1] == 0.0 && (from..=to).contains(&x[0]));
        scene
            .fix(&on(0.0, 1.0)?, Components::ALL)
            .prescribe_velocity(&on(joint, 4.0)?, Components::ALL, up)
            .with_contact(Contact::new(&on(1.0, joint)?, law, 1.0))
    };
    let mut body = Simulation::new(scene, BackwardEuler, Condensed::new())?;
    for _ in 0..4 {
        body.step(0.25)?;
    }
    let at = body.snapshot();
    let contact = at.contact(0);
    Ok((0..contact.len())
        .map(|k| (contact.point(k)[0], contact.slip(k)))
        .collect())
}

/// By symmetry the slip between the halves is twice that of one on a rigid surface, where contacts and driven parts have
/// shared vertices all along.
#[test]
fn a_group_that_creeps_drives_the_contact_beside_it() -> Outcome {
    for (joint, creep) in [(1.5, 0.2), (2.0, 0.9), (3.0, 0.05), (3.5, 0.4)] {
        let (half, whole) = (
            beside_creep(false, joint, creep)?,
            beside_creep(true, joint, creep)?,
        );
        assert_eq!(whole.len() + 1, half.len());
        for (x, slip) in whole {
            let (_, own) = half
                .iter()
                .find(|(at, _)| *at == x)
                .ok_or("no such place")?;
            assert!((slip - 2.0 * own).abs() < 1e-9, "{x}: {slip} {own}");
            assert!(x < joint || (slip - creep).abs() < 1e-12);
        }
    }
    Ok(())
}
