//! Loads of a fault, and its initial slip rates.

use pyo3::prelude::*;
use stickslip::nalgebra::SVector;
use stickslip::{Operator, Scene};

use super::function::CellFunction;
use super::per_cell::{Layout, PerCell};
use crate::raised::Raised;

/// The arguments of Python with the components of slip.
pub(super) struct Directed {
    pub(super) shear_stress: PerCell,
    pub(super) plate_rate: Option<PerCell>,
    pub(super) stress_rate: Option<PerCell>,
    pub(super) slip_rate: Option<PerCell>,
    pub(super) overstress: Option<Py<PyAny>>,
}

impl Directed {
    /// The shear stress at time 0 \[Pa\] and the loading of so many cells.
    pub(super) fn checked<const C: usize>(
        self,
        py: Python<'_>,
        cells: Layout,
        raised: &Raised,
    ) -> PyResult<(Vec<SVector<f64, C>>, Loading<C>)> {
        let given = |name: &str, values: Option<PerCell>| {
            values.map(|values| values.checked(name, cells)).transpose()
        };
        let plate_rate = given("plate_rate", self.plate_rate)?;
        let loading = Loading {
            plate_rate: plate_rate.unwrap_or_else(|| vec![SVector::zeros(); cells.count]),
            stress_rate: given("stress_rate", self.stress_rate)?,
            overstress: CellFunction::given(py, "overstress", self.overstress, cells, raised)?,
            slip_rate: given("slip_rate", self.slip_rate)?,
        };
        Ok((self.shear_stress.checked("shear_stress", cells)?, loading))
    }
}

/// The loading of a fault, and its initial slip rates.
pub(super) struct Loading<const C: usize> {
    /// Of the plates beyond the fault, or of back slip on each cell [m/s].
    pub(super) plate_rate: Vec<SVector<f64, C>>,
    /// Of shear stress on each cell [Pa/s].
    stress_rate: Option<Vec<SVector<f64, C>>>,
    /// Shear stress that adds to all others \[Pa\].
    overstress: Option<CellFunction>,
    /// At time 0 [m/s]; that in balance with stress and state if there is none.
    slip_rate: Option<Vec<SVector<f64, C>>>,
}

impl<const C: usize> Loading<C> {
    /// Whether initial slip rates are given.
    pub(super) fn has_rates(&self) -> bool {
        self.slip_rate.is_some()
    }

    /// The scene with stress rates, overstress and initial rates, on cells of these sizes [m] or [m^2].
    pub(super) fn on<Op: Operator<C>>(
        self,
        mut scene: Scene<Op, C>,
        sizes: &[f64],
    ) -> Scene<Op, C> {
        if let Some(rates) = self.stress_rate {
            let sizes = sizes.to_vec();
            scene = scene.with_load_history(move |time, load| {
                for ((load, rate), size) in load.iter_mut().zip(&rates).zip(&sizes) {
                    *load += rate * *size * time;
                }
            });
        }
        if let Some(overstress) = self.overstress {
            let sizes = sizes.to_vec();
            scene = scene.with_load_history(move |time, load| {
                let stresses: Vec<SVector<f64, C>> = overstress.at(time);
                for ((load, stress), size) in load.iter_mut().zip(stresses).zip(&sizes) {
                    *load += stress * *size;
                }
            });
        }
        match self.slip_rate {
            Some(rates) => scene.with_velocity(rates),
            None => scene.with_balanced_rates(),
        }
    }
}
