//! How does a body slide by a friction law of one's own?
//!
//! Friction with a soft cut-off next to Dieterich's and Ruina's law with a hard one, in a velocity step of a
//! spring slider and in the paper's 2D slider. Far above the cut-off, where both slide, they agree.
//!
//! ```text
//! cargo run --release --example custom_friction_law -- --refinements 3 --steps 10000
//! ```

mod law;

use std::process::ExitCode;

use stickslip::friction::check_friction_law;
use stickslip::problems::{AGING, FRICTION, INITIAL_LOG_THETA};
use stickslip::state::LogTheta;
use support::cli::expect;
use support::own_law::{Trial, run};

use law::SoftCutoff;

fn main() -> ExitCode {
    run("custom_friction_law", |arguments| {
        let law = SoftCutoff(FRICTION);
        check_friction_law(&law, &[-300.0, -50.0, -10.0, 2.0, 30.0].map(LogTheta))?;
        let alpha = LogTheta(INITIAL_LOG_THETA);
        let own = Trial::run("SoftCutoff", (law, AGING, alpha), arguments)?;
        let known = Trial::run("DieterichRuina", (FRICTION, AGING, alpha), arguments)?;
        expect("first slip", own.first_slip()?, known.first_slip()?, 1e-8)?;
        Ok([own, known])
    })
}
