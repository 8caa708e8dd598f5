//! A state law of your own: that of Perrin, Rice and Zheng, written in theta, beside the aging law.
//!
//! Both reach the same steady friction after a velocity step, by different ways.

use std::error::Error;
use std::path::Path;

use stickslip::friction::{DieterichRuina, FrictionLaw};
use stickslip::problems::spring_slider::{AGING, FRICTION, LoadPath, SpringSlider};
use stickslip::state::{Reads, StateLaw, Theta, check_state_law};
use stickslip::{RungeKutta, Steps};
use stickslip_cli::output::Output;
use stickslip_cli::plot::{self, DARK, PALE, Panel, Points};

/// `theta' = 1 - (V theta / 2L)^2` (G. Perrin, J. Rice, G. Zheng, J. Mech. Phys. Solids 43 (1995)), with the steady
/// state `2L/V`.
#[derive(Debug, Clone, Copy, PartialEq)]
struct PerrinRiceZheng {
    /// `L` \[m\], finite and positive.
    slip_distance: f64,
}

impl StateLaw for PerrinRiceZheng {
    type State = Theta;

    // The square keeps its sign, so that the rate also decreases where theta < 0.
    fn evolution(&self, Theta(theta): Theta, slip_rate: f64) -> f64 {
        let x = slip_rate * theta / (2.0 * self.slip_distance);
        1.0 - x * x.abs()
    }

    fn evolution_state_slope(&self, Theta(theta): Theta, slip_rate: f64) -> f64 {
        let rate = slip_rate / (2.0 * self.slip_distance);
        -2.0 * theta.abs() * rate * rate
    }
}

/// The coefficient of friction over time through a step from 1 to 10 um/s at the start, on a stiff spring.
fn velocity_step<L, S>(friction: L, law: S) -> Result<Points, Box<dyn Error>>
where
    L: FrictionLaw + 'static,
    S: StateLaw + 'static,
    L::State: Reads<S::State>,
{
    let slider = SpringSlider {
        stiffness: 1e10,
        normal_stress: 1e6,
        mass: 0.0,
        damping: 5e6,
        load: LoadPath::steady(1e-5),
    };
    let mut block = RungeKutta::new(slider.steady(friction, law, 1e-6)?)?;
    let mut history = Points::new();
    block.run(&Steps::adaptive(1e-8).until(20.0), |at| {
        history.push((at.time, at.contact(0).coefficient(0)));
    })?;
    Ok(history)
}

fn main() -> Result<(), Box<dyn Error>> {
    let law = PerrinRiceZheng {
        slip_distance: AGING.slip_distance,
    };
    // The contract of a state law: slopes, signs, existence of the state after a step.
    check_state_law(&law, &[1e-5, 1.0, 1e3].map(Theta))?;
    // Steady contacts are twice as old as by the aging law; friction compares them with 2L/V0.
    let friction = DieterichRuina {
        slip_distance: 2.0 * law.slip_distance,
        ..FRICTION
    };

    let own = velocity_step(friction, law)?;
    let aging = velocity_step(FRICTION, AGING)?;
    let steady = FRICTION.steady_coefficient(1e-5);
    for (name, history) in [("Perrin-Rice-Zheng", &own), ("aging", &aging)] {
        let (_, last) = *history.last().ok_or("no steps")?;
        println!("{name}: {last:.9} after 20 s, in steady sliding {steady:.9}");
        assert!((last - steady).abs() < 1e-8);
    }

    let early = |history: Points| {
        history
            .into_iter()
            .filter(|(time, _)| *time < 8.0)
            .collect()
    };
    let panel = Panel::new("time [s]", "coefficient of friction")
        .with("aging law", PALE, 4, early(aging))
        .with("Perrin-Rice-Zheng", DARK, 2, early(own));
    let output = Output::create(Path::new("out/custom_state_law"), &[])?;
    plot::draw(&output.path("custom_state_law.png"), &[panel])?;
    println!("custom_state_law.png in {}", output.folder().display());
    Ok(())
}
