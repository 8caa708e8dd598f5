//! Meshes of triangles and tetrahedra.

use std::path::PathBuf;

use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use stickslip::SceneError;
use stickslip::fem::{FemError, GridDiagonal, Mesh as FemMesh, P1, ReadError, gmsh};
use stickslip::nalgebra::SVector;

use super::part::{AnyTrace, Part};
use super::predicate::Predicate;
use crate::arguments::{named, positive};
use crate::errors::{self, argument};
use crate::exit::Call;
use crate::memory::{MESH_CELL, check_memory};
use crate::view::{rows, view};

/// A mesh of triangles or tetrahedra with linear elements.
///
/// Build it by `Mesh.grid` or `Mesh.gmsh`, cut it by `split`, refine it last.
#[pyclass(frozen, module = "stickslip")]
pub(crate) struct Mesh {
    pub(super) space: AnySpace,
    refined: bool,
}

/// Elements in the plane or in space.
#[derive(Clone)]
pub(super) enum AnySpace {
    Plane(P1<2>),
    Space(P1<3>),
}

/// Does the same in the plane and in space.
macro_rules! each {
    ($any:expr, $space:ident => $work:expr) => {
        match $any {
            AnySpace::Plane($space) => $work,
            AnySpace::Space($space) => $work,
        }
    };
}

/// The exception of an error of meshes.
pub(super) fn refused(py: Python<'_>, error: FemError) -> PyErr {
    errors::scene(py, &SceneError::from(error))
}

#[pymethods]
impl Mesh {
    /// A box from the origin, of so many cells a side, each of 2 triangles or 6 tetrahedra.
    ///
    /// Args:
    ///     size: lengths of its 2 or 3 sides [m], > 0.
    ///     cells: number of cells a side, >= 1.
    ///     origin: its lower corner [m]; by default 0.
    #[staticmethod]
    #[pyo3(signature = (size, cells, origin=None))]
    fn grid(
        py: Python<'_>,
        #[pyo3(from_py_with = named)] size: Vec<f64>,
        #[pyo3(from_py_with = named)] cells: Vec<usize>,
        #[pyo3(from_py_with = named)] origin: Option<Vec<f64>>,
    ) -> PyResult<Self> {
        for (n, &length) in size.iter().enumerate() {
            positive(&format!("size[{n}]"), length)?;
        }
        let origin = origin.unwrap_or_else(|| vec![0.0; size.len()]);
        if cells.len() != size.len() {
            return Err(argument("cells", "as long as size", &cells));
        }
        if origin.len() != size.len() || origin.iter().any(|x| !x.is_finite()) {
            return Err(argument("origin", "finite and as long as size", &origin));
        }
        check_memory("cells", &cells, MESH_CELL)?;
        let space = match (size.as_slice(), cells.as_slice()) {
            (&[x, y], &[m, n]) => FemMesh::<2>::grid([x, y], [m, n], GridDiagonal::Rising)
                .and_then(|mesh| moved(mesh, &origin))
                .map(|mesh| AnySpace::Plane(P1::new(mesh))),
            (&[x, y, z], &[l, m, n]) => FemMesh::<3>::grid([x, y, z], [l, m, n])
                .and_then(|mesh| moved(mesh, &origin))
                .map(|mesh| AnySpace::Space(P1::new(mesh))),
            _ => return Err(argument("size", "of 2 or 3 lengths", &size)),
        };
        let space = space.map_err(|error| refused(py, error))?;
        let refined = false;
        Ok(Self { space, refined })
    }

    /// The mesh of a file of Gmsh, with its named parts of the boundary and inner surfaces.
    ///
    /// Args:
    ///     path: an .msh file of version 2.2 or 4.1; tetrahedra, or triangles where there are none.
    #[staticmethod]
    fn gmsh(py: Python<'_>, #[pyo3(from_py_with = named)] path: PathBuf) -> PyResult<Self> {
        let space = match gmsh::read::<3>(&path) {
            Err(ReadError::Empty {
                what: "elements", ..
            }) => gmsh::read::<2>(&path).map(|mesh| AnySpace::Plane(P1::new(mesh))),
            mesh => mesh.map(|mesh| AnySpace::Space(P1::new(mesh))),
        };
        let refined = false;
        match space {
            Ok(space) => Ok(Self { space, refined }),
            Err(error) => Err(errors::mesh_file(py, &path, &error)),
        }
    }

    /// A mesh with the faces whose vertices all satisfy `on(x)` as an inner surface of this name, for `split`.
    fn with_surface(
        &self,
        py: Python<'_>,
        #[pyo3(from_py_with = named)] name: &str,
        on: &Bound<'_, PyAny>,
    ) -> PyResult<Self> {
        let _call = Call::begin()?;
        let (space, predicate) = (self.unrefined()?, Predicate::new(on));
        let space = each!(space, space => {
            let mesh = space.mesh().clone();
            mesh.with_surface_where(name, |x| predicate.holds(x)).map(|mesh| P1::new(mesh).into())
        });
        let space = predicate.finish(space.map_err(|error| refused(py, error)))?;
        let refined = false;
        Ok(Self { space, refined })
    }

    /// A mesh that is cut along inner surfaces, with the parts `name+` and `name-` of its boundary.
    #[pyo3(signature = (*names))]
    fn split(
        &self,
        py: Python<'_>,
        #[pyo3(from_py_with = named)] names: Vec<String>,
    ) -> PyResult<Self> {
        if names.is_empty() {
            return Err(argument("names", "at least one inner surface", &names));
        }
        let names = names.iter().map(String::as_str);
        let space = each!(self.unrefined()?, space => {
            space.mesh().clone().split_all(names).map(|mesh| P1::new(mesh).into())
        });
        let space = space.map_err(|error| refused(py, error))?;
        let refined = false;
        Ok(Self { space, refined })
    }

    /// A mesh whose edges are halved so many times. It keeps its coarser meshes for multigrid.
    #[pyo3(signature = (levels=1))]
    fn refined(
        &self,
        py: Python<'_>,
        #[pyo3(from_py_with = named)] levels: usize,
    ) -> PyResult<Self> {
        let (cells, halved) =
            each!(&self.space, space => (space.mesh().cell_count(), halved(space)));
        let children = halved.saturating_pow(u32::try_from(levels).unwrap_or(u32::MAX));
        check_memory("levels", &[cells, children], MESH_CELL)?;
        let call = Call::begin()?;
        let space = each!(&self.space, space => {
            call.detach(py, || space.clone().refined(levels)).map(AnySpace::from)
        });
        let space = space.map_err(|error| refused(py, error))?;
        let refined = self.refined || levels > 0;
        Ok(Self { space, refined })
    }

    /// A part of the boundary: by the name of the file or of a split, or the faces whose vertices all satisfy a function.
    ///
    /// Args:
    ///     which: a name, or a function of a position, a list of coordinates [m], to bool.
    fn part(&self, py: Python<'_>, which: &Bound<'_, PyAny>) -> PyResult<Part> {
        let _call = Call::begin()?;
        let part = if let Ok(name) = which.extract::<String>() {
            each!(&self.space, space => space.part(&name).map(AnyTrace::from))
                .map_err(|error| refused(py, error))?
        } else if which.is_callable() {
            let predicate = Predicate::new(which);
            let part = each!(&self.space, space => {
                space.trace(|x| predicate.holds(x)).map(AnyTrace::from)
            });
            predicate.finish(part.map_err(|error| refused(py, error)))?
        } else {
            return Err(argument("which", "a name or a function", which));
        };
        Ok(Part { trace: part })
    }

    /// The names of the parts of its boundary.
    #[getter]
    fn parts(&self) -> Vec<String> {
        each!(&self.space, space => {
            space.mesh().parts().map(|(name, _)| name.to_owned()).collect()
        })
    }

    /// Positions [m], one row per vertex: a view, which cannot be written.
    #[getter]
    fn vertices<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        view(
            slf,
            |mesh| each!(&mesh.space, space => rows(space.mesh().vertices())),
        )
    }

    /// Vertices of cells, one row per triangle or tetrahedron.
    #[getter]
    fn cells<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<u32>>> {
        each!(&self.space, space => {
            let cells: Vec<u32> = space.mesh().cells().flatten().copied().collect();
            let count = space.mesh().cell_count();
            let length = cells.len() / count.max(1);
            PyArray1::from_vec(py, cells).reshape([count, length])
        })
    }

    fn __repr__(&self) -> String {
        each!(&self.space, space => {
            let mesh = space.mesh();
            format!("Mesh({} vertices, {} cells)", mesh.vertex_count(), mesh.cell_count())
        })
    }
}

impl Mesh {
    /// The mesh before any refinement.
    fn unrefined(&self) -> PyResult<&AnySpace> {
        if self.refined {
            let message = "a refined mesh cannot be cut: cut it first, then refine it";
            return Err(pyo3::exceptions::PyValueError::new_err(message));
        }
        Ok(&self.space)
    }
}

impl From<P1<2>> for AnySpace {
    fn from(space: P1<2>) -> Self {
        Self::Plane(space)
    }
}

impl From<P1<3>> for AnySpace {
    fn from(space: P1<3>) -> Self {
        Self::Space(space)
    }
}

/// The number of children of a cell.
fn halved<const D: usize>(_: &P1<D>) -> usize {
    1 << D
}

fn moved<const D: usize>(mesh: FemMesh<D>, origin: &[f64]) -> Result<FemMesh<D>, FemError> {
    if origin.iter().all(|&x| x == 0.0) {
        return Ok(mesh);
    }
    let by = SVector::from_fn(|c, _| origin[c]);
    let vertices = mesh.vertices().iter().map(|x| x + by).collect();
    FemMesh::new(vertices, mesh.cells().flatten().copied().collect())
}
