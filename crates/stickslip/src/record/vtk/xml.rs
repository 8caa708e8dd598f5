//! Escaping of XML attributes.

/// A text, escaped as the value of an attribute between double quotes.
pub(super) fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            // A reader takes them for spaces.
            '\t' => escaped.push_str("&#9;"),
            '\n' => escaped.push_str("&#10;"),
            '\r' => escaped.push_str("&#13;"),
            other => escaped.push(other),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::escaped;

    #[test]
    fn reserved_letters_are_escaped() {
        let name = "a & <b>\t\"c\"\r\n'd', &amp; \u{e4}";
        assert_eq!(
            escaped(name),
            "a &amp; &lt;b&gt;&#9;&quot;c&quot;&#13;&#10;'d', &amp;amp; \u{e4}"
        );
    }
}
