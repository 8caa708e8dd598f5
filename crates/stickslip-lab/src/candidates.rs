//! Parameters from which a fit may start.

use crate::evolution::Evolution;
use crate::features::Features;
use crate::model::Model;
use crate::parameter::Parameter;
use crate::parameters::{Parameters, StateParameters};
use crate::part::Part;

/// The factors on the direct effect that the curve shows: a soft machine shows less than `a`.
const DIRECT_EFFECTS: [f64; 3] = [0.7, 1.5, 3.0];
/// The factors on the steepest rise of the curve, which is less steep than the machine's.
const STIFFNESSES: [f64; 2] = [1.0, 2.0];
/// The ratio of neighbouring slip distances.
const RATIO: f64 = 2.5;
/// The shares of the first of two states in `b1 + b2`.
const SHARES: [f64; 3] = [0.3, 0.7, 1.3];
/// The evolution effect over `a - b`, and the factors on a stiffness that was fitted without one.
const EFFECTS: [f64; 2] = [0.3, 1.0];
const SOFTER: [f64; 2] = [1.0, 0.8];

/// What all records show, and what each of them shows.
pub(crate) struct Shown {
    pub(crate) all: Features,
    pub(crate) each: Vec<Features>,
}

/// The factors on the stiffness of machines, where one is fitted.
fn factors<'f>(model: &Model<'_>, factors: &'f [f64]) -> &'f [f64] {
    let free = |part: &Part<'_>| part.free.contains(&Parameter::Stiffness);
    if model.parts.iter().any(free) {
        factors
    } else {
        &[1.0]
    }
}

impl Shown {
    /// What the records of a model show.
    pub(crate) fn new(model: &Model<'_>) -> Self {
        let each = model.parts.iter().map(|part| {
            let v0 = part.fixed.parameters.reference_velocity;
            let known = part.known(Parameter::Stiffness);
            Features::new(part.record, part.load, v0, &part.trend, known)
        });
        let each: Vec<Features> = each.collect();
        Self {
            all: Features::of_all(&each),
            each,
        }
    }

    /// Slip distances from twice the distance of the samples to the length of a piece.
    fn slip_distances(&self) -> Vec<f64> {
        let (low, high) = (2.0 * self.all.distances.0, self.all.distances.1);
        let count = ((high / low).ln() / RATIO.ln()).ceil().clamp(1.0, 12.0) as i32;
        let ratio = (high / low).powf(1.0 / f64::from(count));
        (0..=count).map(|k| low * ratio.powi(k)).collect()
    }

    /// One or two states with the sum `b`.
    fn states(&self, laws: &[Evolution<'_>], b: f64) -> Vec<Vec<StateParameters>> {
        let lengths = self.slip_distances();
        let mut states = Vec::new();
        for &one in &lengths {
            if laws.len() == 1 {
                states.push(vec![StateParameters::steady(b, one)]);
                continue;
            }
            // Two different laws can have either order.
            let ordered = laws[0].name() == laws[1].name();
            let apart = |two: f64| two > RATIO * one || (!ordered && one > RATIO * two);
            for &two in lengths.iter().filter(|two| apart(**two)) {
                for share in SHARES {
                    states.push(vec![
                        StateParameters::steady(share * b, one),
                        StateParameters::steady((1.0 - share) * b, two),
                    ]);
                }
            }
        }
        states
    }

    /// The parameters of each record, with one state, and with two.
    pub(crate) fn candidates(&self, model: &Model<'_>) -> Vec<Vec<Parameters>> {
        let (laws, known) = (model.parts[0].laws, &model.parts[0].fixed.parameters);
        // By Nagata's law a velocity step shows a/(1 + c).
        let weights = laws
            .iter()
            .zip(&known.states)
            .map(|(law, state)| match law {
                Evolution::Nagata => state.stress_weight,
                _ => 0.0,
            });
        let direct_effect = self.all.direct_effect * (1.0 + weights.sum::<f64>());
        let mut candidates = Vec::new();
        for factor in factors(model, &STIFFNESSES) {
            for larger in DIRECT_EFFECTS {
                let a = larger * direct_effect;
                for states in self.states(laws, a - self.all.a_minus_b) {
                    let parts = model.parts.iter().zip(&self.each);
                    let candidate = parts.map(|(part, shown)| Parameters {
                        a,
                        states: states.clone(),
                        stiffness: part
                            .known(Parameter::Stiffness)
                            .unwrap_or(factor * shown.stiffness),
                        trend: 0.0,
                        ..part.fixed.parameters.clone()
                    });
                    candidates.push(candidate.collect());
                }
            }
        }
        candidates
    }

    /// Starts with a resolved state in place of one that acts as a direct effect: the fastest one, if its `b` is negative
    /// or its `L` is below the distance of samples. As `L` tends to 0 only `a - b` remains, and iterations from a start far
    /// away end there.
    pub(crate) fn with_resolved_state(
        &self,
        model: &Model<'_>,
        found: &[Parameters],
    ) -> Vec<Vec<Parameters>> {
        let states = &found[0].states;
        let length = |i: &usize| states[*i].slip_distance;
        let fastest = (0..states.len()).min_by(|i, j| length(i).total_cmp(&length(j)));
        let Some(i) = fastest else { return Vec::new() };
        let state = states[i];
        if state.b >= 0.0 && state.slip_distance >= self.all.distances.0 {
            return Vec::new();
        }
        let without = (found[0].a - state.b).abs();
        let mut starts = Vec::new();
        for softer in factors(model, &SOFTER) {
            for share in EFFECTS {
                for slip_distance in self.slip_distances() {
                    let mut start = found.to_vec();
                    for (part, parameters) in model.parts.iter().zip(&mut start) {
                        if part.known(Parameter::Stiffness).is_none() {
                            parameters.stiffness *= softer;
                        }
                        parameters.a = (1.0 + share) * without;
                        parameters.states[i].b = share * without;
                        parameters.states[i].slip_distance = slip_distance;
                    }
                    starts.push(start);
                }
            }
        }
        starts
    }
}
