//! The cells of faults of a file, as a run sees them.

use std::fs::File;
use std::path::Path;

use stickslip::bie::{Mode, SegmentFault, Segments, SurfaceFault, Triangles};
use stickslip::fem::gmsh;
use stickslip::problems::bp1::MEDIUM;

use super::super::bp3::POISSON_RATIO;
use super::super::{Arguments, Failed};

/// Cells, whatever they are made of.
pub(super) struct Layout {
    /// The number of its fault, of each cell.
    pub(super) faults: Vec<usize>,
    pub(super) centers: Vec<[f64; 3]>,
    /// Lengths \[m\] or areas [m^2].
    pub(super) sizes: Vec<f64>,
    /// The distance down dip of a cell of a polyline, the depth of a triangle \[m\].
    pub(super) downward: Vec<f64>,
    /// The angle with neighbours \[degrees\], of polylines.
    pub(super) bends: Vec<f64>,
    /// Lines of cells for pictures, from below, with their distances upwards \[km\].
    pub(super) lines: Vec<Vec<(usize, f64)>>,
    pub(super) largest_bend: f64,
    /// The number, the extent and the largest bend of the cells: the extent tells kilometres from metres.
    pub(super) told: String,
}

impl Layout {
    /// The number of cells.
    pub(super) fn count(&self) -> usize {
        self.centers.len()
    }

    /// The extent of the centres of triangles along `x` and `y` \[m\]; none of polylines.
    pub(super) fn extent(&self) -> Option<[[f64; 2]; 2]> {
        if !self.lines.is_empty() {
            return None;
        }
        let range = |axis: usize| {
            let places = self.centers.iter().map(|center| center[axis]);
            let none = [f64::INFINITY, f64::NEG_INFINITY];
            places.fold(none, |[low, high], x| [low.min(x), high.max(x)])
        };
        Some([range(0), range(1)])
    }

    /// The number of faults.
    pub(super) fn fault_count(&self) -> usize {
        self.faults.iter().max().map_or(0, |last| last + 1)
    }

    /// Of polylines.
    pub(super) fn of_segments(cells: &Segments) -> Self {
        let all = || 0..cells.count();
        let quality = cells.quality();
        let downward = cells.distances();
        let lines = (0..cells.fault_count()).map(|fault| {
            let line = cells.cells_of(fault);
            line.rev()
                .map(|cell| (cell, -downward[cell] / 1e3))
                .collect()
        });
        let mut layout = Self {
            faults: all().map(|cell| cells.fault_of(cell)).collect(),
            centers: cells.map(|[x, z]| [x, 0.0, z]),
            sizes: all().map(|cell| cells.length(cell)).collect(),
            bends: all().map(|cell| cells.bend_at(cell)).collect(),
            lines: lines.collect(),
            largest_bend: quality.largest_bend,
            told: String::new(),
            downward,
        };
        let place = quality.largest_bend_between;
        layout.told = layout.tell(
            all()
                .flat_map(|cell| cells.ends(cell))
                .map(|[x, z]| [x, 0.0, z]),
            place.map(|[cell, _]| cell),
        );
        layout
    }

    /// Of triangles.
    pub(super) fn of_triangles(cells: &Triangles) -> Self {
        let all = || 0..cells.count();
        let quality = cells.quality();
        let mut layout = Self {
            faults: all().map(|cell| cells.sheet(cell)).collect(),
            centers: cells.map(|center| center),
            sizes: all().map(|cell| cells.area(cell)).collect(),
            downward: cells.map(|[_, _, z]| -z),
            bends: vec![f64::NAN; cells.count()],
            lines: Vec::new(),
            largest_bend: quality.largest_bend.map_or(0.0, |(bend, _)| bend),
            told: String::new(),
        };
        let place = quality.largest_bend.map(|(_, [cell, _])| cell);
        layout.told = layout.tell(cells.points().iter().copied(), place);
        layout
    }

    fn tell(&self, points: impl Iterator<Item = [f64; 3]>, bend: Option<usize>) -> String {
        let none = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        let [low, high] = points.fold(none, |[low, high], point| {
            let ends = |k: usize| (low[k].min(point[k]), high[k].max(point[k]));
            let ends = [0, 1, 2].map(ends);
            [ends.map(|(low, _)| low), ends.map(|(_, high)| high)]
        });
        let range =
            |name: &str, k: usize| format!("{name} from {:.1} m to {:.1} m", low[k], high[k]);
        let number = self.fault_count();
        let faults = if number == 1 { "fault" } else { "faults" };
        let bend = bend.map_or_else(String::new, |cell| {
            let bend = self.largest_bend;
            format!(", largest bend {bend:.2} degrees behind cell {cell}")
        });
        format!(
            "{} cells on {number} {faults}, {}, {}, {}{bend}",
            self.count(),
            range("x", 0),
            range("y", 1),
            range("z", 2)
        )
    }
}

/// Whether a file holds triangles, by its ending; else it is a table.
pub(super) fn has_triangles(path: &Path) -> bool {
    let ending = path.extension().and_then(|ending| ending.to_str());
    ending.is_some_and(|ending| ["msh", "stl"].contains(&ending.to_lowercase().as_str()))
}

/// The faults of a table, in cells.
pub(super) fn segments(arguments: &Arguments, path: &Path) -> Result<SegmentFault, Failed> {
    let settings = &arguments.fault_file;
    if settings.rake.is_some() || !settings.groups.is_empty() {
        return Err(
            "--rake and --groups are settings of triangles: of --faults FILE.msh or FILE.stl"
                .into(),
        );
    }
    let name = path.display();
    let file = File::open(path).map_err(|cause| format!("cannot read {name}: {cause}"))?;
    let wrong = |error| Failed::from(format!("{name}: {error}"));
    let lines = Segments::from_csv(file).map_err(wrong)?;
    let cells = lines.divided(arguments.cell()).map_err(wrong)?;
    let mode = if settings.antiplane {
        Mode::Antiplane
    } else {
        Mode::InPlane {
            poisson_ratio: POISSON_RATIO,
        }
    };
    let fault = SegmentFault::half_space(cells, MEDIUM, mode).map_err(wrong)?;
    Ok(fault.with_sense(arguments.sense()))
}

/// The faults of triangles of a file of Gmsh or STL.
pub(super) fn triangles(arguments: &Arguments, path: &Path) -> Result<SurfaceFault<1>, Failed> {
    let settings = &arguments.fault_file;
    if settings.antiplane || arguments.cell.is_some() {
        return Err(
            "--antiplane and --cell are settings of polylines: of --faults with a table".into(),
        );
    }
    let name = path.display();
    let wrong = |error| Failed::from(format!("{name}: {error}"));
    let is_gmsh = path
        .extension()
        .is_some_and(|ending| ending.eq_ignore_ascii_case("msh"));
    let cells = if is_gmsh {
        let mut surface =
            gmsh::read_surface(path).map_err(|error| Failed::from(format!("{name}: {error}")))?;
        if !settings.groups.is_empty() {
            let groups: Vec<&str> = settings.groups.iter().map(String::as_str).collect();
            surface = surface
                .of_groups(&groups)
                .map_err(|error| Failed::from(format!("{name}: {error}")))?;
        }
        Triangles::new(&surface.points, &surface.triangles)
    } else if settings.groups.is_empty() {
        Triangles::read_stl(path)
    } else {
        return Err("--groups is a setting of files of Gmsh: STL has none".into());
    };
    let fault =
        SurfaceFault::half_space(cells.map_err(wrong)?, MEDIUM, POISSON_RATIO).map_err(wrong)?;
    let rake = settings
        .rake
        .unwrap_or(if arguments.normal { -90.0 } else { 90.0 });
    Ok(fault.with_rake(rake)?)
}
