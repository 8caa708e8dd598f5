//! Files in the format of the SEAS benchmarks.

use std::fs::{File, create_dir_all};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use stickslip::Snapshot;
use stickslip::problems::bp1::MEDIUM;
use stickslip::record::{
    RuptureTimes, SeasGlobal, SeasHeader, SeasPoint, SeasProfile, SeasStation,
};

use super::{Arguments, Failed};

/// The places of the files.
pub(super) struct Places<'a> {
    pub(super) stations: Vec<SeasPoint>,
    /// The points of the profiles.
    pub(super) line: Vec<SeasPoint>,
    /// The names of their files: slip, shear stress, and normal stress if it is written.
    pub(super) profiles: [&'static str; 3],
    /// The unit \[m\] and the digits of the names of stations.
    pub(super) names: (f64, usize),
    pub(super) normal_stress: bool,
    /// The slip rate of an event [m/s], and the intervals of profiles below and above it \[s\].
    pub(super) event: (f64, [f64; 2]),
    /// The components of slip, along strike and up dip.
    pub(super) directions: &'a [[f64; 2]],
}

/// The files of a run.
pub(super) struct SeasFiles<const C: usize> {
    folder: PathBuf,
    header: SeasHeader,
    stations: Vec<SeasStation<File>>,
    global: SeasGlobal<File>,
    profiles: Vec<SeasProfile<File>>,
    ruptures: RuptureTimes,
}

impl<const C: usize> SeasFiles<C> {
    /// The files that the command line asks for, with their first rows.
    pub(super) fn new(
        arguments: &Arguments,
        places: &Places<'_>,
        at: &Snapshot<'_, C>,
    ) -> Result<Option<Self>, Failed> {
        let Some(folder) = &arguments.seas else {
            return Ok(None);
        };
        Self::create(folder, arguments, places, at).map(Some)
    }

    fn create(
        folder: &Path,
        arguments: &Arguments,
        places: &Places<'_>,
        at: &Snapshot<'_, C>,
    ) -> Result<Self, Failed> {
        create_dir_all(folder)
            .map_err(|error| format!("cannot create folder {}: {error}", folder.display()))?;
        let name = arguments.problem.name().to_uppercase();
        let kind = if name == "BP7" { "QD-A" } else { "QD" };
        let header = SeasHeader::new(&format!("SEAS Benchmark {name}-{kind}"))
            .with("element_size", &format!("{} m", arguments.cell()));
        let (unit, digits) = places.names;
        let mut stations = Vec::new();
        for &point in &places.stations {
            let path = folder.join(point.file_name(unit, digits));
            let mut station = SeasStation::create(at, 0, point, &header, path)?;
            if places.normal_stress {
                station = station.with_normal_stress();
            }
            stations.push(station.along(places.directions).with_start(at));
        }
        let path = folder.join("global.dat");
        let global = SeasGlobal::create(at, 0, MEDIUM.shear_modulus, &header, path)?;
        let (threshold, intervals) = places.event;
        let profile = |name: &str| -> Result<_, Failed> {
            let path = folder.join(name);
            let profile = SeasProfile::create(at, 0, &places.line, &header, path)?;
            Ok(profile.at_intervals(threshold, intervals)?)
        };
        let [slip, shear, normal] = places.profiles;
        let mut profiles = vec![profile(slip)?, profile(shear)?.shear_stress()];
        if places.normal_stress {
            profiles.push(profile(normal)?.normal_stress());
        }
        Ok(Self {
            folder: folder.to_owned(),
            stations,
            global: global.with_start(at),
            profiles: (profiles.into_iter())
                .map(|profile| profile.with_start(at))
                .collect(),
            ruptures: RuptureTimes::new(at, 0, [threshold, 0.1 * threshold])?,
            header,
        })
    }

    /// Records a step; ends the run on a write error.
    pub(super) fn record(&mut self, at: &Snapshot<'_, C>) -> ControlFlow<()> {
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

    /// Writes what is left: the rupture times of the first event.
    pub(super) fn finish(self) -> Result<(), Failed> {
        for station in self.stations {
            station.finish()?;
        }
        self.global.finish()?;
        for profile in self.profiles {
            profile.finish()?;
        }
        let first = self.ruptures.events().first();
        if let Some(rupture) = first.or(self.ruptures.under_way()) {
            let path = self.folder.join("rupture.dat");
            let file = File::create(&path)
                .map_err(|error| format!("cannot write {}: {error}", path.display()))?;
            self.ruptures
                .write(rupture, &self.header, std::io::BufWriter::new(file))?;
        }
        Ok(())
    }
}
