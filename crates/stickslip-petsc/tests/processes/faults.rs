//! Faults inside the body, in one to four processes and in none but this one: with normal stress from the deformation,
//! faults that end inside and such that cross.

use stickslip::fem::{Elastic, GridDiagonal, Mesh, P1, body_force, elasticity, mass};
use stickslip::friction::Tresca;
use stickslip::nalgebra::Vector2;
use stickslip::problems::pipping_slider::{
    AGING, END, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider, load_velocity,
};
use stickslip::state::LogTheta;
use stickslip::{
    BackwardEuler, Cholesky, Components, Condensed, Contact, GeneralizedAlpha, NormalStress, Scene,
    Simulation, Steps,
};

use super::{agree, cycles, history_and_output};

/// Time, displacement, velocity, normal stress, state if there is one, largest slip rate, at a vertex of the plus side.
fn history<const D: usize>(
    mut body: Simulation<D>,
    steps: &Steps,
    vertex: usize,
    with_state: bool,
) -> Vec<Vec<f64>> {
    let mut rows = Vec::new();
    let ended = body.run(steps, |at| {
        let contact = at.contact(0);
        let place = contact.position_of(vertex).expect("a frictional vertex");
        let mut row = vec![at.time];
        row.extend(at.displacement[vertex].iter());
        row.extend(at.velocity[vertex].iter());
        row.push(contact.normal_stress(place));
        row.extend(with_state.then(|| contact.state(place)));
        row.push(at.max_slip_rate());
        rows.push(row);
    });
    ended.expect("steps that can be taken");
    rows
}

/// The vertex of the plus side in the middle of the fault.
fn middle(space: &P1<2>) -> usize {
    let plus = space.part("fault+").expect("a side");
    let place = plus.points().iter().position(|x| x[0] == 2.5);
    plus.vertices()[place.expect("a middle")]
}

/// The example `crossing_faults` by the serial library.
fn crossing_faults() -> Vec<Vec<f64>> {
    let split = Mesh::<3>::grid([4.0; 3], [4; 3]).and_then(|cube| {
        cube.with_surface_where("level", |x| x[2] == 2.0 && x[0] <= 3.0)?
            .with_surface_where("upright", |x| x[0] == 2.0 && x[1] >= 1.0)?
            .split_all(["level", "upright"])
    });
    let space = P1::new(split.expect("faults")).refined(1).expect("a mesh");
    let soft = Elastic {
        young_modulus: 1e3,
        poisson_ratio: 0.25,
    };
    let between = |name: &str| {
        let [plus, minus] = ["+", "-"].map(|side| space.part(&format!("{name}{side}")));
        let (plus, minus) = (plus.expect("a side"), minus.expect("a side"));
        let friction = Tresca { coefficient: 0.3 };
        Contact::between(&plus, &minus, friction, NormalStress::from_body(1.0))
    };
    let on = |z: f64| space.trace(move |x| x[2] == z).expect("a side");
    let scene = Scene::new(elasticity(&space, &soft).expect("a stiffness"))
        .with_contact(between("upright"))
        .with_contact(between("level"))
        .fix(&on(0.0), Components::ALL)
        .prescribe_velocity(&on(4.0), Components::ALL, |_| [0.1, 0.02, -0.3]);
    let cube = Simulation::new(scene, BackwardEuler, Condensed::new()).expect("a simulation");
    let plus = space.part("upright+").expect("a side");
    let watched = plus
        .points()
        .iter()
        .position(|x| x.as_slice() == [2.0, 3.0, 3.0]);
    let vertex = plus.vertices()[watched.expect("a vertex")];
    history(cube, &Steps::constant(0.1).count(5), vertex, false)
}

/// The example `dipping_fault` by the serial library.
fn dipping_fault() -> Vec<Vec<f64>> {
    let slope = 30_f64.to_radians().tan();
    let grid = Mesh::<2>::grid([4.0, 2.0], [8, 4], GridDiagonal::Rising).expect("a grid");
    let points = grid.vertices().iter();
    let points = points.map(|x| Vector2::new(x[0], slope * x[1])).collect();
    let cells = grid.cells().flatten().copied().collect();
    let on_fault = |x: &Vector2<f64>| x[0] >= 2.0 && x[1] == slope * (x[0] - 1.0);
    let split = Mesh::new(points, cells)
        .and_then(|mesh| mesh.with_surface_where("fault", on_fault)?.split("fault"));
    let space = P1::new(split.expect("a fault")).refined(3).expect("a mesh");
    let sand = Elastic {
        young_modulus: 5e7,
        poisson_ratio: 0.3,
    };
    let part = |name| space.part(name).expect("a side");
    let base = space.trace(|x| x[1] == 0.0).expect("a side");
    let wall = space.trace(|x| x[0] == 0.0 && x[1] > 0.0).expect("a side");
    let scene = Scene::new(elasticity(&space, &sand).expect("a stiffness"))
        .with_load(body_force(&space, |_| Vector2::new(0.0, -5e3 * 9.81)))
        .with_contact(Contact::between(
            &part("fault+"),
            &part("fault-"),
            Tresca { coefficient: 0.4 },
            NormalStress::from_body(0.0),
        ))
        .fix(&base, Components::ALL)
        .prescribe_velocity(&wall, Components::X, |_| [1e-3, 0.0])
        .in_equilibrium(Cholesky::new());
    let block = Simulation::new(scene, BackwardEuler, Condensed::new()).expect("a simulation");
    let steps = Steps::constant(0.25).count(30);
    history(block, &steps, middle(&space), false)
}

/// The example `two_sides` by the serial library.
fn two_sides() -> Vec<Vec<f64>> {
    let paper = PippingSlider::default();
    let split = Mesh::<2>::grid([5.0, 2.0], [10, 4], GridDiagonal::Rising).and_then(|mesh| {
        mesh.with_surface_where("fault", |x| x[1] == 1.0)?
            .split("fault")
    });
    let space = P1::new(split.expect("a fault")).refined(2).expect("a mesh");
    let part = |name| space.part(name).expect("a side");
    let on = |y: f64| space.trace(move |x| x[1] == y).expect("a side");
    let pressure = NormalStress::from_body(NORMAL_STRESS);
    let contact = Contact::between(&part("fault+"), &part("fault-"), FRICTION, pressure)
        .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
    let scene = Scene::new(elasticity(&space, &paper.elastic).expect("a stiffness"))
        .with_mass(mass(&space, paper.density).expect("a mass"))
        .prescribe_velocity(&on(2.0), Components::ALL, |time| {
            [10.0 * load_velocity(time), 0.0]
        })
        .fix(&on(0.0), Components::ALL)
        .with_contact(contact);
    let blocks = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new());
    let blocks = blocks.expect("a simulation");
    let steps = Steps::constant(END / 1e4).count(2400);
    history(blocks, &steps, middle(&space), true)
}

/// A history with displacement and velocity, `D` columns each behind the time, as multiples of the largest component of
/// each, and its other columns as they are.
fn scaled<const D: usize>(rows: &[Vec<f64>], by: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let largest = |first: usize| {
        let vectors = by.iter().flat_map(|row| &row[first..first + D]);
        vectors.fold(0.0, |largest: f64, x| largest.max(x.abs()))
    };
    let scales = [largest(1), largest(1 + D)];
    let scaled = |row: &Vec<f64>| {
        let mut row = row.clone();
        for c in 0..2 * D {
            // Beside 1: a component that is small is to be so.
            row[1 + c] = 1.0 + row[1 + c] / scales[c / D];
        }
        row
    };
    rows.iter().map(scaled).collect()
}

/// The example in one to four processes beside the serial history.
fn check<const D: usize>(example: &str, serial: &[Vec<f64>], refinements: &str) {
    let mut alone = 0.0;
    for processes in 1..=4 {
        let (rows, said) = history_and_output(example, processes, &["--refinements", refinements]);
        let columns: Vec<usize> = (0..rows[0].len()).collect();
        let rows = scaled::<D>(&rows, serial);
        agree(&scaled::<D>(serial, serial), &rows, &columns, 1e-8);
        let cycles = cycles(&said) as f64;
        if processes == 1 {
            alone = cycles;
        }
        let share = cycles / alone;
        // A cycle sees less of the vertices of other processes.
        assert!(
            (share - 1.0).abs() <= 0.2,
            "{processes}: {share} times the cycles"
        );
    }
}

#[test]
fn a_thrust_under_its_weight_slides_alike_in_any_number_of_processes() {
    let serial = dipping_fault();
    let last = &serial[serial.len() - 1];
    assert!(last[6] > 1e-4, "nothing slides: {last:?}");
    check::<2>("dipping_fault", &serial, "3");
}

#[test]
fn two_blocks_have_their_event_alike_in_any_number_of_processes() {
    let serial = two_sides();
    let peak = serial.iter().map(|row| row[7]).fold(0.0, f64::max);
    assert!(peak > 1e-3, "no event: {peak:e}");
    check::<2>("two_sides", &serial, "2");
}

/// Where three processes meet, sweeps that see nothing of each other diverge but for larger diagonals.
#[test]
fn faults_that_cross_in_space_slide_alike_in_any_number_of_processes() {
    let serial = crossing_faults();
    let last = &serial[serial.len() - 1];
    assert!(last[8] > 1e-3, "nothing slides: {last:?}");
    check::<3>("crossing_faults", &serial, "1");
}
