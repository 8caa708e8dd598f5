//! Commands whose reader closes the pipe, and files that are whole.

use std::fs;
use std::path::Path;
use std::process::Stdio;

use crate::{Outcome, folder, program};

/// Short runs of every command, with their files.
const RUNS: [(&str, &str, &[&str]); 8] = [
    (
        "slider",
        "--refinements 1 --steps 1000 --until 0.05",
        &["history.csv", "history.png", "history.svg", "summary.json"],
    ),
    (
        "spring-slider",
        "--until 20",
        &["history.csv", "history.png", "history.svg", "summary.json"],
    ),
    (
        "fit",
        "../../examples/data/steps-and-holds.csv --displacement-unit 1e-6 --holds",
        &[
            "fits.csv",
            "holds.csv",
            "fit-1.csv",
            "fit-1.png",
            "fit-1.svg",
            "summary.json",
        ],
    ),
    (
        "layer",
        "--steps 500 --cells 8 --transit-steps 20",
        &["history.csv", "exact.csv", "history.png", "summary.json"],
    ),
    (
        "sweep",
        "--sets 2 --steps 300 --refinements 1",
        &["sweep.csv", "sweep.png", "sweep.svg"],
    ),
    (
        "slider3d",
        "--refinements 0 --steps 500 --until 0.05",
        &[
            "history.csv",
            "history.png",
            "front.png",
            "front.svg",
            "summary.json",
        ],
    ),
    (
        "rupture",
        "--cell 2000 --growth 0.5 --height 8e3 --until 1",
        &["stations.csv", "rupture.png", "rupture.svg", "summary.json"],
    ),
    (
        "earthquakes",
        "--problem bp1 --cell 2000 --years 2",
        &[
            "events.csv",
            "history.csv",
            "slip.png",
            "slip_rate_map.svg",
            "summary.json",
        ],
    ),
];

fn is_whole(file: &Path) -> Outcome<bool> {
    Ok(fs::metadata(file)?.len() > 0)
}

/// Standard output and standard error are closed before the command begins: it ends as if they were read, with its files.
#[test]
fn a_closed_pipe_ends_no_command() -> Outcome {
    for (name, arguments, files) in RUNS {
        let folder = folder(&format!("pipes-{name}"))?;
        let mut run = program(name)
            .args(arguments.split_whitespace())
            .arg("--out")
            .arg(&folder)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()?;
        drop((run.stdout.take(), run.stderr.take()));
        let status = run.wait()?;
        // Coarse runs may differ from published results, which is no panic (101).
        assert!(matches!(status.code(), Some(0 | 1)), "{name}: {status}");
        for file in files {
            assert!(is_whole(&folder.join(file))?, "{name}: {file}");
        }
        for entry in fs::read_dir(&folder)? {
            let path = entry?.path();
            assert!(is_whole(&path)?, "{name}: {} is empty", path.display());
        }
    }
    Ok(())
}

/// The same of help and of errors, of which one goes to standard error.
#[test]
fn a_closed_pipe_ends_no_message() -> Outcome {
    for arguments in [
        &["--help"][..],
        &["fit", "--help"],
        &["fit", "none.csv"],
        &["--no-such-flag"],
    ] {
        let mut run = program(arguments[0])
            .args(&arguments[1..])
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()?;
        drop((run.stdout.take(), run.stderr.take()));
        let status = run.wait()?;
        assert!(
            matches!(status.code(), Some(0..=2)),
            "{arguments:?}: {status}"
        );
    }
    Ok(())
}

/// Tables have 10 digits, or all with --full-precision, and times all in both.
#[test]
fn tables_have_ten_digits_or_all() -> Outcome {
    let rows = |more: &[&str]| -> Outcome<Vec<Vec<String>>> {
        let folder = folder("digits")?;
        let output = program("spring-slider")
            .args(["--until", "11.3"])
            .args(more)
            .arg("--out")
            .arg(&folder)
            .output()?;
        assert!(output.status.success());
        let text = fs::read_to_string(folder.join("history.csv"))?;
        let row = |line: &str| line.split(',').map(String::from).collect();
        Ok(text.lines().skip(1).map(row).collect())
    };
    let (ten, all) = (rows(&[])?, rows(&["--full-precision"])?);
    assert_eq!(ten.len(), all.len());
    for (ten, all) in ten.iter().zip(&all) {
        assert_eq!(ten[0], all[0]);
        for (ten, all) in ten.iter().zip(all).skip(1) {
            let [short, long]: [f64; 2] = [ten.parse()?, all.parse()?];
            assert!((short - long).abs() <= 5.1e-10 * long.abs(), "{ten} {all}");
            assert!(ten.len() <= all.len(), "{ten} {all}");
        }
    }
    Ok(())
}
