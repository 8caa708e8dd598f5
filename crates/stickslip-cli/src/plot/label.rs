//! Numbers as the labels of ticks.

/// The sign of negative numbers.
pub(super) const MINUS: &str = "\u{2212}";

/// An exponent in small digits.
pub(super) fn raised(exponent: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digit = |c: char| c.to_digit(10).map_or('⁻', |digit| DIGITS[digit as usize]);
    exponent.to_string().chars().map(digit).collect()
}

/// A number by a power of ten.
pub(super) fn scientific(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let mantissa = match mantissa.split_once('.') {
        Some((whole, part)) if part.trim_end_matches('0').is_empty() => whole,
        _ => mantissa,
    };
    let exponent = exponent.parse().unwrap_or(0);
    match mantissa {
        "0" | "-0" => "0".into(),
        "1" => format!("10{}", raised(exponent)),
        _ => format!("{}·10{}", mantissa.replace('-', MINUS), raised(exponent)),
    }
}

/// A positive number of at most three digits, by a power of ten unless it is near 1.
pub(super) fn rounded(value: f64) -> String {
    let text = format!("{value:.2e}");
    let value: f64 = text.parse().unwrap_or(value);
    if (1e-3..1e4).contains(&value) {
        return value.to_string();
    }
    let digits = text.split('e').next().unwrap_or_default();
    scientific(value, digits.trim_end_matches('0').len().saturating_sub(2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_ten_are_raised() {
        let labels = [
            (0.0, "0"),
            (1e-5, "10⁻⁵"),
            (-2e-5, "−2·10⁻⁵"),
            (1.5e12, "1.5·10¹²"),
        ];
        for (value, label) in labels {
            assert_eq!(scientific(value, 1), label);
        }
        for (value, label) in [
            (0.005, "0.005"),
            (250.0, "250"),
            (5e-4, "5·10⁻⁴"),
            (1.25e-7, "1.25·10⁻⁷"),
        ] {
            assert_eq!(rounded(value), label);
        }
    }
}
