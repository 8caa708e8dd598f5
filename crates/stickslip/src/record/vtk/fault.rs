//! Files of a fault by boundary integrals for ParaView and similar viewers.

use std::ops::ControlFlow;
use std::path::PathBuf;

use nalgebra::Vector3;
use stickslip_bie::{SegmentFault, SurfaceFault};

use super::super::check::{check_index, require};
use super::collection::Collection;
use super::file::write_whole;
use super::fit;
use super::vtu::{Field, Grid, Kind, Shape};
use crate::{ContactView, FileError, MeshMismatch, SceneError, Snapshot};

/// The cells of a fault that is not a plane as VTU files, one per step kept, and a PVD file that lists their times.
///
/// | file | fields by cell |
/// | --- | --- |
/// | `NAME_0000.vtu` | `slip` \[m\], `slip_rate` [m/s], `state`, `shear_stress` and `normal_stress` \[Pa\]; of triangles the vector `slip_vector` \[m\] |
/// | `NAME.pvd` | the times: this is the file to open |
///
/// The slip is its length, the state that of the state law, and the shear stress the length of the traction. Polylines lie
/// in the plane `y = 0`. Each file allocates memory while it is written. The list is rewritten with each of them, so that it
/// is complete even if a run ends early. A write error ends the run, and [`finish`](Self::finish) returns it.
///
/// ```
/// use stickslip::bie::{FaultGeometry, Medium, SurfaceFault, Triangles};
/// use stickslip::friction::{FrictionLaw, RegularizedDieterichRuina};
/// use stickslip::nalgebra::Vector1;
/// use stickslip::record::VtkFaultSeries;
/// use stickslip::state::{Dieterich, LogTheta};
/// use stickslip::{BoundaryPart, Contact, RungeKutta, Scene, Steps};
///
/// // A square of 1 km that dips 45 degrees, of two triangles, at the plate rate.
/// let points = [[0.0, 0.0, -1e3], [1e3, 0.0, -1e3], [1e3, -7e2, -1.7e3], [0.0, -7e2, -1.7e3]];
/// let cells = Triangles::new(&points, &[[0, 1, 2], [0, 2, 3]])?;
/// let rock = Medium { shear_modulus: 32.04e9, shear_wave_speed: 3464.0 };
/// let fault = SurfaceFault::half_space(cells, rock, 0.25)?.with_rake(90.0)?;
/// let (plate, friction) = (Vector1::new(1e-9), RegularizedDieterichRuina {
///     a: 0.01, b: 0.015, reference_friction: 0.6, reference_velocity: 1e-6, slip_distance: 0.01,
/// });
/// let part = BoundaryPart::from(FaultGeometry::cells(&fault));
/// // Steady, so that friction and radiation damping bear the shear stress.
/// let state = LogTheta((0.01_f64 / 1e-9).ln());
/// let stress = 50e6 * friction.coefficient(1e-9, state) + 0.5 * 32.04e9 / 3464.0 * 1e-9;
/// let contact = Contact::new(part, friction, 50e6)
///     .with_state(Dieterich { slip_distance: 0.01 }, state)
///     .with_shear_stress(vec![Vector1::new(stress); 2]);
/// let scene = Scene::of_fault(&fault, plate)?.with_contact(contact).with_velocity(vec![plate; 2]);
/// let mut run = RungeKutta::new(scene)?;
/// let folder = std::env::temp_dir().join("stickslip-vtk-fault-example");
/// std::fs::create_dir_all(&folder)?;
/// let mut series = VtkFaultSeries::of_surface(&run.snapshot(), 0, &fault, folder.join("fault"))?;
/// run.run(&Steps::adaptive(1e-4).count(3), |at| series.record(&at))?;
/// series.finish()?;
/// assert!(folder.join("fault_0002.vtu").exists() && folder.join("fault.pvd").exists());
/// # std::fs::remove_dir_all(&folder)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias("ParaView", "VTU"))]
pub struct VtkFaultSeries {
    base: PathBuf,
    contact: usize,
    points: Vec<f64>,
    corners: Vec<i64>,
    shape: Shape,
    /// The directions of the components of slip, per cell; none of polylines.
    directions: Vec<Vec<Vector3<f64>>>,
    every: usize,
    since: usize,
    frames: usize,
    list: Collection,
    error: Option<FileError>,
}

impl VtkFaultSeries {
    /// A series of files whose names begin with `base`, for contact number `contact`, counted from 0, on all triangles of a
    /// surface.
    ///
    /// # Errors
    /// [`SceneError::Index`] for a contact that the scene does not have, [`SceneError::Mesh`] for another fault, and
    /// [`SceneError::Length`] for a contact on a part of it.
    pub fn of_surface<const C: usize>(
        at: &Snapshot<'_, C>,
        contact: usize,
        fault: &SurfaceFault<C>,
        base: impl Into<PathBuf>,
    ) -> Result<Self, SceneError> {
        let cells = fault.cells();
        check(at, contact, cells.count(), cells.identity())?;
        let directions = fault.directions().iter().enumerate().map(|(cell, parts)| {
            let axes = cells.axes(cell);
            let [s, d] = [axes.strike, axes.up_dip].map(Vector3::from);
            parts
                .iter()
                .map(|[along, up]| s * *along + d * *up)
                .collect()
        });
        Ok(Self {
            points: cells.points().as_flattened().to_vec(),
            corners: (cells.triangles().as_flattened().iter())
                .map(|&point| point as i64)
                .collect(),
            directions: directions.collect(),
            ..Self::new(contact, Shape::Triangle, base.into())
        })
    }

    /// The same on all cells of polylines.
    ///
    /// # Errors
    /// See [`of_surface`](Self::of_surface).
    pub fn of_segments(
        at: &Snapshot<'_, 1>,
        contact: usize,
        fault: &SegmentFault,
        base: impl Into<PathBuf>,
    ) -> Result<Self, SceneError> {
        let cells = fault.cells();
        check(at, contact, cells.count(), cells.identity())?;
        let ends = (0..cells.count()).flat_map(|cell| cells.ends(cell));
        Ok(Self {
            points: ends.flat_map(|[x, z]| [x, 0.0, z]).collect(),
            corners: (0..2 * cells.count() as i64).collect(),
            ..Self::new(contact, Shape::Line, base.into())
        })
    }

    fn new(contact: usize, shape: Shape, base: PathBuf) -> Self {
        Self {
            base,
            contact,
            points: Vec::new(),
            corners: Vec::new(),
            shape,
            directions: Vec::new(),
            every: 1,
            since: 0,
            frames: 0,
            list: Collection::default(),
            error: None,
        }
    }

    /// Keeps every step number `steps` shown; every step by default.
    ///
    /// # Errors
    /// [`SceneError::Value`] for 0.
    pub fn every(mut self, steps: usize) -> Result<Self, SceneError> {
        require("every", "at least 1", steps as f64, steps > 0)?;
        self.every = steps;
        Ok(self)
    }

    /// Records the step shown; breaks the run on a write error.
    pub fn record<const C: usize>(&mut self, at: &Snapshot<'_, C>) -> ControlFlow<()> {
        self.since += 1;
        if self.since >= self.every && self.error.is_none() {
            self.since = 0;
            self.error = self.write(at).err();
        }
        if self.error.is_some() {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }

    /// Returns the first error, if any.
    ///
    /// # Errors
    /// [`FileError::Write`] for the first file that could not be written.
    pub fn finish(self) -> Result<(), FileError> {
        self.error.map_or(Ok(()), Err)
    }

    /// Writes the file of a step, and the list.
    fn write<const C: usize>(&mut self, at: &Snapshot<'_, C>) -> Result<(), FileError> {
        let stem = self.base.file_name().unwrap_or_default().to_string_lossy();
        let name = format!("{stem}_{:04}.vtu", self.frames);
        let grid = Grid {
            points: self.points.clone(),
            corners: self.corners.clone(),
            shape: self.shape,
            at_points: Vec::new(),
            at_cells: self.fields(&at.contact(self.contact)),
        };
        write_whole(&self.base.with_file_name(&name), |file| grid.write(file))?;
        self.list.add(at.time, 0, &name);
        self.frames += 1;
        self.list.write(&self.base.with_extension("pvd"))
    }

    fn fields<const C: usize>(&self, contact: &ContactView<'_, C>) -> Vec<Field> {
        let scalars = |name, of: &dyn Fn(usize) -> f64| Field {
            name,
            kind: Kind::Scalars,
            values: (0..contact.len()).map(of).collect(),
        };
        let mut fields = vec![
            scalars("slip_rate", &|k| contact.slip_rate(k)),
            scalars("slip", &|k| contact.slip(k)),
            scalars("state", &|k| contact.state(k)),
            scalars("shear_stress", &|k| contact.traction(k).norm()),
            scalars("normal_stress", &|k| contact.normal_stress(k)),
        ];
        if !self.directions.is_empty() {
            let vectors = self.directions.iter().enumerate().flat_map(|(k, along)| {
                let slip = contact.slip_vector(k);
                let parts = along.iter().zip(slip.iter());
                let sum: Vector3<f64> = parts.map(|(along, slip)| along * *slip).sum();
                [sum.x, sum.y, sum.z]
            });
            fields.push(Field {
                name: "slip_vector",
                kind: Kind::Vectors,
                values: vectors.collect(),
            });
        }
        fields
    }
}

/// Refuses a contact that is not on all cells of a mesh.
fn check<const C: usize>(
    at: &Snapshot<'_, C>,
    contact: usize,
    cells: usize,
    mesh: stickslip_solvers::MeshId,
) -> Result<(), SceneError> {
    check_index("contact", contact, at.contact_count())?;
    MeshMismatch::check("fault", at.source().mesh(), Some(mesh))?;
    fit("contact", cells, at.contact(contact).len())
}
