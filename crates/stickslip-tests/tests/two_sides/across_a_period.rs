//! Faults in groups of a mesh that meet across a periodic boundary.

use stickslip::fem::{GridDiagonal, Mesh, P1, elasticity};
use stickslip::friction::Tresca;
use stickslip::{
    Components, Condensed, Contact, GeneralizedAlpha, NormalStress, Scene, Simulation, Steps,
};

use crate::{ELASTIC, Outcome};

/// A group of a mesh: its name, and which positions along the fault it holds.
type Group<'a> = (&'a str, fn(f64) -> bool);

/// Slip at the places of a fault that is given as groups of a mesh, in a body of period 4 that is sheared and stretched,
/// shifted along the period.
fn slip_of_groups(
    groups: &[Group<'_>],
    shift: f64,
    stress: impl Fn() -> NormalStress,
) -> Outcome<Vec<(u32, f64)>> {
    let mut mesh = Mesh::<2>::grid([4.0, 2.0], [16, 8], GridDiagonal::Rising)?;
    for &(name, inside) in groups {
        mesh = mesh.with_surface_where(name, |x| x[1] == 1.0 && inside(x[0]))?;
    }
    let space = P1::new(mesh.split_all(groups.iter().map(|group| group.0))?);
    let edge = |axis: usize, at: f64| space.trace(move |x| x[axis] == at);
    let mut scene = Scene::new(elasticity(&space, &ELASTIC)?)
        .with_periodic(&edge(0, 0.0)?, &edge(0, 4.0)?)
        .fix(&edge(1, 0.0)?, Components::ALL)
        .prescribe_velocity(&edge(1, 2.0)?, Components::ALL, |_| [2e-2, -1e-2]);
    for (name, _) in groups {
        let sides = ["+", "-"].map(|side| space.part(&format!("{name}{side}")));
        let [plus, minus] = sides;
        let law = Tresca { coefficient: 0.3 };
        scene = scene.with_contact(Contact::between(&plus?, &minus?, law, stress()));
    }
    let mut body = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;
    body.run(&Steps::constant(0.5).count(2), |_| ())?;
    let at = body.snapshot();
    let contacts = (0..groups.len()).map(|index| at.contact(index));
    let slips = contacts.flat_map(|contact| {
        let place = |k: usize| {
            let x = space.mesh().vertices()[contact.vertex(k)][0];
            (4.0 * (x + shift).rem_euclid(4.0)) as u32
        };
        let each = (0..contact.len()).map(|k| (place(k), contact.slip(k)));
        each.collect::<Vec<_>>()
    });
    let mut slips: Vec<_> = slips.collect();
    slips.sort_by_key(|slip| slip.0);
    Ok(slips)
}

/// A fault in two groups that meet across a periodic boundary alone slips as the same fault inside the period.
#[test]
fn groups_that_meet_across_a_period_are_one_fault() -> Outcome {
    let stresses: [fn() -> NormalStress; 2] = [|| 5e-3.into(), || NormalStress::from_body(5e-3)];
    for stress in stresses {
        let inside = slip_of_groups(&[("f", |x| (1.0..=3.0).contains(&x))], 0.0, stress)?;
        let split: [Group<'_>; 2] = [("a", |x| x <= 1.0), ("b", |x| x >= 3.0)];
        let across = slip_of_groups(&split, 2.0, stress)?;
        // Each group has the vertex at which they meet.
        assert_eq!(across.len(), inside.len() + 1);
        let largest = inside.iter().fold(0.0_f64, |most, own| most.max(own.1));
        for (place, slip) in across {
            let same = inside.iter().find(|own| own.0 == place);
            let (_, expected) = same.ok_or("a vertex of both")?;
            assert!(
                (slip - expected).abs() < 1e-8 * largest,
                "{place}: {slip} {expected}"
            );
        }
        assert!(largest > 1e-4);
    }
    Ok(())
}
