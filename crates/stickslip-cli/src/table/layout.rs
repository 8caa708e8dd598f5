//! How the cells of a table stand: what separates them, and what their decimals.

use std::borrow::Cow;
use std::collections::BTreeMap;

use csv::{ReaderBuilder, StringRecord, Trim};

use super::cell::{Cell, cell};

/// What separates cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Delimiter {
    /// A character.
    Character(u8),
    /// One or more blanks or tabs.
    Blanks,
}

impl Delimiter {
    const ALL: [Self; 4] = [
        Self::Character(b'\t'),
        Self::Character(b';'),
        Self::Character(b','),
        Self::Blanks,
    ];

    /// Reads `comma`, `semicolon`, `tab`, `blanks`, or a character.
    ///
    /// # Errors
    /// In words: the text is none of these.
    pub fn parse(text: &str) -> Result<Self, String> {
        match (text, text.as_bytes()) {
            ("comma", _) => Ok(Self::Character(b',')),
            ("semicolon", _) => Ok(Self::Character(b';')),
            ("tab" | "\\t", _) => Ok(Self::Character(b'\t')),
            ("blanks" | "blank" | " ", _) => Ok(Self::Blanks),
            (_, &[byte]) if !byte.is_ascii_alphanumeric() && !b"\"'\n\r.+-".contains(&byte) => {
                Ok(Self::Character(byte))
            }
            _ => Err("must be comma, semicolon, tab, blanks or a sign such as |".into()),
        }
    }
}

/// The layout of a table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Layout {
    delimiter: Delimiter,
    /// Whether quotation marks enclose cells: each line then is a record of its own.
    quoted: bool,
    decimal: char,
}

/// The lines by which a layout is judged.
pub(super) const JUDGED: usize = 1000;

impl Layout {
    /// The layout in which most cells of the lines are numbers and fewest text, and the number of cells of the rows of
    /// numbers; `None` if no line holds a number. With a given delimiter, or each.
    ///
    /// A comma separates cells rather than decimals where both are possible.
    pub(super) fn of(lines: &[&str], delimiter: Option<Delimiter>) -> Option<(Self, usize)> {
        let stride = lines.len().div_ceil(JUDGED).max(1);
        let judged: Vec<&str> = lines.iter().copied().step_by(stride).collect();
        let marked = lines.iter().any(|line| line.contains('"'));
        let delimiters = delimiter.map_or(Delimiter::ALL.to_vec(), |one| vec![one]);
        let mut best: Option<(i64, Self, usize)> = None;
        for decimal in ['.', ','] {
            for &delimiter in &delimiters {
                let mut layout = Self {
                    delimiter,
                    quoted: marked,
                    decimal,
                };
                // Marks that do not close in their line, such as those of inches, enclose nothing.
                layout.quoted &= layout.records(lines).len() == lines.len();
                if let Some((score, width)) = layout.score(&judged)
                    && best.is_none_or(|(most, ..)| score > most)
                {
                    best = Some((score, layout, width));
                }
            }
        }
        best.map(|(_, layout, width)| (layout, width))
    }

    /// The numbers less the texts beside them in rows of one width, and that width without cells at the end that are always empty:
    /// of the width with most.
    fn score(&self, lines: &[&str]) -> Option<(i64, usize)> {
        #[derive(Default)]
        struct Rows {
            score: i64,
            numbers: i64,
            used: usize,
        }
        let mut widths = BTreeMap::<usize, Rows>::new();
        for record in self.records(lines) {
            let rows = widths.entry(record.len()).or_default();
            let (mut numbers, mut texts) = (0, 0);
            for (k, text) in record.iter().enumerate() {
                match self.cell(text) {
                    Cell::Empty => continue,
                    Cell::Text => texts += 1,
                    Cell::Number(_) => numbers += 1,
                }
                rows.used = rows.used.max(k + 1);
            }
            // Texts alone are names or a preamble.
            if numbers > 0 {
                rows.numbers += numbers;
                rows.score += numbers - texts;
            }
        }
        let rows = widths.into_values().filter(|rows| rows.numbers > 0);
        let best = rows.max_by_key(|rows| rows.score)?;
        Some((best.score, best.used))
    }

    /// The cells of lines, one record a line.
    pub(super) fn records(&self, lines: &[&str]) -> Vec<StringRecord> {
        let text: Cow<'_, str> = match self.delimiter {
            Delimiter::Character(_) => lines.join("\n").into(),
            Delimiter::Blanks => {
                let mut text = String::new();
                for line in lines {
                    for (k, part) in line.split_whitespace().enumerate() {
                        if k > 0 {
                            text.push('\t');
                        }
                        text.push_str(part);
                    }
                    text.push('\n');
                }
                text.into()
            }
        };
        let delimiter = match self.delimiter {
            Delimiter::Character(byte) => byte,
            Delimiter::Blanks => b'\t',
        };
        let mut reader = ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .quoting(self.quoted)
            .delimiter(delimiter)
            .trim(Trim::All)
            .from_reader(text.as_bytes());
        // Text in memory and in UTF-8, with rows of any length: nothing is left that could fail.
        reader.records().map_while(Result::ok).collect()
    }

    /// A cell in this layout.
    pub(super) fn cell(&self, text: &str) -> Cell {
        cell(text, self.decimal)
    }
}
