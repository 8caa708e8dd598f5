//! Displacement off the fault during a run: stations of the benchmarks, receivers of a table, a grid of the surface.

mod arguments;
mod surface;
mod table;

pub use arguments::OffFault;

use std::ops::ControlFlow;
use std::path::Path;

use stickslip::Snapshot;
use stickslip::bie::{self, Receivers, Sources};
use stickslip::nalgebra::SVector;
use stickslip::record::{ReceiverFiles, ReceiverFolder, SeasHeader};

use super::{Arguments, Failed};
use surface::Surface;

/// Components of displacement: names, and directions along the axes of the receivers.
pub(super) type Axes = &'static [(&'static str, [f64; 3])];

/// Those of a line in plane strain: horizontal and down.
pub(super) const PLANE_STRAIN: Axes = &[("1", [1.0, 0.0, 0.0]), ("2", [0.0, 0.0, -1.0])];
/// Those of a vertical plane: along its normal, along strike and down.
pub(super) const VERTICAL: Axes = &[
    ("1", [0.0, -1.0, 0.0]),
    ("2", [1.0, 0.0, 0.0]),
    ("3", [0.0, 0.0, -1.0]),
];
/// Those of a plane in a whole space.
pub(super) const WHOLE_SPACE: Axes = &[
    ("1", [0.0, 0.0, 1.0]),
    ("2", [1.0, 0.0, 0.0]),
    ("3", [0.0, -1.0, 0.0]),
];
/// Those of receivers as they are.
pub(super) const OWN: Axes = &[
    ("x", [1.0, 0.0, 0.0]),
    ("y", [0.0, 1.0, 0.0]),
    ("z", [0.0, 0.0, 1.0]),
];

/// What a problem knows of what is off its fault.
pub(super) struct Plan<const C: usize> {
    pub(super) sources: Sources<C>,
    /// The rate of creep on the rest of the plane [m/s]; none of faults that are not one plane.
    pub(super) plate: Option<SVector<f64, C>>,
    /// The names and points of the stations of the benchmark.
    pub(super) stations: Vec<(String, [f64; 3])>,
    pub(super) axes: Axes,
    /// The slip rate of events [m/s].
    pub(super) event: f64,
    /// The extent of the cells along `x` and `y` \[m\]; none without a free surface in space.
    pub(super) extent: Option<[[f64; 2]; 2]>,
}

/// The files of a run.
pub(super) struct Record<const C: usize> {
    files: Vec<ReceiverFiles<C>>,
    surface: Option<Surface<C>>,
}

impl<const C: usize> Record<C> {
    /// Those that the command line asks for, with their first rows, in the folder of the run or that of the benchmark.
    pub(super) fn new(
        arguments: &Arguments,
        plan: Plan<C>,
        folder: &Path,
        at: &Snapshot<'_, C>,
    ) -> Result<Self, Failed> {
        let (seas, asked) = (arguments.seas.as_deref(), &arguments.off_fault);
        let mut files = Vec::new();
        if let Some(seas) = seas
            && !plan.stations.is_empty()
        {
            let (names, points): (Vec<_>, Vec<_>) = plan.stations.iter().cloned().unzip();
            files.push(plan.files(arguments, seas, (names, points), at)?);
        }
        if let Some(path) = &asked.receivers {
            let (names, points) = table::read(path)?;
            let kind = if seas.is_some() { "srfst" } else { "receiver" };
            let names = names.iter().map(|name| format!("{kind}_{name}")).collect();
            let folder = seas.unwrap_or(folder);
            files.push(plan.files(arguments, folder, (names, points), at)?);
        }
        let mut surface = None;
        if let Some(spacing) = asked.surface_grid {
            let Some(extent) = plan.extent else {
                return Err(
                    "--surface-grid is a setting of planes in a half space and of triangles: take --receivers for lines"
                        .into(),
                );
            };
            let (of, at_events) = ((plan.sources, plan.plate), (folder.into(), plan.event));
            surface = Some(Surface::new(of, (extent, spacing), at_events, at)?);
        }
        Ok(Self { files, surface })
    }

    /// Records a step; ends the run on a write error.
    pub(super) fn record(&mut self, at: &Snapshot<'_, C>) -> ControlFlow<()> {
        for files in &mut self.files {
            files.record(at)?;
        }
        match &mut self.surface {
            Some(surface) => surface.record(at),
            None => ControlFlow::Continue(()),
        }
    }

    /// Writes what is left.
    pub(super) fn finish(self, at: &Snapshot<'_, C>) -> Result<(), Failed> {
        for files in self.files {
            files.finish()?;
        }
        self.surface.map_or(Ok(()), |surface| surface.finish(at))
    }
}

impl<const C: usize> Plan<C> {
    /// That of a fault in a whole space that does not slip beyond its cells.
    pub(super) fn of_injection(
        fault: &impl bie::OffFault<C>,
        axes: Axes,
        event: f64,
    ) -> Result<Self, Failed> {
        Ok(Self {
            sources: fault.sources()?,
            plate: None,
            stations: Vec::new(),
            axes,
            event,
            extent: None,
        })
    }

    fn files(
        &self,
        arguments: &Arguments,
        folder: &Path,
        (names, points): (Vec<String>, Vec<[f64; 3]>),
        at: &Snapshot<'_, C>,
    ) -> Result<ReceiverFiles<C>, Failed> {
        let (problem, axes) = if arguments.seas.is_some() {
            (
                format!("SEAS Benchmark {}", arguments.published()),
                self.axes,
            )
        } else if arguments.fault_file.faults.is_some() {
            ("faults of a file".into(), OWN)
        } else {
            (arguments.published(), OWN)
        };
        let mut header = SeasHeader::new(&problem);
        if arguments.fault_file.faults.is_none() {
            header = header.with("element_size", &format!("{} m", arguments.cell()));
        }
        let receivers = Receivers::of_sources(self.sources.clone(), &points)?;
        let mut files = ReceiverFolder::new(folder, header, receivers)
            .with_names(names)
            .with_axes(axes.iter().copied());
        if let Some(rate) = self.plate {
            files = files.with_creep(rate)?;
        }
        Ok(files.create(at)?)
    }
}

/// The name of a station off a plane: along strike, along the normal and down, in multiples of a unit \[m\].
pub(super) fn block_name([x, normal, down]: [f64; 3], (unit, digits): (f64, usize)) -> String {
    // Zero has no negative sign.
    let number = |x: f64| (x / unit).round() + 0.0;
    let [x, normal, down] = [x, normal, down].map(number);
    let signed = digits + 1;
    format!("blkst_strk{x:+0signed$}fn{normal:+0signed$}dp{down:+0signed$}")
}
