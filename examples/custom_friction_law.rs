//! A friction law of your own: rate-and-state friction with a soft cut-off, on the paper's slider.
//!
//! Far above the cut-off it agrees with Dieterich-Ruina friction, whose cut-off is hard: so does the first slip.

use std::error::Error;
use std::ops::ControlFlow;
use std::path::Path;

use stickslip::friction::{DieterichRuina, FrictionError, FrictionLaw, check_friction_law};
use stickslip::problems::pipping_slider::{
    AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider,
};
use stickslip::state::LogTheta;
use stickslip::{Condensed, Contact, GeneralizedAlpha, Simulation, Steps};
use stickslip_cli::output::Output;
use stickslip_cli::plot::{self, DARK, PALE, Panel, Points};

/// `mu = a ln(1 + V/Vm)`, positive and smooth where Dieterich's and Ruina's law `a ln(V/Vm)` is cut off at `Vm`. It lies
/// above that law by `a ln 2` at `V = Vm` and by less than `a Vm/V` beyond.
#[derive(Debug, Clone, Copy, PartialEq)]
struct SoftCutoff(DieterichRuina);

impl SoftCutoff {
    /// `ln(V/Vm)`. `Vm` itself underflows for old contacts; rates below the normal numbers count as the smallest of these.
    fn excess(&self, slip_rate: f64, state: LogTheta) -> f64 {
        slip_rate.max(f64::MIN_POSITIVE).ln() - self.0.ln_cutoff_rate(state)
    }
}

impl FrictionLaw for SoftCutoff {
    type State = LogTheta;

    // ln(1 + exp(t)), whose exponential must not overflow.
    fn coefficient(&self, slip_rate: f64, state: LogTheta) -> f64 {
        let t = self.excess(slip_rate, state);
        self.0.a * (t.max(0.0) + (-t.abs()).exp().ln_1p())
    }

    // a / (V + Vm)
    fn coefficient_rate_slope(&self, slip_rate: f64, state: LogTheta) -> f64 {
        self.0.a / (slip_rate + self.0.ln_cutoff_rate(state).exp())
    }

    // a V ((1 + 1/y) ln(1 + y) - 1) with y = V/Vm: cancels where y is small, y/2 - y^2/6 there.
    fn potential(&self, slip_rate: f64, state: LogTheta) -> f64 {
        let y = self.excess(slip_rate, state).exp();
        let mean = self.coefficient(slip_rate, state) * (1.0 + y.recip()) - self.0.a;
        slip_rate
            * if y > 1e-5 {
                mean
            } else {
                self.0.a * y * (0.5 - y / 6.0)
            }
    }

    fn validate(&self) -> Result<(), FrictionError> {
        self.0.validate()
    }
}

/// The slip rate over time at the middle of the slider's base, up to its first slip at 0.1 mm/s.
fn first_slip<L: FrictionLaw<State = LogTheta> + 'static>(
    law: L,
) -> Result<Points, Box<dyn Error>> {
    let body = PippingSlider {
        refinements: 2,
        ..PippingSlider::default()
    };
    let space = body.space()?;
    let contact = Contact::new(&PippingSlider::bottom(&space)?, law, NORMAL_STRESS)
        .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
    let scene = body.scene(&space)?.with_contact(contact);
    let mut slider = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;
    let middle =
        PippingSlider::centre(&space).ok_or("the mesh has no vertex at the middle of the base")?;
    let mut history = Points::new();
    slider.run(&Steps::constant(1.5e-3).until(12.0), |at| {
        let rate = at.velocity[middle].norm();
        history.push((at.time, rate));
        if rate > 1e-4 {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    })?;
    Ok(history)
}

fn main() -> Result<(), Box<dyn Error>> {
    let law = SoftCutoff(FRICTION);
    // The contract of a friction law: its slope, its potential, convexity.
    check_friction_law(&law, &[-300.0, -50.0, -10.0, 2.0, 30.0].map(LogTheta))?;
    let (own, known) = (first_slip(law)?, first_slip(FRICTION)?);
    let [soft, hard] =
        [&own, &known].map(|history| history.last().map_or(f64::NAN, |&(time, _)| time));
    println!("first slip at {soft:.4} s by a soft cut-off, at {hard:.4} s by a hard one");
    assert!((soft - hard).abs() < 2e-3 && hard > 9.0 && hard < 11.0);

    let late = |history: Points| {
        history
            .into_iter()
            .filter(|(time, _)| *time > hard - 1.0)
            .collect()
    };
    let panel = Panel::new("time [s]", "slip rate in the middle [m/s]")
        .logarithmic()
        .with("hard cut-off", PALE, 4, late(known))
        .with("soft cut-off", DARK, 2, late(own));
    let output = Output::create(Path::new("out/custom_friction_law"), &[])?;
    plot::draw(&output.path("custom_friction_law.png"), &[panel])?;
    println!("custom_friction_law.png in {}", output.folder().display());
    Ok(())
}
