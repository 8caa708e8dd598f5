//! Starts of a fit, computed from the curves.

use crate::candidates::Shown;
use crate::course::Course;
use crate::model::Model;
use crate::parameter::Parameter;
use crate::parameters::Parameters;
use crate::part::Part;
use crate::point::Point;

/// The local error of curves that are only compared.
const TOLERANCE: f64 = 1e-2;
/// The number of starts with one and with two states.
const STARTS: [usize; 2] = [3, 8];

impl Shown {
    /// The best starts computed from the curves, and the number of those tried.
    pub(crate) fn starts(
        &self,
        model: &Model<'_>,
        bounds: &[(f64, f64)],
        course: &mut Course<'_>,
    ) -> (Vec<Vec<f64>>, usize) {
        let candidates = self.candidates(model);
        let tried = candidates.len();
        let count = STARTS[model.parts[0].laws.len() - 1];
        let guesses = model.parts[0].guesses;
        (
            best(model, bounds, candidates, guesses, count, course),
            tried,
        )
    }

    /// The best starts in place of an end at which a state is not resolved; none if all are.
    pub(crate) fn restarts(
        &self,
        model: &Model<'_>,
        bounds: &[(f64, f64)],
        end: &[Parameters],
        course: &mut Course<'_>,
    ) -> Vec<Vec<f64>> {
        let candidates = self.with_resolved_state(model, end);
        best(model, bounds, candidates, &[], STARTS[0], course)
    }
}

/// The best starts with different slip distances, at most `count`, by their curves; of those so far if it is interrupted.
fn best(
    model: &Model<'_>,
    bounds: &[(f64, f64)],
    candidates: Vec<Vec<Parameters>>,
    guesses: &[(Parameter, f64)],
    count: usize,
    course: &mut Course<'_>,
) -> Vec<Vec<f64>> {
    let mut ranked: Vec<(f64, Vec<Point>)> = Vec::new();
    let mut tried = Vec::new();
    for candidate in candidates {
        let start = model.parts.iter().zip(candidate).map(|(part, candidate)| {
            let mut start = Point::new(candidate);
            let free = |guess: &&(Parameter, f64)| part.free.contains(&guess.0);
            for &(parameter, value) in guesses.iter().filter(free) {
                start.set(parameter, value);
            }
            start
        });
        let start: Vec<Point> = start.collect();
        // Near the critical stiffness curves oscillate, and below it they are records of no experiment.
        let soft = |(part, point): (&Part<'_>, &Point)| {
            let parameters = &point.parameters;
            parameters.critical_stiffness_by(part.laws) >= parameters.stiffness
        };
        if model.parts.iter().zip(&start).any(soft) {
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
        let mut points = model.points(&values);
        let mut squares = 0.0;
        for (part, point) in model.parts.iter().zip(&mut points) {
            squares += match part.change(point, TOLERANCE, course) {
                Ok(change) => level(part, &mut point.parameters, &change),
                Err(_) => f64::INFINITY,
            };
            if squares.is_infinite() {
                break;
            }
        }
        if squares.is_finite() {
            ranked.push((squares, points));
        }
    }
    ranked.sort_by(|one, two| one.0.total_cmp(&two.0));
    let chosen = distinct(ranked, count, !guesses.is_empty());
    chosen.iter().map(|start| model.values(start)).collect()
}

/// The first ones with different slip distances, at most `count`: first different in `a` or `k`, too, and at last in one of
/// these alone if lengths may be guessed.
fn distinct(ranked: Vec<(f64, Vec<Point>)>, count: usize, guessed: bool) -> Vec<Vec<Point>> {
    let lengths = |points: &[Point]| -> Vec<f64> {
        let states = &points[0].parameters.states;
        states.iter().map(|s| s.slip_distance).collect()
    };
    let machine = |points: &[Point]| (points[0].parameters.a, points[0].parameters.stiffness);
    let mut chosen: Vec<Vec<Point>> = Vec::new();
    let passes = if guessed { 3 } else { 2 };
    for pass in 0..passes {
        for (_, start) in &ranked {
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
    chosen
}

/// Sets `mu0` and the trend, where they are fitted, to those of the least squares, and returns their sum.
fn level(part: &Part<'_>, parameters: &mut Parameters, change: &[f64]) -> f64 {
    let record = part.record;
    let [free_level, free_trend] = [Parameter::ReferenceFriction, Parameter::Trend]
        .map(|parameter| part.free.contains(&parameter));
    let rest = |n: usize, parameters: &Parameters| {
        let fixed = parameters.reference_friction + parameters.trend * part.trend[n];
        record.friction()[n] - change[n] - fixed
    };
    let mut sums = [0.0; 5];
    for (n, &weight) in record.weights().iter().enumerate() {
        let (x, y) = (part.trend[n], rest(n, parameters));
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
