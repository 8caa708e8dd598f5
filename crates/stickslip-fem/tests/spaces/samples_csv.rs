//! Tables of samples: what is read, and what an error points at.

use nalgebra::Vector2;
use stickslip_fem::{FemError, FilePlace, ReadError, Samples};

fn error(text: &str) -> ReadError {
    Samples::<2>::parse(text.as_bytes()).unwrap_err()
}

#[test]
fn tables_are_read_with_and_without_heading() {
    for text in [
        "0,0,1\n2,0,5\n",
        "x, y, value\n0, 0, 1\n2, 0, 5",
        "# of the fault\n\"x [m]\",y,a\r\n\r\n0,0,1e0\r\n# the end\r\n2,0,+5.0\r\n",
    ] {
        let samples = Samples::<2>::parse(text.as_bytes()).unwrap();
        assert_eq!(samples.linear().unwrap().at(&Vector2::new(0.5, 3.0)), 2.0);
        assert_eq!(samples.nearest(&Vector2::new(1.5, -2.0)), 5.0);
    }
}

#[test]
fn errors_point_at_lines() {
    assert!(matches!(
        error("x,y,a\n0,0,1\n2,0\n"),
        ReadError::Unexpected { expected, found: Some(found), at: FilePlace::Line(3) } if expected == "3 columns, the coordinates and a value" && found == "2 columns"
    ));
    assert!(matches!(
        error("x,y,z,a\n0,0,1,4\n"),
        ReadError::Unexpected { expected, found: Some(found), at: FilePlace::Line(2) } if expected == "3 columns, the coordinates and a value" && found == "4 columns"
    ));
    for found in ["?", "nan", "1e999", ""] {
        assert!(matches!(
            error(&format!("0,0,1\n2,{found},3\n")),
            ReadError::Unexpected { expected, found: Some(it), at: FilePlace::Entry { line: 2, column: 2 } } if expected == "a finite number" && it == found
        ));
    }
    // A heading is the first row alone, and has no numbers.
    assert!(matches!(
        error("0,0,1\nx,y,a\n"),
        ReadError::Unexpected {
            at: FilePlace::Entry { line: 2, column: 1 },
            ..
        }
    ));
    assert!(matches!(
        error("x,0,1\n"),
        ReadError::Unexpected {
            at: FilePlace::Entry { line: 1, column: 1 },
            ..
        }
    ));
    assert!(matches!(
        error("x,y,a\n0,0,1\n\n1,0,1\n-0,0,2\n"),
        ReadError::Same {
            what: "lines",
            numbers: [2, 5],
            share: "point",
            at: FilePlace::Line(5)
        }
    ));
    for text in ["", "x,y,a\n", "# nothing\n"] {
        assert!(matches!(
            error(text),
            ReadError::Fem(FemError::Empty {
                what: "samples",
                ..
            })
        ));
    }
    assert!(matches!(
        Samples::<2>::parse(b"0,0,1\n\xff,0,1\n"),
        Err(ReadError::Unexpected { expected, at: FilePlace::Line(2), .. }) if expected == "text in UTF-8"
    ));
    let missing = Samples::<2>::read("no/such/table.csv").unwrap_err();
    assert!(
        missing
            .to_string()
            .starts_with("cannot read no/such/table.csv: ")
    );
}
