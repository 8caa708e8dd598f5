//! Words and numbers of a file, as text or in binary.

use std::str::FromStr;

use crate::{FilePlace, ReadError};

/// The end of a section, as expected in an error.
const END: &str = "the end of a section";

/// The encoding of numbers outside the parts that are text in any file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

/// A position in the bytes of a file. Reads never exceed its length.
#[derive(Clone)]
pub(super) struct Cursor<'a> {
    bytes: &'a [u8],
    position: usize,
    pub(super) encoding: Encoding,
}

impl<'a> Cursor<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self {
            bytes,
            position: 0,
            encoding: Encoding::Text,
        }
    }

    /// The start of the next item.
    pub(super) fn start(&mut self) -> usize {
        if self.encoding == Encoding::Text {
            self.skip_blank();
        }
        self.position
    }

    fn skip_blank(&mut self) {
        let rest = &self.bytes[self.position..];
        self.position += rest
            .iter()
            .take_while(|byte| byte.is_ascii_whitespace())
            .count();
    }

    /// The place of a byte: its line in a text, its offset otherwise.
    pub(super) fn place(&self, offset: usize) -> FilePlace {
        let before = &self.bytes[..offset.min(self.bytes.len())];
        match self.encoding {
            Encoding::Text => {
                FilePlace::Line(1 + before.iter().filter(|&&byte| byte == b'\n').count())
            }
            _ => FilePlace::Byte(before.len()),
        }
    }

    /// The next word and its start; empty at the end of the file.
    fn word(&mut self) -> (&'a [u8], usize) {
        self.skip_blank();
        let start = self.position;
        let rest = &self.bytes[start..];
        let length = rest
            .iter()
            .take_while(|byte| !byte.is_ascii_whitespace())
            .count();
        self.position = start + length;
        (&rest[..length], start)
    }

    /// A number written as text.
    pub(super) fn text<T: FromStr>(&mut self, expected: &'static str) -> Result<T, ReadError> {
        let (word, start) = self.word();
        let number = std::str::from_utf8(word)
            .ok()
            .and_then(|word| word.parse().ok());
        number.ok_or_else(|| self.unexpected(expected, word, start))
    }

    /// An int.
    pub(super) fn int(&mut self, expected: &'static str) -> Result<i32, ReadError> {
        match self.encoding {
            Encoding::Text => self.text(expected),
            Encoding::LittleEndian => self.fixed(expected).map(i32::from_le_bytes),
            Encoding::BigEndian => self.fixed(expected).map(i32::from_be_bytes),
        }
    }

    /// An int that is a count or a number of an item.
    pub(super) fn natural(&mut self, expected: &'static str) -> Result<u64, ReadError> {
        let start = self.start();
        let int = self.int(expected)?;
        u64::try_from(int).map_err(|_| self.unexpected(expected, int.to_string().as_bytes(), start))
    }

    /// A size_t, of 8 bytes.
    pub(super) fn size(&mut self, expected: &'static str) -> Result<u64, ReadError> {
        match self.encoding {
            Encoding::Text => self.text(expected),
            Encoding::LittleEndian => self.fixed(expected).map(u64::from_le_bytes),
            Encoding::BigEndian => self.fixed(expected).map(u64::from_be_bytes),
        }
    }

    /// A double, possibly not finite.
    pub(super) fn real(&mut self, expected: &'static str) -> Result<f64, ReadError> {
        match self.encoding {
            Encoding::Text => self.text(expected),
            Encoding::LittleEndian => self.fixed(expected).map(f64::from_le_bytes),
            Encoding::BigEndian => self.fixed(expected).map(f64::from_be_bytes),
        }
    }

    pub(super) fn fixed<const N: usize>(
        &mut self,
        expected: &'static str,
    ) -> Result<[u8; N], ReadError> {
        let Some(bytes) = self.bytes[self.position..].first_chunk() else {
            let at = self.place(self.bytes.len());
            return Err(ReadError::Unexpected {
                expected: expected.into(),
                found: None,
                at,
            });
        };
        self.position += N;
        Ok(*bytes)
    }

    /// Skips the end of a line without further items; binary numbers begin there.
    pub(super) fn line_end(&mut self) -> Result<(), ReadError> {
        let rest = &self.bytes[self.position..];
        let length = rest.iter().take_while(|&&byte| byte != b'\n').count();
        if !rest[..length].iter().all(u8::is_ascii_whitespace) || length == rest.len() {
            let (word, start) = self.word();
            return Err(self.unexpected("the end of a line", word, start));
        }
        self.position += length + 1;
        Ok(())
    }

    /// In a text an item ends with its line, which keeps errors at their line.
    pub(super) fn item_end(&mut self) -> Result<(), ReadError> {
        match self.encoding {
            Encoding::Text => self.line_end(),
            _ => Ok(()),
        }
    }

    /// The text between the quotation marks on the rest of the line.
    pub(super) fn quoted(&mut self) -> Result<String, ReadError> {
        let start = self.position;
        let rest = &self.bytes[start..];
        let line = &rest[..rest.iter().take_while(|&&byte| byte != b'\n').count()];
        self.position += line.len();
        let name = std::str::from_utf8(line).ok().and_then(|line| {
            let line = line.trim();
            line.strip_prefix('"')?.strip_suffix('"')
        });
        match name {
            Some(name) => Ok(name.to_owned()),
            None => Err(self.unexpected("a name between quotation marks", line, start)),
        }
    }

    /// The name of the next section, without its dollar sign, and its start; `None` at the end.
    pub(super) fn section(&mut self) -> Result<Option<(&'a str, usize)>, ReadError> {
        let (word, start) = self.word();
        if word.is_empty() {
            return Ok(None);
        }
        match word.strip_prefix(b"$").map(std::str::from_utf8) {
            Some(Ok(name)) => Ok(Some((name, start))),
            _ => Err(self.unexpected("a section", word, start)),
        }
    }

    /// Reads the mark at the end of a section.
    pub(super) fn close(&mut self, section: &'static str) -> Result<(), ReadError> {
        let (word, start) = self.word();
        match word.strip_prefix(b"$End") {
            Some(name) if name == section.as_bytes() => Ok(()),
            _ if word.is_empty() => Err(self.unexpected(END, word, start)),
            _ => Err(ReadError::Unexpected {
                expected: format!("$End{section}").into(),
                found: Some(shown(word)),
                at: self.place(start),
            }),
        }
    }

    /// Skips to the end of a section, whatever its contents.
    pub(super) fn skip(&mut self, section: &str) -> Result<(), ReadError> {
        let mark = format!("\n$End{section}");
        let rest = &self.bytes[self.position..];
        match rest
            .windows(mark.len())
            .position(|bytes| bytes == mark.as_bytes())
        {
            Some(length) => {
                self.position += length + mark.len();
                Ok(())
            }
            None => Err(ReadError::Unexpected {
                expected: END.into(),
                found: None,
                at: self.place(self.bytes.len()),
            }),
        }
    }

    /// The error for the next word in place of the expected item.
    pub(super) fn refused(&mut self, expected: &'static str) -> ReadError {
        let (word, start) = self.word();
        self.unexpected(expected, word, start)
    }

    pub(super) fn unexpected(
        &self,
        expected: &'static str,
        found: &[u8],
        start: usize,
    ) -> ReadError {
        ReadError::Unexpected {
            expected: expected.into(),
            found: (!found.is_empty()).then(|| shown(found)),
            at: self.place(start),
        }
    }
}

/// The beginning of the found bytes, printable.
fn shown(bytes: &[u8]) -> String {
    let beginning = &bytes[..bytes.len().min(32)];
    String::from_utf8_lossy(beginning)
        .escape_debug()
        .to_string()
}
