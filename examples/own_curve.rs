//! Error against run time of several methods on a scene of your own.
//!
//! A square in antiplane shear is pulled over its bottom. The displacement of a corner at the end is compared with
//! that of a run with small steps: by the default method, by Newmark's scheme, by the paper's method.

use std::error::Error;
use std::path::Path;

use stickslip::fem::{P1, antiplane, mass};
use stickslip::problems::pipping_slider::{AGING, FRICTION};
use stickslip::state::LogTheta;
use stickslip::work_precision::{WorkPrecision, observed_order, seconds_to};
use stickslip::{
    Components, Condensed, Contact, FixedPoint, GeneralizedAlpha, Newmark, RateScheme, Scene,
    SceneError, Simulation, StateUpdate, Steps,
};
use stickslip_cli::output::Output;
use stickslip_cli::plot::{self, COLORS, Panel};

type Square = Simulation<1>;

fn square(space: &P1<2>, scheme: impl RateScheme + 'static) -> Result<Square, SceneError> {
    let (bottom, top) = (space.trace(|x| x[1] == 0.0)?, space.trace(|x| x[1] == 1.0)?);
    let contact = Contact::new(&bottom, FRICTION, 1e4).with_state(AGING, LogTheta(0.0));
    let scene = Scene::new(antiplane(space, 4e7)?)
        .with_mass(mass(space, 2e3)?)
        .with_contact(contact)
        .prescribe_velocity(&top, Components::ALL, |time| [1e-3 * time]);
    Simulation::new(scene, scheme, Condensed::new())?.with_absolute_tolerance(1e-13)
}

fn main() -> Result<(), Box<dyn Error>> {
    let space = P1::grid([1.0, 1.0], [1, 1])?.refined(3)?;
    let corner = space.vertex_at([0.0, 0.0]).ok_or("no corner")?;
    let run = |mut body: Square, steps: &Steps| -> Result<f64, Box<dyn Error>> {
        body.run(&steps.clone().until(0.6), |_| ())?;
        Ok(body.snapshot().displacement[corner][0])
    };
    let default = |dt| {
        let body = square(&space, GeneralizedAlpha::default())?;
        run(body, &Steps::constant(dt))
    };
    let newmark = |dt| {
        let body = square(&space, Newmark::default())?;
        run(body, &Steps::constant(dt))
    };
    let paper = |dt| {
        let body = square(&space, Newmark::default())?;
        let body = body.with_state_update(StateUpdate::BackwardEuler);
        let body = body.with_coupling(FixedPoint::paper());
        run(body, &Steps::constant(dt))
    };
    let settings = [4e-3, 2e-3, 1e-3, 5e-4];
    let table = WorkPrecision::against(newmark(5e-5)?)
        .method("default", &settings, default)
        .method("newmark", &settings, newmark)
        .method("paper", &settings, paper)
        .finish();

    println!(
        "{:<12}{:>10}{:>14}{:>12}",
        "method", "setting", "error [m]", "time [s]"
    );
    for row in &table {
        let (method, setting) = (&row.method, row.setting);
        println!(
            "{method:<12}{setting:>10.0e}{:>14.2e}{:>12.4}",
            row.error, row.seconds
        );
    }
    let wanted = 1e-9;
    for method in ["default", "newmark", "paper"] {
        let time = seconds_to(&table, method, wanted).map_or("not".into(), |t| format!("{t:.4} s"));
        println!("{method}: error {wanted:e} m in {time}");
    }
    let orders = ["default", "newmark", "paper"].map(|method| observed_order(&table, method));
    println!("observed orders: {orders:.2?}");
    for (order, expected) in orders.into_iter().zip([2.0, 2.0, 1.0]) {
        assert!(order.is_some_and(|order| (order - expected).abs() < 0.2));
    }

    let mut panel = Panel::new("time [s]", "error of the displacement [m]").both_logarithmic();
    for (method, color) in ["default", "newmark", "paper"].into_iter().zip(COLORS) {
        let rows = table.iter().filter(|row| row.method == method);
        panel = panel.with_dots(
            method,
            color,
            rows.map(|row| (row.seconds, row.error)).collect(),
        );
    }
    let output = Output::create(Path::new("out/own_curve"), &[])?;
    plot::draw(&output.path("own_curve.png"), &[panel])?;
    println!("own_curve.png in {}", output.folder().display());
    Ok(())
}
