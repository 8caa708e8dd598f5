//! A run that is killed and restarted writes the files of an uninterrupted one: the slider, repeatedly, a rupture in space, and
//! a figure.

use std::ffi::OsStr;
use std::fs;
use std::hash::{BuildHasher, RandomState};
use std::path::{Path, PathBuf};
use std::process::{Child, Stdio};
use std::time::Duration;

use serde_json::Value;

use crate::{Outcome, program};

const KILLS: usize = 10;
/// Steps between two checkpoints, and how many are seen at most before a run is killed. So few that each run is
/// killed before its end.
const EVERY: &str = "10";
const SEEN: u64 = 8;

/// A random number below `bound`.
fn random(bound: u64) -> u64 {
    RandomState::new().hash_one(bound) % bound
}

fn start(folder: &Path, arguments: &[&str], checkpoint: Option<&Path>) -> Outcome<Child> {
    let mut command = program("slider");
    command.args(["--refinements", "1"]).args(arguments);
    command.arg("--out").arg(folder);
    if let Some(file) = checkpoint {
        command.args(["--checkpoint-every", EVERY, "--checkpoint"]);
        command.arg(file);
        if file.exists() {
            command.arg("--restart").arg(file);
        }
    }
    Ok(command.stdout(Stdio::null()).spawn()?)
}

/// Kills a run at a random moment, which is mostly one at which it has written some checkpoints.
fn kill(run: &mut Child, checkpoint: &Path) -> Outcome {
    let look = || fs::read(checkpoint).unwrap_or_default();
    for _ in 0..random(SEEN) {
        let last = look();
        while look() == last {
            if run.try_wait()?.is_some() {
                return Err("the run ended before it was killed".into());
            }
            std::thread::sleep(Duration::from_micros(100));
        }
    }
    std::thread::sleep(Duration::from_micros(random(5000)));
    run.kill()?;
    if run.wait()?.success() {
        return Err("the run ended before it was killed".into());
    }
    Ok(())
}

/// A summary without the run times.
fn summary(folder: &Path) -> Outcome<Value> {
    let mut summary: Value = serde_json::from_slice(&fs::read(folder.join("summary.json"))?)?;
    let entries = summary.as_object_mut().ok_or("no object")?;
    for times in ["milliseconds_per_step", "setup_seconds"] {
        entries.remove(times).ok_or(times)?;
    }
    Ok(summary)
}

fn same(name: &str, arguments: &[&str]) -> Outcome {
    let name = format!("stickslip-killed-{name}-{}", std::process::id());
    let place = std::env::temp_dir().join(name);
    let (whole, killed) = (place.join("whole"), place.join("killed"));
    fs::create_dir_all(&place)?;
    if !start(&whole, arguments, None)?.wait()?.success() {
        return Err("the whole run failed".into());
    }
    let file = place.join("checkpoint");
    for _ in 0..KILLS {
        kill(&mut start(&killed, arguments, Some(&file))?, &file)?;
    }
    if !start(&killed, arguments, Some(&file))?.wait()?.success() {
        return Err("the last run failed".into());
    }
    let history = |folder: &Path| fs::read(folder.join("history.csv"));
    assert!(history(&whole)? == history(&killed)?, "other histories");
    assert_eq!(summary(&whole)?, summary(&killed)?);
    fs::remove_dir_all(&place)?;
    Ok(())
}

#[test]
fn constant_steps() -> Outcome {
    same("constant", &["--steps", "3000", "--until", "0.5"])
}

#[test]
fn adaptive_steps() -> Outcome {
    let steps = ["--steps", "3000", "--adaptive", "3e-2", "--until", "0.75"];
    same(
        "adaptive",
        &[&steps[..], &["--coupling", "monolithic"]].concat(),
    )
}

/// A run that needs too many steps says so as early, with the same numbers, if it is kept in a file.
#[test]
fn a_hopeless_run_is_told_as_early() -> Outcome {
    let name = format!("stickslip-hopeless-{}", std::process::id());
    let place = std::env::temp_dir().join(name);
    fs::create_dir_all(&place)?;
    let file = place.join("checkpoint");
    let told = |kept: &[&OsStr]| -> Outcome<String> {
        let mut command = program("slider");
        command.args(["--refinements", "1", "--coupling", "monolithic"]);
        command.args([
            "--adaptive",
            "1e-7",
            "--max-steps",
            "5000",
            "--until",
            "0.1",
        ]);
        command.arg("--out").arg(place.join("out")).args(kept);
        let output = command.output()?;
        assert!(!output.status.success());
        // After lines of progress, if there are any.
        let lines = String::from_utf8(output.stderr)?;
        Ok(lines.lines().last().unwrap_or_default().to_owned())
    };
    let [keep, every] = ["--checkpoint", "--checkpoint-every"].map(OsStr::new);
    let kept = [keep, file.as_ref(), every, OsStr::new(EVERY)];
    assert_eq!(told(&[])?, told(&kept)?);
    fs::remove_dir_all(&place)?;
    Ok(())
}

#[test]
fn a_rupture_in_space() -> Outcome {
    let name = format!("stickslip-killed-rupture-{}", std::process::id());
    let place = std::env::temp_dir().join(name);
    fs::create_dir_all(&place)?;
    let file = place.join("checkpoint");
    let start = |folder: &str, kept: &[&OsStr]| -> Outcome<Child> {
        let mut command = program("rupture3d");
        let line = "--problem tpv105 --cell 2500 --growth 0.4 --margin 6000 --until 3";
        command.args(line.split(' ')).args(kept);
        command.arg("--out").arg(place.join(folder));
        Ok(command
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()?)
    };
    if !start("whole", &[])?.wait()?.success() {
        return Err("the whole run failed".into());
    }
    let [keep, every, restart] =
        ["--checkpoint", "--checkpoint-every", "--restart"].map(OsStr::new);
    let kept = [keep, file.as_ref(), every, OsStr::new("2")];
    kill(&mut start("killed", &kept)?, &file)?;
    let kept = if file.exists() {
        vec![restart, file.as_ref()]
    } else {
        Vec::new()
    };
    if !start("killed", &kept)?.wait()?.success() {
        return Err("the last run failed".into());
    }
    for table in [
        "moment.csv",
        "fault.csv",
        "cplot.dat",
        "faultst-090dp075.txt",
    ] {
        let read = |folder: &str| fs::read(place.join(folder).join(table));
        assert!(read("whole")? == read("killed")?, "other {table}");
    }
    fs::remove_dir_all(&place)?;
    Ok(())
}

#[test]
fn a_figure() -> Outcome {
    let name = format!("stickslip-figure-{}", std::process::id());
    let place = std::env::temp_dir().join(name);
    let start = |folder: &str| -> Outcome<Child> {
        let mut command = program("figures");
        command.args(["6.3", "--quick", "--out"]);
        command
            .arg(place.join(folder))
            .stdout(Stdio::null())
            .stderr(Stdio::null());
        Ok(command.spawn()?)
    };
    if !start("whole")?.wait()?.success() {
        return Err("the whole figure failed".into());
    }
    let mut killed = start("killed")?;
    let kept = || -> Outcome<Vec<PathBuf>> {
        let Ok(files) = fs::read_dir(place.join("killed/runs")) else {
            return Ok(Vec::new());
        };
        let paths = files.map(|file| Ok(file?.path()));
        let paths: Vec<PathBuf> = paths.collect::<Outcome<_>>()?;
        let is_kept = |path: &PathBuf| path.extension().is_some_and(|e| e == "checkpoint");
        Ok(paths.into_iter().filter(is_kept).collect())
    };
    while kept()?.is_empty() {
        if killed.try_wait()?.is_some() {
            return Err("the figure was drawn before it was killed".into());
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    killed.kill()?;
    killed.wait()?;
    assert!(!kept()?.is_empty(), "nothing was kept");
    if !start("killed")?.wait()?.success() {
        return Err("the second part failed".into());
    }
    assert!(kept()?.is_empty(), "left behind");
    let curves = |folder: &str| fs::read(place.join(folder).join("6.3/6.3.csv"));
    assert!(curves("whole")? == curves("killed")?, "other curves");
    fs::remove_dir_all(&place)?;
    Ok(())
}
