//! Every option of a scene, a contact and a reduction: used, carried by copies, reductions and checkpoints, or refused
//! by name.

mod carried;
mod cases;
mod names;

use stickslip::fem::{BlockMatrix, Elastic, P1, elasticity, mass};
use stickslip::friction::RegularizedDieterichRuina;
use stickslip::integrate::Stepper;
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{
    Components, Condensed, Contact, GeneralizedAlpha, Run, Scene, Simulation, StateUpdate, Steps,
};

use crate::Outcome;

pub(crate) type Body = Scene<BlockMatrix<2>, 2>;

const L: f64 = 1e-5;
const AGING: Dieterich = Dieterich { slip_distance: L };
const LAW: RegularizedDieterichRuina = RegularizedDieterichRuina {
    a: 0.012,
    b: 0.010,
    reference_friction: 0.6,
    reference_velocity: 1e-6,
    slip_distance: L,
};
const NORMAL_STRESS: f64 = 2e3;
const STATE: LogTheta = LogTheta(2.0);
/// Shear of 5 kPa: more than the strength.
const RATE: f64 = 1e-3;
/// The number of steps of 0.02 s.
const COUNT: usize = 12;

/// What becomes of a scene with the option.
pub(crate) enum Fate {
    /// It moves otherwise than without, or as one that is refused without.
    Used,
    /// An error says so, with this word.
    Refused(&'static str),
}

/// An option: scenes without and with it, and what becomes of the latter.
pub(crate) struct Case {
    pub(crate) name: &'static str,
    pub(crate) scenes: fn(&P1<2>) -> Outcome<[Body; 2]>,
    pub(crate) whole: Fate,
    pub(crate) reduced: Fate,
    /// A state contains it: a checkpoint is of both scenes.
    pub(crate) initial: bool,
}

fn space() -> Outcome<P1<2>> {
    Ok(P1::grid([2.0, 1.0], [4, 2])?)
}

fn contact(space: &P1<2>) -> Outcome<Contact<RegularizedDieterichRuina, Dieterich, 2>> {
    let bottom = space.trace(|x| x[1] == 0.0)?;
    Ok(Contact::new(&bottom, LAW, NORMAL_STRESS).with_state(AGING, STATE))
}

const ROCK: Elastic = Elastic {
    young_modulus: 5e7,
    poisson_ratio: 0.3,
};

/// A body without mass and contact, whose top is pulled along.
fn quasi_static(space: &P1<2>) -> Outcome<Body> {
    let top = space.trace(|x| x[1] == 1.0)?;
    let scene = Scene::new(elasticity(space, &ROCK)?);
    Ok(scene.prescribe_velocity(&top, Components::ALL, |_| [RATE, 0.0]))
}

fn dynamic(space: &P1<2>) -> Outcome<Body> {
    Ok(quasi_static(space)?.with_mass(mass(space, 1e3)?))
}

fn body(space: &P1<2>) -> Outcome<Body> {
    Ok(dynamic(space)?.with_contact(contact(space)?))
}

/// Without inertia by backward Euler, which has no memory of the first velocities inside.
fn simulation(scene: Body) -> Outcome<Simulation<2>> {
    let body = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;
    Ok(body.with_state_update(StateUpdate::BackwardEuler))
}

/// The slip rates of the first contact, in their order.
fn slip_rates(stepper: &(impl Stepper<2> + ?Sized)) -> Vec<f64> {
    let contact = stepper.snapshot().contact(0);
    (0..contact.len()).map(|k| contact.slip_rate(k)).collect()
}

/// Takes the steps, and returns the slip rates before them, and displacement and velocity after them.
fn motion(stepper: &mut (impl Stepper<2> + ?Sized)) -> Outcome<Vec<f64>> {
    let mut numbers = slip_rates(stepper);
    let plan = Steps::constant(0.02).count(COUNT).without_substeps();
    Run::run(stepper, &plan, |_| ())?;
    let at = stepper.snapshot();
    for vector in at.displacement.iter().chain(at.velocity) {
        numbers.extend(vector.iter());
    }
    Ok(numbers)
}

/// The largest difference of two motions, relative to the largest number.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    let size = a.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
    let pairs = a.iter().zip(b);
    pairs.fold(0.0, |largest: f64, (x, y)| largest.max((x - y).abs())) / size
}
