//! All files of a run in the format of the SEAS benchmarks.

use std::collections::HashMap;
use std::fs::{File, create_dir_all};
use std::io::BufWriter;
use std::ops::ControlFlow;
use std::path::PathBuf;

use super::{SeasGlobal, SeasHeader, SeasPoint, SeasProfile, SeasStation};
use crate::Snapshot;
use crate::record::{FileError, RuptureTimes};

/// The files that a run writes in the format of the SEAS benchmarks, in one folder:
///
/// - `global.dat`: the largest slip rate and the moment rate;
/// - a file per station, such as `fltst_dp075` or `fltst_strk-16dp+10`: slip, slip rate, stress and state;
/// - slip and stresses along a line: `slip.dat`, `shear_stress.dat`, `normal_stress.dat` on a line, and
///   `slip_2_strike.dat`, `stress_2_strike.dat`, `normal_stress_strike.dat` on a plane (`depth` for points down dip,
///   also component 3 with two components of slip, no number for a rake that is not along strike);
/// - `rupture.dat` after an event: the rupture times of the first one.
///
/// ```no_run
/// use stickslip::bie::{Cells, Fault};
/// use stickslip::problems::bp1;
/// use stickslip::record::{SeasFolder, SeasHeader, SeasPoint};
/// use stickslip::{RungeKutta, Steps};
///
/// let cells = Cells::new([0.0, 40e3], 400)?;
/// let fault = Fault::half_space(cells, bp1::MEDIUM)?;
/// let mut cycle = RungeKutta::new(bp1::scene(&fault))?;
/// let mut files = SeasFolder::new("out/bp1", SeasHeader::new("SEAS Benchmark BP1-QD"))
///     .with_stations([0.0, 7.5e3, 15e3].map(SeasPoint::Line))
///     .with_line((0..400).map(|k| SeasPoint::Line(50.0 + 100.0 * f64::from(k))))
///     .at_intervals([5.0 * 365.25 * 86400.0, 1.0])
///     .create(&cycle.snapshot(), bp1::MEDIUM.shear_modulus, &[])?;
/// cycle.run(&Steps::adaptive(1e-4).until(1e10), |at| files.record(&at))?;
/// files.finish()?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct SeasFolder {
    folder: PathBuf,
    header: SeasHeader,
    stations: Vec<SeasPoint>,
    line: Vec<SeasPoint>,
    intervals: Option<[f64; 2]>,
    event: f64,
    normal_stress: bool,
    names: (f64, usize),
}

impl SeasFolder {
    /// Files in a folder, with `global.dat` alone at first.
    pub fn new(folder: impl Into<PathBuf>, header: SeasHeader) -> Self {
        Self {
            folder: folder.into(),
            header,
            stations: Vec::new(),
            line: Vec::new(),
            intervals: None,
            event: 1e-2,
            normal_stress: false,
            names: (100.0, 3),
        }
    }

    /// Adds a file per station.
    #[must_use]
    pub fn with_stations(mut self, stations: impl IntoIterator<Item = SeasPoint>) -> Self {
        self.stations.extend(stations);
        self
    }

    /// Adds slip and stresses at the points of a line; on a plane all along strike, or all down dip.
    #[must_use]
    pub fn with_line(mut self, points: impl IntoIterator<Item = SeasPoint>) -> Self {
        self.line.extend(points);
        self
    }

    /// Writes rows of slip and stresses along the line at these intervals outside and inside of events, both positive
    /// \[s\]; by default every step is a row.
    #[must_use]
    pub fn at_intervals(mut self, intervals: [f64; 2]) -> Self {
        self.intervals = Some(intervals);
        self
    }

    /// Sets the slip rate from which a vertex is in an event, by default 0.01 [m/s].
    #[must_use]
    pub fn with_event_rate(mut self, slip_rate: f64) -> Self {
        self.event = slip_rate;
        self
    }

    /// Adds the normal stress to stations and lines, as in BP3.
    #[must_use]
    pub fn with_normal_stress(mut self) -> Self {
        self.normal_stress = true;
        self
    }

    /// Sets the unit \[m\] and the least number of digits of positions in the names of stations: by default 100 m and 3
    /// digits; BP5 takes 1000 m and 2.
    #[must_use]
    pub fn with_names(mut self, unit: f64, digits: usize) -> Self {
        self.names = (unit, digits);
        self
    }

    /// Refuses two stations with one file.
    fn check_names(&self) -> Result<(), FileError> {
        let (unit, digits) = self.names;
        let mut named = HashMap::new();
        for point in &self.stations {
            let name = point.file_name(unit, digits);
            if let Some(first) = named.insert(name.clone(), point) {
                return Err(FileError::SameName {
                    path: self.folder.join(name),
                    points: [first, point].map(ToString::to_string),
                });
            }
        }
        Ok(())
    }

    /// Creates the folder and the files, each with a row for the state shown. The moment takes the shear modulus \[Pa\].
    /// `directions` are those of the components of slip on a plane, as of `PlaneFault::directions`; on a line they mean
    /// nothing.
    ///
    /// # Errors
    /// [`FileError::SameName`] for two stations with one file, before any file is created; [`FileError::Write`] for a
    /// folder or file that cannot be created, and those of [`SeasStation::new`],
    /// [`SeasGlobal::new`] and [`SeasProfile::new`].
    pub fn create<const C: usize>(
        &self,
        at: &Snapshot<'_, C>,
        shear_modulus: f64,
        directions: &[[f64; 2]],
    ) -> Result<SeasFiles, FileError> {
        let (folder, header) = (&self.folder, &self.header);
        self.check_names()?;
        create_dir_all(folder).map_err(|source| FileError::Write {
            path: Some(folder.clone()),
            source,
        })?;
        let (unit, digits) = self.names;
        let station = |&point: &SeasPoint| {
            let path = folder.join(point.file_name(unit, digits));
            let mut station = SeasStation::create(at, 0, point, header, path)?;
            if self.normal_stress {
                station = station.with_normal_stress();
            }
            if !directions.is_empty() {
                station = station.along(directions);
            }
            Ok(station.with_start(at))
        };
        let stations = self.stations.iter().map(station);
        let stations = stations.collect::<Result<_, FileError>>()?;
        let global = SeasGlobal::create(at, 0, shear_modulus, header, folder.join("global.dat"))?;
        let profile = |name: &str| {
            let path = folder.join(name);
            let profile = SeasProfile::create(at, 0, &self.line, header, path)?;
            match self.intervals {
                Some(intervals) => Ok(profile.at_intervals(self.event, intervals)?),
                None => Ok::<_, FileError>(profile),
            }
        };
        let mut profiles = Vec::new();
        for (c, component) in components(directions).iter().enumerate() {
            let Some([slip, stress, normal]) = names(&self.line, component) else {
                break;
            };
            let (slip, stress) = (profile(&slip)?, profile(&stress)?.shear_stress());
            if c > 0 {
                profiles.extend([slip.down_dip(), stress.down_dip()]);
                continue;
            }
            profiles.extend([slip, stress]);
            if self.normal_stress {
                profiles.push(profile(&normal)?.normal_stress());
            }
        }
        let profiles = profiles.into_iter().map(|profile| profile.with_start(at));
        Ok(SeasFiles {
            folder: folder.clone(),
            header: header.clone(),
            stations,
            global: global.with_start(at),
            profiles: profiles.collect(),
            ruptures: RuptureTimes::new(at, 0, [self.event, 0.1 * self.event])?,
        })
    }
}

/// The components of slip in the names of files: 2 along strike, 3 down dip, none for another rake.
fn components(directions: &[[f64; 2]]) -> &'static [&'static str] {
    match directions {
        [_, _] => &["_2", "_3"],
        [[along_strike, _]] if along_strike.abs() == 1.0 => &["_2"],
        _ => &[""],
    }
}

/// The names of files of slip, shear and normal stress along a line, if there is one.
fn names(line: &[SeasPoint], component: &str) -> Option<[String; 3]> {
    let names = match line {
        [] => return None,
        [SeasPoint::Line(_), ..] => ["slip", "shear_stress", "normal_stress"].map(String::from),
        [SeasPoint::Plane([x, _]), rest @ ..] => {
            let falls = |point: &SeasPoint| matches!(point, SeasPoint::Plane([y, _]) if x == y);
            let falls = !rest.is_empty() && rest.iter().all(falls);
            let axis = if falls { "depth" } else { "strike" };
            let of = |name: &str| format!("{name}{component}_{axis}");
            [of("slip"), of("stress"), format!("normal_stress_{axis}")]
        }
    };
    Some(names.map(|name| name + ".dat"))
}

/// The files of a run, made by [`SeasFolder::create`].
#[derive(Debug)]
pub struct SeasFiles {
    folder: PathBuf,
    header: SeasHeader,
    stations: Vec<SeasStation<File>>,
    global: SeasGlobal<File>,
    profiles: Vec<SeasProfile<File>>,
    ruptures: RuptureTimes,
}

impl SeasFiles {
    /// Records a step; ends the run on a write error, which [`finish`](Self::finish) returns.
    pub fn record<const C: usize>(&mut self, at: &Snapshot<'_, C>) -> ControlFlow<()> {
        for station in &mut self.stations {
            station.record(at)?;
        }
        self.global.record(at)?;
        for profile in &mut self.profiles {
            profile.record(at)?;
        }
        self.ruptures.record(at);
        ControlFlow::Continue(())
    }

    /// Writes the buffered rows, and the rupture times of the first event.
    ///
    /// # Errors
    /// [`FileError::Write`], also that of a step.
    pub fn finish(self) -> Result<(), FileError> {
        for station in self.stations {
            station.finish()?;
        }
        self.global.finish()?;
        for profile in self.profiles {
            profile.finish()?;
        }
        let first = self.ruptures.events().first();
        let Some(rupture) = first.or(self.ruptures.under_way()) else {
            return Ok(());
        };
        let path = self.folder.join("rupture.dat");
        let file = File::create(&path).map_err(|source| FileError::Write {
            path: Some(path),
            source,
        })?;
        let rows = BufWriter::new(file);
        self.ruptures.write(rupture, &self.header, rows)?;
        Ok(())
    }
}
