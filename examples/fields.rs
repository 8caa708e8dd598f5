//! Parameters from a function of position: where does slip begin, and where does it end?
//!
//! The paper's slider on a bottom whose middle weakens with the slip rate (`a < b`) and whose rims strengthen
//! (`a > b`): an earthquake begins in the middle, and the rims slide slower. The picture is the slip rate in space and
//! time.

use std::error::Error;
use std::ops::ControlFlow;
use std::path::Path;

use stickslip::friction::DieterichRuina;
use stickslip::problems::pipping_slider::{
    AGING, END, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider,
};
use stickslip::state::LogTheta;
use stickslip::{Condensed, Contact, GeneralizedAlpha, Simulation, Steps};
use stickslip_cli::output::Output;
use stickslip_cli::plot::{self, Map};

/// `a` grows from 0.010 in the middle to 0.020 within 0.7 m of the ends.
fn law(x: f64) -> DieterichRuina {
    let rim = ((x - 2.5).abs() - 1.5).clamp(0.0, 0.3) / 0.3;
    DieterichRuina {
        a: 0.010 + 0.010 * rim,
        ..FRICTION
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let body = PippingSlider::default();
    let space = body.space()?;
    let bottom = PippingSlider::bottom(&space)?;
    let laws = bottom.map(|x| law(x[0]));
    let contact = Contact::per_vertex(&bottom, laws, NORMAL_STRESS)
        .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
    let scene = body.scene(&space)?.with_contact(contact);
    let mut slider = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;

    // From one end of the bottom to the other.
    let mut along: Vec<usize> = (0..bottom.points().len()).collect();
    along.sort_by(|&i, &k| bottom.points()[i][0].total_cmp(&bottom.points()[k][0]));
    let (mut times, mut rates) = (Vec::new(), Vec::new());

    // The run ends once a vertex slides at 1 mm/s.
    let mut first = None;
    slider.run(&Steps::constant(END / 1e4), |at| {
        let contact = at.contact(0);
        if at.time > 9.9 {
            times.push(at.time);
            rates.extend(along.iter().map(|&k| contact.slip_rate(k)));
        }
        first = (0..contact.len()).find(|&k| contact.slip_rate(k) > 1e-3);
        if first.is_some() || at.time > END {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    })?;
    let at = slider.snapshot();
    let first = at.contact(0).point(first.ok_or("it never slips")?)[0];
    println!("slip begins at x = {first} m, t = {:.4} s", at.time);

    // It goes on with steps that adapt.
    let mut peaks = vec![0.0_f64; bottom.vertices().len()];
    slider.run(&Steps::adaptive(1e-3).until(0.8 * END), |at| {
        let contact = at.contact(0);
        if at.time < 10.4 {
            times.push(at.time);
            rates.extend(along.iter().map(|&k| contact.slip_rate(k)));
        }
        for (k, peak) in peaks.iter_mut().enumerate() {
            *peak = peak.max(contact.slip_rate(k));
        }
    })?;
    let fastest = |within: fn(f64) -> bool| {
        let fault = bottom.points().iter().zip(&peaks);
        fault
            .filter(|(x, _)| within((x[0] - 2.5).abs()))
            .map(|(_, &v)| v)
            .fold(0.0, f64::max)
    };
    let (middle, rims) = (fastest(|x| x < 1.5), fastest(|x| x > 1.8));
    println!("largest slip rates: {middle:.2e} m/s in the middle, {rims:.2e} m/s at the rims");
    assert!((first - 2.5).abs() < 1.5 && rims < 0.5 * middle);

    let positions: Vec<f64> = along.iter().map(|&k| bottom.points()[k][0]).collect();
    let map = Map {
        names: ["time [s]", "position along the base [m]", "slip rate [m/s]"],
        x: &times,
        y: &positions,
        values: &rates,
        range: (1e-7, 1e-2),
        downward: false,
    };
    let output = Output::create(Path::new("out/fields"), &[])?;
    plot::draw(&output.path("fields.png"), &map)?;
    println!("fields.png in {}", output.folder().display());
    Ok(())
}
