//! Histories of vertices, written during the run.

use std::io;
use std::ops::ControlFlow;

use super::check::{check_index, require};
use super::table::{Entry, Lasting};
#[cfg(doc)]
use crate::SceneError;
use crate::{FileError, Snapshot};

/// Histories of chosen vertices as comma-separated values: one row per vertex, at a fixed interval of steps.
///
/// | column | source | unit |
/// | --- | --- | --- |
/// | `time`, `vertex` | the step, the vertex of the body | s |
/// | `displacement`, `velocity` | the vertex, one column per component (`_x`, `_y`, `_z`) | m, m/s |
/// | `state`, `slip_rate`, `traction` | the first contact there, see [`ContactView`](crate::ContactView); `NaN` beside one | state law's, m/s, Pa |
///
/// Where a contact has fields, the columns `pore_pressure`, `effective_normal_stress` and the readings of all fields
/// follow, `NaN` beside a contact that has them.
///
/// The memory does not grow with the run. A write error ends the run, and [`finish`](Self::finish) returns it.
///
/// ```
/// use stickslip::problems::spring_slider::{AGING, FRICTION, LoadPath, SpringSlider};
/// use stickslip::record::PointHistories;
/// use stickslip::{GeneralizedAlpha, Point, Simulation, Steps};
///
/// # let load = LoadPath::steady(1e-6);
/// # let slider = SpringSlider { stiffness: 1e9, normal_stress: 1e6, mass: 0.0, damping: 0.0, load };
/// # let scene = slider.steady(FRICTION, AGING, 1e-6)?;
/// let mut simulation = Simulation::new(scene, GeneralizedAlpha::default(), Point)?;
/// let mut points = PointHistories::new(&simulation.snapshot(), &[0], 10, Vec::new())?;
/// simulation.run(&Steps::constant(0.1).count(100), |at| points.record(&at))?;
/// let text = String::from_utf8(points.finish()?)?;
/// assert!(text.starts_with("time,vertex,displacement,velocity,state,slip_rate,traction\n"));
/// assert_eq!(text.lines().count(), 1 + 10);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
#[doc(alias("probe", "station"))]
pub struct PointHistories<W> {
    rows: Lasting<W>,
    vertices: Vec<Place>,
    /// The names of the readings of fields; none without fields.
    readings: Option<Vec<&'static str>>,
    every: usize,
    /// The steps since the last row.
    since: usize,
}

/// A vertex, and its place in a contact.
#[derive(Debug, Clone, Copy)]
struct Place {
    vertex: usize,
    contact: Option<(usize, usize)>,
}

impl<W: io::Write> PointHistories<W> {
    /// Rows of `vertices` for every step whose number of steps shown is a multiple of `every`. Writes the names of the
    /// columns.
    ///
    /// # Errors
    /// [`SceneError::Index`] for a vertex that the body does not have, [`SceneError::Value`] for `every` 0,
    /// [`FileError::Write`].
    pub fn new<const C: usize>(
        at: &Snapshot<'_, C>,
        vertices: &[usize],
        every: usize,
        writer: W,
    ) -> Result<Self, FileError> {
        require("every", "at least 1", every as f64, every > 0)?;
        let place = |&vertex: &usize| {
            check_index("vertex", vertex, at.displacement.len())?;
            let mut contacts = at.contacts().enumerate();
            let contact =
                contacts.find_map(|(index, contact)| Some((index, contact.position_of(vertex)?)));
            Ok(Place { vertex, contact })
        };
        let places: Result<Vec<_>, FileError> = vertices.iter().map(place).collect();
        let mut columns = vec!["time".to_string(), "vertex".into()];
        columns.extend(components::<C>("displacement"));
        columns.extend(components::<C>("velocity"));
        columns.extend(["state".into(), "slip_rate".into()]);
        columns.extend(components::<C>("traction"));
        let readings = of_fields(at);
        if let Some(readings) = &readings {
            columns.extend(["pore_pressure".into(), "effective_normal_stress".into()]);
            columns.extend(readings.iter().map(|&name| name.into()));
        }
        Ok(Self {
            rows: Lasting::new(writer, &columns)?,
            vertices: places?,
            readings,
            every,
            since: 0,
        })
    }

    /// Records the step shown; breaks the run on a write error.
    ///
    /// # Panics
    /// For a step of a scene with fewer contacts or vertices than the recorder's own.
    pub fn record<const C: usize>(&mut self, at: &Snapshot<'_, C>) -> ControlFlow<()> {
        self.since += 1;
        if self.since < self.every {
            return ControlFlow::Continue(());
        }
        self.since = 0;
        for &Place { vertex, contact } in &self.vertices {
            let [mut state, mut slip_rate] = [f64::NAN; 2];
            let mut traction = [f64::NAN; C];
            if let Some((index, k)) = contact {
                let contact = at.contact(index);
                (state, slip_rate) = (contact.state(k), contact.slip_rate(k));
                traction = contact.traction(k).into();
            }
            let (u, v) = (&at.displacement[vertex], &at.velocity[vertex]);
            let numbers = (u.iter().copied())
                .chain(v.iter().copied())
                .chain([state, slip_rate])
                .chain(traction);
            let begin = [at.time.into(), vertex.into()];
            let of_fields = self.readings.iter().flat_map(|names| {
                let contact = contact.map(|(index, k)| (at.contact(index), k));
                let contact = contact.filter(|(contact, _)| contact.field(0).is_some());
                let own = contact.map_or([f64::NAN; 2], |(contact, k)| {
                    [contact.pore_pressure(k), contact.effective_normal_stress(k)]
                });
                let readings = names.iter().map(move |name| {
                    let values = contact.and_then(|(contact, k)| Some(contact.reading(name)?[k]));
                    values.unwrap_or(f64::NAN)
                });
                own.into_iter().chain(readings)
            });
            let numbers = numbers.chain(of_fields).map(Entry::Number);
            self.rows.row(begin.into_iter().chain(numbers));
        }
        self.rows.flow()
    }

    /// Writes the buffered rows, and returns the writer.
    ///
    /// # Errors
    /// [`FileError::Write`], also of an earlier row.
    pub fn finish(self) -> Result<W, FileError> {
        self.rows.finish()
    }
}

/// The names of the readings of the fields of all contacts, each once; none if there is no field.
fn of_fields<const C: usize>(at: &Snapshot<'_, C>) -> Option<Vec<&'static str>> {
    let mut contacts = at.contacts();
    contacts.find(|contact| contact.field(0).is_some())?;
    let mut names: Vec<&str> = Vec::new();
    for reading in at.contacts().flat_map(|contact| contact.readings()) {
        if !names.contains(&reading.name) {
            names.push(reading.name);
        }
    }
    Some(names)
}

/// The names of the components of a vector.
fn components<const C: usize>(name: &str) -> impl Iterator<Item = String> {
    (0..C).map(move |c| match (C, ["x", "y", "z"].get(c)) {
        (1, _) => name.into(),
        (_, Some(axis)) => format!("{name}_{axis}"),
        (_, None) => format!("{name}_{c}"),
    })
}
