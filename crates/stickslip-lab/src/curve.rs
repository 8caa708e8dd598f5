//! Friction over time: the solution of the model at the samples.

use crate::course::Course;
use crate::error::LabError;
use crate::evolution::Evolution;
use crate::law::Law;
use crate::load::LoadHistory;
use crate::parameters::Parameters;
use crate::point::Point;
use crate::system::{System, Unknowns, column};

/// The largest number of steps without a sample or a velocity step between: more indicate a slip instability.
const MAX_STEPS: usize = 20_000;
/// The bounds of the change of a step's length, and the share of the length that the error allows (Hairer and Wanner,
/// Sec. IV.8).
const SHRINK: f64 = 0.2;
const GROW: f64 = 6.0;
const SAFETY: f64 = 0.9;

/// The work of integrations.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Work {
    /// The number of curves.
    pub integrations: usize,
    /// The number of steps of the integrator, rejected ones included; each evaluates 6 right-hand sides.
    pub steps: usize,
}

/// `m = mu - mu0` at ascending times, and its derivatives in the columns from 1 on, for `N - 1` states.
///
/// The times are those of the load history. The block is in steady sliding with the load point before the first one, or
/// begins as the point says. `tolerance` is the local error of a step
/// in `ln V` and in each `ln theta`.
pub(crate) fn curve<const N: usize, const W: usize>(
    laws: &[Evolution<'_>],
    point: &Point,
    load: &LoadHistory,
    times: &[f64],
    tolerance: f64,
    course: &mut Course<'_>,
) -> Result<Vec<[f64; W]>, LabError> {
    let Some((&first, &last)) = times.first().zip(times.last()) else {
        return Ok(Vec::new());
    };
    let parameters = &point.parameters;
    let v0 = parameters.reference_velocity;
    let mut system = system(laws, parameters);
    system.load = load.velocity_before(first) / v0;
    let mut y = start::<N, W>(&system, point)?;
    course.begin_curve()?;
    let mut rows = Vec::with_capacity(times.len());
    let ends = load
        .changes(first, last)
        .map(|(time, velocity)| (time, Some(velocity)));
    let mut time = first;
    for (end, velocity) in ends.chain([(last, None)]) {
        // Times are large, and the steps behind a velocity step small.
        let (mut since, length) = (0.0, end - time);
        let mut h = (tolerance.powf(0.25) / system.speed(&y)).min(length);
        let mut steps = 0;
        while since < length {
            if since + h >= length * (1.0 - f64::EPSILON) {
                h = length - since;
            }
            let step = system.step(&y, h);
            let error = step.error / tolerance;
            steps += 1;
            course.count_step()?;
            let factor = if error.is_finite() {
                (SAFETY / error.powf(0.25)).clamp(SHRINK, GROW)
            } else {
                SHRINK
            };
            if error <= 1.0 {
                let to = if since + h >= length {
                    length
                } else {
                    since + h
                };
                while let Some(&sample) = times.get(rows.len()) {
                    let ahead = sample - time;
                    if ahead > to {
                        break;
                    }
                    let share = ((ahead - since) / h).clamp(0.0, 1.0);
                    rows.push(step.at(&y[0], share));
                    steps = 0;
                }
                y = step.end;
                since = to;
                h *= factor;
            } else {
                h *= factor.min(SAFETY);
            }
            if steps > MAX_STEPS || since + h <= since {
                return Err(LabError::Unstable {
                    time: time + since,
                    stiffness: parameters.stiffness,
                });
            }
        }
        time = end;
        if let Some(velocity) = velocity {
            system.load = velocity / v0;
        }
    }
    // A single time, or samples at one end.
    while rows.len() < times.len() {
        rows.push(y[0]);
    }
    Ok(rows)
}

fn system<const N: usize>(laws: &[Evolution<'_>], parameters: &Parameters) -> System<N> {
    let v0 = parameters.reference_velocity;
    let states = &parameters.states;
    System {
        a: parameters.a,
        b: std::array::from_fn(|i| if i == 0 { 0.0 } else { states[i - 1].b }),
        rate: std::array::from_fn(|i| {
            if i == 0 {
                0.0
            } else {
                v0 / states[i - 1].slip_distance
            }
        }),
        laws: (laws.iter().enumerate())
            .map(|(i, &law)| Law::new(law, &parameters.friction(i), &states[i]))
            .collect(),
        weakening: std::array::from_fn(|i| match laws.get(i.wrapping_sub(1)) {
            Some(Evolution::Nagata) => states[i - 1].stress_weight / states[i - 1].b,
            _ => 0.0,
        }),
        stiffness: parameters.stiffness * v0,
        load: 0.0,
    }
}

/// The unknowns at the first sample.
fn start<const N: usize, const W: usize>(
    system: &System<N>,
    point: &Point,
) -> Result<Unknowns<N, W>, LabError> {
    let w = system.load.ln();
    let mut y = [[0.0; W]; N];
    y[0][0] = system.a * w + point.initial_stress;
    for i in 1..N {
        let state = point.parameters.states[i - 1].initial_state;
        let (steady, by_parameter) = system.laws[i - 1].steady(w)?;
        y[i][0] = steady + state;
        y[0][0] += system.b[i] * y[i][0];
        if W > column::law::<N>(1) {
            y[i][column::law::<N>(i)] = by_parameter;
            y[0][column::law::<N>(i)] = system.b[i] * by_parameter;
        }
    }
    if W > 1 {
        y[0][column::A] = w;
        for i in 1..N {
            y[0][column::b(i)] = y[i][0];
        }
    }
    if W > column::initial_state::<N>(1) {
        for i in 1..N {
            y[0][column::initial_state::<N>(i)] = system.b[i];
            y[i][column::initial_state::<N>(i)] = 1.0;
        }
        y[0][column::initial_stress::<N>()] = 1.0;
    }
    Ok(y)
}
