//! `stickslip earthquakes`: displacement off the fault.

use std::fs;
use std::path::Path;

use crate::{Outcome, folder, program};

/// Runs the program, and returns its error if it fails.
fn run(line: &str, out: &Path) -> Result<Option<String>, Box<dyn std::error::Error>> {
    let output = program("earthquakes")
        .args(line.split_whitespace())
        .arg("--out")
        .arg(out)
        .output()?;
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    Ok((!output.status.success()).then_some(error))
}

/// The names of the columns, and the last row.
fn end(path: &Path) -> Result<(String, Vec<f64>), Box<dyn std::error::Error>> {
    let text = fs::read_to_string(path)?;
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let names = lines.next().ok_or("no names")?.to_owned();
    let row = lines.next_back().ok_or("no row")?.split_whitespace();
    Ok((names, row.map(str::parse).collect::<Result<_, _>>()?))
}

/// The ground on both sides of the trace of a thrust moves as the slip there: `disp_1` horizontal, `disp_2` down.
#[test]
fn the_ground_is_torn_by_the_slip_at_the_trace() -> Outcome {
    let out = folder("off-fault-thrust")?;
    let (seas, table) = (out.join("seas"), out.join("gps.csv"));
    fs::write(&table, "name,x,z\nGPS1,8e3,0\nfar,-1e9,0\n")?;
    let line = format!(
        "--problem bp3 --cell 1000 --years 5 --seas {} --receivers {}",
        seas.display(),
        table.display()
    );
    assert_eq!(run(&line, &out)?, None);
    let (names, above) = end(&seas.join("srfst_fn+00"))?;
    assert_eq!(names, "t disp_1 disp_2 vel_1 vel_2");
    let (_, below) = end(&seas.join("srfst_fn-00"))?;
    let (_, fault) = end(&seas.join("fltst_dp000"))?;
    // 60 degrees up dip, to the left and up.
    let up_dip = |at: usize| {
        let [across, down] = [at, at + 1].map(|k| above[k] - below[k]);
        -0.5 * across - 0.75_f64.sqrt() * down
    };
    assert!(
        (up_dip(1) / fault[1] - 1.0).abs() < 1e-3,
        "{} {}",
        up_dip(1),
        fault[1]
    );
    let rate = 10_f64.powf(fault[2]);
    // Between both points the plate strains the ground, too.
    assert!(
        (up_dip(3) - rate).abs() < 1e-7 * 1e-9,
        "{} {rate}",
        up_dip(3)
    );
    // A receiver of the table at the place of a station; far away one half of the plate, down dip.
    assert_eq!(
        end(&seas.join("srfst_GPS1"))?,
        end(&seas.join("srfst_fn+08"))?
    );
    let (_, far) = end(&seas.join("srfst_far"))?;
    let half = 0.5e-9 * far[0];
    assert!((far[1] / (0.5 * half) - 1.0).abs() < 1e-4, "{far:?}");
    assert!(
        (far[2] / (0.75_f64.sqrt() * half) - 1.0).abs() < 1e-4,
        "{far:?}"
    );
    // Without the folder of the benchmark: in the folder of the run, along the axes of the fault.
    let line = format!(
        "--problem bp1 --cell 1000 --years 5 --receivers {}",
        table.display()
    );
    assert_eq!(run(&line, &out)?, None);
    let (names, _) = end(&out.join("receiver_GPS1"))?;
    assert_eq!(names, "t disp_x disp_y disp_z vel_x vel_y vel_z");
    Ok(())
}

#[test]
fn a_grid_shows_the_surface() -> Outcome {
    let out = folder("off-fault-plane")?;
    let seas = out.join("seas");
    let line = format!(
        "--problem bp5 --cell 5000 --years 1 --surface-grid 20000 --seas {}",
        seas.display()
    );
    assert_eq!(run(&line, &out)?, None);
    // The first event is under way at the start.
    for name in ["surface_event_000.vtu", "surface_end.vtu"] {
        let bytes = fs::read(out.join(name))?;
        assert!(String::from_utf8_lossy(&bytes).contains("displacement"));
    }
    // Both sides of a vertical fault move along strike, oppositely: the normal side forward.
    let (names, block) = end(&seas.join("blkst_strk-16fn+08dp+00"))?;
    assert_eq!(names, "t disp_1 disp_2 disp_3 vel_1 vel_2 vel_3");
    assert!(block[2] > 0.05, "{block:?}");
    Ok(())
}

/// The rock on both sides of a fault with fluid parts by the slip of the cell between, and moves oppositely. The cells
/// around the injection slip equally: the station there has the slip of each.
#[test]
fn rock_moves_beside_an_injection() -> Outcome {
    for (problem, points, [station, column]) in [
        (
            "bp6 --cell 100 --years 0.1",
            "1e-2,-50,a\n-1e-2,-50,b\n",
            ["fltst_dp000", "disp_y"],
        ),
        (
            "bp8 --cell 100 --years 0.01 --refine 1",
            "50,50,1e-2,a\n50,50,-1e-2,b\n",
            ["fltst_strk+000dp+000", "disp_2"],
        ),
    ] {
        let out = folder("off-fault-injection")?;
        let (seas, table) = (out.join("seas"), out.join("points.csv"));
        let head = if points.starts_with('1') {
            "x,z,name"
        } else {
            "x,y,z,name"
        };
        fs::write(&table, format!("{head}\n{points}"))?;
        let line = format!(
            "--problem {problem} --seas {} --receivers {}",
            seas.display(),
            table.display()
        );
        assert_eq!(run(&line, &out)?, None);
        let (names, above) = end(&seas.join("srfst_a"))?;
        let (_, below) = end(&seas.join("srfst_b"))?;
        let (_, fault) = end(&seas.join(station))?;
        let mut names = names.split(' ');
        let at = names.position(|name| name == column).ok_or(column)?;
        let slip = fault[1];
        assert!(slip > 1e-6, "{problem}: {slip}");
        let jump = above[at] - below[at];
        assert!((jump / slip - 1.0).abs() < 1e-3, "{problem}: {jump} {slip}");
        assert!((above[at] + below[at]).abs() < 1e-6 * slip, "{problem}");
        // There is no creep beyond the cells, and the file says so.
        let text = fs::read_to_string(seas.join("srfst_a"))?;
        assert!(text.contains("that of slip on the cells alone"), "{text}");
    }
    Ok(())
}

#[test]
fn receivers_that_are_none_are_told_in_a_line() -> Outcome {
    let out = folder("off-fault-wrong")?;
    let table = out.join("gps.csv");
    for (text, rest, told) in [
        (
            "x,z\n8e3,10\n",
            "",
            "receiver 0 is 10 m above the free surface",
        ),
        ("x,z\n0,-500\n0,-1000\n", "", "from an edge of cell"),
        ("x,z\n0,no\n", "", "line 2: z is \"no\""),
        ("a,b\n1,2\n", "", "name the columns"),
        (
            "x,z,name\n1,0,a\n2,0,a\n",
            "",
            "would be the file of two points",
        ),
        (
            "x,z\n1,0\n",
            "--surface-grid 1000",
            "--surface-grid is not a setting of bp1",
        ),
    ] {
        fs::write(&table, text)?;
        let line = format!(
            "--problem bp1 --cell 1000 --years 1 --receivers {} {rest}",
            table.display()
        );
        let error = run(&line, &out)?.ok_or(text)?;
        assert!(error.contains(told), "{text}: {error}");
    }
    Ok(())
}
