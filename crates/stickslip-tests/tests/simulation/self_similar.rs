//! A crack in antiplane shear whose front is forced to run at a constant speed, against its exact slip.

use nalgebra::Vector1;
use stickslip::fem::{P1, antiplane, lumped_mass};
use stickslip::friction::LinearWeakening;
use stickslip::state::TimeWeakening;
use stickslip::{CentralDifferences, Contact, Diagonal, Scene, Simulation, Steps};

use crate::Outcome;

/// The slip at the middle of a crack that grows at a speed in both directions, over `2 dtau v t/mu`, when its front has
/// passed so many cells; length, density, shear modulus, stress drop and shear wave speed are 1.
fn slip_at_the_middle(speed: f64, cells: usize) -> Outcome<f64> {
    // Waves from the sides arrive at the middle after the end.
    let counts = [8 * cells / 5, 6 * cells / 5];
    let space = P1::grid(counts.map(|count| count as f64), counts)?;
    let fault = space.trace(|x| x[1] == 0.0)?;
    // Static strength is above the stress at the front, so that the front runs as it is forced to.
    let law = LinearWeakening {
        static_friction: 50.0,
        dynamic_friction: 0.0,
    };
    let forced = TimeWeakening { duration: 0.1 };
    let contact = Contact::new(&fault, law, 1.0)
        .with_state(forced, fault.map(|x| forced.before(x[0] / speed)))
        .with_shear_stress(Vector1::new(1.0));
    let scene = Scene::new(antiplane(&space, 1.0)?)
        .with_mass(lumped_mass(&space, 1.0)?)
        .with_contact(contact);
    let mut crack = Simulation::new(scene, CentralDifferences, Diagonal::new())?;
    // Between the ruptures of two vertices, as far as the cells of the vertices that have.
    let front = cells as f64 + 0.5;
    let end = front / speed;
    let dt = end / (end / 0.4).ceil();
    crack.run(&Steps::constant(dt).until(end), |_| ())?;
    let at = crack.snapshot();
    let contact = at.contact(0);
    let middle = (0..contact.len()).find(|&k| contact.point(k)[0] == 0.0);
    // The body is one of two halves: the slip across the fault is twice its own.
    Ok(contact.slip(middle.ok_or("no middle")?) / front)
}

/// `1/E(k)` with `k^2 = 1 - v^2/c^2`: B. V. Kostrov, J. Appl. Math. Mech. 28 (1964).
#[test]
fn a_self_similar_crack_slips_as_an_ellipse() -> Outcome {
    for (speed, exact) in [(0.5, 0.825_726), (0.75, 0.723_868)] {
        for (cells, bound) in [(50, 0.02), (100, 0.01)] {
            let error = slip_at_the_middle(speed, cells)? / exact - 1.0;
            assert!(error.abs() < bound, "{speed} {cells}: {error}");
        }
    }
    Ok(())
}
