//! What is concluded; its numbers are those of the measurements.

use std::fmt::{Error, Write};

use crate::report::rounded;
use crate::study::{Reached, Study};
use crate::waves::Waves;

const PAPER: &str = "Newmark, backward Euler state, monolithic";
const MIDPOINT: &str = "Newmark, midpoint state, monolithic";
const FIXED_POINT: &str = "Newmark, midpoint state, fixed point";
const TNNMG: &str = "Newmark, midpoint state, monolithic, TNNMG";
const ALPHA: &str = "generalised-alpha, monolithic";
const SDIRK2: &str = "Sdirk2, monolithic";
const BACKWARD_EULER: &str = "backward Euler, monolithic";
const EXPLICIT: &str = "central differences, lumped mass";
const ADAPTIVE: &str = "Newmark, midpoint state, adaptive";

/// The conclusions from those scenes that were measured.
pub(crate) fn conclusions(studies: &[Study], waves: &[Waves]) -> Result<String, Error> {
    let mut text = String::from("## What follows\n\n");
    let of = |name: &str| studies.iter().find(|study| study.name == name);
    if let (Some(layer), Some(slider)) = (of("layer"), of("slider")) {
        state(&mut text, layer, slider)?;
        space(&mut text, layer, slider)?;
        schemes(&mut text, layer, slider)?;
        steps(&mut text, layer, slider)?;
    }
    if let Some(events) = of("layer-events") {
        after(&mut text, events, waves)?;
    }
    if let (Some(first), Some(peak)) = (of("slow-slider"), of("slow-slider-peak")) {
        slow(&mut text, first, peak)?;
    }
    if let Some(spring) = of("spring-slider") {
        point(&mut text, spring)?;
    }
    text += DEFAULTS;
    Ok(text)
}

fn state(text: &mut String, layer: &Study, slider: &Study) -> Result<(), Error> {
    writeln!(
        text,
        "- **State at the midpoint rate.** At the price of the paper's backward Euler state it is of \
         second order instead of first (observed on the layer: {} against {}). An error of 1e-3 s costs \
         it {} (layer) and {} (slider), the paper's pairing {} and {}.",
        order(layer, MIDPOINT),
        order(layer, PAPER),
        cost(layer, MIDPOINT, 1e-3),
        cost(slider, MIDPOINT, 1e-3),
        cost(layer, PAPER, 1e-3),
        cost(slider, PAPER, 1e-3),
    )
}

fn space(text: &mut String, layer: &Study, slider: &Study) -> Result<(), Error> {
    writeln!(
        text,
        "- **Rate and state at once.** `Monolithic` and `FixedPoint` have the same errors; the former \
         takes {} of the time on the layer, {} on the slider.\n\
         - **Condensed on these meshes.** TNNMG has the same errors too and takes {} (layer) and {} \
         (slider) the time. It is the choice for meshes whose factor is too large, which are not \
         measured here.",
        share(layer, FIXED_POINT, MIDPOINT),
        share(slider, FIXED_POINT, MIDPOINT),
        share(layer, MIDPOINT, TNNMG),
        share(slider, MIDPOINT, TNNMG),
    )
}

fn schemes(text: &mut String, layer: &Study, slider: &Study) -> Result<(), Error> {
    let [on_layer, on_slider] = [layer, slider].map(|study| cheapest(study, EXPLICIT));
    writeln!(
        text,
        "- **Newmark's scheme at constant steps.** For 1e-4 s it takes {} on the layer and {} on the \
         slider, Sdirk2 {} and {}. Backward Euler is of first order like the paper's pairing, and no \
         better: {} and {} for 1e-2 s. Generalised-alpha with a spectral radius of 0.8 has Newmark's \
         errors at the same steps, for {} (layer) and {} (slider) of the time: until the first event \
         there are no waves to be damped.\n\
         - **Central differences for small errors.** Their step is bounded by the mesh, not by the \
         error: the cheapest run takes {} (layer) and {} (slider), and has an error of {} and {}. \
         Newmark takes {} and {} for 1e-5 s. They are ahead \
         where steps near their limit are wanted anyway, and no choice for a coarse answer; the limit \
         halves with the mesh size.",
        cost(layer, MIDPOINT, 1e-4),
        cost(slider, MIDPOINT, 1e-4),
        cost(layer, SDIRK2, 1e-4),
        cost(slider, SDIRK2, 1e-4),
        cost(layer, BACKWARD_EULER, 1e-2),
        cost(slider, BACKWARD_EULER, 1e-2),
        share(layer, MIDPOINT, ALPHA),
        share(slider, MIDPOINT, ALPHA),
        on_layer.0,
        on_slider.0,
        on_layer.1,
        on_slider.1,
        cost(layer, MIDPOINT, 1e-5),
        cost(slider, MIDPOINT, 1e-5),
    )
}

fn steps(text: &mut String, layer: &Study, slider: &Study) -> Result<(), Error> {
    let row = |study: &Study, error| against(study, [ADAPTIVE, MIDPOINT], error);
    writeln!(
        text,
        "- **Adaptive steps, loaded as in the paper.** Newmark, adaptive against constant, until the \
         first event: on the layer {} for 1e-3 s, {} for 1e-4 s, {} for 1e-5 s; on the slider {}, {} \
         and {}. So they gain on the layer, \
         and on the slider for coarse answers at most. These runs end with the event.",
        row(layer, 1e-3),
        row(layer, 1e-4),
        row(layer, 1e-5),
        row(slider, 1e-3),
        row(slider, 1e-4),
        row(slider, 1e-5),
    )
}

fn after(text: &mut String, events: &Study, waves: &[Waves]) -> Result<(), Error> {
    let steps = |scene: &str, method: &str| {
        let found = (waves.iter())
            .find(|w| w.scene == scene && w.method == method && w.tolerance == 1e-3)
            .or_else(|| {
                waves
                    .iter()
                    .find(|w| w.scene == scene && w.method == method)
            });
        found.map_or_else(Default::default, |w| {
            let per_second = w.steps.after as f64 / w.steps.span_after;
            format!("{} and {:.0} a second", w.steps.before, per_second)
        })
    };
    writeln!(
        text,
        "- **After an event** nothing damps the waves that it leaves in an elastic body, and a local error \
         sees them. Steps until the first event, and after it, at a tolerance of 1e-3: on the layer {} \
         (Newmark), {} (generalised-alpha), {} (Sdirk2); on the slider {}, {} and {}. Where loading is \
         slow and viscosity damps the waves steps grow again: {}, {} and {}. Through all events of the layer, \
         adaptive against constant, for an error of 1e-2 s in the time of the last: {} (Newmark), {} \
         (generalised-alpha), {} (Sdirk2).",
        steps("layer", "Newmark"),
        steps("layer", "generalised-alpha"),
        steps("layer", "Sdirk2"),
        steps("slider", "Newmark"),
        steps("slider", "generalised-alpha"),
        steps("slider", "Sdirk2"),
        steps("slow slider", "Newmark"),
        steps("slow slider", "generalised-alpha"),
        steps("slow slider", "Sdirk2"),
        pair(events, "Newmark", 1e-2),
        pair(events, "generalised-alpha", 1e-2),
        pair(events, "Sdirk2", 1e-2),
    )
}

fn slow(text: &mut String, first: &Study, peak: &Study) -> Result<(), Error> {
    writeln!(
        text,
        "- **Adaptive steps, loaded slowly.** With loading a thousand times slower and some viscosity, \
         adaptive against constant steps of Newmark: {} for the first slip to 0.1 s of 10549 s, {} to \
         0.01 s; {} for the largest slip rate to 2 %. Sdirk2, adaptive, takes {}, {} and {}. This is \
         where adaptive steps belong. The event itself is slow here, see its largest \
         slip rate below: the body is nearly stiff enough to slide steadily. A fast event was not \
         measured.",
        pair(first, "Newmark", 1e-1),
        pair(first, "Newmark", 1e-2),
        pair(peak, "Newmark", 2e-2),
        cost(first, "Sdirk2, adaptive", 1e-1),
        cost(first, "Sdirk2, adaptive", 1e-2),
        cost(peak, "Sdirk2, adaptive", 2e-2),
    )
}

fn point(text: &mut String, spring: &Study) -> Result<(), Error> {
    let at = |method: &str, error| cost(spring, method, error);
    let newmark = |levels: usize| format!("Newmark, midpoint, extrapolated({levels})");
    writeln!(
        text,
        "- **A point: `RungeKutta`.** Three cycles with an error of 1e-4 in ln V take it {}; Newmark \
         extrapolated over 2, 3 and 4 levels {}, {} and {}, Sdirk2 extrapolated {}. For 1e-6: {}, and \
         {}, {} and {}. Doubling without extrapolation takes {} for 1e-2. Where inertia or a law with \
         a jump excludes `RungeKutta`, `ErrorControl::extrapolated(3)` is the choice.",
        at("Runge-Kutta", 1e-4),
        at(&newmark(2), 1e-4),
        at(&newmark(3), 1e-4),
        at(&newmark(4), 1e-4),
        at("Sdirk2, extrapolated(2)", 1e-4),
        at("Runge-Kutta", 1e-6),
        at(&newmark(2), 1e-6),
        at(&newmark(3), 1e-6),
        at(&newmark(4), 1e-6),
        at("Newmark, midpoint, doubled", 1e-2),
    )
}

const DEFAULTS: &str = "
| scene | choice |
| --- | --- |
| a body in 2D, constant steps | `Newmark::default()`, `Condensed`, and the defaults of `Simulation`: `StateUpdate::Midpoint`, `Monolithic` |
| a body in 2D, slowly loaded and damped | the same with `Adaptive`, quantised |
| a body whose steps are to be near the stability limit anyway | `CentralDifferences`, `lumped_mass`, `Diagonal`, `Staggered` |
| a point without inertia | `RungeKutta` with `Adaptive` |
| the figures of the paper | `StateUpdate::BackwardEuler`, `FixedPoint::paper()`: of first order |

What these numbers do not say: an event time is one number of one run, and methods that agree in it may
differ after it. Between two steps the logarithm of the slip rate is taken as linear, which adds an
error of second order to that of every method. Errors of the layer below some 3e-6 s are those of its
mesh. Where a method's error changes sign between settings, one of them looks better than it is.

";

/// The time of a scheme of second order at adaptive and at constant steps.
fn pair(study: &Study, scheme: &str, error: f64) -> String {
    let ways = ["adaptive", "constant steps"].map(|way| format!("{scheme}, {way}"));
    against(study, [&ways[0], &ways[1]], error)
}

fn against(study: &Study, methods: [&str; 2], error: f64) -> String {
    let [one, other] = methods.map(|method| cost(study, method, error));
    format!("{one} against {other}")
}

fn cost(study: &Study, method: &str, error: f64) -> String {
    match study.reached(method, error) {
        Reached::In(seconds) => format!("{} s", rounded(seconds)),
        Reached::AtMost(seconds) => format!("less than {} s", rounded(seconds)),
        Reached::Never => "more than was measured".into(),
    }
}

/// Run time and error of the cheapest setting of a method that has a result.
fn cheapest(study: &Study, method: &str) -> (String, String) {
    let results = study.of(method).filter(|m| m.failure.is_none());
    let least = results.min_by(|a, b| a.seconds.total_cmp(&b.seconds));
    least.map_or_else(Default::default, |m| {
        (
            format!("{} s", rounded(m.seconds)),
            format!("{:.1e} s", m.error),
        )
    })
}

/// The median ratio of the run times of two methods over the settings they share.
fn share(study: &Study, of: &str, what: &str) -> String {
    let pairs = study.of(what).filter_map(|m| {
        let other = study.of(of).find(|other| other.setting == m.setting)?;
        Some(m.seconds / other.seconds)
    });
    let mut ratios: Vec<f64> = pairs.collect();
    ratios.sort_unstable_by(f64::total_cmp);
    let middle = ratios.get(ratios.len() / 2);
    middle.map_or("no part".into(), |ratio| format!("{ratio:.2}"))
}

fn order(study: &Study, method: &str) -> String {
    let order = study.observed_order(method);
    order.map_or("unknown".into(), |order| format!("{order:.1}"))
}
