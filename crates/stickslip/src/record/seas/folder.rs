//! All files of a run in the format of the SEAS benchmarks.

use std::collections::HashMap;
use std::fs::{File, create_dir_all};
use std::path::PathBuf;

use super::columns::Chosen;
use super::{SeasFiles, SeasGlobal, SeasHeader, SeasPoint, SeasProfile, SeasStation};
use crate::Snapshot;
use crate::record::{FileError, RuptureTimes};

/// The files that a run writes in the format of the SEAS benchmarks, in one folder:
///
/// - `global.dat`: the largest slip rate and the moment rate;
/// - a file per station, such as `fltst_dp075` or `fltst_strk-16dp+10`: slip, slip rate, stress and state;
/// - slip and stresses along a line: `slip.dat`, `shear_stress.dat`, `normal_stress.dat`, `pore_pressure.dat` on a line,
///   and `slip_2_strike.dat`, `stress_2_strike.dat`, `normal_stress_strike.dat`, `pore_pressure_strike.dat` on a plane
///   (`depth` for points down dip, also component 3 with two components of slip, no number for a rake that is not along
///   strike);
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
    lines: Vec<Vec<SeasPoint>>,
    intervals: Option<[f64; 2]>,
    event: f64,
    chosen: Chosen,
    names: (f64, usize),
}

impl SeasFolder {
    /// Files in a folder, with `global.dat` alone at first.
    pub fn new(folder: impl Into<PathBuf>, header: SeasHeader) -> Self {
        Self {
            folder: folder.into(),
            header,
            stations: Vec::new(),
            lines: Vec::new(),
            intervals: None,
            event: 1e-2,
            chosen: Chosen::default(),
            names: (100.0, 3),
        }
    }

    /// Adds a file per station.
    #[must_use]
    pub fn with_stations(mut self, stations: impl IntoIterator<Item = SeasPoint>) -> Self {
        self.stations.extend(stations);
        self
    }

    /// Adds slip and stresses at the points of a line; on a plane all along strike, or all down dip, and by another call
    /// the other ones. No points add nothing.
    #[must_use]
    pub fn with_line(mut self, points: impl IntoIterator<Item = SeasPoint>) -> Self {
        self.lines.push(points.into_iter().collect());
        self.lines.retain(|line| !line.is_empty());
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
        self.chosen.normal_stress = true;
        self
    }

    /// Adds pore pressure and Darcy velocity to stations, and pore pressure along lines, as in BP6 and BP8. Shear stress
    /// on a plane is then in `shear_stress_2_strike.dat`, as in BP8.
    #[must_use]
    pub fn with_pore_fluid(mut self) -> Self {
        self.chosen.pore_fluid = true;
        self
    }

    /// Sets the unit \[m\] and the least number of digits of positions in the names of stations: by default 100 m and 3
    /// digits; BP5 takes 1000 m and 2.
    #[must_use]
    pub fn with_names(mut self, unit: f64, digits: usize) -> Self {
        self.names = (unit, digits);
        self
    }

    /// Refuses two stations or two lines with one file.
    fn check_names(&self) -> Result<(), FileError> {
        let (unit, digits) = self.names;
        let stations = self.stations.iter();
        let stations = stations.map(|point| (point.file_name(unit, digits), point));
        let lines = self.lines.iter().map(|line| (file("slip", line), &line[0]));
        let mut named = HashMap::new();
        for (name, point) in stations.chain(lines) {
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
    /// [`FileError::SameName`] for two stations or lines with one file, before any file is created; [`FileError::Write`] for a
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
            if self.chosen.normal_stress {
                station = station.with_normal_stress();
            }
            if self.chosen.pore_fluid {
                station = station.with_pore_fluid();
            }
            if !directions.is_empty() {
                station = station.along(directions);
            }
            Ok(station.with_start(at))
        };
        let stations = self.stations.iter().map(station);
        let stations = stations.collect::<Result<_, FileError>>()?;
        let global = SeasGlobal::create(at, 0, shear_modulus, header, folder.join("global.dat"))?;
        let mut profiles = Vec::new();
        for line in &self.lines {
            profiles.extend(self.profiles(at, line, directions)?);
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

    /// The profiles along a line.
    fn profiles<const C: usize>(
        &self,
        at: &Snapshot<'_, C>,
        line: &[SeasPoint],
        directions: &[[f64; 2]],
    ) -> Result<Vec<SeasProfile<File>>, FileError> {
        let profile = |quantity: &str| {
            let path = self.folder.join(file(quantity, line));
            let profile = SeasProfile::create(at, 0, line, &self.header, path)?;
            match self.intervals {
                Some(intervals) => Ok(profile.at_intervals(self.event, intervals)?),
                None => Ok::<_, FileError>(profile),
            }
        };
        // BP4 to BP7 have shorter names.
        let shear = if is_plane(line) && !self.chosen.pore_fluid {
            "stress"
        } else {
            "shear_stress"
        };
        let components: &[&str] = if is_plane(line) {
            components(directions)
        } else {
            &[""]
        };
        let mut profiles = Vec::new();
        for (c, component) in components.iter().enumerate() {
            let slip = profile(&format!("slip{component}"))?;
            let stress = profile(&format!("{shear}{component}"))?.shear_stress();
            if c > 0 {
                profiles.extend([slip.down_dip(), stress.down_dip()]);
            } else {
                profiles.extend([slip, stress]);
            }
        }
        if self.chosen.normal_stress {
            profiles.push(profile("normal_stress")?.normal_stress());
        }
        if self.chosen.pore_fluid {
            profiles.push(profile("pore_pressure")?.pore_pressure());
        }
        Ok(profiles)
    }
}

fn is_plane(line: &[SeasPoint]) -> bool {
    matches!(line.first(), Some(SeasPoint::Plane(_)))
}

/// The components of slip in the names of files of a plane: 2 along strike, 3 down dip, none for another rake.
fn components(directions: &[[f64; 2]]) -> &'static [&'static str] {
    match directions {
        [_, _] => &["_2", "_3"],
        [[along_strike, _]] if along_strike.abs() == 1.0 => &["_2"],
        _ => &[""],
    }
}

/// The name of the file of a quantity along a line.
fn file(quantity: &str, line: &[SeasPoint]) -> String {
    let axis = match line {
        [SeasPoint::Plane([x, _]), rest @ ..] => {
            let falls = |point: &SeasPoint| matches!(point, SeasPoint::Plane([y, _]) if x == y);
            let falls = !rest.is_empty() && rest.iter().all(falls);
            if falls { "_depth" } else { "_strike" }
        }
        _ => "",
    };
    format!("{quantity}{axis}.dat")
}
