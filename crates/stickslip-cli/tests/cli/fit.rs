//! `stickslip fit` on synthetic data of known parameters, and its refusals.

use std::fs;
use std::path::PathBuf;

use serde_json::Value;

use crate::{Outcome, folder, program};

/// `a` = 0.009, `b` = 0.012, `L` = 12 um, `mu0` = 0.6 at 1 um/s, `k` = 1500/m, noise of 5e-4.
fn data() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../examples/data/steps-and-holds.csv")
}

const STEPS: &str = "0:1e-6,60:1e-5,90:3e-6,190:3e-5,200:0,230:1e-5,260:0,560:1e-5";

/// The history by velocities and that by measured displacements; two windows of one file, one of which has no holds.
#[test]
fn synthetic_parameters_are_found() -> Outcome {
    let folder = folder("fit")?;
    let by_steps = [
        "--columns",
        "1,3",
        "--steps",
        STEPS,
        "--window",
        "0:190",
        "--window",
        "0:600",
    ];
    let by_displacement = ["--displacement-unit", "1e-6", "--holds"];
    let to_resolution = [
        "--displacement-unit",
        "1e-6",
        "--resolution",
        "1e-8",
        "--holds",
    ];
    for (arguments, fits) in [
        (&by_steps[..], 2),
        (&by_displacement[..], 1),
        (&to_resolution[..], 1),
    ] {
        let output = (program("fit")
            .arg(data())
            .args(arguments)
            .arg("--out")
            .arg(&folder))
        .output()?;
        assert!(
            output.status.success(),
            "{}",
            String::from_utf8(output.stderr)?
        );
        let summary: Value = serde_json::from_slice(&fs::read(folder.join("summary.json"))?)?;
        let summary = summary.as_array().ok_or("no list")?;
        assert_eq!(summary.len(), fits);
        let exact = [
            ("a", 0.009),
            ("b1", 0.012),
            ("L1", 1.2e-5),
            ("k", 1500.0),
            ("mu0", 0.6),
        ];
        for fit in summary {
            let estimates = fit["parameters"].as_array().ok_or("no parameters")?;
            assert_eq!(estimates.len(), exact.len());
            for (estimate, (name, exact)) in estimates.iter().zip(exact) {
                assert_eq!(estimate["parameter"], name);
                let number = |key: &str| estimate[key].as_f64().unwrap_or(f64::NAN);
                let error = (number("value") - exact).abs();
                assert!(error <= 4.0 * number("standard_error"), "{estimate}");
            }
        }
        let table = fs::read_to_string(folder.join("fits.csv"))?;
        assert_eq!(table.lines().count(), 1 + fits, "{table}");
        assert!(folder.join("fit-1.png").exists());
    }
    assert_eq!(
        fs::read_to_string(folder.join("holds.csv"))?
            .lines()
            .count(),
        3
    );
    Ok(())
}

#[test]
fn wrong_input_of_a_fit_is_one_line() -> Outcome {
    let folder = folder("fit-refusals")?;
    let text = folder.join("text.csv");
    fs::write(&text, "time,friction\n0,0.6\n1,much\n")?;
    let steps = ["--columns", "time,friction", "--steps"];
    let cases: [(&[&str], &str); 12] = [
        (
            &["--columns", "x,friction", "--steps", STEPS],
            "`x`, but time, displacement, friction",
        ),
        (&["--columns", "time,friction"], "--steps"),
        (&["--steps", "0"], "`:`"),
        (&["--steps", STEPS, "--steps-at", STEPS], "--steps"),
        (
            &[steps[0], steps[1], steps[2], "0:1e-6,9:2e-6,5:1e-6"],
            "is 5 at position 1",
        ),
        (
            &[steps[0], steps[1], steps[2], "0:1e-6"],
            "the window must contain a velocity step",
        ),
        (&["--window", "5:1"], "--window"),
        (&["--window", "700:800"], "no samples in --window"),
        (
            &["--law", "aging,slip", "--states", "1"],
            "2 laws for --states 1",
        ),
        (&["--stiffness", "soft"], "free"),
        (&["--fix", "q=1"], "`q`"),
        (&["--fix", "b2=0.01"], "2 states"),
    ];
    for (arguments, expected) in cases {
        let output = (program("fit").arg(data()).args(arguments))
            .args(["--displacement-unit", "1e-6", "--out"])
            .arg(folder.join("out"))
            .output()?;
        let error = String::from_utf8(output.stderr)?;
        assert!(!output.status.success(), "accepted: {arguments:?}");
        assert_eq!(error.lines().count(), 1, "{arguments:?}: {error}");
        assert!(error.contains(expected), "{arguments:?}: {error}");
    }
    let output = program("fit")
        .arg(&text)
        .args(["--steps", STEPS])
        .output()?;
    let error = String::from_utf8(output.stderr)?;
    assert!(
        error.contains("line 3, cell 2 (friction): `much` is not a number"),
        "{error}"
    );
    assert!(!folder.join("out").exists());
    Ok(())
}

/// A file of a batch that cannot be read is a row of the table, with its error; rows with empty cells are dropped and
/// counted.
#[test]
fn a_bad_file_of_a_batch_is_a_row() -> Outcome {
    let folder = folder("fit-batch")?;
    let text = fs::read_to_string(data())?;
    let gaps = text.replace("5.000,5.00,0.59947", "5.000,5.00,");
    assert_ne!(gaps, text);
    let [bad, gappy] = ["bad.csv", "gappy.csv"].map(|name| folder.join(name));
    fs::write(&bad, text.replace("0.60087", "much"))?;
    fs::write(&gappy, gaps)?;
    let output = (program("fit").arg(&bad).arg(data()).arg(&gappy))
        .args(["--displacement-unit", "1e-6", "--out"])
        .arg(folder.join("out"))
        .output()?;
    assert_eq!(output.status.code(), Some(1));
    let error = String::from_utf8(output.stderr)?;
    let error = error.lines().last().ok_or("no error")?;
    assert!(error.contains("1 of 3 fits failed"), "{error}");
    let told = String::from_utf8(output.stdout)?;
    assert!(
        told.contains("1 row with an empty cell was dropped"),
        "{told}"
    );
    let table = fs::read_to_string(folder.join("out/fits.csv"))?;
    let rows: Vec<&str> = table.lines().collect();
    assert_eq!(rows.len(), 4, "{table}");
    let failed = rows[3];
    assert!(
        failed.contains("bad.csv, line 3, cell 3 (friction): `much`"),
        "{failed}"
    );
    let summary: Value = serde_json::from_slice(&fs::read(folder.join("out/summary.json"))?)?;
    assert_eq!(summary[1]["dropped_rows"], 1);
    assert!(summary[2]["error"].is_string(), "{summary}");
    Ok(())
}
