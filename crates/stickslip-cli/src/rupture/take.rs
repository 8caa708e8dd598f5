//! The steps of a rupture in the plane, and what stations record.

use stickslip::{Simulation, Steps};

use super::Arguments;
use crate::cli::Problem;
use crate::probes::Probes;
use crate::progress::Progress;

/// A row of a station: time \[s\], slip \[m\] and slip rate [m/s] across the fault, shear stress, pore pressure \[Pa\],
/// temperature \[K\], the normal stress of friction, that of the body \[Pa\], opening \[m\].
pub(super) type Row = [f64; 9];

/// Takes the steps to the end, with a stop at each whole second, and records the stations. The first row has the initial
/// shear stress.
///
/// # Errors
/// The failure of the run.
pub fn take(
    arguments: &Arguments,
    simulation: &mut Simulation<2>,
) -> Result<Probes<2, 9>, Problem> {
    let problem = arguments.problem;
    let from = |x: &f64, point: [f64; 3]| (point[0] - x).abs();
    let start = simulation.snapshot();
    let mut stations = Probes::new(&start, problem.stations(), from, move |at, k| -> Row {
        let contact = at.contact(0);
        let bodies = problem.bodies();
        let temperature = contact.reading("temperature");
        [
            at.time,
            bodies * contact.slip(k),
            bodies * contact.slip_rate(k),
            contact.traction(k)[0],
            contact.pore_pressure(k),
            temperature.map_or(f64::NAN, |all| all[k]),
            contact.normal_stress(k),
            contact.body_normal_stress(k),
            contact.opening(k),
        ]
    });
    let contact = start.contact(0);
    for station in &mut stations.each {
        if let Some(k) = contact.position_of(station.vertex) {
            station.rows[0][3] = problem.shear(contact.point(k)[0], contact.weight(k));
        }
    }
    let dt = step(arguments, simulation).recip();
    let mut progress = Progress::default();
    for time in arguments.stops() {
        let plan = Steps::constant(dt).until(time);
        stations.run(simulation, &plan, (&mut progress, arguments.until), |_| ())?;
    }
    Ok(stations)
}

/// Steps per second. In an explicit scheme a step is a tenth below the stability limit; in an implicit one a pressure
/// wave crosses the largest edge at the fault.
fn step(arguments: &Arguments, simulation: &mut Simulation<2>) -> f64 {
    if arguments.explicit() {
        // A step that is too large tells the limit, and leaves everything as it is.
        let _ = simulation.step(f64::MAX);
    }
    let limit = simulation.step_limit().map(|limit| 0.9 * limit);
    limit.unwrap_or(arguments.cell / 6000.0).recip().ceil()
}
