//! Files in the format of the SEAS benchmarks during a run.

use std::fs::{File, create_dir_all};
use std::io::BufWriter;
use std::ops::ControlFlow;
use std::path::PathBuf;

use pyo3::prelude::*;
use pyo3::types::PyDict;
use stickslip::Snapshot;
use stickslip::record::{
    FileError, RuptureTimes, SeasGlobal, SeasHeader, SeasPoint, SeasProfile, SeasStation,
};

use crate::arguments::{count, positive};
use crate::errors::argument;

/// Positions on a fault.
#[derive(FromPyObject)]
enum Points {
    /// On a line \[m\].
    #[pyo3(transparent, annotation = "positions on a line")]
    Line(Vec<f64>),
    /// Along strike and down dip \[m\].
    #[pyo3(transparent, annotation = "pairs of positions on a plane")]
    Plane(Vec<[f64; 2]>),
}

impl Points {
    fn points(self) -> Vec<SeasPoint> {
        match self {
            Self::Line(points) => points.into_iter().map(SeasPoint::Line).collect(),
            Self::Plane(points) => points.into_iter().map(SeasPoint::Plane).collect(),
        }
    }
}

/// Files in the format of the SEAS benchmarks, for `FaultSimulation.run(.., seas=..)`:
///
/// - `global.dat`: the largest slip rate and the moment rate;
/// - a file per station, such as `fltst_dp075` or `fltst_strk-16dp+10`: slip, slip rate, stress and state;
/// - with `line`, slip and stresses there: `slip.dat`, `shear_stress.dat`, `normal_stress.dat` on a line, and
///   `slip_2_strike.dat`, `stress_2_strike.dat`, `normal_stress_strike.dat` on a plane (`depth` for a line down dip;
///   for a rake that is not horizontal the component of slip, in `slip_strike.dat`, `stress_strike.dat`; for a free rake
///   also component 3, down dip, in `slip_3_strike.dat`, `stress_3_strike.dat`);
/// - `rupture.dat` after an event: the rupture times of the first one.
///
/// Stations and lines are interpolated between the centres of cells. A run begins new files, with a row for its start;
/// every step is a row.
///
/// Args:
///     folder: of the files; it is created.
///     problem: of the header, such as "SEAS Benchmark BP1-QD".
///     stations: positions [m]: distances along a line, or pairs along strike and down dip.
///     line: positions [m] of slip and stresses on a line; on a plane all along strike, or all down dip.
///     intervals: between rows of slip and stresses outside and inside of events [s]; by default every step is a row.
///     threshold: largest slip rate in an event [m/s].
///     normal_stress: whether the normal stress is written, too.
///     unit: of positions in the names of stations [m]: 100, and 1000 for BP5.
///     digits: of the positions there, at least.
///     header: further lines of the header, such as {"element_size": "25 m"}.
#[pyclass(frozen, module = "stickslip")]
pub(crate) struct SeasFiles {
    folder: PathBuf,
    header: SeasHeader,
    stations: Vec<SeasPoint>,
    line: Vec<SeasPoint>,
    intervals: Option<[f64; 2]>,
    threshold: f64,
    normal_stress: bool,
    names: (f64, usize),
}

#[pymethods]
impl SeasFiles {
    #[new]
    #[pyo3(signature = (folder, problem, *, stations=Points::Line(Vec::new()), line=Points::Line(Vec::new()), intervals=None,
                        threshold=1e-2, normal_stress=false, unit=100.0, digits=3, header=Vec::new()),
           text_signature = "(folder, problem, *, stations=[], line=[], intervals=None, threshold=0.01, normal_stress=False, unit=100.0, digits=3, header={})")]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn new(
        folder: PathBuf,
        problem: &str,
        stations: Points,
        line: Points,
        intervals: Option<[f64; 2]>,
        threshold: f64,
        normal_stress: bool,
        unit: f64,
        digits: usize,
        #[pyo3(from_py_with = lines)] header: Vec<(String, String)>,
    ) -> PyResult<Self> {
        if let Some([quiet, event]) = intervals {
            positive("intervals[0]", quiet)?;
            positive("intervals[1]", event)?;
        }
        if count("digits", digits)? > 20 {
            return Err(argument("digits", "at most 20", digits));
        }
        let begin = SeasHeader::new(problem);
        Ok(Self {
            folder,
            header: (header.iter()).fold(begin, |header, (key, value)| header.with(key, value)),
            stations: stations.points(),
            line: line.points(),
            intervals,
            threshold: positive("threshold", threshold)?,
            normal_stress,
            names: (positive("unit", unit)?, digits),
        })
    }

    fn __repr__(&self) -> String {
        let (folder, stations) = (self.folder.display(), self.stations.len());
        format!("SeasFiles({folder}, {stations} stations)")
    }
}

/// The lines of a dictionary.
fn lines(given: &Bound<'_, PyAny>) -> PyResult<Vec<(String, String)>> {
    let pairs = given.cast::<PyDict>()?.iter();
    pairs
        .map(|(key, value)| Ok((key.extract()?, value.extract()?)))
        .collect()
}

/// The files of a run.
pub(super) struct Files<'a> {
    settings: &'a SeasFiles,
    stations: Vec<SeasStation<File>>,
    global: SeasGlobal<File>,
    profiles: Vec<SeasProfile<File>>,
    ruptures: RuptureTimes,
}

impl<'a> Files<'a> {
    /// New files with a row for the start of a run, of a fault whose slip on a plane has these directions.
    pub(super) fn create<const C: usize>(
        settings: &'a SeasFiles,
        (shear_modulus, directions): &(f64, Vec<[f64; 2]>),
        at: &Snapshot<'_, C>,
    ) -> Result<Self, FileError> {
        let (folder, header) = (&settings.folder, &settings.header);
        create_dir_all(folder).map_err(|source| FileError::Write {
            path: Some(folder.clone()),
            source,
        })?;
        let (unit, digits) = settings.names;
        let station = |&point: &SeasPoint| {
            let path = folder.join(point.file_name(unit, digits));
            let mut station = SeasStation::create(at, 0, point, header, path)?;
            if settings.normal_stress {
                station = station.with_normal_stress();
            }
            Ok(station.along(directions).with_start(at))
        };
        let stations = settings.stations.iter().map(station);
        let stations = stations.collect::<Result<_, FileError>>()?;
        let global = SeasGlobal::create(at, 0, *shear_modulus, header, folder.join("global.dat"))?;
        let profile = |name: &str| {
            let path = folder.join(name);
            let profile = SeasProfile::create(at, 0, &settings.line, header, path)?;
            match settings.intervals {
                Some(intervals) => Ok(profile.at_intervals(settings.threshold, intervals)?),
                None => Ok::<_, FileError>(profile),
            }
        };
        let mut profiles = Vec::new();
        for (c, component) in components(directions).iter().enumerate() {
            let Some([slip, stress, normal]) = names(&settings.line, component) else {
                break;
            };
            if c == 0 {
                profiles.push(profile(&slip)?);
                profiles.push(profile(&stress)?.shear_stress());
            } else {
                profiles.push(profile(&slip)?.down_dip());
                profiles.push(profile(&stress)?.shear_stress().down_dip());
            }
            if c == 0 && settings.normal_stress {
                profiles.push(profile(&normal)?.normal_stress());
            }
        }
        let profiles = profiles.into_iter().map(|profile| profile.with_start(at));
        let rates = [settings.threshold, 0.1 * settings.threshold];
        Ok(Self {
            settings,
            stations,
            global: global.with_start(at),
            profiles: profiles.collect(),
            ruptures: RuptureTimes::new(at, 0, rates)?,
        })
    }

    /// Records a step; ends the run on a write error.
    pub(super) fn record<const C: usize>(&mut self, at: &Snapshot<'_, C>) -> ControlFlow<()> {
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

    /// Writes what is left: buffered rows, and the rupture times of the first event.
    pub(super) fn finish(self) -> Result<(), FileError> {
        for station in self.stations {
            station.finish()?;
        }
        self.global.finish()?;
        for profile in self.profiles {
            profile.finish()?;
        }
        let first = self.ruptures.events().first();
        if let Some(rupture) = first.or(self.ruptures.under_way()) {
            let path = self.settings.folder.join("rupture.dat");
            let file = File::create(&path).map_err(|source| FileError::Write {
                path: Some(path),
                source,
            })?;
            let header = &self.settings.header;
            self.ruptures.write(rupture, header, BufWriter::new(file))?;
        }
        Ok(())
    }
}

/// The components of slip in the names of files: 2 along strike, 3 down dip, none for an oblique rake.
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
