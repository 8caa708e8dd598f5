//! The marks that identify a scene.

use std::fmt;

use serde::{Deserialize, Serialize};

/// The relative difference of function values between mathematical libraries \[-\].
const ROUNDING: f64 = 1e-9;

/// A named property that identifies a scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Mark {
    pub(crate) name: String,
    pub(crate) value: Value,
}

/// The compared value.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) enum Value {
    /// A text of the caller.
    Tag(String),
    Count(u64),
    /// A hash of bits.
    Bits(u64),
    /// Values of functions.
    Numbers(Vec<f64>),
}

/// The first difference of two scenes.
pub(crate) struct CheckpointMismatch {
    pub(crate) what: String,
    /// The value in the file.
    pub(crate) found: String,
    /// The value in the present scene.
    pub(crate) expected: String,
}

/// Refuses marks that differ, with the first difference.
pub(crate) fn compare(found: &[Mark], expected: &[Mark]) -> Result<(), CheckpointMismatch> {
    let absent = || "absent".to_string();
    for k in 0..found.len().max(expected.len()) {
        match (found.get(k), expected.get(k)) {
            (Some(there), Some(here)) if there.name == here.name => {
                there.value.compare(&here.value, &there.name)?;
            }
            (there, Some(here)) if there.is_none() || !names(found, here) => {
                return Err(CheckpointMismatch {
                    what: here.name.clone(),
                    found: absent(),
                    expected: here.value.to_string(),
                });
            }
            (Some(there), _) => {
                return Err(CheckpointMismatch {
                    what: there.name.clone(),
                    found: there.value.to_string(),
                    expected: absent(),
                });
            }
            (None, _) => {}
        }
    }
    Ok(())
}

/// Whether a mark of that name exists.
fn names(marks: &[Mark], mark: &Mark) -> bool {
    marks.iter().any(|other| other.name == mark.name)
}

impl Value {
    fn compare(&self, expected: &Self, name: &str) -> Result<(), CheckpointMismatch> {
        let differ = |found: &dyn fmt::Display, expected: &dyn fmt::Display| {
            Err(CheckpointMismatch {
                what: name.into(),
                found: found.to_string(),
                expected: expected.to_string(),
            })
        };
        match (self, expected) {
            (Self::Numbers(there), Self::Numbers(here)) if there.len() == here.len() => {
                let mut pairs = there.iter().zip(here);
                match pairs.find(|(there, here)| !agree(**there, **here)) {
                    Some((there, here)) => {
                        differ(&format_args!("{there:e}"), &format_args!("{here:e}"))
                    }
                    None => Ok(()),
                }
            }
            _ if self == expected => Ok(()),
            _ => differ(self, expected),
        }
    }
}

fn agree(a: f64, b: f64) -> bool {
    a == b || (a.is_nan() && b.is_nan()) || (a - b).abs() <= ROUNDING * a.abs().max(b.abs())
}

impl fmt::Display for Value {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Tag(text) => formatter.write_str(text),
            Self::Count(count) => write!(formatter, "{count}"),
            Self::Bits(hash) => write!(formatter, "{hash:016x}"),
            Self::Numbers(numbers) => write!(formatter, "{} numbers", numbers.len()),
        }
    }
}
