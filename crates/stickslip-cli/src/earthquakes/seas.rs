//! Files in the format of the SEAS benchmarks.

use stickslip::Snapshot;
use stickslip::record::{SeasFiles, SeasFolder, SeasHeader, SeasPoint};

use super::{Arguments, Failed};

/// The places of the files.
pub(super) struct Places<'a> {
    pub(super) stations: Vec<SeasPoint>,
    /// The points of the profiles, a line each.
    pub(super) lines: Vec<Vec<SeasPoint>>,
    /// The unit \[m\] and the digits of the names of stations.
    pub(super) names: (f64, usize),
    pub(super) normal_stress: bool,
    pub(super) pore_fluid: bool,
    /// The slip rate of an event [m/s], and the intervals of profiles below and above it \[s\].
    pub(super) event: (f64, [f64; 2]),
    /// \[Pa\]
    pub(super) shear_modulus: f64,
    /// The components of slip, along strike and up dip.
    pub(super) directions: &'a [[f64; 2]],
}

/// The files that the command line asks for, with their first rows.
pub(super) fn files<const C: usize>(
    arguments: &Arguments,
    places: Places<'_>,
    at: &Snapshot<'_, C>,
) -> Result<Option<SeasFiles>, Failed> {
    let Some(folder) = &arguments.seas else {
        return Ok(None);
    };
    let name = arguments.published();
    let header = SeasHeader::new(&format!("SEAS Benchmark {name}"))
        .with("element_size", &format!("{} m", arguments.cell()));
    let ((unit, digits), (event, intervals)) = (places.names, places.event);
    let mut files = SeasFolder::new(folder, header)
        .with_stations(places.stations)
        .with_names(unit, digits)
        .with_event_rate(event)
        .at_intervals(intervals);
    for line in places.lines {
        files = files.with_line(line);
    }
    if places.pore_fluid {
        files = files.with_pore_fluid();
    }
    if places.normal_stress {
        files = files.with_normal_stress();
    }
    let files = files.create(at, places.shear_modulus, places.directions)?;
    Ok(Some(files))
}
