//! The run of a rupture in space.

use stickslip::fem::{Elastic, Impedance, P1, dashpot, element_stiffness, lumped_mass, traction};
use stickslip::nalgebra::Vector3;
use stickslip::record::RuptureTimes;
use stickslip::{
    CentralDifferences, Components, Diagonal, ElementOperator, Scene, Simulation, Steps,
};

use super::report::{Outcome, report};
use super::{Arguments, Benchmark};
use crate::cli::Problem;
use crate::probes::Probes;
use crate::progress::Progress;
use crate::rupture::grow;

/// The slip rate of a half at which a vertex ruptures [m/s].
const RUPTURED: f64 = 0.5e-3;

/// The edges of cells in the length over which friction weakens that resolve it (S. Day et al., J. Geophys. Res. 110 (2005)).
const RESOLVED: f64 = 3.0;

/// A dynamic rupture in space.
///
/// # Errors
/// In one line: a wrong setting, a failed step, a file that cannot be written.
pub fn run(arguments: &Arguments) -> Result<(), Problem> {
    let problem = arguments.problem;
    let length = problem.weakening_length();
    if arguments.cell > length / RESOLVED {
        note!(
            "warning: edges of {} m do not resolve the {length:.0} m over which friction weakens at the front: take --cell {:.0} or less",
            arguments.cell,
            length / RESOLVED
        );
    }
    let space = body(arguments)?;
    let begin = begin(arguments);
    let place = move |x: &Vector3<f64>| [x[0] + begin, x[2]];
    let fault = space.trace(|x| x[1] == 0.0)?;
    let mut rupture = Simulation::new(
        scene(arguments, &space)?,
        CentralDifferences,
        Diagonal::new(),
    )?;
    // A step that is too large tells the limit, and leaves everything as it is.
    let _ = rupture.step(f64::MAX);
    let limit = rupture
        .step_limit()
        .ok_or("central differences have no step limit")?;
    let dt = arguments.until / (arguments.until / (0.9 * limit)).ceil();
    let distance = move |station: &[f64; 2], point: [f64; 3]| {
        (point[0] + begin - station[0]).hypot(point[2] - station[1])
    };
    let mut stations = Probes::new(
        &rupture.snapshot(),
        problem.stations(),
        distance,
        |at, k| {
            let contact = at.contact(0);
            let (slip, rate) = (contact.slip_vector(k) * 2.0, contact.slip_velocity(k) * 2.0);
            let stress = contact.traction(k);
            [
                at.time, slip[0], rate[0], stress[0], slip[2], rate[2], stress[2],
            ]
        },
    );
    // The first row is the initial stress.
    for station in &mut stations.each {
        let at = place(&space.mesh().vertices()[station.vertex]);
        station.rows[0] = [
            0.0,
            0.0,
            2.0 * problem.initial_rate(),
            problem.shear(at, spacing(arguments)),
            0.0,
            0.0,
            0.0,
        ];
    }
    let mut front = RuptureTimes::new(&rupture.snapshot(), 0, [RUPTURED, 1e-9 * RUPTURED])?;
    let modulus = 2670.0 * 3464.0_f64.powi(2);
    let whole = if problem.is_even() { 2.0 } else { 1.0 }
        * if problem == Benchmark::Tpv101 {
            2.0
        } else {
            1.0
        };
    let mut moment = Vec::new();
    let plan = Steps::constant(dt).until(arguments.until);
    let mut progress = (Progress::default(), arguments.until);
    stations.run(&mut rupture, &plan, (&mut progress.0, progress.1), |at| {
        front.record(&at);
        let contact = at.contact(0);
        let sum = |of: &dyn Fn(usize) -> f64| {
            let vertices = 0..contact.len();
            vertices.map(|k| contact.weight(k) * of(k)).sum::<f64>() * 2.0 * whole * modulus
        };
        moment.push([
            at.time,
            sum(&|k| contact.slip(k)),
            sum(&|k| contact.slip_rate(k)),
        ]);
    })?;
    let outcome = Outcome {
        stations,
        front,
        moment,
        vertices: space.vertex_count(),
        on_fault: fault.vertices().len(),
        dt,
    };
    report(arguments, &outcome)
}

/// The distance along strike at which the body begins \[m\].
fn begin(arguments: &Arguments) -> f64 {
    let [along, _] = arguments.problem.extent();
    if arguments.problem.is_even() {
        0.0
    } else {
        -along - arguments.margin
    }
}

/// The mean distance of vertices at the fault \[m\]: two legs of a cell have its longest edge.
fn spacing(arguments: &Arguments) -> f64 {
    arguments.cell * std::f64::consts::FRAC_1_SQRT_2
}

/// The lengths of the body along strike, across the fault and downward \[m\].
fn lengths(arguments: &Arguments) -> [f64; 3] {
    let ([along, depth], margin) = (arguments.problem.extent(), arguments.margin);
    [along + margin - begin(arguments), margin, depth + margin]
}

/// The rock beside the fault, with fine cells at what slips.
fn body(arguments: &Arguments) -> Result<P1<3>, Problem> {
    let ([along, depth], begin) = (arguments.problem.extent(), begin(arguments));
    let lengths = lengths(arguments);
    // Cubes whose halves become cells.
    let counts = lengths.map(|length| (length / 6e3).ceil().max(1.0) as usize);
    let size = |x: &Vector3<f64>| {
        let beyond = [(x[0] + begin).abs() - along, x[1], x[2] - depth];
        let distance = beyond.map(|distance| distance.max(0.0));
        arguments.cell + arguments.growth * Vector3::from(distance).norm()
    };
    Ok(P1::grid(lengths, counts)?.graded(size)?)
}

fn scene(arguments: &Arguments, space: &P1<3>) -> Result<Scene<ElementOperator<3>, 3>, Problem> {
    let (problem, begin) = (arguments.problem, begin(arguments));
    let place = move |x: &Vector3<f64>| [x[0] + begin, x[2]];
    let [length, height, bottom] = lengths(arguments);
    // c_s = 3464 m/s and c_p = 6000 m/s.
    let (density, elastic) = (2670.0, Elastic::of_waves(2670.0, 6000.0, 3464.0)?);
    let impedance = Impedance::of(&elastic, density)?;
    let fault = space.trace(|x| x[1] == 0.0)?;
    let normal = Vector3::new(0.0, -problem.normal(), 0.0);
    // The normal stress is there from the start and compresses nothing.
    let balance = traction(space, &fault, |_| normal)?;
    let pull = traction(space, &fault, |x| {
        Vector3::new(problem.nucleation(place(x)), 0.0, 0.0)
    })?;
    let even = problem.is_even();
    let absorbs = move |x: &Vector3<f64>| {
        x[0] == length || x[1] == height || x[2] == bottom || (!even && x[0] == 0.0)
    };
    let mut scene = Scene::new(element_stiffness(space, &elastic)?)
        .with_mass(lumped_mass::<3, 3>(space, density)?)
        .with_viscosity(dashpot(space, &space.trace(absorbs)?, |_| impedance)?)
        .with_load(balance)
        .with_load_history(move |time, load| grow(time, &pull, load))
        .with_velocity(vec![
            Vector3::new(problem.initial_rate(), 0.0, 0.0);
            space.vertex_count()
        ]);
    if even {
        // The body on the other side moves as this one turned about the normal of the fault.
        scene = scene.fix(
            &space.trace(|x| x[0] == 0.0)?,
            Components::Y | Components::Z,
        );
    }
    if problem == Benchmark::Tpv101 {
        scene = scene.fix(&space.trace(|x| x[2] == 0.0)?, Components::Z);
    }
    Ok(problem.on(scene, &fault, place, spacing(arguments)))
}
