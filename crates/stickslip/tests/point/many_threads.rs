//! Explicit steps of a plane that is large enough for several threads.

use nalgebra::Vector2;
use rayon::ThreadPoolBuilder;
use stickslip::bie::{Cells, Medium, PlaneFault, Rectangles};
use stickslip::friction::RegularizedDieterichRuina;
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{Contact, RungeKutta, Scene, Steps};

use crate::Outcome;

/// Slip and slip rates of 80 x 32 cells after some steps.
fn after_steps() -> Outcome<Vec<[Vector2<f64>; 2]>> {
    let medium = Medium {
        shear_modulus: 32.04e9,
        shear_wave_speed: 3464.0,
    };
    let law = RegularizedDieterichRuina {
        a: 0.010,
        b: 0.015,
        reference_friction: 0.6,
        reference_velocity: 1e-6,
        slip_distance: 8e-3,
    };
    let aging = Dieterich {
        slip_distance: 8e-3,
    };
    let cells = Rectangles::new(Cells::new([-20e3, 20e3], 80)?, Cells::new([0.0, 16e3], 32)?);
    let fault = PlaneFault::half_space(cells, 90.0, medium, 0.25)?;
    let shear = cells.map(|[x, y]| {
        let bump = (-(x * x + (y - 8e3).powi(2)) / 16e6).exp();
        Vector2::new(14e6 + 2e6 * bump, 1e6 * bump)
    });
    let contact = Contact::new(&fault, law, 25e6)
        .with_state(aging, LogTheta(10.0))
        .with_shear_stress(shear);
    let scene = Scene::new(fault.stiffness())
        .with_viscosity(fault.radiation_damping())
        .with_contact(contact);
    let mut cycle = RungeKutta::new(scene)?;
    cycle.run(&Steps::adaptive(1e-4).until(1e3), |_| ())?;
    let at = cycle.snapshot();
    let fields = at.displacement.iter().zip(at.velocity);
    Ok(fields.map(|(slip, rate)| [*slip, *rate]).collect())
}

/// From outside of the threads, alone, and within two pools.
#[test]
fn steps_have_the_same_bits_in_any_number_of_threads() -> Outcome {
    let outside = after_steps()?;
    assert!(outside.iter().all(|[slip, _]| slip[0] > 0.0));
    for threads in [1, 2, 3] {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build()?;
        let inside = pool.install(|| after_steps().map_err(|error| error.to_string()))?;
        assert!(inside == outside, "{threads}");
    }
    Ok(())
}
