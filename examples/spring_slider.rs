//! A spring slider through a velocity step, and in stick-slip below the critical stiffness.
//!
//! One node and no mesh: nothing but the laws and the time integration. The load point of a block that slides steadily
//! moves ten times faster at once: friction rises by the direct effect, and falls to its new steady value over the
//! characteristic slip distance D_c.

use std::error::Error;
use std::path::Path;

use stickslip::friction::{DieterichRuina, RegularizedDieterichRuina};
use stickslip::problems::spring_slider::{LoadPath, SpringSlider};
use stickslip::state::Dieterich;
use stickslip::{RungeKutta, Steps};
use stickslip_cli::output::Output;
use stickslip_cli::plot::{self, DARK, Panel};

const LAW: DieterichRuina = DieterichRuina {
    a: 0.010,
    b: 0.015,
    reference_friction: 0.6,
    reference_velocity: 1e-6,
    slip_distance: 1e-5,
};
const AGING: Dieterich = Dieterich {
    slip_distance: LAW.slip_distance,
};
const NORMAL_STRESS: f64 = 5e6;

fn main() -> Result<(), Box<dyn Error>> {
    // (b - a) sigma_n/D_c
    let critical = SpringSlider::critical_stiffness(NORMAL_STRESS, LAW.a, LAW.b, LAW.slip_distance);
    let slider = |stiffness: f64, load: LoadPath| SpringSlider {
        stiffness,
        normal_stress: NORMAL_STRESS,
        mass: 0.0,
        damping: 5e6,
        load,
    };

    // Stiff: a velocity step from 1 to 10 um/s at 10 s.
    let stiff = slider(20.0 * critical, LoadPath::steady(1e-6).then(10.0, 1e-5));
    let mut block =
        RungeKutta::new(stiff.steady(RegularizedDieterichRuina::from(LAW), AGING, 1e-6)?)?;
    let mut friction = Vec::new();
    block.run(
        &Steps::adaptive(1e-6).stopping_at([10.0]).until(30.0),
        |at| {
            friction.push((at.time, at.contact(0).coefficient(0)));
        },
    )?;
    let [before, after] = [1e-6, 1e-5].map(|rate| LAW.steady_coefficient(rate));
    let peak = friction.iter().map(|&(_, mu)| mu).fold(0.0, f64::max);
    let last = block.snapshot().contact(0).coefficient(0);
    println!("coefficient of friction: {before:.4}, at most {peak:.4}, then {last:.4}");
    assert!((last - after).abs() < 1e-5);
    // The direct effect a ln 10, less what evolves on the way to the peak.
    assert!(peak - before > 0.8 * LAW.a * 10f64.ln() && peak - before < LAW.a * 10f64.ln());

    // Soft: stick-slip.
    let soft = slider(0.5 * critical, LoadPath::steady(1e-6));
    let mut block =
        RungeKutta::new(soft.steady(RegularizedDieterichRuina::from(LAW), AGING, 1.01e-6)?)?;
    let mut rates = Vec::new();
    block.run(&Steps::adaptive(1e-6).until(3000.0), |at| {
        rates.push((at.time, at.contact(0).slip_rate(0)));
    })?;
    let events = rates
        .windows(2)
        .filter(|pair| pair[0].1 < 1e-3 && pair[1].1 >= 1e-3)
        .count();
    println!("{events} events in 3000 s below the critical stiffness of {critical:.2e} Pa/m");
    assert!(events > 5);

    let output = Output::create(Path::new("out/spring_slider"), &[])?;
    plot::draw(
        &output.path("spring_slider.png"),
        &[
            Panel::new("time [s]", "coefficient of friction").with("", DARK, 2, friction),
            Panel::new("time [s]", "slip rate [m/s]")
                .logarithmic()
                .with("", DARK, 2, rates),
        ],
    )?;
    println!("spring_slider.png in {}", output.folder().display());
    Ok(())
}
