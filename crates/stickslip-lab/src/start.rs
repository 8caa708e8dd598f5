//! Starts of a fit, computed from the curve.

use crate::curve::Work;
use crate::evolution::Evolution;
use crate::features::Features;
use crate::model::Model;
use crate::parameter::Parameter;
use crate::parameters::{Parameters, StateParameters};
use crate::point::Point;

/// The local error of curves that are only compared.
const TOLERANCE: f64 = 1e-2;
/// The factors on the direct effect that the curve shows: a soft machine shows less than `a`.
const DIRECT_EFFECTS: [f64; 3] = [0.7, 1.5, 3.0];
/// The factors on the steepest rise of the curve, which is less steep than the machine's.
const STIFFNESSES: [f64; 2] = [1.0, 2.0];
/// The ratio of neighbouring slip distances.
const RATIO: f64 = 2.5;
/// The shares of the first of two states in `b1 + b2`.
const SHARES: [f64; 3] = [0.3, 0.7, 1.3];
/// The number of starts with one and with two states.
const STARTS: [usize; 2] = [3, 8];
/// The evolution effect over `a - b`, and the factors on a stiffness that was fitted without one.
const EFFECTS: [f64; 2] = [0.3, 1.0];
const SOFTER: [f64; 2] = [1.0, 0.8];

impl Features {
    /// Slip distances from twice the distance of the samples to the length of a piece.
    fn slip_distances(&self) -> Vec<f64> {
        let (low, high) = (2.0 * self.distances.0, self.distances.1);
        let count = ((high / low).ln() / RATIO.ln()).ceil().clamp(1.0, 12.0) as i32;
        let ratio = (high / low).powf(1.0 / f64::from(count));
        (0..=count).map(|k| low * ratio.powi(k)).collect()
    }

    /// Parameters with one state, and with two.
    fn candidates(&self, model: &Model<'_>) -> Vec<Parameters> {
        let stiffnesses = if model.free.contains(&Parameter::Stiffness) {
            STIFFNESSES
                .iter()
                .map(|factor| factor * self.stiffness)
                .collect()
        } else {
            vec![model.fixed.parameters.stiffness]
        };
        let lengths = self.slip_distances();
        // By Nagata's law a velocity step shows a/(1 + c).
        let weights = model.laws.iter().zip(&model.fixed.parameters.states);
        let weights = weights.map(|(law, state)| match law {
            Evolution::Nagata => state.stress_weight,
            _ => 0.0,
        });
        let direct_effect = self.direct_effect * (1.0 + weights.sum::<f64>());
        let mut candidates = Vec::new();
        for stiffness in stiffnesses {
            for larger in DIRECT_EFFECTS {
                let a = larger * direct_effect;
                let b = a - self.a_minus_b;
                let mut add = |states: Vec<StateParameters>| {
                    candidates.push(Parameters {
                        a,
                        states,
                        stiffness,
                        trend: 0.0,
                        ..model.fixed.parameters.clone()
                    });
                };
                for &one in &lengths {
                    if model.laws.len() == 1 {
                        add(vec![StateParameters::steady(b, one)]);
                        continue;
                    }
                    // Two different laws can have either order.
                    let ordered = model.laws[0].name() == model.laws[1].name();
                    let apart = |two: f64| two > RATIO * one || (!ordered && one > RATIO * two);
                    for &two in lengths.iter().filter(|two| apart(**two)) {
                        for share in SHARES {
                            add(vec![
                                StateParameters::steady(share * b, one),
                                StateParameters::steady((1.0 - share) * b, two),
                            ]);
                        }
                    }
                }
            }
        }
        candidates
    }

    /// Starts with a resolved state in place of one that acts as a direct effect: the fastest one, if its `b` is negative
    /// or its `L` is below the distance of samples. As `L` tends to 0 only `a - b` remains, and iterations from a start far
    /// away end there.
    fn with_resolved_state(&self, model: &Model<'_>, found: &Parameters) -> Vec<Parameters> {
        let length = |i: &usize| found.states[*i].slip_distance;
        let fastest = (0..found.states.len()).min_by(|i, j| length(i).total_cmp(&length(j)));
        let Some(i) = fastest else { return Vec::new() };
        let state = found.states[i];
        if state.b >= 0.0 && state.slip_distance >= self.distances.0 {
            return Vec::new();
        }
        let without = (found.a - state.b).abs();
        let stiffnesses: &[f64] = match model.known(Parameter::Stiffness) {
            Some(_) => &[1.0],
            None => &SOFTER,
        };
        let mut starts = Vec::new();
        for softer in stiffnesses {
            for share in EFFECTS {
                for slip_distance in self.slip_distances() {
                    let mut start = found.clone();
                    start.stiffness *= softer;
                    start.a = (1.0 + share) * without;
                    start.states[i].b = share * without;
                    start.states[i].slip_distance = slip_distance;
                    starts.push(start);
                }
            }
        }
        starts
    }

    /// The best starts computed from the curve, and the number of those tried.
    pub(crate) fn starts(
        &self,
        model: &Model<'_>,
        bounds: &[(f64, f64)],
        work: &mut Work,
    ) -> (Vec<Vec<f64>>, usize) {
        let candidates = self.candidates(model);
        let tried = candidates.len();
        let count = STARTS[model.laws.len() - 1];
        let guesses = model.guesses;
        (best(model, bounds, candidates, guesses, count, work), tried)
    }

    /// The best starts in place of an end at which a state is not resolved; none if all are.
    pub(crate) fn restarts(
        &self,
        model: &Model<'_>,
        bounds: &[(f64, f64)],
        end: &Parameters,
        work: &mut Work,
    ) -> Vec<Vec<f64>> {
        let candidates = self.with_resolved_state(model, end);
        best(model, bounds, candidates, &[], STARTS[0], work)
    }
}

/// The best starts with different slip distances, at most `count`, by their curves.
fn best(
    model: &Model<'_>,
    bounds: &[(f64, f64)],
    candidates: Vec<Parameters>,
    guesses: &[(Parameter, f64)],
    count: usize,
    work: &mut Work,
) -> Vec<Vec<f64>> {
    let mut ranked: Vec<(f64, Point)> = Vec::new();
    let mut tried = Vec::new();
    for candidate in candidates {
        let mut start = Point::new(candidate);
        let free = |guess: &&(Parameter, f64)| model.free.contains(&guess.0);
        for &(parameter, value) in guesses.iter().filter(free) {
            start.set(parameter, value);
        }
        // Near the critical stiffness curves oscillate, and below it they are records of no experiment.
        if start.parameters.critical_stiffness_by(model.laws) >= start.parameters.stiffness {
            continue;
        }
        // Candidates that differ in guessed parameters alone are the same start.
        if !guesses.is_empty() {
            if tried.contains(&start) {
                continue;
            }
            tried.push(start.clone());
        }
        let mut values = model.values(&start);
        for (value, &(low, high)) in values.iter_mut().zip(bounds) {
            *value = value.clamp(low, high);
        }
        let mut point = model.point(&values);
        if let Ok(change) = model.change(&point, TOLERANCE, work) {
            let squares = level(model, &mut point.parameters, &change);
            if squares.is_finite() {
                ranked.push((squares, point));
            }
        }
    }
    ranked.sort_by(|one, two| one.0.total_cmp(&two.0));
    let lengths = |point: &Point| -> Vec<f64> {
        let states = &point.parameters.states;
        states.iter().map(|s| s.slip_distance).collect()
    };
    let mut chosen: Vec<Point> = Vec::new();
    // First different in `a` or `k`, too; lengths that are guessed are the same.
    let passes = if guesses.is_empty() { 2 } else { 3 };
    for pass in 0..passes {
        for (_, start) in &ranked {
            let machine = |point: &Point| (point.parameters.a, point.parameters.stiffness);
            let new = chosen.iter().all(|other| {
                let length = lengths(other) != lengths(start);
                let machine = machine(other) != machine(start);
                match pass {
                    0 => length && machine,
                    1 => length,
                    _ => length || machine,
                }
            });
            if new && chosen.len() < count {
                chosen.push(start.clone());
            }
        }
    }
    chosen.iter().map(|start| model.values(start)).collect()
}

/// Sets `mu0` and the trend, where they are fitted, to those of the least squares, and returns their sum.
fn level(model: &Model<'_>, parameters: &mut Parameters, change: &[f64]) -> f64 {
    let record = model.record;
    let [free_level, free_trend] = [Parameter::ReferenceFriction, Parameter::Trend]
        .map(|parameter| model.free.contains(&parameter));
    let rest = |n: usize, parameters: &Parameters| {
        let fixed = parameters.reference_friction + parameters.trend * model.trend[n];
        record.friction()[n] - change[n] - fixed
    };
    let mut sums = [0.0; 5];
    for (n, &weight) in record.weights().iter().enumerate() {
        let (x, y) = (model.trend[n], rest(n, parameters));
        for (sum, term) in sums.iter_mut().zip([1.0, x, x * x, y, x * y]) {
            *sum += weight * term;
        }
    }
    let [count, x, xx, y, xy] = sums;
    let determinant = count * xx - x * x;
    if free_level && free_trend && determinant > 0.0 {
        parameters.reference_friction += (y * xx - x * xy) / determinant;
        parameters.trend += (count * xy - x * y) / determinant;
    } else if free_level {
        parameters.reference_friction += y / count;
    } else if free_trend {
        parameters.trend += xy / xx;
    }
    let squares = record.weights().iter().enumerate();
    squares
        .map(|(n, weight)| weight * rest(n, parameters).powi(2))
        .sum()
}
