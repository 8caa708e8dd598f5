//! From a command line to records, load histories and the fit.

use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use stickslip::lab::{Evolution, Experiment, Fit, LabError, LoadHistory, Parameter, Record};

use super::arguments::{Arguments, Stiffness};
use crate::cli::Problem;
use crate::table::{Columns, Table};

/// A file that cannot be fitted.
pub(super) struct Unread {
    /// The file.
    pub(super) file: String,
    /// Why, in one line.
    pub(super) error: String,
}

impl Unread {
    /// A file or window that a fit refuses.
    pub(super) fn of(job: &Job, error: &LabError) -> Self {
        Self {
            file: job.file.clone(),
            error: format!("{}: {error}", job.name()),
        }
    }

    /// Its part of the summary.
    pub(super) fn summary(&self) -> Value {
        json!({"file": self.file, "error": self.error})
    }
}

/// A file or a window of it.
#[derive(Clone)]
pub(super) struct Job {
    /// The file.
    pub(super) file: String,
    /// The window [s], if there is one.
    pub(super) window: Option<(f64, f64)>,
    pub(super) record: Record,
    pub(super) load: LoadHistory,
    /// The rows of the file that were dropped for an empty cell.
    pub(super) dropped: usize,
}

impl Job {
    /// The file and the window.
    pub(super) fn name(&self) -> String {
        match self.window {
            Some((from, to)) => format!("{} {from}:{to}", self.file),
            None => self.file.clone(),
        }
    }

    /// A note of rows that were dropped.
    pub(super) fn note(&self) -> Option<String> {
        match self.dropped {
            0 => None,
            1 => Some("1 row with an empty cell was dropped".into()),
            many => Some(format!("{many} rows with an empty cell were dropped")),
        }
    }
}

impl Arguments {
    /// One state law per state.
    pub(super) fn laws(&self) -> Result<Vec<Evolution<'static>>, Problem> {
        let laws: Vec<_> = self.law.iter().map(|law| law.evolution()).collect();
        let states = self.states.map_or(laws.len(), usize::from);
        match laws[..] {
            [one] => Ok(vec![one; states]),
            [_, _] if states == 2 => Ok(laws),
            _ => Err(format!("--law: {} laws for --states {states}", laws.len()).into()),
        }
    }

    /// The fit.
    pub(super) fn fit(&self, laws: &[Evolution<'static>]) -> Fit<'static> {
        let mut fit = Fit::new(laws).with_loss(self.loss.loss());
        for &parameter in &self.free {
            fit = fit.with_free(parameter);
        }
        for &(parameter, low, high) in &self.bounds {
            fit = fit.with_bounds(parameter, low, high);
        }
        for &(parameter, value) in &self.guess {
            fit = fit.with_guess_of(parameter, value);
        }
        for &(parameter, value) in &self.fix {
            fit = fit.with_fixed(parameter, value);
        }
        if let Some(detrend) = self.detrend {
            fit = fit.with_trend(detrend.trend());
        }
        if self.free_initial_state {
            fit = fit.with_free_initial_state();
        }
        if self.step_offset {
            fit = fit.with_step_offset();
        }
        if let Some(velocity) = self.reference_velocity {
            fit = fit.with_reference_velocity(velocity);
        }
        fit
    }

    /// The experiment of a file, with the stiffness of its machine if it is known.
    pub(super) fn machine<'j>(&self, job: &'j Job) -> Experiment<'j> {
        let experiment = Experiment::new(&job.record, &job.load);
        let same = |file: &PathBuf| file.display().to_string() == job.file;
        let place = self.files.iter().position(same).unwrap_or(0);
        match self.stiffness.get(place).or(self.stiffness.first()) {
            Some(Stiffness::Fixed(stiffness)) => experiment.with_stiffness(*stiffness),
            _ => experiment,
        }
    }

    /// The files and their windows, and the files that cannot be fitted.
    pub(super) fn jobs(&self) -> Result<(Vec<Job>, Vec<Unread>), Problem> {
        for &(parameter, _) in &self.fix {
            if parameter == Parameter::Stiffness && self.stiffness != [Stiffness::Free] {
                return Err("--fix k and --stiffness are given".into());
            }
        }
        let (machines, files) = (self.stiffness.len(), self.files.len());
        if machines != 1 && machines != files {
            return Err(format!(
                "--stiffness: {machines} values for {files} files; give one, or one per file"
            )
            .into());
        }
        let (mut jobs, mut unread) = (Vec::new(), Vec::new());
        for file in &self.files {
            match self.jobs_of(file) {
                Ok(of_file) => jobs.extend(of_file),
                Err(error) => unread.push(Unread {
                    file: file.display().to_string(),
                    error: error.to_string(),
                }),
            }
        }
        Ok((jobs, unread))
    }

    /// A file and its windows.
    fn jobs_of(&self, path: &Path) -> Result<Vec<Job>, Problem> {
        let file = path.display().to_string();
        let whole = self.experiment(path).map_err(|error| {
            let error = error.to_string();
            let named = error.contains(&file);
            if named {
                error
            } else {
                format!("{file}: {error}")
            }
        })?;
        if self.window.is_empty() {
            return Ok(vec![whole]);
        }
        let window = |&(from, to): &(f64, f64)| {
            let record = whole.record.window(from, to);
            if record.times().is_empty() {
                return Err(format!("{file} has no samples in --window {from}:{to}").into());
            }
            Ok(Job {
                window: Some((from, to)),
                record,
                ..whole.clone()
            })
        };
        self.window.iter().map(window).collect()
    }

    /// The record of a file and the history of its load point.
    fn experiment(&self, file: &Path) -> Result<Job, Problem> {
        let table = Table::read(file, &self.format)?;
        let defaults: &[&str] = if !self.steps_at.is_empty() {
            &["displacement", "friction"]
        } else if !self.steps.is_empty() && !table.has("displacement") {
            &["time", "friction"]
        } else {
            &["time", "displacement", "friction"]
        };
        let names: Vec<&str> = if self.columns.is_empty() {
            defaults.to_vec()
        } else {
            self.columns.iter().map(String::as_str).collect()
        };
        let wanted: Vec<&str> = names.into_iter().chain(self.weights.as_deref()).collect();
        let Columns {
            values: mut columns,
            dropped,
        } = table.columns(&wanted)?;
        let weights = self.weights.as_ref().and_then(|_| columns.pop());
        let friction = columns.pop().unwrap_or_default();
        let displaced = |column: &[f64]| -> Vec<f64> {
            column.iter().map(|x| self.displacement_unit * x).collect()
        };
        let (times, load) = match (
            &columns[..],
            self.steps.is_empty(),
            self.steps_at.is_empty(),
        ) {
            ([displacements], _, false) => {
                let (initial, changes) = (self.steps_at[0].1, &self.steps_at[1..]);
                let load = LoadHistory::by_displacement(initial, changes)?;
                let displacements = displaced(displacements);
                (displacements.iter().map(|&x| load.time(x)).collect(), load)
            }
            ([times] | [times, _], false, true) => {
                let load = LoadHistory::new(self.steps[0].1, &self.steps[1..])?;
                (times.clone(), load)
            }
            ([times, displacements], true, true) => {
                let displacements = displaced(displacements);
                let (resolution, initial) = (self.resolution, self.initial_velocity);
                let load = LoadHistory::measured(times, &displacements, resolution, initial)?;
                (times.clone(), load)
            }
            _ => {
                return Err(
                    "--columns: TIME,DISPLACEMENT,FRICTION, or TIME,FRICTION with --steps, or \
                     DISPLACEMENT,FRICTION with --steps-at"
                        .into(),
                );
            }
        };
        let mut record = Record::new(times, friction)?;
        if let Some(weights) = weights {
            record = record.with_weights(weights)?;
        }
        Ok(Job {
            file: file.display().to_string(),
            window: None,
            record,
            load,
            dropped,
        })
    }
}
