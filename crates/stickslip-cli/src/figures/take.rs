//! Reproduction of the figures of the paper, with its settings and beside its claims.
//!
//! ```text
//! stickslip figures 6.3          # or 1.1, 6.1, 6.2, 6.4, 6.5, converged, work
//! stickslip figures all          # all of them; --quick: coarse, in under a minute
//! ```

use std::path::Path;

use super::{Experiment, Iteration, Law, Outcome, Scheme};
use crate::cli::Problem;
use stickslip::problems::pipping_slider::{
    AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider,
};
use stickslip::state::LogTheta;
use stickslip::{
    BackwardEuler, Condensed, Contact, Coupling, FixedPoint, Monolithic, Newmark, RateScheme,
    Simulation, StateUpdate,
};

/// A run of the paper's slider, from the checkpoint `file` if there is one.
pub(super) fn take(
    experiment: &Experiment,
    file: &Path,
    progress: &mut dyn FnMut(f64),
) -> Result<Outcome, Problem> {
    let body = PippingSlider {
        refinements: experiment.refinements,
        // Accelerations that agree with the forces, where more is wanted than the paper's numbers.
        recurrent: !experiment.midpoint,
        ..PippingSlider::default()
    };
    let space = body.space()?;
    let bottom = PippingSlider::bottom(&space)?;
    let contact = Contact::new(&bottom, FRICTION, NORMAL_STRESS);
    let (scene, initial) = (body.scene(&space)?, LogTheta(INITIAL_LOG_THETA));
    let scene = match experiment.law {
        Law::Dieterich => scene.with_contact(contact.with_state(AGING, initial)),
        Law::Ruina => scene.with_contact(contact.with_state(FRICTION.slip(), initial)),
    };
    let scheme: Box<dyn RateScheme> = match experiment.scheme {
        Scheme::Newmark => Box::new(Newmark::default()),
        Scheme::BackwardEuler => Box::new(BackwardEuler),
    };
    let coupling: Box<dyn Coupling> = match experiment.rule {
        Iteration::Paper => Box::new(FixedPoint::paper()),
        Iteration::Aitken => Box::new(FixedPoint::accelerated()),
        Iteration::Monolithic => Box::new(Monolithic::default()),
    };
    let update = if experiment.midpoint {
        StateUpdate::Midpoint
    } else {
        StateUpdate::BackwardEuler
    };
    let mut simulation = Simulation::new(scene, scheme, Condensed::new())?
        .with_coupling(coupling)
        .with_state_update(update)
        .with_absolute_tolerance(1e-10)?;
    let centre = PippingSlider::centre(&space).ok_or("the mesh has no vertex at x0")?;
    Outcome::of(experiment, &mut simulation, centre, file, progress)
}
