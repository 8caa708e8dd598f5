//! Explicit steps by elements of a block in space with two contacts, in one, two and four processes, and by the serial
//! library.

use std::error::Error;

use stickslip::fem::{
    Assembled, Elastic, ElementStiffness, FemError, Impedance, Mesh, P1, dashpot,
    element_stiffness, lumped_mass,
};
use stickslip::nalgebra::Vector3;
use stickslip::problems::pipping_slider::{AGING, FRICTION};
use stickslip::solvers::IntoOperator;
use stickslip::state::LogTheta;
use stickslip::{
    BoundaryPart, CentralDifferences, Contact, Diagonal, NonsmoothSolver, NormalStress, Scene,
    Simulation, Staggered, StateUpdate, Steps,
};
use stickslip_petsc::{DistributedDiagonal, DistributedSpace, run};

use super::{alone, in_processes};

const DENSITY: f64 = 1.0;
/// Waves travel at 1 m/s and 3^(1/2) m/s.
const ROCK: Elastic = Elastic {
    young_modulus: 2.5,
    poisson_ratio: 0.25,
};
const PRESSURE: f64 = 0.5;
/// The time of Kelvin-Voigt viscosity \[s\].
const RELAXATION: f64 = 0.01;
const STEP: f64 = 0.02;
const STEPS: usize = 300;
const REFINEMENTS: usize = 1;
/// More than rounding, and less than any of the differences that a wrong exchange leaves.
const TOLERANCE: f64 = 1e-10;

/// 4 m x 2 m x 2 m, with a fault at half of its height.
fn block() -> Result<Mesh<3>, FemError> {
    let mesh = Mesh::<3>::grid([4.0, 2.0, 2.0], [4, 2, 2])?;
    mesh.with_surface_where("fault", |x| x[2] == 1.0)?
        .split("fault")
}

/// Lysmer's dashpots at the top and at one end.
fn dashpots(space: &P1<3>) -> Result<Assembled<3>, FemError> {
    let impedance = Impedance::of(&ROCK, DENSITY)?;
    let none = Impedance {
        normal: 0.0,
        tangential: 0.0,
    };
    dashpot(space, &space.trace(|_| true)?, |x| {
        if x[2] == 2.0 || x[0] == 4.0 {
            impedance
        } else {
            none
        }
    })
}

/// The block is sheared, more at one end than at the other.
fn velocity(x: &Vector3<f64>) -> Vector3<f64> {
    Vector3::new(x[2] * (0.1 + 0.1 * x[0]), 0.05 * x[2] * x[1], 0.0)
}

/// Friction on the base and on the fault, whose normal stress is that of the deformation.
fn sheared<S, M>(
    [stiffness, viscosity]: [S; 2],
    [mass, damping]: [M; 2],
    [base, plus, minus]: [BoundaryPart; 3],
    velocity: Vec<Vector3<f64>>,
    solver: impl NonsmoothSolver<S::Operator, 3> + 'static,
) -> Result<Simulation<3>, Box<dyn Error>>
where
    S: IntoOperator<3>,
    M: IntoOperator<3, Operator: Into<S::Operator>>,
{
    let base = Contact::new(&base, FRICTION, PRESSURE).with_state(AGING, LogTheta(0.0));
    let stress = NormalStress::from_body(PRESSURE);
    let fault = Contact::between(&plus, &minus, FRICTION, stress);
    let scene = Scene::new(stiffness)
        .with_mass(mass)
        .with_viscosity(damping)
        .with_viscosity(viscosity)
        .with_contact(base)
        .with_contact(fault.with_state(AGING, LogTheta(0.0)))
        .with_velocity(velocity);
    Ok(Simulation::new(scene, CentralDifferences, solver)?
        .with_coupling(Staggered::default())
        .with_state_update(StateUpdate::Midpoint))
}

/// After all steps: place, displacement and velocity of each vertex, and place, slip and state of those of contacts.
fn rows(mut body: Simulation<3>, points: &[Vector3<f64>]) -> Result<Vec<Vec<f64>>, Box<dyn Error>> {
    body.run(&Steps::constant(STEP).count(STEPS), |_| ())?;
    let at = body.snapshot();
    let mut rows = Vec::new();
    for (i, x) in points.iter().enumerate() {
        let all = [x, &at.displacement[i], &at.velocity[i]];
        rows.push(
            [-1.0]
                .iter()
                .chain(all.into_iter().flatten())
                .copied()
                .collect(),
        );
    }
    for (number, contact) in at.contacts().enumerate() {
        for k in 0..contact.len() {
            let (slip, state) = (contact.slip_vector(k), contact.state(k));
            let (x, last) = (contact.point(k), [state, contact.normal_stress(k)]);
            let all = [number as f64].into_iter().chain(x);
            rows.push(all.chain(slip.iter().copied()).chain(last).collect());
        }
    }
    Ok(rows)
}

/// In the order of places; the two sides of the fault, which have slipped, in that of displacements.
fn sorted(mut rows: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    rows.sort_by(|a, b| a.partial_cmp(b).expect("numbers"));
    rows
}

fn serial() -> Result<Vec<Vec<f64>>, Box<dyn Error>> {
    let space = P1::new(block()?).refined(REFINEMENTS)?;
    let stiffness: ElementStiffness<3> = element_stiffness(&space, &ROCK)?;
    let viscosity = &stiffness * RELAXATION;
    let parts = [
        (&space.trace(|x| x[2] == 0.0)?).into(),
        (&space.part("fault+")?).into(),
        (&space.part("fault-")?).into(),
    ];
    let matrices = [lumped_mass(&space, DENSITY)?, dashpots(&space)?];
    let start = space.interpolate(velocity);
    let body = sheared(
        [stiffness, viscosity],
        matrices,
        parts,
        start,
        Diagonal::new(),
    )?;
    rows(body, space.mesh().vertices())
}

/// The part of this test program that runs in each of several processes.
#[test]
#[ignore = "started by `explicit_steps_are_those_of_the_serial_library`"]
fn steps_in_this_process() {
    run(|world| -> Result<(), Box<dyn Error>> {
        let space = DistributedSpace::new(world, block()?, REFINEMENTS)?;
        println!("\nowns {} of {}", space.vertex_count(), world.size());
        let local = space.local();
        let stiffness = element_stiffness(local, &ROCK)?;
        let terms = [
            space.elements(&stiffness)?,
            space.elements(&(&stiffness * RELAXATION))?,
        ];
        let matrices = [
            space.matrix(&lumped_mass(local, DENSITY)?)?,
            space.matrix(&dashpots(local)?)?,
        ];
        let parts = [
            space.part(|x| x[2] == 0.0)?,
            space.named_part("fault+")?,
            space.named_part("fault-")?,
        ];
        let start = space.field(&local.interpolate(velocity));
        let body = sheared(terms, matrices, parts, start, DistributedDiagonal::new())?;
        // Behind the name of the test.
        println!();
        for row in world.collect(&rows(body, &space.points())?)?.concat() {
            let numbers: Vec<String> = row.iter().map(f64::to_string).collect();
            println!("row {}", numbers.join(" "));
        }
        Ok(())
    });
}

fn distributed(processes: usize) -> Vec<Vec<f64>> {
    let _alone = alone();
    let program = std::env::current_exe().expect("the test has a path");
    let arguments = [
        "--ignored",
        "--nocapture",
        "--exact",
        "explicit::steps_in_this_process",
    ];
    let ended = in_processes(120, &program, processes, &arguments).output();
    let ended = ended.expect("mpirun starts");
    assert!(ended.status.success(), "{ended:?}");
    let said = String::from_utf8_lossy(&ended.stdout).into_owned();
    // Each has its share, which is not all.
    let shares = said.lines().filter_map(|line| line.strip_prefix("owns "));
    let shares: Vec<usize> = shares
        .filter_map(|line| line.strip_suffix(&format!(" of {processes}")))
        .map(|share| share.parse().expect("a number"))
        .collect();
    assert_eq!(shares.len(), processes, "{said}");
    assert!(shares.iter().all(|&share| share > 0));
    let rows = said.lines().filter_map(|line| line.strip_prefix("row "));
    let numbers = |line: &str| {
        let cells = line.split(' ');
        cells.map(|cell| cell.parse().expect("a number")).collect()
    };
    rows.map(numbers).collect()
}

/// The largest difference of some columns, as a share of the largest entry there.
fn difference(a: &[Vec<f64>], b: &[Vec<f64>], columns: std::ops::Range<usize>) -> f64 {
    let (mut apart, mut scale) = (0.0_f64, 0.0_f64);
    for (a, b) in a.iter().zip(b) {
        for c in columns.clone() {
            apart = apart.max((a[c] - b[c]).abs());
            scale = scale.max(b[c].abs());
        }
    }
    apart / scale
}

#[test]
fn explicit_steps_are_those_of_the_serial_library() {
    let whole = sorted(serial().expect("a run"));
    let is_of_body = |row: &Vec<f64>| row[0] < 0.0;
    let count = whole.iter().filter(|row| is_of_body(row)).count();
    // Each contact slips, here more and there less.
    for contact in [0.0, 1.0] {
        let own = whole.iter().filter(|row| row[0] == contact);
        let slips: Vec<f64> = own.map(|row| row[4].abs()).collect();
        let largest = slips.iter().copied().fold(0.0, f64::max);
        assert!(largest > 0.02, "{contact}: {largest}");
        assert!(slips.iter().any(|&slip| slip < 0.5 * largest), "{contact}");
    }
    for processes in [1, 2, 4] {
        let parts = sorted(distributed(processes));
        assert_eq!(parts.len(), whole.len());
        let places = parts.iter().zip(&whole).all(|(a, b)| a[..4] == b[..4]);
        assert!(places, "{processes}");
        let (body, contacts) = (
            (&parts[..count], &whole[..count]),
            (&parts[count..], &whole[count..]),
        );
        let differences = [
            difference(body.0, body.1, 4..7),
            difference(body.0, body.1, 7..10),
            difference(contacts.0, contacts.1, 4..7),
            difference(contacts.0, contacts.1, 7..8),
            difference(contacts.0, contacts.1, 8..9),
        ];
        println!("{processes}: {differences:?}");
        assert!(
            differences.iter().all(|&apart| apart <= TOLERANCE),
            "{processes}: {differences:?}"
        );
    }
}
