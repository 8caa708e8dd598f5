//! From the bytes of a file to lines of text.

use encoding_rs::{Encoding, UTF_16BE, UTF_16LE, WINDOWS_1252};

/// The text of a file in UTF-8, UTF-16 or Latin-1, with line feeds alone as ends of lines.
///
/// A byte-order mark tells the encoding. Without one, text of this kind in UTF-16 has a zero byte in every digit, and
/// what is no UTF-8 is Latin-1 (as Windows extends it).
pub(super) fn text(bytes: &[u8]) -> String {
    let marked = Encoding::for_bom(bytes).map(|(encoding, _)| encoding);
    let guessed = || match bytes {
        [0, _, ..] => Some(UTF_16BE),
        [_, 0, ..] => Some(UTF_16LE),
        _ => None,
    };
    let text = match (marked.or_else(guessed), std::str::from_utf8(bytes)) {
        (Some(encoding), _) => encoding.decode(bytes).0,
        (None, Ok(text)) => text.into(),
        (None, Err(_)) => WINDOWS_1252.decode(bytes).0,
    };
    if text.contains('\r') {
        text.replace("\r\n", "\n").replace('\r', "\n")
    } else {
        text.into_owned()
    }
}
