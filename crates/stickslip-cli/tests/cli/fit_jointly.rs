//! `stickslip fit` of several files at once, by laws with parameters, and interrupted.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;
use stickslip::friction::DieterichRuina;
use stickslip::lab::{Evolution, LoadHistory, Parameters};

use crate::{Outcome, folder, program};

const STEPS: &str = "0:1e-6,60:1e-5,90:3e-6,190:1e-5,215:0,245:1e-5";

/// Noise of 5e-4, by the golden ratio.
fn noise(n: usize) -> f64 {
    let uniform = |shift: f64| {
        (n as f64 * 0.618_033_988_749_895 + shift)
            .fract()
            .max(1e-12)
    };
    let angle = std::f64::consts::TAU * (n as f64 * 0.754_877_666_246_693).fract();
    5e-4 * (-2.0 * uniform(0.5).ln()).sqrt() * angle.cos()
}

/// A record on a machine of `stiffness` [1/m].
fn write(path: &Path, law: Evolution<'_>, stiffness: f64, shift: usize) -> Outcome {
    let nagata = law.name() == "nagata";
    let friction = DieterichRuina {
        a: if nagata { 0.03 } else { 0.009 },
        b: if nagata { 0.033 } else { 0.012 },
        reference_friction: 0.6,
        reference_velocity: 1e-6,
        slip_distance: 1.2e-5,
    };
    let changes = [
        (60.0, 1e-5),
        (90.0, 3e-6),
        (190.0, 1e-5),
        (215.0, 0.0),
        (245.0, 1e-5),
    ];
    let load = LoadHistory::new(1e-6, &changes)?.ending(280.0)?;
    let times = load.samples(80);
    let curve = Parameters::one_state(&friction, stiffness).curve(&[law], &load, &times)?;
    let rows = times.iter().zip(&curve).enumerate();
    let rows = rows.map(|(n, (time, mu))| format!("{time},{}\n", mu + noise(n + shift)));
    fs::write(path, format!("time,friction\n{}", rows.collect::<String>()))?;
    Ok(())
}

fn files(folder: &Path) -> Outcome<Vec<PathBuf>> {
    let mut files = Vec::new();
    for (number, stiffness) in [900.0, 1500.0, 4000.0].into_iter().enumerate() {
        let file = folder.join(format!("{number}.csv"));
        write(&file, Evolution::Aging, stiffness, 1000 * number)?;
        files.push(file);
    }
    Ok(files)
}

/// Within four standard errors, of the estimates of a summary.
fn assert_found(estimates: &Value, exact: &[(&str, Option<u64>, f64)]) -> Outcome {
    let estimates = estimates.as_array().ok_or("no parameters")?;
    for (name, record, exact) in exact {
        let same = |estimate: &&Value| {
            estimate["parameter"] == *name
                && estimate.get("record").and_then(Value::as_u64) == *record
        };
        let found = estimates.iter().find(same).ok_or(format!("no {name}"))?;
        let number = |key: &str| found[key].as_f64().unwrap_or(f64::NAN);
        let error = (number("value") - exact).abs();
        assert!(error <= 4.0 * number("standard_error"), "{found}");
    }
    Ok(())
}

#[test]
fn several_files_are_one_fit() -> Outcome {
    let folder = folder("fit-jointly")?;
    let files = files(&folder)?;
    let run = |more: &[&str]| {
        let mut command = program("fit");
        command
            .args(&files)
            .args(["--joint", "--steps", STEPS])
            .args(more);
        command.arg("--out").arg(folder.join("out")).output()
    };
    let output = run(&[])?;
    let text = String::from_utf8(output.stdout)?;
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8(output.stderr)?
    );
    assert!(text.contains("3 records, one state, aging law"), "{text}");
    assert!(
        text.contains("record 3: ") && text.contains("2.csv"),
        "{text}"
    );
    let read = || -> Outcome<Value> {
        Ok(serde_json::from_slice(&fs::read(
            folder.join("out/summary.json"),
        )?)?)
    };
    let summary = read()?;
    let shared = [
        ("a", None, 0.009),
        ("b1", None, 0.012),
        ("L1", None, 1.2e-5),
    ];
    let own = [
        ("k", Some(1), 900.0),
        ("k", Some(2), 1500.0),
        ("k", Some(3), 4000.0),
    ];
    assert_found(&summary["parameters"], &[shared, own].concat())?;
    assert_eq!(summary["records"].as_array().map(Vec::len), Some(3));
    assert_eq!(summary["interrupted"], false);
    let table = fs::read_to_string(folder.join("out/fits.csv"))?;
    assert_eq!(table.lines().count(), 4);
    assert!(table.starts_with("file,from,to,") && table.contains(",interrupted,warnings,error"));
    assert!(folder.join("out/fit-3.png").exists());
    // Machines that are known.
    assert!(run(&["--stiffness", "900,1500,4000"])?.status.success());
    let summary = read()?;
    assert_found(&summary["parameters"], &shared)?;
    assert_eq!(summary["records"][2]["stiffness"], 4000.0);
    for (arguments, message) in [
        (["--stiffness", "900,1500"], "2 values for 3 files"),
        (
            ["--window", "0:50"],
            "0.csv 0:50: the load point has the velocity",
        ),
    ] {
        let error = String::from_utf8(run(&arguments)?.stderr)?;
        assert!(
            error.contains(message) && error.lines().count() == 1,
            "{error}"
        );
    }
    Ok(())
}

#[test]
fn parameters_of_laws_are_fitted_fixed_or_published() -> Outcome {
    let folder = folder("fit-laws")?;
    let file = folder.join("nagata.csv");
    write(&file, Evolution::Nagata, 1500.0, 0)?;
    let run = |more: &[&str]| {
        let mut command = program("fit");
        command
            .arg(&file)
            .args(["--law", "nagata", "--steps", STEPS])
            .args(more);
        command.arg("--out").arg(folder.join("out")).output()
    };
    for (arguments, c) in [
        (vec![], false),
        (vec!["--free", "c1"], true),
        (vec!["--fix", "c=2"], false),
    ] {
        let output = run(&arguments)?;
        assert!(
            output.status.success(),
            "{}",
            String::from_utf8(output.stderr)?
        );
        let summary: Value = serde_json::from_slice(&fs::read(folder.join("out/summary.json"))?)?;
        let exact = [
            ("a", None, 0.03),
            ("b1", None, 0.033),
            ("L1", None, 1.2e-5),
            ("c1", None, 2.0),
        ];
        assert_found(&summary[0]["parameters"], &exact[..if c { 4 } else { 3 }])?;
        assert_eq!(summary[0]["laws"][0], "nagata");
        assert_eq!(summary[0]["load_point"].as_array().map(Vec::len), Some(6));
    }
    for (arguments, message) in [
        (["--free", "Vc1"], "no parameter Vc1"),
        (["--fix", "c=-2"], "positive"),
        (["--free", "q"], "q"),
    ] {
        let error = String::from_utf8(run(&arguments)?.stderr)?;
        assert!(
            error.contains(message) && error.lines().count() == 1,
            "{error}"
        );
    }
    Ok(())
}

/// Ctrl-C while a long fit runs: the files have what there is, and say so; the exit status is that of a shell.
#[cfg(unix)]
#[test]
fn ctrl_c_ends_a_fit_with_what_it_has() -> Outcome {
    use std::process::Command;
    use std::time::Duration;

    let folder = folder("fit-interrupted")?;
    let file = folder.join("long.csv");
    // Two states in a record that none made: a fit of minutes.
    let rows = (0..100_000_usize).map(|n| format!("{},{}\n", 0.0028 * n as f64, 0.6 + noise(n)));
    fs::write(
        &file,
        format!("time,friction\n{}", rows.collect::<String>()),
    )?;
    let out = folder.join("out");
    let mut command = program("fit");
    command
        .arg(&file)
        .arg(&file)
        .args(["--states", "2", "--steps", STEPS])
        .arg("--out")
        .arg(&out);
    let mut child = command.spawn()?;
    // The folder is there before the fits begin.
    while !out.exists() && child.try_wait()?.is_none() {
        std::thread::sleep(Duration::from_millis(10));
    }
    std::thread::sleep(Duration::from_millis(1500));
    Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status()?;
    assert_eq!(child.wait()?.code(), Some(130));
    let table = fs::read_to_string(out.join("fits.csv"))?;
    let rows: Vec<&str> = table.lines().skip(1).collect();
    assert_eq!(rows.len(), 2, "{table}");
    assert!(rows.iter().all(|row| row.contains(",true,")), "{table}");
    assert!(
        rows[1].contains("interrupted before it had a curve"),
        "{table}"
    );
    Ok(())
}
