//! The same numbers in every way in which instruments and programs write tables: read with the same bits.

mod formats;

use std::fs;
use std::path::Path;

use stickslip_cli::table::{Columns, Delimiter, Format, Table, TableError};

use crate::{Outcome, folder};
use formats::{cases, rows};

fn read(
    path: &Path,
    bytes: &[u8],
    format: &Format,
    wanted: &[&str],
) -> Outcome<Result<Columns, TableError>> {
    fs::write(path, bytes)?;
    Ok(Table::read(path, format).and_then(|table| table.columns(wanted)))
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
