//! Frictional healing in slide-hold-slide experiments.

use crate::error::LabError;
use crate::load::LoadHistory;
use crate::record::Record;

/// A hold and the reload behind it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hold {
    /// The begin of the hold \[s\].
    pub start: f64,
    /// The duration \[s\].
    pub duration: f64,
    /// The mean coefficient of friction over the last quarter of the time of the slide before.
    pub level: f64,
    /// The coefficient at the last sample of the hold.
    pub relaxed: f64,
    /// The largest coefficient in the slide behind.
    pub peak: f64,
}

impl Hold {
    /// Frictional healing, the peak minus the level before the hold.
    #[doc(alias = "delta mu")]
    pub fn healing(&self) -> f64 {
        self.peak - self.level
    }

    /// Relaxation, the level before the hold minus the coefficient at its end.
    pub fn relaxation(&self) -> f64 {
        self.level - self.relaxed
    }
}

/// The holds of a record, and their healing rate.
#[derive(Debug, Clone, PartialEq)]
pub struct Healing {
    /// The holds, in order.
    pub holds: Vec<Hold>,
    /// The healing rate: the slope of the healing in the decimal logarithm of the duration, per decade. NaN for less
    /// than two durations.
    #[doc(alias = "beta")]
    pub rate: f64,
    /// Its standard error, for independent errors of equal variance; NaN for less than three holds.
    pub standard_error: f64,
}

impl Healing {
    /// Reads the peaks of a record without a model.
    ///
    /// A hold is slower than a thousandth of the slides around it, and slides that are interrupted by less than a factor of
    /// 1.5 in velocity are one: so are those of a measured displacement. A hold counts if the record has samples in it and in the slides before and behind. The peak is the largest
    /// sample, so that noise increases it: of `n` samples at a flat peak by about `sqrt(2 ln n)` standard deviations. A
    /// fit of the whole record has no such bias.
    ///
    /// # Errors
    /// [`LabError::NoHold`] without a hold.
    ///
    /// ```
    /// use stickslip_lab::{Evolution, Healing, LoadHistory, Parameters, Record};
    /// # let friction = stickslip_friction::DieterichRuina {
    /// #     a: 0.008, b: 0.012, reference_friction: 0.6, reference_velocity: 1e-6, slip_distance: 1.5e-5,
    /// # };
    /// # let parameters = Parameters::one_state(&friction, 1e3);
    ///
    /// let load = LoadHistory::slide_hold_slide(1e-5, &[10.0, 100.0, 1000.0], 3e-4)?;
    /// let times = load.samples(300);
    /// let record = Record::new(times.clone(), parameters.curve(&[Evolution::Aging], &load, &times)?)?;
    /// let healing = Healing::of(&record, &load)?;
    /// assert_eq!(healing.holds.len(), 3);
    /// // The soft machine lets the sample slip while it reloads: less than b ln 10 = 0.028 per decade.
    /// assert!(healing.rate > 0.015 && healing.rate < 0.028);
    /// # Ok::<(), stickslip_lab::LabError>(())
    /// ```
    pub fn of(record: &Record, load: &LoadHistory) -> Result<Self, LabError> {
        let (times, mu) = (record.times(), record.friction());
        let (Some(&first), Some(&last)) = (times.first(), times.last()) else {
            return Err(LabError::NoHold);
        };
        let phases = load.phases(first, last);
        let end_of = |k: usize| phases.get(k + 1).map_or(last, |next| next.start);
        let samples = |k: usize| {
            let from = times.partition_point(|&time| time < phases[k].start);
            from..times.partition_point(|&time| time <= end_of(k)).max(from)
        };
        let mut holds = Vec::new();
        for k in 1..phases.len().saturating_sub(1) {
            let [before, hold, behind] = [k - 1, k, k + 1].map(samples);
            let [slide, rest, reload] = [phases[k - 1], phases[k], phases[k + 1]];
            let moves = slide.velocity > 0.0 && reload.velocity > 0.0;
            if rest.velocity != 0.0 || !moves || before.is_empty() || hold.is_empty() {
                continue;
            }
            // The last sample at least.
            let quarter = rest.start - 0.25 * (rest.start - slide.start);
            let from = times.partition_point(|&time| time < quarter);
            let steady = &mu[from.clamp(before.start, before.end - 1)..before.end];
            let peak = mu[behind].iter().copied().fold(f64::NEG_INFINITY, f64::max);
            if peak.is_finite() {
                holds.push(Hold {
                    start: rest.start,
                    duration: end_of(k) - rest.start,
                    level: steady.iter().sum::<f64>() / steady.len() as f64,
                    relaxed: mu[hold.end - 1],
                    peak,
                });
            }
        }
        if holds.is_empty() {
            return Err(LabError::NoHold);
        }
        let (rate, standard_error) = slope(&holds);
        Ok(Self {
            holds,
            rate,
            standard_error,
        })
    }
}

/// The slope of the healing in the logarithm of the duration, and its standard error.
fn slope(holds: &[Hold]) -> (f64, f64) {
    let count = holds.len() as f64;
    let points = || {
        holds
            .iter()
            .map(|hold| (hold.duration.log10(), hold.healing()))
    };
    let mean = points().fold((0.0, 0.0), |sum, p| {
        (sum.0 + p.0 / count, sum.1 + p.1 / count)
    });
    let (mut xx, mut xy) = (0.0, 0.0);
    for (x, y) in points() {
        xx += (x - mean.0).powi(2);
        xy += (x - mean.0) * (y - mean.1);
    }
    if xx == 0.0 {
        return (f64::NAN, f64::NAN);
    }
    let rate = xy / xx;
    let rest = |(x, y): (f64, f64)| (y - mean.1 - rate * (x - mean.0)).powi(2);
    let freedom = if holds.len() > 2 {
        count - 2.0
    } else {
        f64::NAN
    };
    (
        rate,
        (points().map(rest).sum::<f64>() / freedom / xx).sqrt(),
    )
}
