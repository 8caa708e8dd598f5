//! Verification: an antiplane layer with an exact solution.
//!
//! A layer of the slider's material, 1 m high, is moved at its top and slides at its base; nothing depends on the
//! position along it. Waves then give the slip rate of the base exactly, by one scalar equation per time. The program
//! computes both, and compares the times of the events.
//!
//! ```text
//! stickslip layer --steps 10000 --cells 64
//! ```

use super::{Arguments, EVENT, Exact, SLIP, report};
use crate::cli::Problem;
use crate::progress::Progress;
use crate::record::{Record, Recording};
use stickslip::friction::DieterichRuina;
use stickslip::problems::antiplane_layer::{
    AntiplaneLayer, END, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS,
};
use stickslip::state::LogTheta;
use stickslip::{Contact, GeneralizedAlpha, Simulation, Steps, Tnnmg};

/// The laws of the slider.
const LAW: DieterichRuina = FRICTION;

/// A sliding layer beside its exact solution.
///
/// # Errors
/// In one line: a wrong setting, a failed step, a file that cannot be written.
pub fn run(arguments: &Arguments) -> Result<(), Problem> {
    let layer = AntiplaneLayer {
        cells: arguments.cells.get(),
        ..AntiplaneLayer::default()
    };
    let space = layer.space()?;
    let base = AntiplaneLayer::base(&space)?;
    let initial = LogTheta(INITIAL_LOG_THETA);
    let contact = Contact::new(&base, LAW, NORMAL_STRESS);
    let contact = contact.with_state(arguments.law.evolution(), initial);
    let scene = layer.scene(&space)?.with_contact(contact);
    let solver = Tnnmg::new(space.transfers());
    let mut simulation = Simulation::new(scene, GeneralizedAlpha::default(), solver)?;

    let mut exact = Exact::new(arguments);
    let law = arguments.law.evolution();
    let mut progress = Progress::default();
    layer.exact(&LAW, &law, initial, arguments.transit_steps.get(), |at| {
        progress.at(at.time, END, at.slip_rate);
        exact.add(at);
    })?;
    drop(progress);
    let recording = Recording {
        vertex: base.vertices()[0],
        every: arguments.every.get(),
        slip: SLIP,
        event: EVENT,
        end: END,
        adaptive: false,
    };
    let steps = arguments.steps.get();
    let steps = Steps::constant(END / steps as f64).count(steps);
    report(
        arguments,
        Record::take(recording, &mut simulation, &steps)?,
        &exact,
    )
}
