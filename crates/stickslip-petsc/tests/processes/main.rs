//! The examples in several processes.

mod checkpoints;
mod explicit;
mod faults;
mod slider;
mod sweep;
mod two_contacts;
mod weakening;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// One run at a time: processes that wait for each other want a processor each.
fn alone() -> MutexGuard<'static, ()> {
    static ALONE: Mutex<()> = Mutex::new(());
    ALONE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A folder of a test of its own, removed with all that is in it.
struct Place(PathBuf);

impl Place {
    fn new() -> Self {
        static COUNT: AtomicUsize = AtomicUsize::new(0);
        let (process, number) = (std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
        let folder = std::env::temp_dir().join(format!("stickslip-processes-{process}-{number}"));
        std::fs::create_dir_all(&folder).expect("a folder");
        Self(folder)
    }

    /// The path of a file in it.
    fn file(&self, name: &str) -> String {
        self.0.join(name).display().to_string()
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// An example in so many processes, at most so many seconds: after these it ends with status 124.
fn command(seconds: u32, example: &str, processes: usize, arguments: &[&str]) -> Command {
    let test = std::env::current_exe().expect("the test has a path");
    let folder = test
        .parent()
        .and_then(Path::parent)
        .expect("a folder of artefacts");
    let program = folder.join("examples").join(example);
    in_processes(seconds, &program, processes, arguments)
}

/// A program, likewise.
fn in_processes(seconds: u32, program: &Path, processes: usize, arguments: &[&str]) -> Command {
    let mut command = Command::new("timeout");
    command.args([
        &seconds.to_string(),
        "mpirun",
        "--oversubscribe",
        "--allow-run-as-root",
        "--mca",
        "mpi_yield_when_idle",
        "1",
        "-n",
    ]);
    command
        .arg(processes.to_string())
        .arg(program)
        .args(arguments)
        .env("OMP_NUM_THREADS", "1");
    command
}

/// Runs an example in so many processes, at most two minutes.
fn run(example: &str, processes: usize, arguments: &[&str]) -> Output {
    let _alone = alone();
    let mut command = command(120, example, processes, arguments);
    command.output().expect("mpirun starts")
}

/// Runs an example that has to end well, and writes to this folder; what it says.
fn succeed(example: &str, processes: usize, arguments: &[&str], out: &str) -> String {
    let ended = run(example, processes, &[arguments, &["--out", out]].concat());
    let said = String::from_utf8_lossy(&ended.stderr);
    assert!(ended.status.success(), "{said}");
    String::from_utf8_lossy(&ended.stdout).into_owned()
}

fn history(example: &str, processes: usize, arguments: &[&str]) -> Vec<Vec<f64>> {
    history_and_output(example, processes, arguments).0
}

/// The files that an example writes, and its output.
fn history_and_output(
    example: &str,
    processes: usize,
    arguments: &[&str],
) -> (Vec<Vec<f64>>, String) {
    let place = Place::new();
    let said = succeed(example, processes, arguments, &place.file(""));
    let text = std::fs::read_to_string(place.file("history.csv")).expect("a history");
    let numbers = |line: &str| {
        let cells = line.split(',');
        cells.map(|cell| cell.parse().expect("a number")).collect()
    };
    // Below the names of the columns.
    (text.lines().skip(1).map(numbers).collect(), said)
}

/// The multigrid cycles of a run, by what it says.
fn cycles(said: &str) -> usize {
    let count = said.split("cycles ").nth(1).expect("cycles");
    let digits = count.chars().take_while(char::is_ascii_digit);
    digits.collect::<String>().parse().expect("a number")
}

/// Some columns of two histories, to this share of the largest entry in each.
fn agree(whole: &[Vec<f64>], parts: &[Vec<f64>], columns: &[usize], tolerance: f64) {
    let distances = distances(whole, parts);
    for &c in columns {
        assert!(distances[c] <= tolerance, "{distances:?}");
    }
}

/// The largest difference in each column, as a share of the largest entry there.
fn distances(a: &[Vec<f64>], b: &[Vec<f64>]) -> Vec<f64> {
    assert_eq!(a.len(), b.len());
    let columns = 0..a[0].len();
    let largest = |of: &dyn Fn(usize) -> f64| (0..a.len()).map(of).fold(0.0, f64::max);
    columns
        .map(|c| {
            let scale = largest(&|k| a[k][c].abs());
            largest(&|k| (a[k][c] - b[k][c]).abs()) / scale.max(f64::MIN_POSITIVE)
        })
        .collect()
}
