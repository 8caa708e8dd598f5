//! The state of a body at one time.

use numpy::{IntoPyArray, PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stickslip::{ContactView, Snapshot};

use super::reduced::Whole;
use crate::errors;
use crate::plain::{Reduced, fields, helper, ranges, reduced};
use crate::view::{into_rows, rows};

/// A body at the end of a step: arrays of its own, which later steps do not change.
#[pyclass(frozen, get_all, module = "stickslip")]
pub(crate) struct BodyState {
    /// Time [s].
    time: f64,
    /// Displacements [m], one row per vertex.
    displacement: Py<PyArray2<f64>>,
    /// Velocities [m/s], one row per vertex.
    velocity: Py<PyArray2<f64>>,
    /// The contacts, in the order in which they were given.
    contacts: Vec<Py<ContactState>>,
    /// Iterations of the solver in the last step.
    iterations: usize,
}

/// A contact at the end of a step: arrays with one entry per vertex.
#[pyclass(frozen, get_all, module = "stickslip")]
pub(crate) struct ContactState {
    /// The numbers of its vertices in the mesh.
    vertices: Py<PyArray1<usize>>,
    /// Slip, the length of its path [m].
    slip: Py<PyArray1<f64>>,
    /// Slip rate [m/s].
    slip_rate: Py<PyArray1<f64>>,
    /// State [s]; None without a state law.
    theta: Option<Py<PyArray1<f64>>>,
    /// Normal stress [Pa], positive in compression; with fields the total one.
    normal_stress: Py<PyArray1<f64>>,
    /// Pore pressure of the fields [Pa]; 0 without any.
    pore_pressure: Py<PyArray1<f64>>,
    /// Normal stress that friction sees [Pa], less the pore pressure.
    effective_normal_stress: Py<PyArray1<f64>>,
    /// Arrays of what fields show, by name, such as "temperature" [K].
    readings: Py<PyDict>,
    /// Distance of both sides [m], where the contact is open.
    opening: Py<PyArray1<f64>>,
    /// Coefficient of friction.
    mu: Py<PyArray1<f64>>,
    /// Shear stress of the body on the surface, or of the plus side on the minus side [Pa], one row per vertex with the
    /// components of a velocity: in the direction of slip.
    shear_stress: Py<PyArray2<f64>>,
}

#[pymethods]
impl ContactState {
    #[new]
    #[pyo3(signature = (*, vertices, slip, slip_rate, theta, normal_stress, pore_pressure, effective_normal_stress, readings, opening,
                        mu, shear_stress))]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn new(
        vertices: Py<PyArray1<usize>>,
        slip: Py<PyArray1<f64>>,
        slip_rate: Py<PyArray1<f64>>,
        theta: Option<Py<PyArray1<f64>>>,
        normal_stress: Py<PyArray1<f64>>,
        pore_pressure: Py<PyArray1<f64>>,
        effective_normal_stress: Py<PyArray1<f64>>,
        readings: Py<PyDict>,
        opening: Py<PyArray1<f64>>,
        mu: Py<PyArray1<f64>>,
        shear_stress: Py<PyArray2<f64>>,
    ) -> Self {
        Self {
            vertices,
            slip,
            slip_rate,
            theta,
            normal_stress,
            pore_pressure,
            effective_normal_stress,
            readings,
            opening,
            mu,
            shear_stress,
        }
    }

    /// A table of pandas with a row per vertex; with fields it has their pressures and readings, too.
    fn to_frame<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let columns = self.fields(py)?;
        columns.del_item("shear_stress")?;
        columns.del_item("readings")?;
        if self.readings.bind(py).is_empty() {
            columns.del_item("pore_pressure")?;
            columns.del_item("effective_normal_stress")?;
        } else {
            columns.update(self.readings.bind(py).as_mapping())?;
        }
        if self.theta.is_none() {
            columns.del_item("theta")?;
        }
        helper(py, "_frames", "columns", (columns,))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<Self>(py, self.fields(py)?)
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        ranges(&self.__repr__(py)?, &self.fields(py)?)
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let vertices = self.vertices.bind(py).as_any().len()?;
        Ok(format!("ContactState({vertices} vertices)"))
    }
}

impl ContactState {
    fn fields<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        Ok(
            fields!(py, self; vertices, slip, slip_rate, theta, normal_stress, pore_pressure, effective_normal_stress, readings,
                              opening, mu, shear_stress),
        )
    }
}

#[pymethods]
impl BodyState {
    #[new]
    #[pyo3(signature = (*, time, displacement, velocity, contacts, iterations))]
    fn new(
        time: f64,
        displacement: Py<PyArray2<f64>>,
        velocity: Py<PyArray2<f64>>,
        contacts: Vec<Py<ContactState>>,
        iterations: usize,
    ) -> Self {
        Self {
            time,
            displacement,
            velocity,
            contacts,
            iterations,
        }
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<Self>(
            py,
            fields!(py, self; time, displacement, velocity, contacts, iterations),
        )
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        let fields = fields!(py, self; displacement, velocity);
        ranges(&self.__repr__(), &fields)
    }

    /// The largest slip rate of all contacts [m/s].
    #[getter]
    fn max_slip_rate(&self, py: Python<'_>) -> PyResult<f64> {
        let mut largest = 0.0_f64;
        for contact in &self.contacts {
            let rates = contact.get().slip_rate.bind(py).as_any();
            for rate in rates.try_iter()? {
                largest = largest.max(rate?.extract()?);
            }
        }
        Ok(largest)
    }

    fn __repr__(&self) -> String {
        format!(
            "BodyState(time={}, {} contacts)",
            self.time,
            self.contacts.len()
        )
    }
}

impl BodyState {
    pub(super) fn of<const C: usize>(
        py: Python<'_>,
        at: &Snapshot<'_, C>,
        whole: Option<&Whole<C>>,
    ) -> PyResult<Self> {
        let contacts = at
            .contacts()
            .map(|contact| Py::new(py, ContactState::of(py, contact, whole)?));
        let fields = whole.map(|whole| whole.fields(at)).transpose();
        let fields = fields.map_err(|error| errors::scene(py, &error))?;
        let (displacement, velocity) = match fields {
            Some((displacement, velocity)) => {
                (into_rows(py, displacement)?, into_rows(py, velocity)?)
            }
            // Of the stepper, whose next step writes there.
            None => [at.displacement, at.velocity]
                .map(|field| PyArray2::from_array(py, &rows(field)))
                .into(),
        };
        Ok(Self {
            time: at.time,
            displacement: displacement.unbind(),
            velocity: velocity.unbind(),
            contacts: contacts.collect::<PyResult<_>>()?,
            iterations: at.report.solver_iterations,
        })
    }
}

impl ContactState {
    fn of<const C: usize>(
        py: Python<'_>,
        contact: ContactView<'_, C>,
        whole: Option<&Whole<C>>,
    ) -> PyResult<Self> {
        let count = contact.len();
        let array =
            |value: &dyn Fn(usize) -> f64| PyArray1::from_iter(py, (0..count).map(value)).unbind();
        let vertex = |k| match whole {
            Some(whole) => whole.vertex(contact.vertex(k)),
            None => contact.vertex(k),
        };
        let readings = PyDict::new(py);
        for reading in contact.readings() {
            let values = contact.reading(reading.name).unwrap_or_default();
            readings.set_item(reading.name, values.into_pyarray(py))?;
        }
        let tractions = (0..count).map(|k| contact.traction(k)).collect();
        Ok(Self {
            vertices: PyArray1::from_iter(py, (0..count).map(vertex)).unbind(),
            slip: array(&|k| contact.slip(k)),
            slip_rate: array(&|k| contact.slip_rate(k)),
            theta: contact
                .has_state()
                .then(|| array(&|k| contact.state(k).exp())),
            normal_stress: array(&|k| contact.normal_stress(k)),
            pore_pressure: array(&|k| contact.pore_pressure(k)),
            effective_normal_stress: array(&|k| contact.effective_normal_stress(k)),
            readings: readings.unbind(),
            opening: array(&|k| contact.opening(k)),
            mu: array(&|k| contact.coefficient(k)),
            shear_stress: into_rows(py, tractions)?.unbind(),
        })
    }
}
