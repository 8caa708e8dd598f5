//! Explicit steps of a plane that is large enough for several threads.

use std::error::Error;
use std::thread;

use nalgebra::Vector2;
use rayon::ThreadPoolBuilder;
use rayon::prelude::*;
use stickslip::bie::{Cells, Medium, PlaneFault, Rectangles};
use stickslip::friction::RegularizedDieterichRuina;
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{Contact, RungeKutta, Scene, Steps};

type Outcome<T = ()> = Result<T, Box<dyn Error>>;

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

/// Steps of several planes at once share the threads of a pool: each ends, with the same bits. They are called from
/// threads of the pool, and from others, of which there are more than in the pool.
#[test]
fn several_planes_share_a_pool() -> Outcome {
    let alone = after_steps()?;
    let pool = ThreadPoolBuilder::new().num_threads(3).build()?;
    let same = || after_steps().is_ok_and(|fields| fields == alone);
    let all = thread::scope(|scope| {
        let called = (0..4).map(|n| {
            let (pool, same) = (&pool, &same);
            // In the pool of three threads, and from outside in the one that all share.
            scope.spawn(move || {
                if n % 2 == 0 {
                    pool.install(same)
                } else {
                    same()
                }
            })
        });
        let called: Vec<_> = called.collect();
        let inside = pool.install(|| (0..4).into_par_iter().all(|_| same()));
        inside
            && called
                .into_iter()
                .all(|thread| thread.join().unwrap_or(false))
    });
    assert!(all);
    Ok(())
}
