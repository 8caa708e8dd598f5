//! Displacement and stress at points off a fault.

use numpy::{IntoPyArray, PyArray2, PyArrayDyn, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stickslip::bie::{ReceiverError, Receivers as Off};
use stickslip::nalgebra::{SVector, Vector3};

use super::geometry::Geometry;
use super::per_cell::{Layout, PerCell};
use super::rows::Points;
use super::slips::Slips;
use crate::arguments::named;
use crate::bodies::PerVertex;
use crate::errors::{self, Bare, argument};
use crate::exit::Call;
use crate::view::into_rows;

/// Points off a fault, at which slip of its cells displaces and strains the rock: stations at the surface, points inside.
/// The method `receivers` of faults makes them.
///
/// Displacement is in elastic equilibrium with slip at each instant: there are no seismic waves. A slip is an array with a
/// value per cell as `run.slip[-1]`, or several of them as `run.slip`: the result has a first axis then, too.
#[pyclass(frozen, module = "stickslip")]
pub(crate) struct Receivers {
    own: Own,
    cells: Layout,
    /// Velocity due to creep beyond the cells [m/s].
    creep: Option<Vec<[f64; 3]>>,
    /// The fault and the rate of creep, as given.
    fault: Py<PyAny>,
    plate_rate: Option<Vec<f64>>,
}

/// Those of a fault with one component of slip, or with two.
enum Own {
    One(Off<1>),
    Two(Off<2>),
}

/// Does the same with one component and with two.
macro_rules! each {
    ($any:expr, $own:ident => $work:expr) => {
        match $any {
            Own::One($own) => $work,
            Own::Two($own) => $work,
        }
    };
}

#[pymethods]
impl Receivers {
    /// The points [m], one row each: x, y and z.
    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        into_rows(
            py,
            self.places().iter().map(|&x| Vector3::from(x)).collect(),
        )
    }

    /// The displacement due to slip on the cells [m], by points and axes; the velocity due to slip rates.
    ///
    /// Args:
    ///     slip: of each cell [m], or several of them.
    #[pyo3(signature = (slip))]
    fn displacement<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named)] slip: PerVertex,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        self.of_slips(py, slip, &[3], |slip| {
            Ok(self.of_slip(slip)?.into_iter().flatten().collect())
        })
    }

    /// The stress due to slip on the cells [Pa], a matrix of 3 x 3 per point; tension is positive. It is computed anew each
    /// time.
    ///
    /// Args:
    ///     slip: of each cell [m], or several of them.
    #[pyo3(signature = (slip))]
    fn stress<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named)] slip: PerVertex,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        self.of_slips(py, slip, &[3, 3], |slip| {
            let found = each!(&self.own, own => own.stress(&vectors(slip)))?;
            // Symmetric: columns are rows.
            Ok(found.iter().flatten().copied().collect())
        })
    }

    /// The displacement due to the same slip of all the fault's plane beyond its cells [m], by points and axes, of a line or
    /// a plane: of plate loading at the rate V until the time t that of the slip V t. Far away each side moves by one half of
    /// it.
    ///
    /// Args:
    ///     slip: beyond the cells [m]; with a free rake a pair along strike and up dip.
    #[pyo3(signature = (slip))]
    fn creep<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named)] slip: PerCell,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let (_, moved) = each!(&self.own, own => creep(own, ("slip", slip))?);
        let moved = moved.map_err(|error| errors::receivers(py, &error))?;
        into_rows(py, moved.into_iter().map(Vector3::from).collect())
    }

    fn __len__(&self) -> usize {
        self.count()
    }

    fn __repr__(&self) -> String {
        let (points, cells) = (self.count(), self.cells.count);
        format!("Receivers({points} points, {cells} cells)")
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Given<'py>)> {
        let rebuild = py.import("stickslip._plain")?.getattr("receivers")?;
        let given = PyDict::new(py);
        given.set_item("points", self.points(py)?)?;
        given.set_item("plate_rate", self.plate_rate.as_deref())?;
        Ok((rebuild, (self.fault.bind(py).clone(), given)))
    }
}

/// A fault, and the arguments of its method.
type Given<'py> = (Bound<'py, PyAny>, Bound<'py, PyDict>);

impl Receivers {
    /// Points off a fault, beyond whose cells its plane creeps at this rate [m/s].
    pub(super) fn of(
        fault: &Bound<'_, PyAny>,
        geometry: &Geometry,
        points: Points,
        plate_rate: Option<PerCell>,
    ) -> PyResult<Self> {
        let py = fault.py();
        let points = match geometry {
            Geometry::Line(_) | Geometry::Dipping(_) | Geometry::Segments(_) => points.in_section(),
            _ => points.at_surface(),
        };
        let call = Call::begin()?;
        let made = call.detach(py, || match geometry {
            Geometry::Line(fault) => Off::new(fault, &points).map(Own::One),
            Geometry::Dipping(fault) => Off::new(fault, &points).map(Own::One),
            Geometry::Plane(fault) => Off::new(fault, &points).map(Own::One),
            Geometry::Free(fault) => Off::new(fault, &points).map(Own::Two),
            Geometry::Planes(system) => Off::new(system, &points).map(Own::One),
            Geometry::FreePlanes(system) => Off::new(system, &points).map(Own::Two),
            Geometry::Segments(fault) => Off::new(fault, &points).map(Own::One),
            Geometry::Surface(fault) => Off::new(fault, &points).map(Own::One),
            Geometry::FreeSurface(fault) => Off::new(fault, &points).map(Own::Two),
        });
        let own = made.map_err(|error| errors::receivers(py, &error))?;
        let mut receivers = Self {
            own,
            cells: geometry.cells().layout,
            creep: None,
            fault: fault.clone().unbind(),
            plate_rate: None,
        };
        if let Some(rate) = plate_rate {
            let (rate, creep) = each!(&receivers.own, own => creep(own, ("plate_rate", rate))?);
            receivers.creep = Some(creep.map_err(|error| errors::receivers(py, &error))?);
            receivers.plate_rate = Some(rate);
        }
        Ok(receivers)
    }

    /// The number of points.
    pub(super) fn count(&self) -> usize {
        self.places().len()
    }

    fn places(&self) -> &[[f64; 3]] {
        each!(&self.own, own => own.points())
    }

    fn components(&self) -> usize {
        match self.own {
            Own::One(_) => 1,
            Own::Two(_) => 2,
        }
    }

    /// The displacement due to slip of the cells, all components of one cell after the other.
    fn of_slip(&self, slip: &[f64]) -> Result<Vec<[f64; 3]>, ReceiverError> {
        each!(&self.own, own => own.displacement(&vectors(slip)))
    }

    /// What points do by each of some slips, in an array by times, points and axes.
    fn of_slips<'py>(
        &self,
        py: Python<'py>,
        slip: PerVertex,
        axes: &[usize],
        of: impl Fn(&[f64]) -> Result<Vec<f64>, ReceiverError> + Send,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let slips = Slips::checked("slip", slip, self.cells, self.components())?;
        let call = Call::begin()?;
        let found = call.detach(py, || slips.each().map(of).collect::<Result<Vec<_>, _>>());
        let found = found.map_err(|error| errors::receivers(py, &error))?;
        let mut shape: Vec<usize> = slips.times.into_iter().chain([self.count()]).collect();
        shape.extend(axes);
        found.concat().into_pyarray(py).reshape(shape)
    }

    /// Refuses a simulation of another fault, by the numbers of its cells and components of slip.
    pub(super) fn check(&self, cells: usize, components: usize) -> PyResult<()> {
        if [cells, components] == [self.cells.count, self.components()] {
            return Ok(());
        }
        let own = format!(
            "those of {} cells with {} components of slip",
            self.cells.count,
            self.components()
        );
        let requirement = format!(
            "those of the fault of the simulation, with {cells} cells and {components} components of slip"
        );
        Err(argument("receivers", &requirement, Bare(own)))
    }

    /// Appends displacements and velocities at a time \[s\] to those before.
    pub(super) fn sample<const C: usize>(
        &self,
        time: f64,
        motion: [&[SVector<f64, C>]; 2],
        [displacement, velocity]: &mut [Vec<f64>; 2],
    ) {
        let flat = |vectors: &[SVector<f64, C>]| -> Vec<f64> {
            vectors.iter().flatten().copied().collect()
        };
        let [moved, rates] = motion.map(|vectors| self.of_slip(&flat(vectors)));
        // The number of slips is that of the cells since `check`.
        let (Ok(moved), Ok(rates)) = (moved, rates) else {
            return;
        };
        displacement.extend(moved.iter().flatten());
        velocity.extend(rates.iter().flatten());
        let creep = self.creep.iter().flatten().flatten();
        let begin = velocity.len() - 3 * self.count();
        let added = displacement[begin..].iter_mut().zip(&mut velocity[begin..]);
        for ((displacement, velocity), creep) in added.zip(creep) {
            *displacement += creep * time;
            *velocity += creep;
        }
    }
}

/// Vectors of consecutive numbers.
fn vectors<const C: usize>(numbers: &[f64]) -> Vec<SVector<f64, C>> {
    let (vectors, _) = numbers.as_chunks::<C>();
    vectors.iter().map(|&vector| vector.into()).collect()
}

/// What the rest of the plane does by the one slip of an argument, and that slip.
fn creep<const C: usize>(
    own: &Off<C>,
    (name, slip): (&str, PerCell),
) -> PyResult<(Vec<f64>, Result<Vec<[f64; 3]>, ReceiverError>)> {
    let one = Layout {
        count: 1,
        shape: None,
    };
    let slip: SVector<f64, C> = slip.checked(name, one)?[0];
    Ok((slip.as_slice().to_vec(), own.creep(slip)))
}
