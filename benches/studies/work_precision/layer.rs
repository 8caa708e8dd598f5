//! The layer, whose first event is known exactly.

use stickslip::fem::{P1, antiplane, lumped_mass};
use stickslip::problems::antiplane_layer::{
    AGING, AntiplaneLayer, END, FRICTION, INITIAL_LOG_THETA, load_velocity,
};
use stickslip::state::LogTheta;
use stickslip::work_precision::{Measurement, WorkPrecision};
use stickslip::{BlockMatrix, Components, Scene, SceneError};
use stickslip_cli::cli::Problem;
use stickslip_cli::onsets::Onsets;

use crate::method::{ADAPTIVE, EXPLICIT, Method, PAPER, PLAIN, Scheme};
use crate::question::{Question, Wanted, contact};
use crate::study::{Effort, Study};
use crate::waves::{self, Waves};

/// The slip rate of the base [m/s] that counts as slip.
const SLIP: f64 = 1e-3;

/// The last question in the scene's time: the number of its events.
const EVENTS: usize = 5;

/// The first event against the exact solution, all five against a fine run, and the steps after the
/// first.
pub(crate) fn measure(effort: Effort) -> Result<([Study; 2], Vec<Waves>), Problem> {
    let layer = AntiplaneLayer::default();
    let reference = exact(&layer, if effort.quick { 400 } else { 3200 })?;
    let space = layer.space()?;
    let base = AntiplaneLayer::base(&space)?;
    let question = |wanted, until| Question {
        space: &space,
        body: Box::new(|lumped| Ok(body(&layer, &space, lumped)?.with_contact(contact(&base)))),
        vertex: base.vertices()[0],
        wanted,
        slip: SLIP,
        kink: END / 4.0,
        first_step: END / 1e4,
        until,
    };
    let first = question(Wanted::Slip(1), [reference + 0.01, reference + 0.5]);
    let last = question(Wanted::Slip(EVENTS), [END; 2]);
    let first_event = Study {
        name: "layer",
        reference: format!("first event at {reference:.7} s, exactly"),
        error: "error of the first event [s]",
        targets: vec![1e-3, 1e-4, 1e-5],
        measurements: compare(&first, reference, effort),
    };
    let waves = waves::measure("layer", &last, END, effort)?;
    Ok(([first_event, all_events(&last, effort)?], waves))
}

/// The layer, with a lumped mass or the consistent one.
fn body(
    layer: &AntiplaneLayer,
    space: &P1<2>,
    lumped: bool,
) -> Result<Scene<BlockMatrix<1>, 1>, SceneError> {
    if !lumped {
        return layer.scene(space);
    }
    let top = space.trace(|x| x[1] == 1.0)?;
    Ok(Scene::new(antiplane(space, layer.shear_modulus)?)
        .on(space)
        .with_mass(lumped_mass(space, layer.density)?)
        .prescribe_velocity(&top, Components::ALL, |time| [load_velocity(time)]))
}

/// All methods by the first event.
fn compare(first: &Question<'_, 1>, reference: f64, effort: Effort) -> Vec<Measurement> {
    let steps = [2.5e3, 5e3, 1e4, 2e4, 4e4, 8e4].map(|n| END / n);
    let tolerances = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6];
    let small_steps = [1e5, 2e5, 4e5].map(|n| END / n);
    let (sdirk2, newmark) = (Scheme::Sdirk2, Scheme::Newmark);
    let methods: [(&str, Method, &[f64]); 12] = [
        (
            "Newmark, backward Euler state, fixed point",
            PAPER.alternating(),
            &steps[..5],
        ),
        ("Newmark, backward Euler state, monolithic", PAPER, &steps),
        (
            "generalised-alpha, midpoint state, fixed point",
            PLAIN.alternating(),
            &steps,
        ),
        (
            "generalised-alpha, midpoint state, monolithic",
            PLAIN,
            &steps,
        ),
        (
            "generalised-alpha, midpoint state, monolithic, TNNMG",
            PLAIN.with_tnnmg(),
            &steps[1..5],
        ),
        (
            "backward Euler, monolithic",
            PAPER.by(Scheme::BackwardEuler),
            &steps[..5],
        ),
        ("Sdirk2, monolithic", PLAIN.by(sdirk2), &steps[..5]),
        ("Newmark, monolithic", PLAIN.by(newmark), &steps[..5]),
        ("central differences, lumped mass", EXPLICIT, &small_steps),
        (
            "generalised-alpha, midpoint state, adaptive",
            ADAPTIVE,
            &tolerances,
        ),
        ("Sdirk2, adaptive", ADAPTIVE.by(sdirk2), &tolerances[..5]),
        ("Newmark, adaptive", ADAPTIVE.by(newmark), &tolerances[..5]),
    ];
    let mut table = WorkPrecision::against(reference).with_runs(effort.runs);
    for (name, method, settings) in methods {
        table = table.method(name, effort.settings(settings), |setting| {
            first.answer(method, setting)
        });
    }
    table.finish()
}

/// The time of the last event: what is left of a method's error after the waves of four events.
fn all_events<const C: usize>(
    question: &Question<'_, C>,
    effort: Effort,
) -> Result<Study, Problem> {
    let fine = if effort.quick { 2e4 } else { 6.4e5 };
    let reference = question.answer(PLAIN, END / fine)?;
    let steps = [5e3, 1e4, 2e4, 4e4, 8e4, 1.6e5].map(|n| END / n);
    let tolerances = [1e-1, 1e-2, 1e-3, 1e-4];
    Ok(Study {
        name: "layer-events",
        reference: format!("event {EVENTS} at {reference:.5} s on this mesh"),
        error: "error of the last event [s]",
        targets: vec![1e-1, 1e-2, 1e-3],
        measurements: question.adaptive_and_constant(reference, effort, &tolerances, &steps),
    })
}

/// The time of the first event by the waves between top and base \[s\].
fn exact(layer: &AntiplaneLayer, transit_steps: usize) -> Result<f64, Problem> {
    let mut slips = Onsets::new(SLIP, SLIP);
    let initial = LogTheta(INITIAL_LOG_THETA);
    layer.exact(&FRICTION, &AGING, initial, transit_steps, |at| {
        if slips.times().is_empty() {
            slips.record(at.time, at.slip_rate);
        }
    })?;
    let first = slips.times().first().copied();
    first.ok_or_else(|| "the exact solution has no event".into())
}
