//! The paper's slider.

use stickslip::WorkPrecision;
use stickslip::problems::{AGING, END, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, Slider};
use stickslip::state::LogTheta;

use crate::common::cli::Problem;
use crate::method::{ADAPTIVE, EXPLICIT, Method, PAPER, PLAIN, Question, Scheme, Wanted};
use crate::study::{Effort, Study};
use crate::waves::{self, Waves};

/// The slip rate at `x0` [m/s] that counts as slip.
const SLIP: f64 = 1e-4;

/// The first slip, and the steps after it.
pub(crate) fn measure(effort: Effort) -> Result<(Study, Vec<Waves>), Problem> {
    let slider = Slider {
        refinements: if effort.quick { 2 } else { 4 },
        ..Slider::default()
    };
    let space = slider.space()?;
    let bottom = Slider::bottom(&space)?;
    let question = Question {
        space: &space,
        density: slider.density,
        scene: Box::new(|| {
            Ok(slider
                .scene(&space)?
                .with_friction(&bottom, FRICTION, NORMAL_STRESS)
                .with_state(AGING, LogTheta(INITIAL_LOG_THETA)))
        }),
        vertex: Slider::centre(&space).ok_or("the mesh has no vertex at x0")?,
        wanted: Wanted::Slip(1),
        slip: SLIP,
        kink: END / 4.0,
        first_step: END / 1e4,
        until: [10.03, 10.5],
    };
    // The masses differ by an error of the mesh: to each its own reference.
    let (fine, finer) = if effort.quick {
        (2e4, 4e4)
    } else {
        (8e4, 2.4e5)
    };
    let consistent = question.answer(PLAIN, END / fine)?;
    let lumped = question.answer(EXPLICIT, END / finer / 2.0)?;

    let steps = [1.25e3, 2.5e3, 5e3, 1e4, 2e4, 4e4].map(|n| END / n);
    let tolerances = [1e-1, 1e-2, 1e-3, 1e-4];
    let small_steps = [4e4, 6e4, 1e5, 2e5].map(|n| END / n);
    let methods: [(&str, Method, &[f64]); 11] = [
        (
            "Newmark, backward Euler state, fixed point",
            Method {
                monolithic: false,
                ..PAPER
            },
            &steps[1..4],
        ),
        (
            "Newmark, backward Euler state, monolithic",
            PAPER,
            &steps[1..5],
        ),
        (
            "Newmark, midpoint state, fixed point",
            Method {
                monolithic: false,
                ..PLAIN
            },
            &steps[1..5],
        ),
        ("Newmark, midpoint state, monolithic", PLAIN, &steps),
        (
            "Newmark, midpoint state, monolithic, TNNMG",
            Method {
                tnnmg: true,
                ..PLAIN
            },
            &steps[1..4],
        ),
        (
            "backward Euler, monolithic",
            Method {
                scheme: Scheme::BackwardEuler,
                ..PAPER
            },
            &steps[1..4],
        ),
        (
            "Sdirk2, monolithic",
            Method {
                scheme: Scheme::Sdirk2,
                ..PLAIN
            },
            &steps[1..5],
        ),
        (
            "generalised-alpha, monolithic",
            Method {
                scheme: Scheme::GeneralizedAlpha,
                ..PLAIN
            },
            &steps[1..5],
        ),
        ("Newmark, midpoint state, adaptive", ADAPTIVE, &tolerances),
        (
            "Sdirk2, adaptive",
            Method {
                scheme: Scheme::Sdirk2,
                ..ADAPTIVE
            },
            &tolerances[..3],
        ),
        (
            "generalised-alpha, adaptive",
            Method {
                scheme: Scheme::GeneralizedAlpha,
                ..ADAPTIVE
            },
            &tolerances[..3],
        ),
    ];
    let mut table = WorkPrecision::against(consistent).with_runs(effort.runs);
    for (name, method, settings) in methods {
        table = table.method(name, effort.settings(settings), |setting| {
            question.answer(method, setting)
        });
    }
    let mut measurements = table.finish();
    let explicit = WorkPrecision::against(lumped)
        .with_runs(effort.runs)
        .method(
            "central differences, lumped mass",
            effort.settings(&small_steps),
            |setting| question.answer(EXPLICIT, setting),
        );
    measurements.extend(explicit.finish());
    let waves = waves::measure("slider", &question, 10.2, effort)?;
    let study = Study {
        name: "slider",
        title: format!(
            "the paper's slider, {} refinements; references {consistent:.7} s (consistent mass), \
             {lumped:.7} s (lumped)",
            slider.refinements
        ),
        error: "error of the first slip at x0 [s]",
        targets: vec![1e-3, 1e-4, 1e-5],
        measurements,
    };
    Ok((study, waves))
}
