//! Files in the format of the SEAS benchmarks during a run.

use std::path::PathBuf;

use pyo3::prelude::*;
use pyo3::types::PyDict;
use stickslip::Snapshot;
use stickslip::record::{self, FileError, SeasFolder, SeasHeader, SeasPoint};

use crate::arguments::{count, named, positive, wrong_type};
use crate::bodies::PerVertex;
use crate::errors::argument;
use crate::plain::{Reduced, fields, reduced, text};

/// Positions on a fault.
#[derive(Clone, IntoPyObject)]
enum Points {
    /// On a line \[m\].
    Line(Vec<f64>),
    /// Along strike and down dip \[m\].
    Plane(Vec<[f64; 2]>),
}

impl<'a, 'py> FromPyObject<'a, 'py> for Points {
    type Error = PyErr;

    fn extract(given: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        match given.extract::<PerVertex>() {
            Ok(PerVertex::Each(points)) => Ok(Self::Line(points)),
            Ok(PerVertex::Shaped(points, shape)) if shape.len() == 2 && shape[1] == 2 => {
                let pairs = points.chunks_exact(2).map(|pair| [pair[0], pair[1]]);
                Ok(Self::Plane(pairs.collect()))
            }
            _ => Err(wrong_type(
                "positions [m], or pairs of them on a plane",
                &given,
            )),
        }
    }
}

impl Points {
    fn points(self) -> Vec<SeasPoint> {
        match self {
            Self::Line(points) => points.into_iter().map(SeasPoint::Line).collect(),
            Self::Plane(points) => points.into_iter().map(SeasPoint::Plane).collect(),
        }
    }
}

/// Files in the format of the SEAS benchmarks, for `FaultSimulation.run(.., seas=..)`:
///
/// - `global.dat`: the largest slip rate and the moment rate;
/// - a file per station, such as `fltst_dp075` or `fltst_strk-16dp+10`: slip, slip rate, stress and state;
/// - with `line`, slip and stresses there: `slip.dat`, `shear_stress.dat`, `normal_stress.dat` on a line, and
///   `slip_2_strike.dat`, `stress_2_strike.dat`, `normal_stress_strike.dat` on a plane (`depth` for a line down dip;
///   for a rake that is not horizontal the component of slip, in `slip_strike.dat`, `stress_strike.dat`; for a free rake
///   also component 3, down dip, in `slip_3_strike.dat`, `stress_3_strike.dat`);
/// - `rupture.dat` after an event: the rupture times of the first one.
///
/// Stations and lines are interpolated between the centres of cells. A run begins new files, with a row for its start;
/// every step is a row.
///
/// Args:
///     folder: of the files; it is created.
///     problem: of the header, such as "SEAS Benchmark BP1-QD".
///     stations: positions [m]: distances along a line, or pairs along strike and down dip.
///     line: positions [m] of slip and stresses on a line; on a plane all along strike, or all down dip.
///     intervals: between rows of slip and stresses outside and inside of events [s]; by default every step is a row.
///     threshold: largest slip rate in an event [m/s].
///     normal_stress: whether the normal stress is written, too.
///     unit: of positions in the names of stations [m]: 100, and 1000 for BP5.
///     digits: of the positions there, at least.
///     header: further lines of the header, such as {"element_size": "25 m"}.
#[pyclass(frozen, module = "stickslip")]
pub(crate) struct SeasFiles {
    files: SeasFolder,
    #[pyo3(get)]
    folder: PathBuf,
    #[pyo3(get)]
    problem: String,
    #[pyo3(get)]
    stations: Points,
    #[pyo3(get)]
    line: Points,
    #[pyo3(get)]
    intervals: Option<[f64; 2]>,
    #[pyo3(get)]
    threshold: f64,
    #[pyo3(get)]
    normal_stress: bool,
    #[pyo3(get)]
    unit: f64,
    #[pyo3(get)]
    digits: usize,
    header: Vec<(String, String)>,
}

#[pymethods]
impl SeasFiles {
    #[new]
    #[pyo3(signature = (folder, problem, *, stations=Points::Line(Vec::new()), line=Points::Line(Vec::new()), intervals=None,
                        threshold=1e-2, normal_stress=false, unit=100.0, digits=3, header=Vec::new()),
           text_signature = "(folder, problem, *, stations=[], line=[], intervals=None, threshold=0.01, normal_stress=False, unit=100.0, digits=3, header={})")]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn new(
        #[pyo3(from_py_with = named)] folder: PathBuf,
        #[pyo3(from_py_with = named)] problem: &str,
        #[pyo3(from_py_with = named)] stations: Points,
        #[pyo3(from_py_with = named)] line: Points,
        #[pyo3(from_py_with = named)] intervals: Option<[f64; 2]>,
        #[pyo3(from_py_with = named)] threshold: f64,
        #[pyo3(from_py_with = named)] normal_stress: bool,
        #[pyo3(from_py_with = named)] unit: f64,
        #[pyo3(from_py_with = named)] digits: usize,
        #[pyo3(from_py_with = lines)] header: Vec<(String, String)>,
    ) -> PyResult<Self> {
        if let Some([quiet, event]) = intervals {
            positive("intervals[0]", quiet)?;
            positive("intervals[1]", event)?;
        }
        if count("digits", digits)? > 20 {
            return Err(argument("digits", "at most 20", digits));
        }
        let begin = SeasHeader::new(problem);
        let lines = (header.iter()).fold(begin, |lines, (key, value)| lines.with(key, value));
        let mut files = SeasFolder::new(&folder, lines)
            .with_stations(stations.clone().points())
            .with_line(line.clone().points())
            .with_event_rate(positive("threshold", threshold)?)
            .with_names(positive("unit", unit)?, digits);
        if let Some(intervals) = intervals {
            files = files.at_intervals(intervals);
        }
        if normal_stress {
            files = files.with_normal_stress();
        }
        Ok(Self {
            files,
            folder,
            problem: problem.to_owned(),
            stations,
            line,
            intervals,
            threshold,
            normal_stress,
            unit,
            digits,
            header,
        })
    }

    /// Further lines of the header.
    #[getter]
    fn header<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let header = PyDict::new(py);
        for (key, value) in &self.header {
            header.set_item(key, value)?;
        }
        Ok(header)
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        text("SeasFiles", &self.given(py)?)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<Self>(py, self.given(py)?)
    }
}

impl SeasFiles {
    /// The arguments.
    fn given<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let given =
            fields!(py, self; folder, problem, intervals, threshold, normal_stress, unit, digits);
        given.set_item("stations", self.stations.clone())?;
        given.set_item("line", self.line.clone())?;
        given.set_item("header", self.header(py)?)?;
        Ok(given)
    }
}

impl SeasFiles {
    /// New files with a row for the start of a run, of a fault whose slip on a plane has these directions.
    pub(super) fn create<const C: usize>(
        &self,
        (shear_modulus, directions): &(f64, Vec<[f64; 2]>),
        at: &Snapshot<'_, C>,
    ) -> Result<record::SeasFiles, FileError> {
        self.files.create(at, *shear_modulus, directions)
    }
}

/// The lines of a dictionary.
fn lines(given: &Bound<'_, PyAny>) -> PyResult<Vec<(String, String)>> {
    let pairs = given.cast::<PyDict>()?.iter();
    pairs
        .map(|(key, value)| Ok((key.extract()?, value.extract()?)))
        .collect()
}
