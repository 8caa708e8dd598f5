//! Steps of a fault with tips take no memory, also under a normal stress that changes in time.

use stickslip::fem::{P1, elasticity};
use stickslip::friction::Tresca;
use stickslip::{Components, Condensed, Contact, GeneralizedAlpha, Scene, Simulation};

use crate::{ELASTIC, Outcome, square};

#[test]
fn a_history_at_a_fault_with_tips_takes_no_memory() -> Outcome {
    let mesh = square(8)?
        .with_surface_where("fault", |x| x[1] == 0.0 && x[0].abs() <= 1.0)?
        .split("fault")?;
    let space = P1::new(mesh);
    let [plus, minus] = ["fault+", "fault-"].map(|side| space.part(side));
    let (plus, count) = (plus?, 5);
    assert_eq!(plus.vertices().len(), count);
    let contact = Contact::between(&plus, &minus?, Tresca { coefficient: 0.3 }, 1e-2)
        // Of all vertices of the part, the tips among them.
        .with_normal_stress_history(move |time, stress| {
            assert_eq!(stress.len(), count);
            stress.fill(1e-2 * (1.0 + time));
        });
    let scene = Scene::new(elasticity(&space, &ELASTIC)?)
        .fix(&space.trace(|x| x[1] == -2.0)?, Components::ALL)
        .prescribe_velocity(&space.trace(|x| x[1] == 2.0)?, Components::ALL, |_| {
            [0.1, 0.0]
        })
        .with_contact(contact);
    let mut body = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;
    body.step(0.1)?;
    let mut steps = Ok(());
    let taken = allocation_counter::measure(|| {
        steps = (0..10).try_for_each(|_| body.step(0.1).map(drop));
    });
    steps?;
    assert_eq!(taken.count_total, 0);
    let at = body.snapshot();
    let fault = at.contact(0);
    assert!((0..fault.len()).all(|k| (fault.normal_stress(k) / 2.1e-2 - 1.0).abs() < 1e-12));
    assert!((0..fault.len()).all(|k| fault.slip(k) > 0.0));
    Ok(())
}
