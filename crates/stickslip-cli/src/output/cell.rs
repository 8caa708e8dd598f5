//! The cells of written tables.

/// The columns of times: differences between them count, be the times large.
pub(super) const TIMES: [&str; 4] = ["time", "start", "from", "to"];

/// A cell of a table.
#[derive(Debug, Clone, PartialEq)]
pub enum Cell {
    /// A number, with 10 digits or all.
    Number(f64),
    /// A text, or a number as it is to be written.
    Text(String),
}

/// The cell of a number.
pub fn number(value: f64) -> Cell {
    Cell::Number(value)
}

/// All digits of a number: parsing them returns the same number.
pub fn digits(value: f64) -> String {
    format!("{value:.16e}")
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.into())
    }
}

impl Cell {
    /// The text of the cell: the shortest that reads as the number, or as the number rounded to 10 digits.
    pub(super) fn text(self, all: bool) -> String {
        match self {
            Self::Text(text) => text,
            Self::Number(value) if all || !value.is_finite() => format!("{value:e}"),
            Self::Number(value) => {
                let rounded = format!("{value:.9e}");
                let shortest = rounded.parse::<f64>().map(|value| format!("{value:e}"));
                shortest.unwrap_or(rounded)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn all_digits_read_as_the_same_number(bits in any::<u64>()) {
            let value = f64::from_bits(bits);
            prop_assume!(value.is_finite());
            let read: f64 = number(value).text(true).parse()?;
            let again: f64 = digits(value).parse()?;
            prop_assert_eq!(again.to_bits(), bits);
            prop_assert_eq!(read.to_bits(), bits);
        }

        #[test]
        fn ten_digits_are_as_close(value in prop_oneof![-1e300..1e300, -1.0..1.0, -1e-290..1e-290]) {
            let text = number(value).text(false);
            let read: f64 = text.parse()?;
            prop_assert!((read - value).abs() <= 5.1e-10 * value.abs(), "{}", text);
            let mantissa = text.split('e').next().unwrap_or_default();
            prop_assert!(mantissa.bytes().filter(u8::is_ascii_digit).count() <= 10, "{}", text);
        }
    }

    #[test]
    fn missing_values_are_nan() {
        assert_eq!(number(f64::NAN).text(false), "NaN");
        assert_eq!(number(0.005).text(false), "5e-3");
    }
}
