//! The same numbers as instruments and programs write them.

const NAMES: [&str; 3] = ["time", "displacement", "friction"];

/// Rows of numbers with signs, exponents and all digits.
pub(super) fn rows() -> Vec<[f64; 3]> {
    let row = |n: i32| {
        let x = f64::from(n);
        [0.1 * x, -1.7e-6 * x / 3.0, 0.6 + (0.7 * x).sin() / 300.0]
    };
    (0..40).map(row).collect()
}

/// Cells written so, with this separator between them and this end of lines.
fn written(cell: impl Fn(f64) -> String, separator: &str, end: &str) -> String {
    let row = |row: &[f64; 3]| row.map(&cell).join(separator) + end;
    rows().iter().map(row).collect()
}

fn plain(x: f64) -> String {
    format!("{x:?}")
}

fn with_comma(x: f64) -> String {
    plain(x).replace('.', ",")
}

/// In columns of one width.
fn aligned(x: f64) -> String {
    format!("{:>26}", format!("{x:e}"))
}

/// In double precision of Fortran.
fn of_fortran(x: f64) -> String {
    format!("{x:.17e}").replace('e', "D")
}

fn names(separator: &str) -> String {
    NAMES.join(separator)
}

/// A name, the bytes of the file, and the columns asked for.
pub(super) type Case = (&'static str, Vec<u8>, [&'static str; 3]);

fn utf16(text: &str, little: bool, marked: bool) -> Vec<u8> {
    let units = marked
        .then_some(0xfeff)
        .into_iter()
        .chain(text.encode_utf16());
    let bytes = |unit: u16| {
        if little {
            unit.to_le_bytes()
        } else {
            unit.to_be_bytes()
        }
    };
    units.flat_map(bytes).collect()
}

fn latin1(text: &str) -> Vec<u8> {
    text.chars().map(|c| c as u8).collect()
}

pub(super) fn cases() -> Vec<Case> {
    let comma = names(",") + "\n" + &written(plain, ",", "\n");
    let body = written(plain, ",", "\n");
    let numbers = ["1", "2", "3"];
    let indexed = |begin: &str| -> String {
        let lines = body.lines().enumerate();
        begin.to_owned()
            + &lines
                .map(|(n, line)| format!("{n},{line}\n"))
                .collect::<String>()
    };
    let text = |name, text: String, wanted| (name, text.into_bytes(), wanted);
    vec![
        text("comma", comma.clone(), NAMES),
        text(
            "semicolon",
            names(";") + "\n" + &written(plain, ";", "\n"),
            NAMES,
        ),
        text(
            "tab",
            names("\t") + "\n" + &written(plain, "\t", "\n"),
            NAMES,
        ),
        text(
            "blanks",
            names(" ") + "\n" + &written(plain, " ", "\n"),
            NAMES,
        ),
        text(
            "aligned columns",
            names("      ") + "\n" + &written(aligned, " ", "\n"),
            NAMES,
        ),
        text(
            "bar",
            names("|") + "\n" + &written(plain, " | ", "\n"),
            NAMES,
        ),
        text("no names", body.clone(), numbers),
        text("byte-order mark", format!("\u{feff}{comma}"), NAMES),
        text("CR", comma.replace('\n', "\r"), NAMES),
        text("CRLF", comma.replace('\n', "\r\n"), NAMES),
        text("no end of the last line", comma.trim_end().into(), NAMES),
        ("Latin-1", latin1(&format!("Gerät,µm,°\n{comma}")), NAMES),
        ("UTF-16, little end", utf16(&comma, true, true), NAMES),
        ("UTF-16, big end", utf16(&comma, false, true), NAMES),
        ("UTF-16 without a mark", utf16(&comma, true, false), NAMES),
        text("units", names(",") + "\ns,um,1\n" + &body, NAMES),
        text(
            "units in names",
            "Time (s),Displacement [m],Friction [-]\n".to_owned() + &body,
            NAMES,
        ),
        text(
            "preamble",
            format!("Granite, run 12\nSample \"A\nArea: 25 cm^2, 3 gauges\nRate,10\n\n{comma}"),
            NAMES,
        ),
        text(
            "comments",
            format!("# of a test\n% at 20 C\n{comma}# in between\n{body}").replacen(&body, "", 1),
            NAMES,
        ),
        text(
            "names in a comment",
            format!("# {}\n{}", names(" "), written(plain, " ", "\n")),
            NAMES,
        ),
        text(
            "decimal comma, semicolon",
            names(";") + "\n" + &written(with_comma, ";", "\n"),
            NAMES,
        ),
        text(
            "decimal comma, tab",
            names("\t") + "\n" + &written(with_comma, "\t", "\n"),
            NAMES,
        ),
        text(
            "decimal comma, blanks",
            names(" ") + "\n" + &written(with_comma, "  ", "\n"),
            NAMES,
        ),
        text("trailing separators", comma.replace('\n', ",\n"), NAMES),
        text(
            "trailing separators but in names",
            names(",") + "\n" + &body.replace('\n', ",\n"),
            NAMES,
        ),
        text(
            "Fortran",
            names("  ") + "\n" + &written(of_fortran, "  ", "\n"),
            NAMES,
        ),
        text(
            "quotation marks",
            format!("\"{}\"", names("\",\""))
                + "\n"
                + &written(|x| format!("\"{x:?}\""), ",", "\n"),
            NAMES,
        ),
        text("index", indexed(",time,displacement,friction\n"), NAMES),
        text(
            "index without a name",
            indexed("time,displacement,friction\n"),
            NAMES,
        ),
        text(
            "duplicates",
            body.lines().fold(
                "gauge,gauge,time,displacement,friction\n".into(),
                |text, line| format!("{text}7,8,{line}\n"),
            ),
            NAMES,
        ),
        text("typographic minus", comma.replace('-', "\u{2212}"), NAMES),
        text(
            "LabVIEW",
            format!(
                "LabVIEW Measurement\t\nWriter_Version\t2\nSeparator\tTab\nDecimal_Separator\t,\n***End_of_Header***\t\n\t\n\
                 {}\tComment\n{}",
                names("\t"),
                written(with_comma, "\t", "\t\n")
            ),
            NAMES,
        ),
        text("blank lines", comma.replace('\n', "\n\n"), NAMES),
        text("another case", comma.replace("time", "TIME"), NAMES),
    ]
}
