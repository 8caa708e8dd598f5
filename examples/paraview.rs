//! Files for ParaView: the paper's slider through its first events, body and contact every 100 steps.
//!
//! `out/paraview/slider.pvd` is the file to open. `out/paraview/centre.csv` has the centre of the bottom at the same
//! times; `examples/paraview.py` opens the files in VTK itself, and compares.
//!
//! ```text
//! cargo run --release --example paraview
//! python3 -m venv out/venv && out/venv/bin/pip install vtk numpy && out/venv/bin/python examples/paraview.py
//! ```

use std::error::Error;
use std::fs::{File, create_dir_all};
use std::io::BufWriter;
use std::ops::ControlFlow;
use std::path::Path;

use stickslip::problems::{AGING, END, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, Slider};
use stickslip::record::{PointHistories, VtkSeries};
use stickslip::state::LogTheta;
use stickslip::{Condensed, Contact, GeneralizedAlpha, Simulation, Steps};

const EVERY: usize = 100;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = Path::new("out/paraview");
    create_dir_all(folder)?;
    let body = Slider::default();
    let space = body.space()?;
    let bottom = Slider::bottom(&space)?;
    let contact = Contact::new(&bottom, FRICTION, NORMAL_STRESS)
        .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
    let scene = body.scene(&space)?.with_contact(contact);
    let mut slider = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;

    let elastic = body.elastic;
    let start = slider.snapshot();
    let mut series = VtkSeries::new(&start, &space, folder.join("slider"))?
        .with_stress(move |_, _| elastic)
        .with_contact(&start, 0, &bottom)?
        .every(EVERY)?;
    let centre = Slider::centre(&space).ok_or("no centre")?;
    let file = BufWriter::new(File::create(folder.join("centre.csv"))?);
    let mut points = PointHistories::new(&start, &[centre], EVERY, file)?;

    slider.run(
        &Steps::constant(END / 1e4).until(0.7 * END),
        |at| match series.record(&at) {
            ControlFlow::Continue(()) => points.record(&at),
            ended => ended,
        },
    )?;
    series.finish()?;
    points.finish()?;
    println!("out/paraview/slider.pvd, out/paraview/centre.csv");
    Ok(())
}
