//! Figure 1.1: friction over displacement as the slip rate steps up and down.

use serde_json::{Value, json};
use stickslip::friction::FrictionLaw;
use stickslip::problems::spring_slider::{AGING, FRICTION, steady_state};
use stickslip::state::{LogTheta, StateLaw};

use super::{Drawing, Experiment, Outcome};
use crate::cli::Problem;
use crate::output::{Output, number};
use crate::plot::{self, COLORS, Panel, Points};

/// A point with a prescribed slip rate: the state has a closed form.
pub(super) struct VelocityStep;

/// The slip rates [m/s], each constant for this displacement \[m\].
const RATES: [f64; 3] = [1e-6, 1e-5, 1e-6];
const DISPLACEMENT: f64 = 1.5e-4;
/// The number of samples of each.
const SAMPLES: usize = 3000;

impl VelocityStep {
    /// The coefficient of friction over the displacement \[mm\], and its values at the ends of each slip rate.
    fn curve(law: &dyn StateLaw<State = LogTheta>) -> Result<(Points, Vec<[f64; 2]>), Problem> {
        let mut state = steady_state(&law, RATES[0])?;
        let (mut points, mut ends) = (Vec::new(), Vec::new());
        for (k, rate) in RATES.into_iter().enumerate() {
            let at_first = FRICTION.coefficient(rate, state);
            let start = state;
            for n in 0..=SAMPLES {
                let share = n as f64 / SAMPLES as f64;
                let exact = law.advance_exact(start, rate, share * DISPLACEMENT / rate);
                state = exact.ok_or("the law has no closed form")?;
                let displacement = 1e3 * DISPLACEMENT * (k as f64 + share);
                points.push((displacement, FRICTION.coefficient(rate, state)));
            }
            ends.push([at_first, FRICTION.coefficient(rate, state)]);
        }
        Ok((points, ends))
    }
}

impl Drawing for VelocityStep {
    fn experiments(&self) -> Vec<Experiment> {
        Vec::new()
    }

    fn draw(&self, output: &Output, _: &[Outcome]) -> Result<Value, Problem> {
        let laws: [(&str, &dyn StateLaw<State = LogTheta>); 2] =
            [("Dieterich", &AGING), ("Ruina", &FRICTION.slip())];
        let mut panel = Panel::new("displacement [mm]", "coefficient of friction");
        let (mut rows, mut numbers) = (Vec::new(), Vec::new());
        for ((name, law), color) in laws.into_iter().zip([COLORS[3], COLORS[2]]) {
            let (points, ends) = Self::curve(law)?;
            let row =
                |p: &(f64, f64)| [name.to_lowercase().into(), number(1e-3 * p.0), number(p.1)];
            rows.extend(points.iter().map(row));
            numbers.push(json!({
                "law": name.to_lowercase(),
                "jump_up": ends[1][0] - ends[0][1],
                "jump_down": ends[2][0] - ends[1][1],
                "steady_change_up": ends[1][1] - ends[0][1],
                "steady_change_down": ends[2][1] - ends[1][1],
            }));
            panel = panel.with(name, color, 3, points);
        }
        output.table("1.1.csv", "law,displacement,coefficient", rows)?;
        plot::print(output.folder(), "1.1", &[panel][..])?;
        let step = (RATES[1] / RATES[0]).ln();
        Ok(json!({
            "claim": "friction jumps by a ln(V2/V1) with the slip rate, and moves by (a - b) ln(V2/V1) in all, over a \
                      displacement like L; down as up",
            "expected": {"jump": FRICTION.a * step, "steady_change": (FRICTION.a - FRICTION.b) * step},
            "laws": numbers,
        }))
    }
}
