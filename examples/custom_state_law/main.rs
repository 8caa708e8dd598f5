//! How does a body slide by a state law of one's own?
//!
//! The law of Perrin, Rice and Zheng in `theta`, which the library has in the logarithm of that, next to Dieterich's:
//! in a velocity step of a spring slider, where both reach the same steady friction on different ways, and in the
//! paper's 2D slider through its first slip.
//!
//! ```text
//! cargo run --release --example custom_state_law -- --refinements 3 --steps 10000
//! ```

mod law;

use std::process::ExitCode;

use stickslip::friction::DieterichRuina;
use stickslip::problems::{AGING, FRICTION, INITIAL_LOG_THETA};
use stickslip::state::{LogTheta, Theta, check_state_law};
use support::own_law::{Trial, run};

use law::PerrinRiceZheng;

fn main() -> ExitCode {
    run("custom_state_law", |arguments| {
        let law = PerrinRiceZheng {
            slip_distance: AGING.slip_distance,
        };
        check_state_law(&law, &[1e-5, 1.0, 1e3].map(Theta))?;

        // Steady contacts are twice as old as by Dieterich's law; friction compares them with 2L/V0.
        let friction = DieterichRuina {
            slip_distance: 2.0 * law.slip_distance,
            ..FRICTION
        };
        let alpha = LogTheta(INITIAL_LOG_THETA);
        let theta = Theta(2.0 * Theta::from(alpha).0);
        Ok([
            Trial::run("PerrinRiceZheng", (friction, law, theta), arguments)?,
            Trial::run("Dieterich", (FRICTION, AGING, alpha), arguments)?,
        ])
    })
}
