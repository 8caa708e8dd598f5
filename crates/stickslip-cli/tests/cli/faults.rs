//! `stickslip earthquakes --faults`: faults of a table.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::{Outcome, folder, program};

/// The summary of a run, or its error.
fn run(line: &str, out: &Path) -> Result<Result<Value, String>, Box<dyn std::error::Error>> {
    let output = program("earthquakes")
        .args(line.split_whitespace())
        .arg("--out")
        .arg(out)
        .output()?;
    if !output.status.success() {
        return Ok(Err(String::from_utf8_lossy(&output.stderr).into_owned()));
    }
    let text = fs::read_to_string(out.join("summary.json"))?;
    Ok(Ok(serde_json::from_str(&text)?))
}

/// The thrust of BP3 as a polyline has the first event of BP3 by its own kernel, and of a table of its friction.
#[test]
fn a_straight_polyline_is_bp3() -> Outcome {
    let out = folder("faults-straight")?;
    let (x, z) = (20e3, -20e3 * 3_f64.sqrt());
    fs::write(out.join("line.csv"), format!("x,z\n0,0\n{x},{z}\n"))?;
    let line = format!(
        "--faults {} --cell 200 --years 180",
        out.join("line.csv").display()
    );
    let found = run(&line, &out)??;
    let first = found["event_times_years"][0].as_f64().ok_or("no event")?;
    let known = run("--problem bp3 --cell 200 --years 180", &out)??;
    let exact = known["event_times_years"][0].as_f64().ok_or("no event")?;
    assert!((first - exact).abs() < 0.05, "{first} {exact}");
    // The same friction by depth: a quarter turn of 60 degrees makes 15 km 12.99 km.
    let depth = |distance: f64| distance * 0.75_f64.sqrt();
    let rows = [(0.0, 0.01), (15e3, 0.01), (18e3, 0.025), (40e3, 0.025)];
    let rows = rows.map(|(distance, a)| format!("{},{a},0.015", depth(distance)));
    fs::write(
        out.join("friction.csv"),
        format!("depth,a,b\n{}\n", rows.join("\n")),
    )?;
    let line = format!("{line} --friction {}", out.join("friction.csv").display());
    let tabled = run(&line, &out)??;
    let again = tabled["event_times_years"][0].as_f64().ok_or("no event")?;
    assert!((again - first).abs() < 0.05, "{again} {first}");
    Ok(())
}

/// Two long lines are far enough from each other once they are divided into cells.
#[test]
fn lines_are_divided_before_they_are_faults() -> Outcome {
    let out = folder("faults-two")?;
    let table = out.join("two.csv");
    fs::write(
        &table,
        "x,z,fault\n0,0,1\n10e3,-17e3,1\n8e3,0,2\n18e3,-17e3,2\n",
    )?;
    let line = format!("--faults {} --cell 1000 --years 1", table.display());
    let found = run(&line, &out)??;
    assert_eq!((&found["cells"], &found["faults"]), (&40.into(), &2.into()));
    Ok(())
}

/// A thrust of triangles, 12 km x 12 km at 60 degrees down from the surface, as a file of Gmsh with one group.
fn thrust() -> String {
    let side = 7;
    let mut text = String::from("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n");
    text += &format!(
        "2 4 \"thrust\"\n$EndPhysicalNames\n$Nodes\n{}\n",
        side * side
    );
    for j in 0..side {
        for i in 0..side {
            let down = 2e3 * f64::from(j);
            let (x, y, z) = (2e3 * f64::from(i), 0.5 * down, -down * 0.75_f64.sqrt());
            text += &format!("{} {x} {y} {z}\n", side * j + i + 1);
        }
    }
    let squares = (0..side - 1).flat_map(|j| (1..side).map(move |i| side * j + i));
    let cells = squares.flat_map(|a| [[a, a + 1, a + side + 1], [a, a + side + 1, a + side]]);
    let lines: Vec<String> = (1..)
        .zip(cells)
        .map(|(number, [a, b, c])| format!("{number} 2 2 4 1 {a} {b} {c}\n"))
        .collect();
    text += &format!("$EndNodes\n$Elements\n{}\n", lines.len());
    text + &lines.concat() + "$EndElements\n"
}

/// Triangles are loaded as their slip is, and slip fastest where friction strengthens least.
#[test]
fn triangles_are_faults_too() -> Outcome {
    let out = folder("faults-triangles")?;
    let file = out.join("thrust.msh");
    fs::write(&file, thrust())?;
    let line = format!(
        "--faults {} --groups thrust --years 20 --vtu-every 10",
        file.display()
    );
    let found = run(&line, &out)??;
    let files = [
        "slip_rate_surface.png",
        "slip_per_event.svg",
        "fault.pvd",
        "fault_0000.vtu",
    ];
    for name in files {
        assert!(out.join(name).is_file(), "{name}");
    }
    assert_eq!((&found["cells"], &found["faults"]), (&72.into(), &1.into()));
    // Slip in a strengthening or stable part is that of the plate at most, and none is ahead of it without an event.
    let events = found["event_times_years"].as_array().ok_or("no list")?;
    let largest = found["largest_slip"].as_f64().ok_or("no slip")?;
    assert!(
        events.is_empty() && largest > 0.0 && largest < 0.65,
        "{largest}"
    );
    // Cells and their slip.
    let table = fs::read_to_string(out.join("cells.csv"))?;
    assert_eq!(table.lines().count(), 73);
    for (rest, told) in [
        ("--cell 100", "settings of polylines"),
        ("--groups flat", "flat"),
        ("--rake inf", "rake"),
    ] {
        let line = format!("--faults {} --years 1 {rest}", file.display());
        let error = run(&line, &out)?.err().ok_or(rest)?;
        assert!(error.contains(told), "{rest}: {error}");
    }
    Ok(())
}

#[test]
fn wrong_faults_are_told_in_a_line() -> Outcome {
    let out = folder("faults-wrong")?;
    let table = out.join("table.csv");
    for (text, rest, told) in [
        ("x,z\n0,0\n0,5\n", "", "above"),
        ("x,z\n0,0\n", "", ""),
        ("x,z\n0,0\n1e3,no\n", "", "line 3"),
        ("x,z\n0,-1e3\n1e3,-2e3\n0,-2e3\n1e3,-1e3\n", "", ""),
        (
            "x,z\n0,-1e3\n1e3,-2e3\n",
            "--seas files",
            "--seas is not a setting of --faults",
        ),
        (
            "x,z\n0,-1e3\n1e3,-2e3\n",
            "--antiplane --normal",
            "--normal",
        ),
        ("x,z\n0,-1e3\n1e3,-2e3\n", "--problem bp3", "--problem"),
        (
            "x,z\n0,-1e3\n1e3,-2e3\n",
            "--friction nowhere.csv",
            "nowhere.csv",
        ),
    ] {
        fs::write(&table, text)?;
        let line = format!("--faults {} --years 1 {rest}", table.display());
        let error = run(&line, &out)?.err().ok_or(text)?;
        assert!(error.contains(told), "{text} {rest}: {error}");
        let shown = error.lines().next().unwrap_or_default();
        assert!(shown.contains("error"), "{error}");
        assert!(!error.contains("panicked"), "{error}");
    }
    // Friction that does not reach down to the cells, or is none.
    fs::write(&table, "x,z\n0,-1e3\n1e3,-2e3\n")?;
    let friction = out.join("friction.csv");
    for (rows, told) in [
        ("0,0.01,0.015\n1e3,0.01,0.015", "add a row"),
        ("0,-0.01,0.015\n1e4,0.01,0.015", "a is -0.01"),
        ("1e4,0.01,0.015\n0,0.01,0.015", "sort the rows"),
    ] {
        fs::write(&friction, format!("depth,a,b\n{rows}\n"))?;
        let (faults, friction) = (table.display(), friction.display());
        let line = format!("--faults {faults} --friction {friction} --years 1");
        let error = run(&line, &out)?.err().ok_or(rows)?;
        assert!(error.contains(told), "{rows}: {error}");
    }
    Ok(())
}
