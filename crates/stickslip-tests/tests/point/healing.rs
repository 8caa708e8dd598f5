//! Strength that returns at rest, on a spring that is stiffer than friction weakens.

use nalgebra::SMatrix;
use stickslip::friction::LinearWeakening;
use stickslip::state::{SlipWeakening, Weakening};
use stickslip::{BoundaryPart, Contact, GeneralizedAlpha, Point, Scene, Simulation, Steps};

use crate::Outcome;

/// Behind an event the block sticks for ever longer the slower it is pulled: it goes where the pull meets the strength
/// `mu_s - (mu_s - mu_d) exp(-t/t_h)`, and slides steadily at `mu_s - (mu_s - mu_d) V t_h/D_c`.
#[test]
fn a_block_regains_its_strength_at_rest() -> Outcome {
    let (normal, static_friction, drop) = (1e6, 0.6, 0.4);
    let law = LinearWeakening {
        static_friction,
        dynamic_friction: static_friction - drop,
    };
    for healing_time in [0.5, 2.0, 8.0] {
        for steps in [40.0, 320.0] {
            let (distance, stiffness) = (0.1, 8e6);
            let velocity = 0.05 * distance / healing_time;
            let healing = SlipWeakening {
                slip_distance: distance,
            }
            .healing(healing_time);
            // From the dynamic strength on.
            let pull = move |time: f64| normal * 0.2 + stiffness * velocity * time;
            let contact = Contact::new(BoundaryPart::point(1.0), law, normal)
                .with_state(healing, Weakening(1.0));
            let scene = Scene::new(SMatrix::<f64, 1, 1>::new(stiffness))
                .with_contact(contact)
                .with_load_history(move |time, load| load[0][0] = pull(time));
            let mut block = Simulation::new(scene, GeneralizedAlpha::default(), Point)?;
            let dt = healing_time / steps;
            let strength =
                |time: f64| normal * (static_friction - drop * (-time / healing_time).exp());
            let (mut slipping, mut first) = (false, 0.0);
            block.run(&Steps::constant(dt).until(40.0 * healing_time), |at| {
                let own = at.contact(0);
                if !slipping && own.slip(0) > 0.0 {
                    (slipping, first) = (true, at.time);
                }
                if !slipping {
                    let mu = strength(at.time) / normal;
                    assert!((own.coefficient(0) - mu).abs() < 1e-12);
                }
            })?;
            // Between two steps the pull meets the strength.
            let excess = |time: f64| pull(time) - strength(time);
            assert!(slipping && excess(first) > 0.0 && excess(first - 1.01 * dt) <= 0.0);
            let own = block.snapshot();
            let own = own.contact(0);
            let steady = static_friction - drop * 0.05;
            assert!((own.coefficient(0) - steady).abs() < 1e-6);
            assert!((own.slip_rate(0) / velocity - 1.0).abs() < 1e-6);
        }
    }
    Ok(())
}
