//! The table of all cases, one line for those that differ in laws alone.

use std::collections::BTreeMap;
use std::fmt::Write;

use serde::Serialize;

use crate::case::{Label, Outcome, Verdict};

/// The cases of one line.
struct Line<'a> {
    label: &'a Label,
    members: Vec<(&'a Label, &'a Verdict)>,
}

impl Line<'_> {
    fn count(&self, outcome: Outcome) -> usize {
        let all = self.members.iter();
        all.filter(|(_, verdict)| verdict.outcome == outcome)
            .count()
    }

    fn outcomes(&self) -> String {
        let names = [
            (Outcome::Defect, "**DEFECT**"),
            (Outcome::Solved, "solved"),
            (Outcome::Refused, "refused"),
            (Outcome::Reported, "failed, reported"),
        ];
        let counted: Vec<String> = names
            .iter()
            .map(|&(outcome, name)| (self.count(outcome), name))
            .filter(|&(count, _)| count > 0)
            .map(|(count, name)| format!("{name} {count}"))
            .collect();
        counted.join(", ")
    }

    /// The error of the worst member, the first of its kind.
    fn remark(&self) -> String {
        let worst = self
            .members
            .iter()
            .rev()
            .max_by_key(|(_, verdict)| verdict.outcome);
        let Some((label, verdict)) = worst.filter(|(_, verdict)| !verdict.text.is_empty()) else {
            return String::new();
        };
        let reported = || {
            self.members
                .iter()
                .filter(|(_, v)| v.outcome == Outcome::Reported)
        };
        let resumed = reported().filter(|(_, v)| v.resumed.is_some()).count();
        let on = match (reported().count(), resumed) {
            (0, _) => String::new(),
            (all, resumed) => format!("; {resumed} of {all} went on with smaller steps"),
        };
        format!("{}: {}{on}", label.member, verdict.text)
    }
}

fn lines(results: &[(Label, Verdict)]) -> Vec<Line<'_>> {
    let mut lines: Vec<Line<'_>> = Vec::new();
    let mut places = BTreeMap::new();
    for (label, verdict) in results {
        let key = (label.section, &label.extreme, &label.method);
        let place = *places.entry(key).or_insert_with(|| {
            lines.push(Line {
                label,
                members: Vec::new(),
            });
            lines.len() - 1
        });
        lines[place].members.push((label, verdict));
    }
    lines
}

/// The table, in Markdown.
pub(crate) fn table(results: &[(Label, Verdict)]) -> String {
    let mut text = String::new();
    let mut section = "";
    for line in lines(results) {
        if line.label.section != section {
            section = line.label.section;
            // Writing to a string does not fail.
            let _ = writeln!(
                text,
                "\n## {}\n\n| extreme | method | outcome | iterations | residual | remark |\n| --- | --- | --- | --- | --- | --- |",
                capitalised(section)
            );
        }
        let of =
            |f: fn(&Verdict) -> usize| line.members.iter().map(|(_, v)| f(v)).max().unwrap_or(0);
        let (coupling, solver) = (of(|v| v.iterations.0), of(|v| v.iterations.1));
        let iterations = match (coupling, solver) {
            (0, 0) => String::new(),
            (steps, 0) => format!("{steps}"),
            (coupling, solver) => format!("{coupling} / {solver}"),
        };
        let _ = writeln!(
            text,
            "| {} | {} | {} | {iterations} | {:.1e} | {} |",
            line.label.extreme,
            line.label.method,
            line.outcomes(),
            worst_residual(line.members.iter().map(|&(_, verdict)| verdict)),
            line.remark().replace('|', "/"),
        );
    }
    text
}

fn worst_residual<'a>(verdicts: impl Iterator<Item = &'a Verdict>) -> f64 {
    verdicts.map(|verdict| verdict.residual).fold(0.0, f64::max)
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| {
        first.to_uppercase().chain(letters).collect()
    })
}

/// How often each outcome was met, in all and by section.
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
    fn of<'a>(verdicts: impl Iterator<Item = &'a Verdict>) -> Self {
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
            "{} solved, {} refused, {} failed and reported ({} of these went on with smaller steps), {} defects",
            self.solved, self.refused, self.reported, self.resumed, self.defects
        )
    }
}

impl Summary {
    pub(crate) fn of(results: &[(Label, Verdict)], seconds: f64) -> Self {
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
