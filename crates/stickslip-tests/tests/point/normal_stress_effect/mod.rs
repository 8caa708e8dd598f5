//! The state follows the normal stress: jumps in closed form, smooth paths against an independent integration.

mod jumps;
mod refusals;
mod smooth;

use nalgebra::SMatrix;
use stickslip::problems::spring_slider::FRICTION;
use stickslip::state::{LogTheta, Reads, StateError, StateLaw, Theta};
use stickslip::{BoundaryPart, Contact, Scene};

/// `zeta/b`.
const KAPPA: f64 = 0.4;
const SLIP_DISTANCE: f64 = 1e-5;

type Spring = Scene<SMatrix<f64, 1, 1>, 1>;

/// The aging law in `theta` itself, without any closed form.
struct Aging;

impl StateLaw for Aging {
    type State = Theta;

    fn evolution(&self, Theta(theta): Theta, slip_rate: f64) -> f64 {
        1.0 - slip_rate * theta / SLIP_DISTANCE
    }

    fn evolution_state_slope(&self, _: Theta, slip_rate: f64) -> f64 {
        -slip_rate / SLIP_DISTANCE
    }

    fn validate_state(&self, Theta(theta): Theta) -> Result<(), StateError> {
        StateError::check_positive("theta", theta)
    }
}

/// A block under a normal stress with a history, with the effect `kappa` if there is one.
fn contact<S: StateLaw>(
    law: S,
    initial: S::State,
    history: impl Fn(f64) -> f64 + Send + Sync + 'static,
    kappa: Option<f64>,
) -> Contact<stickslip::friction::DieterichRuina, S, 1>
where
    S::State: stickslip::state::LogScale,
    LogTheta: Reads<S::State>,
{
    let contact = Contact::new(BoundaryPart::point(1.0), FRICTION, 1e6)
        .with_state(law, initial)
        .with_normal_stress_history(move |time, stress| stress[0] = history(time));
    match kappa {
        Some(kappa) => contact.with_normal_stress_effect(kappa),
        None => contact,
    }
}
