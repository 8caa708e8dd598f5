//! Cracks whose front is forced to run at a constant speed, in antiplane shear and as a circle in space, against their exact
//! slip.

use nalgebra::{Vector1, Vector3};
use stickslip::fem::{Elastic, P1, antiplane, element_stiffness, lumped_mass};
use stickslip::friction::LinearWeakening;
use stickslip::state::TimeWeakening;
use stickslip::{CentralDifferences, Components, Contact, Diagonal, Scene, Simulation, Steps};

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

/// The slip at the middle of a circular crack that grows at a speed, over `dtau v t/mu`: length, density, shear modulus, stress
/// drop and shear wave speed are 1, and Poisson's ratio is 1/4.
fn slip_of_a_circle(speed: f64, cells: usize) -> Outcome<f64> {
    let front = cells as f64 + 0.5;
    let end = front / speed;
    // Pressure waves, of speed sqrt(3), return from the sides after the end.
    let count = (0.5 * 3_f64.sqrt() * end).ceil() as usize + 1;
    let space = P1::<3>::grid([count as f64; 3], [count; 3])?;
    let fault = space.trace(|x| x[1] == 0.0)?;
    let law = LinearWeakening {
        static_friction: 50.0,
        dynamic_friction: 0.0,
    };
    let forced = TimeWeakening { duration: 0.1 };
    let contact = Contact::new(&fault, law, 1.0)
        .with_state(forced, fault.map(|x| forced.before(x.norm() / speed)))
        .with_free_normal()
        .with_shear_stress(Vector3::new(1.0, 0.0, 0.0));
    let rock = Elastic::of_waves(1.0, 3_f64.sqrt(), 1.0)?;
    // The traction across the fault stays as it is, and its load balances the normal stress.
    let push = stickslip::fem::traction(&space, &fault, |_| Vector3::new(0.0, -1.0, 0.0))?;
    // A quarter of one of two halves, which moves as the other ones do, turned and mirrored.
    let scene = Scene::new(element_stiffness(&space, &rock)?)
        .with_mass(lumped_mass::<3, 3>(&space, 1.0)?)
        .with_load(push)
        .fix(
            &space.trace(|x| x[0] == 0.0)?,
            Components::Y | Components::Z,
        )
        .fix(&space.trace(|x| x[2] == 0.0)?, Components::Z)
        .with_contact(contact);
    let mut crack = Simulation::new(scene, CentralDifferences, Diagonal::new())?;
    let dt = end / (end / 0.3).ceil();
    crack.run(&Steps::constant(dt).until(end), |_| ())?;
    let at = crack.snapshot();
    let contact = at.contact(0);
    let middle = (0..contact.len()).find(|&k| contact.point(k) == [0.0; 3]);
    Ok(2.0 * contact.slip(middle.ok_or("no middle")?) / front)
}

/// `A` of the slip `A dtau/mu sqrt(v^2 t^2 - r^2)` of a circle at `v = w c`. Its transform `4 pi v^3/(p^2 + k^2 v^2)^2` times
/// those of the tractions of plane waves of slip, half in the direction of slip and half across, is a uniform stress
///
/// ```text
/// 1 = (A w^3/2) integral from 0 of [K_II(q) + K_III(q)]/(q^2 + w^2)^2 dq,    q = p/(k c),
/// K_III = s,    K_II = ((1 + s^2)^2 - 4 s d)/(q^2 s),    s = sqrt(1 + q^2),    d = sqrt(1 + q^2/3)
/// ```
fn exact_circle(w: f64) -> f64 {
    let kernel = |q: f64| {
        let e = q * q;
        let (s, d) = ((1.0 + e).sqrt(), (1.0 + e / 3.0).sqrt());
        // The difference by that of squares: nothing cancels.
        let squares = 32.0 / 3.0 + 56.0 / 3.0 * e + 8.0 * e * e + e.powi(3);
        squares / (s * ((2.0 + e).powi(2) + 4.0 * s * d)) + s
    };
    // q = w tan x, by the midpoint rule.
    let parts = 20_000;
    let width = std::f64::consts::FRAC_PI_2 / f64::from(parts);
    let integral: f64 = (0..parts)
        .map(|n| {
            let x = (f64::from(n) + 0.5) * width;
            kernel(w * x.tan()) * x.cos().powi(2) * width
        })
        .sum();
    2.0 / integral
}

#[test]
fn a_circular_crack_slips_as_an_ellipsoid() -> Outcome {
    // At rest it is 24/(7 pi).
    assert!((exact_circle(1e-6) / (24.0 / (7.0 * std::f64::consts::PI)) - 1.0).abs() < 1e-6);
    for speed in [0.5, 0.75] {
        let error = slip_of_a_circle(speed, 20)? / exact_circle(speed) - 1.0;
        assert!(error.abs() < 0.03, "{speed}: {error}");
    }
    Ok(())
}
