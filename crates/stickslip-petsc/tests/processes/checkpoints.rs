//! Runs that end or are killed, and go on in another number of processes.

use std::fs;
use std::process::{Command, Stdio};
use std::time::Duration;

use super::{Place, agree, alone, command, history, run, succeed};

/// Two processes write, others go on; what one number of processes reads and writes again has the same bits.
fn goes_on(example: &str, arguments: &[&str], [until, end]: [&str; 2], columns: &[usize]) {
    let place = Place::new();
    let [kept, again] = ["kept", "again"].map(|name| place.file(name));
    let whole = history(example, 1, &[arguments, &["--until", end]].concat());
    let keep = [
        "--until",
        until,
        "--checkpoint-every",
        "30",
        "--checkpoint",
        &kept,
    ];
    succeed(example, 2, &[arguments, &keep].concat(), &place.file("out"));
    for processes in [3, 1] {
        let resume = ["--restart", &kept, "--until"];
        let rest = history(example, processes, &[arguments, &resume, &[end]].concat());
        agree(&whole, &rest, columns, 1e-8);
        let copy = [arguments, &resume, &[until, "--checkpoint", &again]].concat();
        succeed(example, processes, &copy, &place.file("out"));
        let [kept, again] = [&kept, &again].map(|path| fs::read(path).expect("a checkpoint"));
        assert!(kept == again, "{processes}: other bits");
    }
}

#[test]
fn a_slider_goes_on_in_another_number_of_processes() {
    goes_on(
        "slider",
        &["--refinements", "3"],
        ["0.01", "0.02"],
        &[1, 2, 4],
    );
}

#[test]
fn a_block_in_space_goes_on_in_another_number_of_processes() {
    goes_on(
        "slider3d",
        &["--refinements", "1"],
        ["0.005", "0.01"],
        &[0, 1, 2, 5],
    );
}

/// Kept before the body slips, and continued through its first event.
#[test]
fn a_slider_goes_on_through_an_event_in_another_number_of_processes() {
    let place = Place::new();
    let kept = place.file("kept");
    let [arguments, until, end] = [
        ["--refinements", "2"],
        ["--until", "0.65"],
        ["--until", "0.69"],
    ];
    let whole = history("slider", 1, &[arguments, end].concat());
    let keep = [arguments, until, ["--checkpoint", &kept]].concat();
    succeed("slider", 2, &keep, &place.file("out"));
    let fastest = |rows: &[Vec<f64>]| rows.iter().map(|row| row[5]).fold(0.0, f64::max);
    let (before, after) = whole.split_at(6500);
    assert!(fastest(before) < 1e-3 && fastest(after) > 1e-3);
    for processes in [1, 3, 4] {
        let resume = [arguments, end, ["--restart", &kept]].concat();
        let rest = history("slider", processes, &resume);
        // Time, displacement, velocity, state, the largest slip rate.
        agree(&whole, &rest, &[1, 2, 3, 4, 5], 1e-8);
    }
}

/// The parent of a process and its name.
fn parent(process: u32) -> Option<(u32, String)> {
    let line = fs::read_to_string(format!("/proc/{process}/stat")).ok()?;
    let (name, rest) = line.split_once('(')?.1.rsplit_once(')')?;
    Some((rest.split_whitespace().nth(1)?.parse().ok()?, name.into()))
}

/// A process of an example, below the one that started it.
fn find(example: &str, above: u32) -> Option<u32> {
    let mut processes = (fs::read_dir("/proc").ok()?)
        .filter_map(|entry| entry.ok()?.file_name().to_str()?.parse::<u32>().ok());
    processes.find(|&process| {
        let mut line = std::iter::successors(parent(process), |&(above, _)| parent(above));
        parent(process).is_some_and(|(_, name)| name == example)
            && line.any(|(process, _)| process == above)
    })
}

#[test]
fn a_process_that_is_killed_ends_all_and_the_run_goes_on_in_another_number() {
    let place = Place::new();
    let kept = place.file("kept");
    let arguments = ["--refinements", "2", "--until", "0.03"];
    let whole = history("slider", 1, &arguments);
    let keep = ["--checkpoint-every", "20", "--checkpoint", &kept];
    let out = ["--out", &place.file("out")];
    let ended = {
        let _alone = alone();
        let mut run = command(60, "slider", 2, &[&arguments[..], &keep, &out].concat());
        let mut run =
            (run.stdout(Stdio::null()).stderr(Stdio::null()).spawn()).expect("mpirun starts");
        let look = || fs::read(&kept).unwrap_or_default();
        for _ in 0..3 {
            let last = look();
            while look() == last && run.try_wait().is_ok_and(|ended| ended.is_none()) {
                std::thread::sleep(Duration::from_millis(1));
            }
        }
        let process = find("slider", run.id())
            .expect("a process of the run")
            .to_string();
        let killed = Command::new("kill").args(["-KILL", &process]).status();
        assert!(killed.expect("kill starts").success());
        run.wait().expect("mpirun ends")
    };
    // 124: it had to be stopped.
    assert!(!ended.success() && ended.code() != Some(124), "{ended}");
    let rest = history(
        "slider",
        3,
        &[&arguments[..], &["--restart", &kept]].concat(),
    );
    agree(&whole, &rest, &[1, 2, 4], 1e-8);
}

#[test]
fn files_that_do_not_fit_are_refused_by_all_processes() {
    let place = Place::new();
    let [kept, damaged] = ["kept", "damaged"].map(|name| place.file(name));
    let out = place.file("out");
    let arguments = ["--refinements", "2", "--until", "0.001"];
    let keep = [&arguments[..], &["--checkpoint", &kept]].concat();
    succeed("slider", 2, &keep, &out);
    let mut bytes = fs::read(&kept).expect("a checkpoint");
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    fs::write(&damaged, bytes).expect("a file");
    let absent = place.file("absent");
    for (refinements, until, file, reason) in [
        ("3", "0.001", &kept, "refinements is 2 there and 3 here"),
        ("2", "0.0001", &kept, "the checkpoint is at step 10"),
        ("2", "0.001", &damaged, "is damaged"),
        ("2", "0.001", &absent, "cannot read"),
    ] {
        let arguments = [
            "--refinements",
            refinements,
            "--until",
            until,
            "--restart",
            file,
            "--out",
            &out,
        ];
        let ended = run("slider", 2, &arguments);
        let said = String::from_utf8_lossy(&ended.stderr);
        assert!(
            !ended.status.success() && ended.status.code() != Some(124),
            "{said}"
        );
        assert!(said.contains(reason), "{said}");
    }
}
