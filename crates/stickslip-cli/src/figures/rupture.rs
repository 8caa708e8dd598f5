//! Figure 6.5: the slip rate in space and time through an event.

use serde_json::{Value, json};
use stickslip::problems::pipping_slider::END;

use super::histories::setting;
use super::outcome::FAST;
use super::{Drawing, Experiment, Outcome};
use crate::cli::Problem;
use crate::output::{Output, number};
use crate::plot::{self, Map};

/// A wave that starts at the centre and is arrested before the ends.
pub(super) struct Rupture {
    pub(super) quick: bool,
}

impl Drawing for Rupture {
    fn experiments(&self) -> Vec<Experiment> {
        let (refinements, steps) = setting(self.quick);
        vec![Experiment::paper(refinements, steps[2])]
    }

    fn draw(&self, output: &Output, outcomes: &[Outcome]) -> Result<Value, Problem> {
        let outcome = &outcomes[0];
        let rupture = &outcome.rupture;
        let width = rupture.x.len();
        plot::print(
            output.folder(),
            "6.5",
            &Map {
                names: ["time [s]", "x [m]", "slip rate [m/s]"],
                x: &rupture.times,
                y: &rupture.x,
                values: &rupture.slip_rates,
                range: (1e-6, 1e-2),
                downward: false,
            },
        )?;
        let rows = rupture.slip_rates.iter().enumerate().map(|(k, &rate)| {
            let (time, x) = (rupture.times[k / width], rupture.x[k % width]);
            [number(time), number(x), number(rate)]
        });
        output.table("6.5.csv", "time,x,slip_rate", rows)?;
        Ok(json!({
            "claim": "an event starts at the centre, spreads as a wave and is arrested before the ends; the first one \
                      is near 2T/3",
            "refinements": outcome.experiment.refinements,
            "steps": outcome.experiment.steps,
            "threshold": FAST,
            "onset_x": rupture.onset.map(|onset| onset.0),
            "onset_fraction": rupture.onset.map(|onset| onset.1 / END),
            "extent": rupture.extent.map(|(from, to)| [from, to]),
            "peak_slip_rate": rupture.peak.1,
            "peak_x": rupture.peak.0,
            "peak_fraction": rupture.peak.2 / END,
            "over_fraction": rupture.over / END,
            "seconds": outcome.seconds,
        }))
    }
}
