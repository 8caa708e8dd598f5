//! A layer between two surfaces through slip, in one to four processes and in none but this one.

use stickslip::fem::{Assembled, P1, antiplane, elasticity, mass};
use stickslip::friction::Tresca;
use stickslip::problems::pipping_slider::{AGING, FRICTION, INITIAL_LOG_THETA, PippingSlider};
use stickslip::state::LogTheta;
use stickslip::{Condensed, Contact, Newmark, Scene, Simulation, Steps};

use super::{agree, cycles, history_and_output};

const STEPS: usize = 400;
/// The slip rate \[m/s\] above which the seam slides at its middle.
const SLIDES: f64 = 1e-4;

/// The example `two_contacts` by the serial library: time, displacements, velocities, state, largest slip rate.
fn serial<const C: usize>(space: &P1<2>, stiffness: Assembled<C>) -> Vec<Vec<f64>> {
    let trace =
        |on: fn(&stickslip::nalgebra::Vector2<f64>) -> bool| space.trace(on).expect("a part");
    let seam = Contact::new(&trace(|x| x[1] == 0.0), FRICTION, 5e3);
    let guide = Contact::new(&trace(|x| x[1] == 1.0), Tresca { coefficient: 0.1 }, 5e3);
    let scene = Scene::new(stiffness)
        .with_mass(mass(space, PippingSlider::default().density).expect("a mass"))
        .with_contact(seam.with_state(AGING, LogTheta(INITIAL_LOG_THETA)))
        .with_contact(guide)
        .prescribe_velocity(&trace(|x| x[0] == 4.0), [true; C], |time: f64| {
            std::array::from_fn(|c| if c == 0 { 2e-2 * time.min(0.1) } else { 0.0 })
        });
    let mut layer = Simulation::new(scene, Newmark::default(), Condensed::new())
        .and_then(|layer| layer.with_absolute_tolerance(1e-12))
        .expect("a simulation");
    let vertex = space.vertex_at([2.0, 0.0]).expect("a middle");
    let mut rows = Vec::new();
    let ended = layer.run(&Steps::constant(2e-3).count(STEPS), |at| {
        let contact = at.contact(0);
        let place = contact.position_of(vertex).expect("a frictional vertex");
        let mut row = vec![at.time];
        row.extend(at.displacement[vertex].iter());
        row.extend(at.velocity[vertex].iter());
        row.extend([contact.state(place), at.max_slip_rate()]);
        rows.push(row);
    });
    ended.expect("steps that can be taken");
    rows
}

fn check(serial: &[Vec<f64>], arguments: &[&str]) {
    let components = (serial[0].len() - 3) / 2;
    let last = &serial[STEPS - 1];
    assert!(last[1 + components] > SLIDES, "nothing slides: {last:?}");
    let steps = STEPS.to_string();
    let arguments = [arguments, &["--steps", &steps]].concat();
    let mut alone = 0.0;
    for processes in 1..=4 {
        let (rows, said) = history_and_output("two_contacts", processes, &arguments);
        let columns: Vec<usize> = (0..rows[0].len()).collect();
        agree(serial, &rows, &columns, 1e-8);
        let cycles = cycles(&said) as f64;
        if processes == 1 {
            alone = cycles;
        }
        // A cycle sees less of the vertices of other processes.
        let share = cycles / alone;
        assert!(
            (share - 1.0).abs() <= 0.2,
            "{processes}: {share} times the cycles"
        );
    }
}

fn space() -> P1<2> {
    let coarse = P1::grid([4.0, 1.0], [4, 1]).expect("a grid");
    coarse.refined(3).expect("a mesh")
}

#[test]
fn two_surfaces_slide_alike_in_any_number_of_processes() {
    let space = space();
    let stiffness = elasticity(&space, &PippingSlider::default().elastic).expect("a stiffness");
    check(&serial(&space, stiffness), &[]);
}

#[test]
fn antiplane_shear_is_the_same_in_any_number_of_processes() {
    let space = space();
    let (_, shear_modulus) = PippingSlider::default().elastic.lame().expect("a material");
    let stiffness = antiplane(&space, shear_modulus).expect("a stiffness");
    check(&serial(&space, stiffness), &["--antiplane"]);
}
