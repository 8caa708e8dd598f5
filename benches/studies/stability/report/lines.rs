//! Cases that differ in laws alone share a line.

use std::collections::BTreeMap;

use super::Counts;
use crate::case::{IntoControlFlow, Label, Outcome};

/// The cases of one line.
pub(super) struct Line<'a> {
    pub(super) label: &'a Label,
    members: Vec<(&'a Label, &'a IntoControlFlow)>,
}

impl<'a> Line<'a> {
    pub(super) fn verdicts(&self) -> impl Iterator<Item = &'a IntoControlFlow> {
        self.members.iter().map(|&(_, verdict)| verdict)
    }

    /// The number of cases by outcome, and the most iterations of a step.
    pub(super) fn cell(&self) -> String {
        let counts = Counts::of(self.verdicts());
        let named = [
            (counts.solved, ""),
            (counts.refused, " refused"),
            (counts.reported, " failed"),
            (counts.defects, " **defects**"),
        ];
        let named = named.iter().filter(|&&(count, _)| count > 0);
        let outcomes: Vec<String> = named
            .map(|(count, name)| format!("{count}{name}"))
            .collect();
        format!("{}{}", outcomes.join(", "), self.iterations())
    }

    fn iterations(&self) -> String {
        let most = |of: fn(&IntoControlFlow) -> usize| self.verdicts().map(of).max().unwrap_or(0);
        match (most(|v| v.iterations.0), most(|v| v.iterations.1)) {
            (0, 0) => String::new(),
            (steps, 0) => format!(" ({steps})"),
            (coupling, solver) => format!(" ({coupling} / {solver})"),
        }
    }

    /// The first of the members with the worst outcome, unless all were solved.
    pub(super) fn worst(&self) -> Option<(&'a Label, &'a IntoControlFlow)> {
        let members = self.members.iter().rev().copied();
        let worst = members.max_by_key(|(_, verdict)| verdict.outcome);
        worst.filter(|(_, verdict)| verdict.outcome != Outcome::Solved)
    }
}

/// The lines of a section, in the order of their first cases.
pub(super) fn lines<'a>(results: &'a [(Label, IntoControlFlow)], section: &str) -> Vec<Line<'a>> {
    let mut lines: Vec<Line<'a>> = Vec::new();
    let mut places = BTreeMap::new();
    for (label, verdict) in results.iter().filter(|(label, _)| label.section == section) {
        let place = *places
            .entry((&label.extreme, &label.method))
            .or_insert(lines.len());
        if place == lines.len() {
            let members = Vec::new();
            lines.push(Line { label, members });
        }
        lines[place].members.push((label, verdict));
    }
    lines
}
