//! Layouts of published codes, and what is refused.

use std::path::Path;

use stickslip::record::{FileError, SeasTable};

use super::parse;
use crate::Outcome;

/// Fixed columns of Fortran, comments with their own indent, blank lines, Windows line ends.
#[test]
fn a_station_of_a_fortran_code() -> Outcome {
    let text = " # This is the header:\r\n # problem=SEAS Benchmark BP5-QD\r\n # code = HBI\r\n\r\n \
        # Column #1 = Time (s)\r\n # Column #2 = Slip_2 (m)\r\n\r\n t slip_2 slip_3 slip_rate_2 slip_rate_3 \
        shear_stress_2 shear_stress_3 state\r\n # Here is the data.\r\n   0.00000000000000E+00   0.000E+00   0.000E+00 \
        -0.152E+01  -0.200E+02   0.299E+02   0.000E+00   0.814E+01\r\n   0.12500000000000D+03   0.375D+01   1.000D-10 \
        -0.151E+01  -0.199E+02   0.298E+02   0.100E-06   0.801E+01\r\n\r\n";
    let read = parse(text.as_bytes())?;
    assert_eq!(read.metadata("code"), Some("HBI"));
    assert_eq!(read.metadata("problem"), Some("SEAS Benchmark BP5-QD"));
    assert_eq!(read.metadata("date"), None);
    assert_eq!((read.len(), read.columns().len()), (2, 8));
    assert_eq!(read.column("slip_3"), Some(&[0.0, 1e-10][..]));
    assert_eq!(read.column("t"), Some(&[0.0, 125.0][..]));
    assert_eq!(read.column("state"), Some(&[8.14, 8.01][..]));
    assert_eq!(read.comments()[0], "This is the header:");
    Ok(())
}

/// Names of positions before, on the line of, or without the others; names one a line.
#[test]
fn slip_has_its_positions_in_the_first_row() -> Outcome {
    let rows = "0 0 0 500 1000\n0 -9 0 0 0\n1e9\t-8.5\t1\t1.1\t1.2\n";
    let names = [
        "z\nt max_slip_rate slip\n",
        "z t max_slip_rate slip\n",
        "t max_slip_rate slip\n",
        "x2\nt\nmax_slip_rate\nslip_2\n",
        "# Column #3-83 = Slip (m)\nxd\nt max_slip_rate shear_stress\n",
    ];
    for names in names {
        let read = parse(format!("# problem=BP\n{names}{rows}").as_bytes())?;
        assert_eq!(read.positions(), Some(&[0.0, 500.0, 1000.0][..]), "{names}");
        assert_eq!((read.names().len(), read.len()), (3, 2));
        assert_eq!(read.columns()[3], [0.0, 1.1]);
    }
    // Not a row of positions.
    let read = parse(b"t max_slip_rate moment_rate\n0 0 1e18\n1 -1 1e17\n")?;
    assert_eq!((read.positions(), read.len()), (None, 2));
    Ok(())
}

/// Names in any encoding, no names at all, numbers that are none, a last row that was cut off.
#[test]
fn files_need_not_be_tidy() -> Outcome {
    let read = parse(b"# modeler=Andr\xe9\n\n1 2\n3 NaN\n-Infinity 1e-")?;
    assert_eq!((read.len(), read.names().len()), (2, 0));
    assert!(read.columns()[1][1].is_nan());
    let read = parse(b"t slip\n1 2\n3 4")?;
    assert_eq!(read.len(), 2);
    // A mark of the encoding, and exponents of three digits.
    let read = parse("\u{feff}# problem=X\nt slip\n0 1.5-103\n".as_bytes())?;
    assert_eq!(read.column("slip"), Some(&[1.5e-103][..]));
    Ok(())
}

#[test]
fn rows_that_differ_are_refused() {
    let cases: [(&str, usize, &str); 7] = [
        (
            "t slip\n1 2\n1 2 3\n4 5\n",
            3,
            "3 numbers where the first row has 2",
        ),
        ("# a\n\n1 2\nnone 3\n4 5\n", 4, "`none` is not a number"),
        ("1 2\n***** 3\n", 2, "`*****` is not a number"),
        ("t slip\n0 abc\n1 2\n", 2, "`abc` is not a number"),
        (
            "time t slip rate\n0 5 -9\n",
            1,
            "4 names [\"time\", \"t\", \"slip\", \"rate\"] of 3 columns",
        ),
        ("# a\nt slip\n", 2, "the file ends without a row of numbers"),
        ("", 0, "the file ends without a row of numbers"),
    ];
    for (text, expected, cause) in cases {
        let read = SeasTable::parse(text.as_bytes(), Path::new("fltst_dp000"));
        let Err(FileError::Line { line, what, .. }) = read else {
            panic!("{text}: {read:?}");
        };
        assert_eq!((line, what.as_str()), (expected, cause));
    }
}
