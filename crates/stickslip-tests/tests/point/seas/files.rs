//! Files on disk, and writers that fail.

use std::io::{self, Write};

use stickslip::Steps;
use stickslip::integrate::StopReason;
use stickslip::problems::bp1;
use stickslip::record::{
    FileError, RuptureTimes, SeasGlobal, SeasPoint, SeasProfile, SeasStation, SeasTable,
};

use super::{Folder, YEAR, bp1_cycle, header};
use crate::Outcome;

/// Dropped without an end, files hold whole rows.
#[test]
fn an_interrupted_run_leaves_readable_files() -> Outcome {
    let folder = Folder::new("interrupted")?;
    let mut cycle = bp1_cycle(1e3)?;
    let at = cycle.snapshot();
    let point = SeasPoint::Line(7.5e3);
    let path = folder.join(&point.file_name(100.0, 3));
    let paths = ["global.dat", "slip.dat"].map(|name| folder.join(name));
    let mut station = SeasStation::create(&at, 0, point, &header(), &path)?.with_start(&at);
    let mut global = SeasGlobal::create(&at, 0, 32e9, &header(), &paths[0])?;
    let mut slip = SeasProfile::create(&at, 0, &[point], &header(), &paths[1])?;
    // The first row is in the file at once.
    assert_eq!(SeasTable::read(&path)?.len(), 1);
    let steps = Steps::adaptive(1e-4).until(20.0 * YEAR);
    let report = cycle.run(&steps, |at| {
        global.record(&at)?;
        slip.record(&at)?;
        station.record(&at)
    })?;
    let read = SeasTable::read(&path)?;
    assert!(read.len() <= report.accepted + 1);
    drop((station, global, slip));
    assert_eq!(SeasTable::read(&path)?.len(), report.accepted + 1);
    assert!(path.ends_with("fltst_dp075"));
    for path in &paths {
        assert_eq!(SeasTable::read(path)?.len(), report.accepted);
    }
    Ok(())
}

#[test]
fn files_that_cannot_be_created_are_refused() -> Outcome {
    let folder = Folder::new("absent")?;
    let path = folder.join("none").join("global.dat");
    let cycle = bp1_cycle(1e3)?;
    let (at, point) = (cycle.snapshot(), SeasPoint::Line(0.0));
    let errors = [
        SeasStation::create(&at, 0, point, &header(), &path).err(),
        SeasGlobal::create(&at, 0, 32e9, &header(), &path).err(),
        SeasProfile::create(&at, 0, &[point], &header(), &path).err(),
    ];
    for error in errors {
        let message = error.ok_or("no error")?.to_string();
        assert!(
            message.starts_with("cannot write") && message.contains("global.dat"),
            "{message}"
        );
    }
    // A station that does not exist leaves no file.
    let path = folder.join("fltst_dp500");
    let station = SeasStation::create(&at, 0, SeasPoint::Line(50e3), &header(), &path);
    assert!(station.is_err() && !path.exists());
    assert!(matches!(
        SeasTable::read(&path),
        Err(FileError::Read { .. })
    ));
    Ok(())
}

/// After the first row, files, rupture times in no event.
#[test]
fn recorders_take_no_memory_between_events() -> Outcome {
    let mut cycle = bp1_cycle(1e3)?;
    let (at, points) = (cycle.snapshot(), [0.0, 7.2e3].map(SeasPoint::Line));
    let mut station = SeasStation::new(&at, 0, points[0], &header(), io::sink())?.with_start(&at);
    let mut global = SeasGlobal::new(&at, 0, 32e9, &header(), io::sink())?.with_start(&at);
    let mut slip = SeasProfile::new(&at, 0, &points, &header(), io::sink())?.with_start(&at);
    let mut front = RuptureTimes::new(&at, 0, [1e-2, 1e-3])?;
    let mut outcome = None;
    let steps = Steps::adaptive(1e-7).until(100.0 * YEAR);
    let taken = allocation_counter::measure(|| {
        outcome = Some(cycle.run(&steps, |at| {
            front.record(&at);
            station.record(&at)?;
            global.record(&at)?;
            slip.record(&at)
        }));
    });
    let report = outcome.ok_or("not run")??;
    // More rows than the buffers keep.
    assert!(report.accepted > 150, "{}", report.accepted);
    assert_eq!(taken.count_total, 0);
    Ok(())
}

/// A disk that is full after some bytes.
struct Full(usize);

impl Write for Full {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0 = self
            .0
            .checked_sub(bytes.len())
            .ok_or(io::ErrorKind::StorageFull)?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_full_disk_ends_the_run() -> Outcome {
    let mut cycle = bp1_cycle(1e3)?;
    let modulus = bp1::MEDIUM.shear_modulus;
    let mut global = SeasGlobal::new(&cycle.snapshot(), 0, modulus, &header(), Full(3000))?;
    let steps = Steps::adaptive(1e-6).until(1e3 * YEAR);
    let report = cycle.run(&steps, |at| global.record(&at))?;
    assert_eq!(report.ended, StopReason::Observer);
    assert!(matches!(global.finish(), Err(FileError::Write { .. })));
    Ok(())
}
