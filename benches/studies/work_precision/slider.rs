//! The paper's slider.

use stickslip::problems::pipping_slider::{END, PippingSlider};
use stickslip::work_precision::{Measurement, WorkPrecision};
use stickslip_cli::cli::Problem;

use crate::method::{ADAPTIVE, EXPLICIT, Method, PAPER, PLAIN, Scheme};
use crate::question::{Question, Wanted, contact};
use crate::study::{Effort, Study};
use crate::waves::{self, Waves};

/// The slip rate at `x0` [m/s] that counts as slip.
const SLIP: f64 = 1e-4;

/// The first slip, and the steps after it.
pub(crate) fn measure(effort: Effort) -> Result<(Study, Vec<Waves>), Problem> {
    let slider = PippingSlider {
        refinements: if effort.quick { 2 } else { 4 },
        ..PippingSlider::default()
    };
    let space = slider.space()?;
    let bottom = PippingSlider::bottom(&space)?;
    let question = Question {
        space: &space,
        body: Box::new(|lumped| {
            let body = PippingSlider { lumped, ..slider };
            Ok(body.scene(&space)?.with_contact(contact(&bottom)))
        }),
        vertex: PippingSlider::centre(&space).ok_or("the mesh has no vertex at x0")?,
        wanted: Wanted::Slip(1),
        slip: SLIP,
        kink: END / 4.0,
        first_step: END / 1e4,
        until: [10.03, 10.5],
    };
    // The masses differ by an error of the mesh: to each its own reference. Newmark's scheme is of
    // second order only where a step resolves the fastest waves.
    let (implicit, explicit) = if effort.quick {
        (8e4, 8e4)
    } else {
        (3.2e5, 4.8e5)
    };
    let consistent = question.answer(PLAIN, END / implicit)?;
    let lumped = question.answer(EXPLICIT, END / explicit)?;
    let study = Study {
        name: "slider",
        reference: format!(
            "first slip at {consistent:.7} s (consistent mass), {lumped:.7} s (lumped)"
        ),
        error: "error of the first slip at x0 [s]",
        targets: vec![1e-3, 1e-4, 1e-5],
        measurements: compare(&question, [consistent, lumped], effort),
    };
    Ok((study, waves::measure("slider", &question, 10.2, effort)?))
}

/// All methods by the first slip, against the references for the consistent and the lumped mass.
fn compare(
    question: &Question<'_, 2>,
    [consistent, lumped]: [f64; 2],
    effort: Effort,
) -> Vec<Measurement> {
    let steps = [1.25e3, 2.5e3, 5e3, 1e4, 2e4, 4e4].map(|n| END / n);
    let tolerances = [1e-1, 1e-2, 1e-3, 1e-4];
    let small_steps = [4e4, 6e4, 1e5, 2e5].map(|n| END / n);
    let (sdirk2, newmark) = (Scheme::Sdirk2, Scheme::Newmark);
    let methods: [(&str, Method, &[f64]); 14] = [
        (
            "Newmark, backward Euler state, fixed point",
            PAPER.alternating(),
            &steps[1..4],
        ),
        (
            "Newmark, backward Euler state, monolithic",
            PAPER,
            &steps[1..5],
        ),
        (
            "generalised-alpha, midpoint state, fixed point",
            PLAIN.alternating(),
            &steps[1..5],
        ),
        (
            "generalised-alpha, midpoint state, monolithic",
            PLAIN,
            &steps,
        ),
        (
            "generalised-alpha, midpoint state, monolithic, TNNMG",
            PLAIN.with_tnnmg(),
            &steps[1..4],
        ),
        (
            "generalised-alpha, midpoint state, reduced to 120 Hz",
            PLAIN.reduced_to(120.0),
            &steps,
        ),
        (
            "generalised-alpha, midpoint state, reduced to 240 Hz",
            PLAIN.reduced_to(240.0),
            &steps,
        ),
        (
            "backward Euler, monolithic",
            PAPER.by(Scheme::BackwardEuler),
            &steps[1..4],
        ),
        ("Sdirk2, monolithic", PLAIN.by(sdirk2), &steps[1..5]),
        ("Newmark, monolithic", PLAIN.by(newmark), &steps[1..5]),
        ("central differences, lumped mass", EXPLICIT, &small_steps),
        (
            "generalised-alpha, midpoint state, adaptive",
            ADAPTIVE,
            &tolerances,
        ),
        ("Sdirk2, adaptive", ADAPTIVE.by(sdirk2), &tolerances[..3]),
        ("Newmark, adaptive", ADAPTIVE.by(newmark), &tolerances[..3]),
    ];
    let mut measurements = Vec::new();
    for (name, method, settings) in methods {
        let reference = if method.is_lumped() {
            lumped
        } else {
            consistent
        };
        let table = WorkPrecision::against(reference).with_runs(effort.runs);
        let measured = table.method(name, effort.settings(settings), |setting| {
            question.answer(method, setting)
        });
        measurements.extend(measured.finish());
    }
    measurements
}
