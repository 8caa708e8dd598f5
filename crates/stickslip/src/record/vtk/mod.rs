//! Files of a body and its contacts for ParaView and similar viewers.

mod collection;
#[cfg(feature = "bie")]
mod fault;
mod file;
mod grid;
mod surface_grid;
mod vtu;
mod xml;

pub use surface_grid::SurfaceGrid;

use std::ops::ControlFlow;
use std::path::PathBuf;

use nalgebra::SVector;
use stickslip_fem::{Elastic, P1, Trace, stress_by_cell};

#[cfg(feature = "bie")]
pub use fault::VtkFaultSeries;

use super::check::{check_index, require};
use collection::Collection;
use file::write_whole;
use grid::{places, surface, vectors};
use vtu::{Field, Grid, Kind, Shape};

use crate::{FileError, MeshMismatch, SceneError, Snapshot};

/// A material by the midpoint \[m\] and the index of a cell.
type Material<const D: usize> = Box<dyn Fn(&SVector<f64, D>, usize) -> Elastic + Send>;

/// A body and its contacts as VTU files, one per step kept, and a PVD file that lists their times.
///
/// | file | fields |
/// | --- | --- |
/// | `NAME_0000.vtu` | `displacement`, `velocity`; `stress` by cell, if a material is given |
/// | `NAME_contact_0_0000.vtu` | `slip`, `slip_rate`, `state`, `traction` of a contact, on its faces |
/// | `NAME.pvd` | the times of both: this is the file to open |
///
/// Vectors and tensors have three dimensions; a displacement out of the plane is along z. A viewer warps the body by
/// its displacement. Each file allocates memory while it is written. The list is rewritten with each of them, so that
/// it is complete even if a run ends early. A write error ends the run, and [`finish`](Self::finish) returns it.
///
/// ```
/// use stickslip::fem::{P1, antiplane};
/// use stickslip::friction::Tresca;
/// use stickslip::record::VtkSeries;
/// use stickslip::{Components, Condensed, Contact, GeneralizedAlpha, Scene, Simulation, Steps};
///
/// let space = P1::grid([2.0, 1.0], [4, 2])?;
/// let (bottom, top) = (space.trace(|x| x[1] == 0.0)?, space.trace(|x| x[1] == 1.0)?);
/// let scene = Scene::new(antiplane(&space, 1e9)?)
///     .with_contact(Contact::new(&bottom, Tresca { coefficient: 0.6 }, 1e6))
///     .prescribe_velocity(&top, Components::ALL, |_| [1e-3]);
/// let mut layer = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;
/// let folder = std::env::temp_dir().join("stickslip-vtk-example");
/// std::fs::create_dir_all(&folder)?;
/// let mut series = VtkSeries::new(&layer.snapshot(), &space, folder.join("layer"))?
///     .with_contact(&layer.snapshot(), 0, &bottom)?
///     .every(50)?;
/// layer.run(&Steps::constant(0.01).count(100), |at| series.record(&at))?;
/// series.finish()?;
/// assert!(folder.join("layer_0001.vtu").exists() && folder.join("layer.pvd").exists());
/// # std::fs::remove_dir_all(&folder)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct VtkSeries<'a, const D: usize> {
    space: &'a P1<D>,
    base: PathBuf,
    material: Option<Material<D>>,
    contacts: Vec<(usize, &'a Trace<D>)>,
    every: usize,
    since: usize,
    frames: usize,
    list: Collection,
    error: Option<FileError>,
}

impl<'a, const D: usize> VtkSeries<'a, D> {
    /// A series of files whose names begin with `base`, for a body on this space.
    ///
    /// # Errors
    /// [`SceneError::Length`] or [`SceneError::Mesh`] for a space of another body.
    pub fn new<const C: usize>(
        at: &Snapshot<'_, C>,
        space: &'a P1<D>,
        base: impl Into<PathBuf>,
    ) -> Result<Self, SceneError> {
        fit("space", at.displacement.len(), space.vertex_count())?;
        let found = Some(space.mesh().identity().into());
        MeshMismatch::check("space", at.source().mesh(), found)?;
        Ok(Self {
            space,
            base: base.into(),
            material: None,
            contacts: Vec::new(),
            every: 1,
            since: 0,
            frames: 0,
            list: Collection::default(),
            error: None,
        })
    }

    /// Adds the Cauchy stress of a body of this material, by the midpoint \[m\] and the index of a cell. It is omitted
    /// for a body whose number of components differs from its dimension.
    #[must_use]
    pub fn with_stress(
        mut self,
        material: impl Fn(&SVector<f64, D>, usize) -> Elastic + Send + 'static,
    ) -> Self {
        self.material = Some(Box::new(material));
        self
    }

    /// Adds contact number `contact`, counted from 0, on its boundary part.
    ///
    /// # Errors
    /// [`SceneError::Index`] for a contact that the scene does not have, [`SceneError::Mesh`] for a part of
    /// another mesh, [`SceneError::Length`] or [`SceneError::OtherVertices`] for another part of this one.
    pub fn with_contact<const C: usize>(
        mut self,
        at: &Snapshot<'_, C>,
        contact: usize,
        trace: &'a Trace<D>,
    ) -> Result<Self, SceneError> {
        check_index("contact", contact, at.contact_count())?;
        let expected = Some(self.space.mesh().identity().into());
        MeshMismatch::check("trace", expected, Some(trace.mesh().into()))?;
        let seen = at.contact(contact);
        fit("trace", seen.len(), trace.vertices().len())?;
        let mut vertices = trace.vertices().iter().enumerate();
        if let Some((k, &found)) = vertices.find(|&(k, &vertex)| seen.vertex(k) != vertex) {
            let expected = seen.vertex(k);
            return Err(SceneError::OtherVertices {
                contact,
                expected,
                found,
            });
        }
        self.contacts.push((contact, trace));
        Ok(self)
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
    /// [`FileError::Write`] for the first file that could not be written, [`SceneError::Fem`] for a material out of
    /// range.
    pub fn finish(self) -> Result<(), FileError> {
        self.error.map_or(Ok(()), Err)
    }

    /// Writes the files of a step, and the list.
    fn write<const C: usize>(&mut self, at: &Snapshot<'_, C>) -> Result<(), FileError> {
        let frame = self.frames;
        let body = self.body(at)?;
        self.add(at.time, 0, &format!("{frame:04}"), body)?;
        for k in 0..self.contacts.len() {
            let (contact, trace) = self.contacts[k];
            let grid = surface(at, contact, trace);
            self.add(
                at.time,
                k + 1,
                &format!("contact_{contact}_{frame:04}"),
                grid,
            )?;
        }
        self.frames += 1;
        self.list.write(&self.base.with_extension("pvd"))
    }

    /// Writes one file and adds it to the list.
    fn add(&mut self, time: f64, part: usize, end: &str, grid: Grid) -> Result<(), FileError> {
        let stem = self.base.file_name().unwrap_or_default().to_string_lossy();
        let name = format!("{stem}_{end}.vtu");
        write_whole(&self.base.with_file_name(&name), |file| grid.write(file))?;
        self.list.add(time, part, &name);
        Ok(())
    }

    /// The body with its fields.
    fn body<const C: usize>(&self, at: &Snapshot<'_, C>) -> Result<Grid, SceneError> {
        let mesh = self.space.mesh();
        let mut at_cells = Vec::new();
        if let Some(material) = self.material.as_ref().filter(|_| C == D) {
            let displacement = at.displacement.iter();
            let displacement: Vec<SVector<f64, D>> = displacement
                .map(|u| SVector::from_fn(|c, _| u[c]))
                .collect();
            let stress = stress_by_cell(self.space, material, &displacement)?;
            let tensors = stress.iter().flat_map(|sigma| {
                (0..9).map(move |n| sigma.get((n / 3, n % 3)).copied().unwrap_or(0.0))
            });
            at_cells.push(Field {
                name: "stress",
                kind: Kind::Tensors,
                values: tensors.collect(),
            });
        }
        Ok(Grid {
            points: places(mesh.vertices()),
            corners: mesh.cells().flatten().map(|&p| i64::from(p)).collect(),
            shape: if D == 2 {
                Shape::Triangle
            } else {
                Shape::Tetrahedron
            },
            at_points: vec![
                vectors::<C, D>("displacement", at.displacement.iter()),
                vectors::<C, D>("velocity", at.velocity.iter()),
            ],
            at_cells,
        })
    }
}

/// Refuses a mesh with another number of vertices.
fn fit(what: &'static str, expected: usize, found: usize) -> Result<(), SceneError> {
    if expected == found {
        return Ok(());
    }
    Err(SceneError::Length {
        what,
        expected,
        found,
    })
}
