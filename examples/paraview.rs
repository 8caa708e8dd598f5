//! Files for ParaView: the paper's slider through its first events, body and contact every 100 steps.
//!
//! `out/paraview/slider.pvd` is the file to open. `out/paraview/centre.csv` has the centre of the bottom at the same
//! times; `examples/paraview.py` opens the files in VTK itself, and compares. `out/paraview/slip_rate.png` shows the times.
//!
//! ```text
//! cargo run --release --example paraview
//! python3 -m venv out/venv && out/venv/bin/pip install vtk numpy && out/venv/bin/python examples/paraview.py
//! ```

use std::error::Error;
use std::ops::ControlFlow;
use std::path::Path;

use stickslip::problems::pipping_slider::{
    AGING, END, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider,
};
use stickslip::record::{PointHistories, VtkSeries};
use stickslip::state::LogTheta;
use stickslip::{Condensed, Contact, GeneralizedAlpha, Simulation, Steps};
use stickslip_cli::output::Output;
use stickslip_cli::plot::{self, COLORS, DARK, Panel, Points};

const EVERY: usize = 100;

fn main() -> Result<(), Box<dyn Error>> {
    let output = Output::create(Path::new("out/paraview"), &[])?;
    let body = PippingSlider::default();
    let space = body.space()?;
    let bottom = PippingSlider::bottom(&space)?;
    let contact = Contact::new(&bottom, FRICTION, NORMAL_STRESS)
        .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
    let scene = body.scene(&space)?.with_contact(contact);
    let mut slider = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;

    let elastic = body.elastic;
    let start = slider.snapshot();
    let mut series = VtkSeries::new(&start, &space, output.path("slider"))?
        .with_stress(move |_, _| elastic)
        .with_contact(&start, 0, &bottom)?
        .every(EVERY)?;
    let centre = PippingSlider::centre(&space).ok_or("no centre")?;
    let mut points = PointHistories::new(&start, &[centre], EVERY, output.file("centre.csv")?)?;
    let (mut rates, mut shown) = (Points::new(), Points::new());

    slider.run(&Steps::constant(END / 1e4).until(0.7 * END), |at| {
        rates.push((at.time, at.max_slip_rate()));
        if at.step.is_multiple_of(EVERY) {
            shown.push((at.time, at.max_slip_rate()));
        }
        match series.record(&at) {
            ControlFlow::Continue(()) => points.record(&at),
            ended => ended,
        }
    })?;
    series.finish()?;
    points.finish()?;
    let event = rates.iter().find(|(_, rate)| *rate > 1e-3);
    let event = event.ok_or("it never slips")?.0;
    println!("{} times, an event after {event:.3} s", shown.len());
    assert!(shown.len() == 70 && output.path("slider_0069.vtu").exists());
    assert!((event - 10.0).abs() < 0.1);

    let panel = Panel::new("time [s]", "largest slip rate [m/s]")
        .logarithmic()
        .with("steps", DARK, 2, rates)
        .with_dots("files", COLORS[0], shown);
    plot::draw(&output.path("slip_rate.png"), &[panel])?;
    let folder = output.folder().display();
    println!("slider.pvd, centre.csv, slip_rate.png in {folder}");
    Ok(())
}
