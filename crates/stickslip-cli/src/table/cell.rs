//! The numbers of cells.

/// A cell of a table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Cell {
    /// Nothing, or a mark of a missing value.
    Empty,
    /// A number.
    Number(f64),
    /// Neither.
    Text,
}

/// Marks of missing values.
const MISSING: [&str; 7] = [
    "na",
    "n/a",
    "null",
    "none",
    "-nan(ind)",
    "1.#qnan",
    "-1.#ind",
];

/// Reads a cell, whose decimals follow this sign.
pub(super) fn cell(text: &str, decimal: char) -> Cell {
    // Most cells are as this program writes them.
    if decimal == '.'
        && let Ok(value) = text.parse::<f64>()
        && !value.is_nan()
    {
        return Cell::Number(value);
    }
    let text = text.trim().trim_matches(['"', '\'']).trim();
    if text.is_empty() || MISSING.iter().any(|mark| text.eq_ignore_ascii_case(mark)) {
        return Cell::Empty;
    }
    // A point is no sign of thousands, and a decimal comma has digits on both of its sides.
    if decimal == ',' && text.contains('.') {
        return Cell::Text;
    }
    let plain = text.parse().ok().filter(|_| !text.contains(','));
    let number = plain.or_else(|| rewritten(text, decimal)?.parse().ok());
    match number {
        Some(value) if f64::is_nan(value) => Cell::Empty,
        Some(value) => Cell::Number(value),
        None => Cell::Text,
    }
}

/// A number as other programs write it, in the signs of this one: a decimal comma, the minus of typesetters, and the
/// exponents of Fortran, `1.5D-03` and `1.5-103`.
fn rewritten(text: &str, decimal: char) -> Option<String> {
    let mut text = text.replace('\u{2212}', "-");
    if let Some((whole, part)) = text.split_once(',') {
        let digits = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
        if decimal != ',' || !digits(whole.chars().last()) || !digits(part.chars().next()) {
            return None;
        }
        text = format!("{whole}.{part}");
    }
    if let Some(place) = text.find(['D', 'd']) {
        text.replace_range(place..=place, "e");
    } else if let Some(place) = text.rfind(['+', '-']).filter(|place| *place > 0) {
        let (mantissa, exponent) = text.split_at(place);
        let of_fortran = mantissa.ends_with(|c: char| c.is_ascii_digit())
            && mantissa.contains('.')
            && exponent.len() == 4;
        if of_fortran {
            text.insert(place, 'e');
        }
    }
    Some(text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Every finite number is read with its bits in each way of writing it.
        #[test]
        fn numbers_keep_their_bits(bits in any::<u64>()) {
            let value = f64::from_bits(bits);
            prop_assume!(value.is_finite());
            let plain = format!("{value:?}");
            prop_assert_eq!(cell(&plain, '.'), Cell::Number(value));
            prop_assert_eq!(cell(&plain.replace('.', ","), ','), Cell::Number(value));
            prop_assert_eq!(cell(&plain.replace('-', "\u{2212}"), '.'), Cell::Number(value));
            prop_assert_eq!(cell(&format!("{value:e}").replace('e', "D"), '.'), Cell::Number(value));
            prop_assert_eq!(cell(&format!(" \"{value:e}\" "), '.'), Cell::Number(value));
        }
    }

    #[test]
    fn what_is_no_number_is_text() {
        for text in [
            "much",
            "1 2",
            "1.234,5",
            "1,2,3",
            "2024-01-01",
            "12-034",
            "****",
            "1e",
            "D5",
        ] {
            assert_eq!(cell(text, '.'), Cell::Text, "{text}");
            assert_eq!(cell(text, ','), Cell::Text, "{text}");
        }
        assert_eq!(cell("1,5", '.'), Cell::Text);
        assert_eq!(cell("0.15-103", '.'), Cell::Number(0.15e-103));
        for text in ["", "NaN", "-nan", "-nan(ind)", " n/a "] {
            assert_eq!(cell(text, '.'), Cell::Empty, "{text}");
        }
    }
}
