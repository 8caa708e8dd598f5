//! Segments from CSV.

use stickslip_bie::Segments;

use crate::Outcome;

#[test]
fn points_are_read_by_fault() -> Outcome {
    let text = "x,z,fault\n0,0,3\n1, -1,3\n# the splay\n5,0,7\n5,-1,7\n5,-2,7\n";
    let segments = Segments::from_csv(text.as_bytes())?;
    let points = [
        vec![[0.0, 0.0], [1.0, -1.0]],
        vec![[5.0, 0.0], [5.0, -1.0], [5.0, -2.0]],
    ];
    assert_eq!(segments, Segments::polylines(points.clone())?);
    let one = Segments::from_csv("5,0\n5,-1\n5,-2\n".as_bytes())?;
    assert_eq!(one, Segments::polyline(&points[1])?);
    Ok(())
}

#[test]
fn lines_that_are_no_points_are_refused_by_number() -> Outcome {
    for (text, start) in [
        (
            "x,z\n0,0\n1,one\n",
            "line 3 of the table of segments: 'one' is no number",
        ),
        (
            "0,0\n1\n",
            "line 2 of the table of segments: 1 columns instead of x, z and fault",
        ),
        (
            "0,0\n1,-1,2,3\n",
            "line 2 of the table of segments: 4 columns",
        ),
        (
            "0,0\n1,-inf\n",
            "line 2 of the table of segments: '-inf' is not finite",
        ),
        (
            "0,0,1\n1,-1,main\n",
            "line 2 of the table of segments: 'main' is no number of a fault",
        ),
        (
            "0,0,1\n1,-1,1\n5,0,2\n5,-1,2\n2,-2,1\n",
            "line 5 of the table of segments: the fault of this line has ended",
        ),
        (
            "0,0,1\n1,-1,1\n2,-2\n",
            "line 3 of the table of segments: the number of the fault is missing",
        ),
        (
            "0,0\n1,-1\n2,-2,1\n",
            "line 3 of the table of segments: the number of the fault is missing",
        ),
        ("x,z\n", "segments need at least one polyline"),
        ("0,0,1\n1,-1,1\n5,0,2\n", "polyline 1 has 1 points"),
    ] {
        let error = Segments::from_csv(text.as_bytes())
            .err()
            .ok_or("accepted")?;
        assert!(error.to_string().starts_with(start), "{text}: {error}");
    }
    Ok(())
}
