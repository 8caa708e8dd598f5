//! Outcomes, counted.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::case::{IntoControlFlow, Label, Outcome};

/// The number of cases by outcome, in all and by section.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct Summary {
    pub(crate) cases: usize,
    pub(crate) outcomes: Counts,
    pub(crate) sections: BTreeMap<&'static str, Section>,
    pub(crate) seconds: f64,
    /// The case that took longest, and its time [s].
    pub(crate) slowest: (String, f64),
}

/// One part of the table.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct Section {
    pub(crate) outcomes: Counts,
    /// The largest residual of what was solved, as a share of what is allowed.
    pub(crate) worst_residual: f64,
}

/// Cases by outcome.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub(crate) struct Counts {
    pub(crate) solved: usize,
    pub(crate) refused: usize,
    pub(crate) reported: usize,
    /// Of these, those that went on with smaller steps.
    pub(crate) resumed: usize,
    pub(crate) defects: usize,
}

impl Counts {
    pub(super) fn of<'a>(verdicts: impl Iterator<Item = &'a IntoControlFlow>) -> Self {
        let mut counts = Self::default();
        for verdict in verdicts {
            *match verdict.outcome {
                Outcome::Solved => &mut counts.solved,
                Outcome::Refused => &mut counts.refused,
                Outcome::Reported => &mut counts.reported,
                Outcome::Defect => &mut counts.defects,
            } += 1;
            counts.resumed += usize::from(verdict.resumed.is_some());
        }
        counts
    }

    pub(crate) fn line(&self) -> String {
        format!(
            "{} solved, {} refused, {} failed and reported ({} of these went on with smaller \
             steps), {} defects",
            self.solved, self.refused, self.reported, self.resumed, self.defects
        )
    }
}

impl Summary {
    pub(crate) fn of(results: &[(Label, IntoControlFlow)], seconds: f64) -> Self {
        let mut sections = BTreeMap::new();
        for (label, _) in results {
            let of_section = || {
                results
                    .iter()
                    .filter(|(l, _)| l.section == label.section)
                    .map(|(_, v)| v)
            };
            sections.entry(label.section).or_insert_with(|| Section {
                outcomes: Counts::of(of_section()),
                worst_residual: worst_residual(
                    of_section().filter(|v| v.outcome == Outcome::Solved),
                ),
            });
        }
        let slowest = results
            .iter()
            .max_by(|(_, x), (_, y)| x.seconds.total_cmp(&y.seconds));
        Self {
            cases: results.len(),
            outcomes: Counts::of(results.iter().map(|(_, verdict)| verdict)),
            sections,
            seconds,
            slowest: slowest.map_or((String::new(), 0.0), |(label, verdict)| {
                (
                    format!("{}, {}, {}", label.extreme, label.method, label.member),
                    verdict.seconds,
                )
            }),
        }
    }
}

/// The largest residual, as a share of what is allowed.
pub(super) fn worst_residual<'a>(verdicts: impl Iterator<Item = &'a IntoControlFlow>) -> f64 {
    verdicts.map(|verdict| verdict.residual).fold(0.0, f64::max)
}
