//! The warnings of a fit.

use crate::end::End;
use crate::fitted::Fitted;
use crate::levels;
use crate::parameter::Parameter;
use crate::score::Score;
use crate::search::Search;
use crate::warning::Warning;

/// The difference of criteria (AIC) that is evidence, by a factor of `exp(5)`. Source: K. P. Burnham, D. R. Anderson,
/// *Model Selection and Multimodel Inference* (2002), Sec. 2.6.
pub(crate) const EVIDENCE: f64 = 10.0;

/// The relative offset of a flat valley: a tenth of a standard error.
const VALLEY: f64 = 0.1;

/// `L` in experiments \[m\]. Source: C. Marone, "Laboratory-derived friction laws and their application to seismic faulting",
/// Annu. Rev. Earth Planet. Sci. 26 (1998).
const EXPERIENCE: (f64, f64) = (1e-6, 1e-4);
/// The factor beyond these at which a unit is doubted: those of lengths differ by a thousand.
const BEYOND: f64 = 10.0;

/// The warnings of a fit for one of its records.
pub(crate) fn warnings(
    fitted: &Fitted,
    search: &Search<'_>,
    values: &[f64],
    end: &End,
    number: usize,
) -> Vec<Warning> {
    let (model, part) = (search.model, &search.model.parts[number]);
    let bounds: Vec<_> = part
        .places
        .iter()
        .map(|&place| search.bounds[place])
        .collect();
    let (statistics, end) = (&end.spread.parts[number], &end.parts[number]);
    let parameters = &fitted.parameters;
    let mut warnings = Vec::new();
    if fitted.interrupted {
        warnings.push(Warning::Interrupted {
            steps: fitted.steps,
            offset: fitted.offset,
        });
    }
    for (k, estimate) in fitted.estimates.iter().enumerate() {
        let parameter = estimate.parameter;
        let scale = match parameter {
            _ if parameter.is_logarithmic() => estimate.value,
            Parameter::B(_) => parameters.a,
            // Levels, slopes, times and the beginning may be zero.
            _ => f64::INFINITY,
        };
        let effect = match parameter {
            Parameter::SlipDistance(i) => {
                let b = Parameter::B(i);
                fitted.value(b).abs() >= 2.0 * fitted.standard_error(b)
            }
            _ => true,
        };
        // Also of an error that is not a number.
        let determined = 2.0 * estimate.standard_error <= scale && effect;
        if !determined {
            warnings.push(Warning::NotDetermined {
                parameter,
                standard_error: estimate.standard_error,
            });
        }
        if values[k] <= bounds[k].0 || values[k] >= bounds[k].1 {
            warnings.push(Warning::AtBound {
                parameter,
                bound: estimate.value,
            });
        }
    }
    let relative = fitted.standard_error(Parameter::A) / parameters.a;
    let (difference, error) = fitted.a_minus_b;
    let vague = relative > 0.1 && error < 0.1 * relative * parameters.a;
    let levels =
        || !fitted.interrupted && levels::aic(model).is_some_and(|aic| aic < fitted.aic + EVIDENCE);
    if vague || levels() {
        warnings.push(Warning::OnlyDifference {
            a_minus_b: difference,
            standard_error: error,
        });
    }
    let slip_distances = || parameters.states.iter().map(|state| state.slip_distance);
    let (least, most) = slip_distances().fold((f64::INFINITY, 0.0_f64), |(least, most), length| {
        (least.min(length), most.max(length))
    });
    let fastest = fitted
        .load
        .iter()
        .fold(0.0_f64, |most, (_, v)| most.max(*v));
    for (i, state) in parameters.states.iter().enumerate() {
        let (parameter, slip_distance) = (Parameter::SlipDistance(i), state.slip_distance);
        let determined = 2.0 * fitted.standard_error(parameter) <= slip_distance;
        if determined && !(EXPERIENCE.0 / BEYOND..=EXPERIENCE.1 * BEYOND).contains(&slip_distance) {
            warnings.push(Warning::Unit {
                parameter,
                slip_distance,
                velocity: fastest,
            });
        }
    }
    let relaxation = parameters.a / parameters.stiffness;
    if relative > 0.1 && relaxation > least {
        warnings.push(Warning::SoftMachine {
            relaxation,
            slip_distance: least,
        });
    }
    let times = part.record.times();
    let (first, last) = (times[0], times[times.len() - 1]);
    let mut ends: Vec<f64> = vec![first];
    ends.extend(part.load.changes(first, last).map(|(time, _)| time));
    ends.push(last);
    let longest = ends[1..]
        .windows(2)
        .map(|pair| part.load.displacement(pair[1]) - part.load.displacement(pair[0]));
    let longest = longest.fold(0.0, f64::max);
    if longest < 3.0 * most {
        warnings.push(Warning::ShortStep {
            displacement: longest,
            slip_distance: most,
        });
    }
    if fitted.offset > VALLEY && !fitted.interrupted {
        warnings.push(Warning::FlatValley {
            offset: fitted.offset,
        });
    }
    // Corners of a measured history are uncertain.
    let (from, to) = (
        part.record.times()[0],
        part.record.times()[fitted.residuals.len() - 1],
    );
    let uncertain = 2.0 * part.load.corner_error(from, to);
    let step_offset = end.tests.step_offset.as_ref();
    let far = |score: &&Score| score.evidence > EVIDENCE && score.estimates[0].0.abs() > uncertain;
    if let Some(score) = step_offset.filter(far) {
        let (offset, standard_error) = score.estimates[0];
        warnings.push(Warning::StepTime {
            offset,
            standard_error,
        });
    }
    if let Some(score) = end
        .tests
        .initial
        .as_ref()
        .filter(|score| score.evidence > EVIDENCE)
    {
        warnings.push(Warning::Transient {
            aic: score.evidence,
        });
    }
    if statistics.correlated && !end.exact {
        warnings.push(Warning::CorrelatedResiduals {
            correlation: fitted.lag_one,
            samples: fitted.effective_samples,
        });
    }
    if let Some(first) = fitted.spikes.first() {
        let sizes = fitted.spikes.iter().map(|spike| spike.residual);
        let largest = sizes.max_by(|one, two| one.abs().total_cmp(&two.abs()));
        warnings.push(Warning::Spikes {
            count: fitted.spikes.len(),
            first: first.time,
            largest: largest.unwrap_or(first.residual),
        });
    }
    let critical = parameters.critical_stiffness_by(part.laws);
    if parameters.stiffness < critical {
        warnings.push(Warning::BelowCritical {
            stiffness: parameters.stiffness,
            critical,
        });
    }
    warnings
}
