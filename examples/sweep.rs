//! Many laws on one body, in threads: recurrence of events over the direct effect `a`.
//!
//! A Craig-Bampton reduction of the body to its fault takes its time once. Each run is then one on the fault alone.
//! `stickslip sweep` draws `a`, `b` and `D_c` at random.

use std::error::Error;
use std::path::Path;
use std::thread;

use stickslip::fem::P1;
use stickslip::friction::DieterichRuina;
use stickslip::problems::pipping_slider::{
    FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider,
};
use stickslip::reduced::{Reduced, ReducedBody};
use stickslip::state::LogTheta;
use stickslip::{
    BlockMatrix, Contact, DenseNewton, GeneralizedAlpha, Scene, SceneError, Simulation, Steps,
};
use stickslip_cli::output::Output;
use stickslip_cli::plot::{self, DARK, Panel};

fn scene(
    slider: &PippingSlider,
    space: &P1<2>,
    law: DieterichRuina,
) -> Result<Scene<BlockMatrix<2>, 2>, SceneError> {
    let contact = Contact::new(&PippingSlider::bottom(space)?, law, NORMAL_STRESS)
        .with_state(law.aging(), LogTheta(INITIAL_LOG_THETA));
    Ok(slider.scene(space)?.with_contact(contact))
}

/// The events of a law in the whole 15 s: how many, and the largest slip rate \[m/s\].
fn events(
    (slider, space, body): (&PippingSlider, &P1<2>, &ReducedBody<2>),
    law: DieterichRuina,
) -> Result<(usize, f64), Box<dyn Error + Send + Sync>> {
    let scene = body.reduce(scene(slider, space, law)?)?;
    let mut block = Simulation::new(scene, GeneralizedAlpha::default(), DenseNewton::new())?;
    let (mut count, mut slips, mut largest) = (0, false, 0.0_f64);
    block.run(&Steps::constant(1.5e-3).until(15.0), |at| {
        let rate = at.max_slip_rate();
        largest = largest.max(rate);
        count += usize::from(rate > 1e-3 && !slips);
        slips = rate > 1e-3 || slips && rate > 2e-4;
    })?;
    Ok((count, largest))
}

fn main() -> Result<(), Box<dyn Error>> {
    let slider = PippingSlider {
        refinements: 2,
        ..PippingSlider::default()
    };
    let space = slider.space()?;
    let body: ReducedBody<2> =
        Reduced::new(&scene(&slider, &space, FRICTION)?).up_to_frequency(120.0)?;
    let direct_effects = [0.006, 0.008, 0.010, 0.012, 0.014, 0.018];
    let shared = (&slider, &space, &body);
    let found = thread::scope(|scope| {
        let runs = direct_effects
            .map(|a| scope.spawn(move || events(shared, DieterichRuina { a, ..FRICTION })));
        runs.map(|run| run.join().map_err(|_| "a run has panicked"))
    });
    let mut peaks = Vec::new();
    for (a, found) in direct_effects.into_iter().zip(found) {
        let (count, largest) = found?.map_err(|error| error.to_string())?;
        println!("a = {a:.3}: {count} events, at most {largest:.2e} m/s");
        peaks.push((a, largest));
    }
    // The more velocity weakening, the faster: b - a falls along the list, and is negative at its end.
    assert!(peaks[0].1 > 10.0 * peaks[5].1);

    let panel = Panel::new("a", "largest slip rate [m/s]")
        .logarithmic()
        .with("", DARK, 2, peaks);
    let output = Output::create(Path::new("out/sweep"), &[])?;
    plot::draw(&output.path("sweep.png"), &[panel])?;
    println!("sweep.png in {}", output.folder().display());
    Ok(())
}
