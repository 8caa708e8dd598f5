//! The tools of the studies: reproducible draws, and a report, whose prose is written by people and whose tables by
//! programs.
//!
//! A table stands between two comments, and nothing else of the file is touched:
//!
//! ```text
//! <!-- table: layer -->
//! | method | 1e-3 |
//! | --- | ---: |
//! <!-- end -->
//! ```

mod draws;

use std::ops::Range;
use std::path::{Path, PathBuf};

pub use draws::Draws;
use stickslip_cli::cli::Problem;

/// The end of every table.
const END: &str = "<!-- end -->";

/// A table with the name of its place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Table {
    /// As in the comment before it.
    pub name: String,
    /// Its lines, in Markdown.
    pub text: String,
}

/// A report with places for these tables.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Report {
    file: PathBuf,
}

impl Report {
    /// Finds the places of all `names`, so that one that is missing is known before anything is
    /// computed.
    ///
    /// # Errors
    /// A file that cannot be read, a place that is missing, not closed or there twice.
    pub fn open<'a>(
        file: &Path,
        names: impl IntoIterator<Item = &'a str>,
    ) -> Result<Self, Problem> {
        let report = Self { file: file.into() };
        let text = report.read()?;
        for name in names {
            place(&text, name).map_err(|problem| report.located(&problem))?;
        }
        Ok(report)
    }

    /// Puts the tables into their places.
    ///
    /// # Errors
    /// Those of [`open`](Self::open), and a file that cannot be written.
    pub fn fill(&self, tables: &[Table]) -> Result<(), Problem> {
        let mut text = self.read()?;
        for table in tables {
            let filled = replaced(&text, &table.name, &table.text);
            text = filled.map_err(|problem| self.located(&problem))?;
        }
        std::fs::write(&self.file, text)
            .map_err(|error| format!("cannot write {}: {error}", self.file.display()).into())
    }

    /// The folder of the file.
    pub fn folder(&self) -> &Path {
        self.file.parent().unwrap_or(Path::new("."))
    }

    fn read(&self) -> Result<String, Problem> {
        std::fs::read_to_string(&self.file)
            .map_err(|error| format!("cannot read {}: {error}", self.file.display()).into())
    }

    fn located(&self, problem: &str) -> String {
        format!("{}: {problem}", self.file.display())
    }
}

/// The text with another table in the place of that name.
fn replaced(text: &str, name: &str, table: &str) -> Result<String, String> {
    let Range { start, end } = place(text, name)?;
    let (before, after) = (&text[..start], &text[end..]);
    Ok(format!("{before}\n{}\n{after}", table.trim_matches('\n')))
}

/// The text between the two comments.
fn place(text: &str, name: &str) -> Result<Range<usize>, String> {
    let comment = format!("<!-- table: {name} -->");
    let mut starts = text.match_indices(&comment);
    let (at, _) = starts.next().ok_or(format!("no {comment}"))?;
    if starts.next().is_some() {
        return Err(format!("{comment} is there twice"));
    }
    let start = at + comment.len();
    let length = text[start..].find(END);
    let inside = length.map(|length| &text[start..start + length]);
    match inside {
        Some(inside) if !inside.contains("<!-- table:") => Ok(start..start + inside.len()),
        _ => Err(format!("no {END} after {comment}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "Prose.\n\n<!-- table: a -->\nold\n<!-- end -->\n\nMore.\n\
        <!-- table: b --><!-- end -->\n<!-- table: open -->\n<!-- table: c -->\n<!-- end -->\n\
        <!-- table: c -->\n<!-- end -->\n";

    #[test]
    fn only_the_place_of_that_name_is_touched() -> Result<(), String> {
        let once = replaced(TEXT, "a", "\n| new |\n")?;
        assert_eq!(once, TEXT.replace("\nold\n", "\n| new |\n"));
        assert_eq!(replaced(&once, "a", "old")?, TEXT);
        let empty = replaced(TEXT, "b", "x")?;
        assert_eq!(empty, TEXT.replace("b --><!-- end", "b -->\nx\n<!-- end"));
        Ok(())
    }

    #[test]
    fn a_place_that_is_missing_open_or_double_is_an_error() {
        let problem = |name| replaced(TEXT, name, "").expect_err("no such place");
        assert_eq!(problem("d"), "no <!-- table: d -->");
        assert_eq!(
            problem("open"),
            "no <!-- end --> after <!-- table: open -->"
        );
        assert_eq!(problem("c"), "<!-- table: c --> is there twice");
    }
}
