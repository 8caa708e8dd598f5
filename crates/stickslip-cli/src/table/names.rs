//! The names of columns, in the lines above the numbers.

use super::TableError;
use super::layout::Layout;

/// The rows above the numbers that have a name for each column, from the last to the first: names, and units below them.
#[derive(Debug, Default)]
pub(super) struct Names {
    rows: Vec<Vec<String>>,
}

impl Names {
    /// The names in lines above rows of `width` numbers; with an index column that has no name, names may be one fewer.
    pub(super) fn of(above: &[&str], layout: Layout, width: usize, indexed: bool) -> Self {
        let row = |line: &&str| {
            let line = line.trim_start_matches(['#', '%', ' ', '\t']);
            let regular: Vec<String> = (layout.records(&[line]).first())
                .map(|record| record.iter().map(unquoted).collect())
                .unwrap_or_default();
            let ways = [
                regular,
                line.split(['\t', ';', ',']).map(unquoted).collect(),
                line.split("  ")
                    .filter(|part| !part.trim().is_empty())
                    .map(unquoted)
                    .collect(),
                without_units(line)
                    .split_whitespace()
                    .map(unquoted)
                    .collect(),
            ];
            ways.into_iter().find_map(|mut names| {
                while names.len() > width && names.last().is_some_and(String::is_empty) {
                    names.pop();
                }
                if indexed && names.len() + 1 == width {
                    names.insert(0, String::new());
                }
                let any = names.iter().any(|name| !name.is_empty());
                (any && names.len() == width).then_some(names)
            })
        };
        Self {
            rows: above.iter().rev().filter_map(row).collect(),
        }
    }

    /// The position of the column of this name: as it is written, without regard to case, or without its unit in brackets.
    /// `None` without one.
    pub(super) fn position(&self, file: &str, name: &str) -> Result<Option<usize>, TableError> {
        let plain = |text: &str| without_units(text).trim().to_lowercase();
        let wanted = plain(name);
        let ways: [&dyn Fn(&String) -> bool; 3] = [
            &|other| other == name,
            &|other| other.eq_ignore_ascii_case(name),
            &|other| !wanted.is_empty() && plain(other) == wanted,
        ];
        for row in &self.rows {
            for way in ways {
                let mut found =
                    (row.iter().enumerate()).filter_map(|(k, other)| way(other).then_some(k));
                match (found.next(), found.next()) {
                    (Some(one), Some(other)) => {
                        return Err(TableError::Twice {
                            file: file.into(),
                            column: name.into(),
                            places: (one + 1, other + 1),
                        });
                    }
                    (Some(one), None) => return Ok(Some(one)),
                    (None, _) => {}
                }
            }
        }
        Ok(None)
    }

    /// The row with the longest names, for messages.
    pub(super) fn longest(&self) -> Vec<String> {
        let length = |row: &&Vec<String>| row.iter().map(String::len).sum::<usize>();
        // Of equal ones the nearest to the numbers.
        let longest = self.rows.iter().rev().max_by_key(length);
        longest.cloned().unwrap_or_default()
    }
}

fn unquoted(text: &str) -> String {
    text.trim().trim_matches(['"', '\'']).trim().to_owned()
}

/// A text without parts in brackets.
fn without_units(text: &str) -> String {
    let mut depth = 0_usize;
    let kept = text.chars().filter(|c| match c {
        '(' | '[' => {
            depth += 1;
            false
        }
        ')' | ']' => {
            depth = depth.saturating_sub(1);
            false
        }
        _ => depth == 0,
    });
    kept.collect()
}
