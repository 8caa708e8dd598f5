//! The spring slider: one vertex, all laws, all ways to couple rate and state.

mod explicit;
mod implicit;

use stickslip::problems::{LoadPath, SpringSlider};

use crate::case::Case;
use crate::setup::{Draws, Setup, one_at_a_time};

const SECTION: &str = "spring slider";
const STEPS: usize = 20;

pub(crate) fn cases(quick: bool) -> Vec<Case> {
    let mut cases = Vec::new();
    for (name, setup) in one_at_a_time() {
        implicit::add(&mut cases, &name, "", setup, quick);
    }
    let mut draws = Draws(1);
    for n in 0..if quick { 20 } else { 300 } {
        implicit::add(
            &mut cases,
            "all at once",
            &format!("draw {n}, "),
            draws.setup(),
            quick,
        );
    }
    explicit::add(&mut cases, quick);
    cases
}

fn slider(setup: &Setup) -> SpringSlider {
    SpringSlider {
        stiffness: setup.stiffness,
        normal_stress: setup.normal_stress,
        mass: setup.mass,
        damping: setup.damping,
        load: LoadPath::steady(setup.velocity),
    }
}
