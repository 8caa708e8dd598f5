//! The same numbers in every way in which instruments and programs write tables: read with the same bits.

use std::fs;
use std::path::Path;

use stickslip_cli::table::{Columns, Delimiter, Format, Table, TableError};

use crate::{Outcome, folder};

const NAMES: [&str; 3] = ["time", "displacement", "friction"];

/// Rows of numbers with signs, exponents and all digits.
fn rows() -> Vec<[f64; 3]> {
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

fn read(
    path: &Path,
    bytes: &[u8],
    format: &Format,
    wanted: &[&str],
) -> Outcome<Result<Columns, TableError>> {
    fs::write(path, bytes)?;
    Ok(Table::read(path, format).and_then(|table| table.columns(wanted)))
}

/// A name, the bytes of the file, and the columns asked for.
type Case = (&'static str, Vec<u8>, [&'static str; 3]);

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

fn cases() -> Vec<Case> {
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
        text("blank lines", comma.replace('\n', "\n\n"), NAMES),
        text("another case", comma.replace("time", "TIME"), NAMES),
    ]
}

#[test]
fn the_same_numbers_have_the_same_bits_in_every_format() -> Outcome {
    let folder = folder("tables")?;
    for (name, bytes, wanted) in cases() {
        let format = Format {
            delimiter: (name == "bar").then_some(Delimiter::Character(b'|')),
            ..Format::default()
        };
        let path = folder.join(name.replace([' ', ','], "-"));
        let columns =
            read(&path, &bytes, &format, &wanted)?.map_err(|error| format!("{name}: {error}"))?;
        assert_eq!(columns.dropped, 0, "{name}");
        for (n, row) in rows().iter().enumerate() {
            for (k, exact) in row.iter().enumerate() {
                let found = columns.values[k][n];
                assert_eq!(
                    found.to_bits(),
                    exact.to_bits(),
                    "{name}, row {n}: {found} {exact}"
                );
            }
        }
        assert_eq!(columns.values[0].len(), rows().len(), "{name}");
    }
    Ok(())
}

/// Rows with an empty cell are dropped and counted, if its column is used.
#[test]
fn empty_cells_drop_their_rows() -> Outcome {
    let folder = folder("tables-empty")?;
    let text = "time,gauge,friction\n0,1,0.6\n1,,0.61\n2,3,\n3,NaN,0.63\n4,x,0.64\n";
    let path = folder.join("empty");
    let columns = read(
        &path,
        text.as_bytes(),
        &Format::default(),
        &["friction", "time"],
    )??;
    assert_eq!(columns.dropped, 1);
    assert_eq!(
        columns.values,
        [[0.6, 0.61, 0.63, 0.64], [0.0, 1.0, 3.0, 4.0]]
    );
    let refused = read(&path, text.as_bytes(), &Format::default(), &["gauge"])?;
    let error = refused.err().ok_or("accepted")?.to_string();
    assert!(error.contains("line 6, cell 2 (gauge): `x`"), "{error}");
    Ok(())
}

/// What is not read is refused with its line and its cell, in one line.
#[test]
fn other_tables_are_refused_with_line_and_cell() -> Outcome {
    let folder = folder("tables-refused")?;
    let skipping = |skip| Format {
        skip,
        ..Format::default()
    };
    let cases: [(&str, Format, &[&str], &str); 13] = [
        (
            "time,friction\n0,0.6\n1,much\n",
            skipping(0),
            &["friction"],
            "line 3, cell 2 (friction): `much`",
        ),
        (
            "time,friction\n0,much\n1,0.6\n",
            skipping(0),
            &["friction"],
            "line 2, cell 2 (friction): `much`",
        ),
        (
            "0 0.6\n\n# so\n1 0.6 0.7\n2 0.6\n",
            skipping(0),
            &["1"],
            "line 4, cell 3: the row has 3 cells, others have 2",
        ),
        (
            "a;b\n0;0,6\n1;0,6\n2\n",
            skipping(0),
            &["a"],
            "line 4, cell 2: the row has 1 cell",
        ),
        (
            "a;b\n0;1.234,5\n1;1.235,5\n",
            Format {
                delimiter: Some(Delimiter::Character(b';')),
                ..Format::default()
            },
            &["b"],
            "line 2, cell 2 (b): `1.234,5`",
        ),
        (
            "a b\n0 ****\n1 0.6\n2 0.6\n",
            skipping(0),
            &["b"],
            "line 2, cell 2 (b): `****`",
        ),
        (
            "a,b\n2024-01-01,0.6\n2024-01-02,0.6\n",
            skipping(0),
            &["a"],
            "line 2, cell 1 (a): `2024-01-01`",
        ),
        (
            "only text\nand more\n",
            skipping(0),
            &["a"],
            "line 1, cell 1: `only text`",
        ),
        ("", skipping(0), &["a"], "no rows of numbers"),
        ("a,b\n0,1\n", skipping(9), &["a"], "no rows of numbers"),
        (
            "t,f,f\n0,1,2\n1,1,2\n",
            skipping(0),
            &["f"],
            "columns 2 and 3 are both called `f`",
        ),
        (
            "t,f\n0,1\n1,1\n",
            skipping(0),
            &["g"],
            "no column `g`, but t, f",
        ),
        (
            "t,f\n0,\n1,\n2,\n",
            skipping(0),
            &["t", "2"],
            "each of the 3 rows has an empty cell",
        ),
    ];
    for (text, format, wanted, expected) in cases {
        let refused = read(&folder.join("table"), text.as_bytes(), &format, wanted)?;
        let error = refused
            .err()
            .ok_or(format!("accepted: {text}"))?
            .to_string();
        assert!(error.contains(expected), "{text}: {error}");
        assert_eq!(error.lines().count(), 1, "{error}");
    }
    Ok(())
}

/// Numbers above the table are left out by --skip.
#[test]
fn lines_are_skipped() -> Outcome {
    let folder = folder("tables-skip")?;
    let text = "1,2\n3,4\ntime,friction\n0,0.6\n1,0.61\n";
    let format = Format {
        skip: 2,
        ..Format::default()
    };
    let columns = read(
        &folder.join("table"),
        text.as_bytes(),
        &format,
        &["time", "friction"],
    )??;
    assert_eq!(columns.values, [[0.0, 1.0], [0.6, 0.61]]);
    Ok(())
}
