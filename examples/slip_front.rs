//! A slip front in three dimensions: nucleation in a velocity-weakening patch, arrest at velocity-strengthening rims.
//!
//! A body of 5 m x 1 m x 1 m is moved at its top, 20 degrees off its long side. `a - b` is negative in the middle of its
//! base and positive at the rim. Slip has two components: friction acts against the slip rate.

use std::error::Error;
use std::path::Path;

use stickslip::fem::{P1, body_force, elasticity, mass};
use stickslip::friction::DieterichRuina;
use stickslip::nalgebra::Vector3;
use stickslip::problems::pipping_slider::{
    AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider, load_velocity,
};
use stickslip::state::LogTheta;
use stickslip::{
    Cholesky, Components, Condensed, Contact, GeneralizedAlpha, Scene, Simulation, Steps,
};
use stickslip_cli::output::Output;
use stickslip_cli::plot::{self, COLORS, Panel, Points};

/// `a` grows from 0.010 to 0.020 towards the edge, over 0.7 m at the ends and 0.2 m at the sides.
fn law(x: f64, y: f64) -> DieterichRuina {
    let from_end = x.min(5.0 - x) / 0.7;
    let from_side = y.min(1.0 - y) / 0.2;
    let rim = 1.0 - from_end.min(from_side).min(1.0);
    DieterichRuina {
        a: 0.010 + 0.010 * rim,
        ..FRICTION
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let space = P1::<3>::grid([5.0, 1.0, 1.0], [5, 1, 1])?.refined(2)?;
    let base = space.trace(|x| x[2] == 0.0)?;
    let top = space.trace(|x| x[2] == 1.0)?;
    let PippingSlider {
        density,
        gravity,
        elastic,
        ..
    } = PippingSlider::default();
    let weight = Vector3::new(0.0, 0.0, -density * gravity);
    let contact = Contact::per_vertex(&base, base.map(|x| law(x[0], x[1])), NORMAL_STRESS)
        .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
    let (sin, cos) = 20f64.to_radians().sin_cos();
    let scene = Scene::new(elasticity(&space, &elastic)?)
        .with_mass(mass(&space, density)?)
        .with_load(body_force(&space, |_| weight))
        .with_contact(contact)
        .prescribe_velocity(&top, Components::ALL, move |time| {
            [cos, sin, 0.0].map(|part| part * load_velocity(time))
        })
        .in_equilibrium(Cholesky::new());
    let mut slider = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;

    // Along the middle of the base: from its centre to its end.
    let near = |x: f64| {
        let distance = |k: &usize| (base.points()[*k] - Vector3::new(x, 0.5, 0.0)).norm();
        (0..base.points().len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))
    };
    let places = [2.5, 3.5, 4.5, 5.0];
    let nodes: Option<Vec<usize>> = places.into_iter().map(near).collect();
    let nodes = nodes.ok_or("the base has no vertices")?;
    let mut rates = vec![Points::new(); places.len()];
    let mut turned = 0.0_f64;
    slider.run(&Steps::constant(3e-3).until(11.5), |at| {
        let contact = at.contact(0);
        for (history, &k) in rates.iter_mut().zip(&nodes) {
            history.push((at.time, contact.slip_rate(k)));
        }
        if contact.slip_rate(nodes[0]) > 1e-3 {
            let v = at.velocity[contact.vertex(nodes[0])];
            turned = v[1].atan2(v[0]).to_degrees();
        }
    })?;
    let largest = |history: &Points| history.iter().map(|&(_, rate)| rate).fold(0.0, f64::max);
    let (centre, rim) = (largest(&rates[0]), largest(&rates[3]));
    println!(
        "largest slip rate: {centre:.2e} m/s in the centre, {rim:.2e} m/s at the rim; slip {turned:.1} degrees off"
    );
    assert!(centre > 1e-3 && rim < 0.5 * centre);
    assert!((turned - 20.0).abs() < 10.0);

    let mut panel = Panel::new("time [s]", "slip rate [m/s]").logarithmic();
    let labels = ["x = 2.5 m", "3.5 m", "4.5 m", "5 m"];
    for ((history, label), color) in rates.into_iter().zip(labels).zip(COLORS) {
        let late = history
            .into_iter()
            .filter(|(time, _)| *time > 8.0)
            .collect();
        panel = panel.with(label, color, 2, late);
    }
    let output = Output::create(Path::new("out/slip_front"), &[])?;
    plot::draw(&output.path("slip_front.png"), &[panel])?;
    println!("slip_front.png in {}", output.folder().display());
    Ok(())
}
