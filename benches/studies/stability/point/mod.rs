//! The spring slider: one vertex, all laws, all ways to couple rate and state.

mod explicit;
mod implicit;

use stickslip::SceneError;
use stickslip::problems::spring_slider::{LoadPath, SpringScene, SpringSlider};
use stickslip::state::{Discontinuous, LogTheta, Theta};
use stickslip_cli::laws::{Law, Laws};
use stickslip_studies::Draws;

use crate::case::Case;
use crate::setup::{Setup, drawn, one_at_a_time};

/// The part of the report.
pub(crate) const SECTION: &str = "spring slider";
const STEPS: usize = 20;

pub(crate) fn cases(quick: bool) -> Vec<Case> {
    let mut cases = Vec::new();
    for (name, setup) in one_at_a_time() {
        implicit::add(&mut cases, &name, "", setup, quick);
    }
    let mut draws = Draws(1);
    for n in 0..if quick { 20 } else { 300 } {
        let prefix = format!("draw {n}, ");
        implicit::add(&mut cases, "all at once", &prefix, drawn(&mut draws), quick);
    }
    explicit::add(&mut cases, quick);
    cases
}

fn scene(setup: &Setup, laws: &Laws) -> Result<SpringScene, SceneError> {
    let slider = SpringSlider {
        stiffness: setup.stiffness,
        normal_stress: setup.normal_stress,
        mass: setup.mass,
        damping: setup.damping,
        load: LoadPath::steady(setup.velocity),
    };
    let (friction, rate, alpha) = (laws.friction(), setup.slip_rate, LogTheta(setup.alpha));
    let scene = match laws.law {
        Law::Discontinuous => slider.scene(friction, Discontinuous, rate, Theta::from(alpha)),
        _ => slider.scene(friction, laws.evolution(), rate, alpha),
    };
    // Without inertia any rate but the one that stress and state imply is refused.
    scene.map(SpringScene::with_balanced_rates)
}
