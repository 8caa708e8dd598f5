//! The tables of the report.

mod counts;
mod lines;

use std::fmt::Write;

use stickslip_studies::Table;

use crate::case::{IntoControlFlow, Label, Outcome};
pub(crate) use counts::Summary;
use counts::{Counts, worst_residual};
use lines::{Line, lines};

/// The name of the table of all outcomes.
pub(crate) const OUTCOMES: &str = "outcomes";

/// The names of the tables of a section.
pub(crate) fn names(section: &str) -> [String; 2] {
    [section.into(), format!("{section}, not solved")]
}

/// The tables of a section: all its cases, and what was not solved.
pub(crate) fn section_tables(results: &[(Label, IntoControlFlow)], section: &str) -> Vec<Table> {
    let lines = lines(results, section);
    let texts = [section_table(&lines), unsolved_table(&lines)];
    let tables = names(section).into_iter().zip(texts);
    tables.map(|(name, text)| Table { name, text }).collect()
}

/// The table of all outcomes, by section and method.
pub(crate) fn outcomes(results: &[(Label, IntoControlFlow)]) -> Table {
    let mut text = header(&[
        "part", "method", "solved", "refused", "failed", "went on", "residual", "time [s]",
    ]);
    for (section, method) in distinct(results.iter().map(|(l, _)| (l.section, l.method.as_str()))) {
        let members = || {
            let all = results.iter();
            let all = all.filter(move |(l, _)| (l.section, l.method.as_str()) == (section, method));
            all.map(|(_, verdict)| verdict)
        };
        write_row(&mut text, [section, method], outcome_row(members));
    }
    let all = || results.iter().map(|(_, verdict)| verdict);
    write_row(&mut text, ["all", ""], outcome_row(all));
    let name = OUTCOMES.into();
    Table { name, text }
}

fn outcome_row<'a, I: Iterator<Item = &'a IntoControlFlow>>(
    members: impl Fn() -> I,
) -> Vec<String> {
    let counts = Counts::of(members());
    let solved = members().filter(|verdict| verdict.outcome == Outcome::Solved);
    let longest = members().map(|verdict| verdict.seconds).fold(0.0, f64::max);
    vec![
        counts.solved.to_string(),
        counts.refused.to_string(),
        counts.reported.to_string(),
        counts.resumed.to_string(),
        format!("{:.1e}", worst_residual(solved)),
        format!("{longest:.1}"),
    ]
}

/// A table of extreme quantities (rows) and methods (columns).
fn section_table(lines: &[Line<'_>]) -> String {
    let methods = distinct(lines.iter().map(|line| line.label.method.as_str()));
    let titles = ["extreme"].iter().chain(&methods).chain(&["residual"]);
    let mut text = header(&titles.copied().collect::<Vec<_>>());
    for extreme in distinct(lines.iter().map(|line| line.label.extreme.as_str())) {
        let of_extreme = || lines.iter().filter(|line| line.label.extreme == extreme);
        let cell = |method: &&str| {
            let line = of_extreme().find(|line| line.label.method == *method);
            line.map_or(String::new(), Line::cell)
        };
        let mut cells: Vec<String> = methods.iter().map(cell).collect();
        let residual = worst_residual(of_extreme().flat_map(Line::verdicts));
        cells.push(format!("{residual:.1e}"));
        write_row(&mut text, [extreme], cells);
    }
    text
}

/// The worst member of each line that was not solved throughout, with its error.
fn unsolved_table(lines: &[Line<'_>]) -> String {
    let mut text = header(&[
        "extreme",
        "method",
        "not solved",
        "went on",
        "worst",
        "error",
    ]);
    if lines.iter().all(|line| line.worst().is_none()) {
        return "All cases are solved.".into();
    }
    for line in lines {
        let counts = Counts::of(line.verdicts());
        let Some((label, verdict)) = line.worst() else {
            continue;
        };
        let cells = vec![
            (counts.refused + counts.reported + counts.defects).to_string(),
            counts.resumed.to_string(),
            label.member.clone(),
            verdict.text.replace('|', "/"),
        ];
        write_row(&mut text, [&line.label.extreme, &line.label.method], cells);
    }
    text
}

fn header(titles: &[&str]) -> String {
    let rule = " --- |".repeat(titles.len());
    format!("| {} |\n|{rule}\n", titles.join(" | "))
}

fn write_row<const N: usize>(text: &mut String, names: [&str; N], cells: Vec<String>) {
    let names = names.map(String::from).into_iter();
    let cells: Vec<String> = names.chain(cells).collect();
    // Writing to a string does not fail.
    let _ = writeln!(text, "| {} |", cells.join(" | "));
}

/// Each of them once, in the order of first appearance.
fn distinct<T: PartialEq>(all: impl Iterator<Item = T>) -> Vec<T> {
    let mut distinct = Vec::new();
    for one in all {
        if !distinct.contains(&one) {
            distinct.push(one);
        }
    }
    distinct
}
