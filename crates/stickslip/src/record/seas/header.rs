//! The first lines of a file.

use std::fmt::Write as _;

/// The header of files in the format of the SEAS benchmarks: lines `# key=value`, with the problem, this code and its
/// version first.
///
/// The platform that compares the codes asks for `modeler`, `date` and `element_size`.
///
/// ```
/// use stickslip::record::SeasHeader;
///
/// let header = SeasHeader::new("SEAS Benchmark BP1-QD")
///     .with("modeler", "A. Ruina")
///     .with("date", "1983/12/10")
///     .with("element_size", "25 m");
/// assert!(header.to_string().starts_with("# problem=SEAS Benchmark BP1-QD\n# code=stickslip\n# version="));
/// assert!(header.to_string().ends_with("# element_size=25 m\n"));
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SeasHeader {
    lines: String,
}

impl SeasHeader {
    /// The header of files for `problem`.
    pub fn new(problem: &str) -> Self {
        let header = Self {
            lines: String::new(),
        };
        header
            .with("problem", problem)
            .with("code", "stickslip")
            .with("version", env!("CARGO_PKG_VERSION"))
    }

    /// Adds a line. Line breaks become spaces.
    #[must_use]
    pub fn with(mut self, key: &str, value: &str) -> Self {
        let [key, value] = [key, value].map(|text| text.replace(['\n', '\r'], " "));
        // Writing into a string does not fail.
        let _ = writeln!(self.lines, "# {key}={value}");
        self
    }
}

impl std::fmt::Display for SeasHeader {
    /// The lines.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.lines)
    }
}
