//! BP3-QD: earthquake cycles on a thrust or normal fault in a half space in plane strain, with the friction of BP1 by the
//! distance down dip. Slip changes the normal stress.

use serde_json::json;
use stickslip::bie::{DippingFault, OffFault, Sense};
use stickslip::nalgebra::Vector1;
use stickslip::problems::bp1::{AGING, MEDIUM, PLATE_RATE};
use stickslip::{RungeKutta, Scene};

use super::bp1::{self, ENDS};
use super::line::{EVENT, Line};
use super::off_fault::{PLANE_STRAIN, Plan};
use super::{Arguments, Failed, YEAR};
use crate::cli::expect;

/// Poisson's ratio.
pub const POISSON_RATIO: f64 = 0.25;

/// The prediction of `V theta^(b/a) = const` at the surface at constant stress: time \[s\], log10 V.
const START: [[f64; 2]; 1] = [[305.176, -9.024_365]];
/// The time of the first event by the code FDRA, cells of 25 m \[years\].
const FIRST_EVENTS: [(f64, Sense, f64); 2] =
    [(60.0, Sense::Thrust, 177.1), (30.0, Sense::Normal, 206.7)];

/// Takes the steps, writes and prints the results, and checks them.
pub(super) fn run(arguments: &Arguments) -> Result<(), Failed> {
    let (dip, sense) = (arguments.dip(), arguments.sense());
    let fault = DippingFault::new(arguments.cells(ENDS)?, MEDIUM, POISSON_RATIO, dip, sense)?;
    let distances = fault.cells().map(|distance| distance);
    let plate = Vector1::new(PLATE_RATE);
    let scene = Scene::new(fault.stiffness())
        .with_viscosity(fault.radiation_damping())
        .with_contact(bp1::contact(&fault, &distances, AGING.slip_distance))
        .with_load_history(fault.plate_loading(PLATE_RATE))
        .with_normal_stress_change(fault.normal_stiffness(), plate)
        .with_velocity(fault.cells().map(|_| plate));
    let mut motion = RungeKutta::new(scene)?;
    let starts = START.map(|[time, _]| time);
    let mut line = Line::new(arguments, fault.cells(), &starts)
        .with_normal_stress()
        .with_off_fault(off_fault(&fault)?);
    let settings = json!({ "dip": dip, "sense": format!("{sense:?}").to_lowercase() });
    line.run(arguments, settings, &mut motion)?;
    check(arguments, &line)
}

/// What is off the fault: the stations of the benchmark, by their distance from the trace \[km\], and one on each side of it.
fn off_fault(fault: &DippingFault) -> Result<Plan<1>, Failed> {
    let beside = 1e-7 * fault.cells().length();
    let far = [-32.0, -16.0, -8.0, 8.0, 16.0, 32.0];
    let stations = far.map(|x: f64| (format!("srfst_fn{x:+03}"), 1e3 * x));
    let near = [
        ("srfst_fn-00".to_owned(), -beside),
        ("srfst_fn+00".to_owned(), beside),
    ];
    let stations = stations.into_iter().chain(near);
    Ok(Plan {
        sources: fault.sources()?,
        plate: Some(Vector1::new(PLATE_RATE)),
        stations: stations.map(|(name, x)| (name, [x, 0.0, 0.0])).collect(),
        axes: PLANE_STRAIN,
        event: EVENT,
        extent: None,
    })
}

/// Checks the start, and the first event for cells that resolve it.
fn check(arguments: &Arguments, line: &Line<'_>) -> Result<(), Failed> {
    if !arguments.is_accurate() {
        return Ok(());
    }
    for ([time, exact], found) in START.iter().zip(&line.start) {
        expect(&format!("log10 V after {time} s"), *found, *exact, 1e-5)?;
    }
    let (dip, sense) = (arguments.dip(), arguments.sense());
    let known = FIRST_EVENTS
        .iter()
        .find(|known| (known.0, known.1) == (dip, sense));
    if let Some((_, _, published)) = known
        && arguments.cell() <= 100.0
        && arguments.end() >= (published + 1.0) * YEAR
    {
        let first = line.times().first().copied().unwrap_or(f64::NAN);
        expect("years to the first event", first, *published, 0.1)?;
    }
    Ok(())
}
