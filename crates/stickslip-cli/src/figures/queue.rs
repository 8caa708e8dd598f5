//! A queue of runs, several at a time, with completed runs kept in files.

use std::fs;
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use indicatif::{MultiProgress, ProgressBar, ProgressStyle};

use super::{Experiment, Outcome};
use crate::cli::Problem;

/// Parts of a progress bar.
const PARTS: f64 = 1000.0;

/// Takes a run, from the checkpoint at a path if there is one, and shows its progress from 0 to 1.
pub type Take<'a> =
    dyn Fn(&Experiment, &Path, &mut dyn FnMut(f64)) -> Result<Outcome, Problem> + Sync + 'a;

/// The outcomes of all runs in their order, read from the folder if present, else computed by `take` and written. The
/// longest begin first. If a run fails, all others continue; the first failure is returned.
pub(super) fn work_off(
    experiments: &[Experiment],
    folder: &Path,
    threads: usize,
    take: &Take<'_>,
) -> Result<Vec<Outcome>, Problem> {
    fs::create_dir_all(folder)
        .map_err(|error| format!("cannot create folder {}: {error}", folder.display()))?;
    let mut outcomes: Vec<Option<Outcome>> =
        (experiments.iter().map(|e| read(&file(folder, e), e))).collect();
    let mut left: Vec<usize> = (0..experiments.len())
        .filter(|&k| outcomes[k].is_none())
        .collect();
    left.sort_by(|&a, &b| experiments[b].effort().total_cmp(&experiments[a].effort()));
    let efforts: Vec<f64> = left.iter().map(|&k| experiments[k].effort()).collect();
    let whole = Whole::new(&efforts, experiments.len() - left.len());
    let next = AtomicUsize::new(0);
    let done = Mutex::new(Vec::new());
    thread::scope(|scope| {
        for _ in 0..threads.min(left.len()) {
            scope.spawn(|| {
                loop {
                    let turn = next.fetch_add(1, Ordering::Relaxed);
                    let Some(&k) = left.get(turn) else { return };
                    let experiment = &experiments[k];
                    let bar = whole.begin(experiment);
                    let checkpoint = folder.join(format!("{}.checkpoint", experiment.name()));
                    let clock = Instant::now();
                    let result = take(experiment, &checkpoint, &mut |share| {
                        whole.show(&bar, turn, share);
                    });
                    let result = result
                        .and_then(|outcome| {
                            write(&file(folder, experiment), &outcome)?;
                            // There is one only where the run took several pieces.
                            let _ = fs::remove_file(&checkpoint);
                            Ok(outcome)
                        })
                        .map_err(|problem| format!("{}: {problem}", experiment.name()));
                    whole.end(&bar, turn, experiment, clock.elapsed());
                    if let Ok(mut done) = done.lock() {
                        done.push((k, result));
                    }
                }
            });
        }
    });
    let done = done.into_inner().map_err(|_| "a run has panicked")?;
    for (k, result) in done {
        outcomes[k] = Some(result?);
    }
    let complete: Option<Vec<Outcome>> = outcomes.into_iter().collect();
    Ok(complete.ok_or("a run has panicked")?)
}

fn file(folder: &Path, experiment: &Experiment) -> std::path::PathBuf {
    folder.join(format!("{}.json", experiment.name()))
}

/// Reads the outcome of a run; an invalid one is computed anew.
fn read(path: &Path, experiment: &Experiment) -> Option<Outcome> {
    let outcome: Outcome = serde_json::from_slice(&fs::read(path).ok()?).ok()?;
    (outcome.experiment == *experiment).then_some(outcome)
}

/// Writes to a temporary file first: a killed program leaves a complete file or none.
fn write(path: &Path, outcome: &Outcome) -> Result<(), Problem> {
    let beside = path.with_extension("new");
    let failed = |error| format!("cannot write {}: {error}", path.display());
    fs::write(&beside, serde_json::to_vec(outcome)?).map_err(failed)?;
    fs::rename(&beside, path).map_err(failed)?;
    Ok(())
}

/// Progress on standard error: bars on a terminal, else a line per completed run.
struct Whole {
    bars: MultiProgress,
    all: ProgressBar,
    efforts: Vec<f64>,
    shares: Mutex<Vec<f64>>,
    shown: Mutex<Instant>,
    begin: Instant,
}

impl Whole {
    fn new(efforts: &[f64], done: usize) -> Self {
        let bars = MultiProgress::new();
        let all = bars.add(ProgressBar::new(PARTS as u64));
        if let Ok(style) = ProgressStyle::with_template("{bar:30} {percent:>3} %  {msg}") {
            all.set_style(style);
        }
        if done > 0 && bars.is_hidden() {
            note!("{done} runs are there already, {} to take", efforts.len());
        }
        Self {
            bars,
            all,
            efforts: efforts.to_vec(),
            shares: Mutex::new(vec![0.0; efforts.len()]),
            shown: Mutex::new(Instant::now()),
            begin: Instant::now(),
        }
    }

    fn begin(&self, experiment: &Experiment) -> ProgressBar {
        let bar = self.bars.add(ProgressBar::new(PARTS as u64));
        if let Ok(style) = ProgressStyle::with_template("{bar:30} {percent:>3} %  {msg}") {
            bar.set_style(style);
        }
        bar.set_message(experiment.name());
        bar
    }

    /// A few times per second, at no cost for a run.
    fn show(&self, bar: &ProgressBar, turn: usize, share: f64) {
        const WHILE: Duration = Duration::from_millis(150);
        let Ok(mut shown) = self.shown.try_lock() else {
            return;
        };
        if shown.elapsed() < WHILE {
            return;
        }
        *shown = Instant::now();
        drop(shown);
        let done = self.set(turn, share);
        bar.set_position((share * PARTS) as u64);
        self.all.set_position((done * PARTS) as u64);
        self.all.set_message(self.left(done));
    }

    /// Updates a run's share of the total progress.
    fn set(&self, turn: usize, share: f64) -> f64 {
        let Ok(mut shares) = self.shares.lock() else {
            return 0.0;
        };
        shares[turn] = share;
        let done: f64 = shares.iter().zip(&self.efforts).map(|(s, e)| s * e).sum();
        done / self.efforts.iter().sum::<f64>()
    }

    fn left(&self, done: f64) -> String {
        let seconds = self.begin.elapsed().as_secs_f64() * (1.0 / done.max(1e-6) - 1.0);
        format!(
            "about {:.0} min {:.0} s left",
            (seconds / 60.0).floor(),
            seconds % 60.0
        )
    }

    fn end(&self, bar: &ProgressBar, turn: usize, experiment: &Experiment, took: Duration) {
        let done = self.set(turn, 1.0);
        bar.finish_and_clear();
        self.bars.remove(bar);
        if self.bars.is_hidden() {
            let (percent, seconds) = (100.0 * done, took.as_secs_f64());
            let left = self.left(done);
            note!(
                "{percent:3.0} %  {} in {seconds:.1} s, {left}",
                experiment.name()
            );
        }
    }
}

impl Drop for Whole {
    fn drop(&mut self) {
        self.all.finish_and_clear();
    }
}
