//! What a contact does in space and time.

use std::io;
use std::ops::ControlFlow;

use super::error::{check_contact, require};
use super::table::{Entry, Lasting};
use crate::step::AtContact;
use crate::{RecordError, Snapshot};

/// What a trace shows of a vertex of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Quantity {
    /// The path length of slip \[m\].
    Slip,
    /// The slip rate [m/s].
    SlipRate,
    /// The state, in the state law's own variable.
    State,
    /// The shear traction \[Pa\]: in the plane with its sign, in space its modulus.
    Traction,
}

impl Quantity {
    fn name(self) -> &'static str {
        match self {
            Self::Slip => "slip",
            Self::SlipRate => "slip_rate",
            Self::State => "state",
            Self::Traction => "traction",
        }
    }

    fn of<const C: usize>(self, contact: &AtContact<'_, C>, k: usize) -> f64 {
        match self {
            Self::Slip => contact.slip(k),
            Self::SlipRate => contact.slip_rate(k),
            Self::State => contact.state(k),
            Self::Traction => {
                let traction = contact.traction(k);
                // At most one component of a vector in the plane is tangential to an axis.
                if C < 3 {
                    traction.sum()
                } else {
                    traction.norm()
                }
            }
        }
    }
}

/// Which steps of which contact a trace keeps, and what of them.
///
/// The first step shown is kept. Then every so many steps, or where the largest slip rate of the contact has
/// changed by a factor since the last step kept, or where either holds; every step if nothing is said.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Tracing {
    contact: usize,
    quantities: Vec<Quantity>,
    every: Option<usize>,
    change: Option<(f64, f64)>,
}

impl Tracing {
    /// Traces these quantities of contact number `contact`, counted from 0.
    pub fn of(contact: usize, quantities: &[Quantity]) -> Self {
        Self {
            contact,
            quantities: quantities.to_vec(),
            every: None,
            change: None,
        }
    }

    /// Keeps every step number `steps` after the last one kept for that.
    #[must_use]
    pub fn every(mut self, steps: usize) -> Self {
        self.every = Some(steps);
        self
    }

    /// Keeps a step whose largest slip rate is `factor` times that of the last one kept, or more, or one over
    /// `factor` times it, or less. Rates below `floor` [m/s] count as that.
    #[must_use]
    pub fn on_change(mut self, factor: f64, floor: f64) -> Self {
        self.change = Some((factor, floor));
        self
    }
}

/// Decides which steps are kept.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Sampler {
    tracing: Tracing,
    /// The steps since the last one kept for their number; none before the first.
    since: Option<usize>,
    /// The largest slip rate of the last step kept [m/s].
    rate: f64,
}

impl Sampler {
    fn new<const C: usize>(at: &Snapshot<'_, C>, tracing: Tracing) -> Result<Self, RecordError> {
        check_contact(tracing.contact, at.contact_count())?;
        if let Some(every) = tracing.every {
            require("every", "at least 1", every as f64, every > 0)?;
        }
        if let Some((factor, floor)) = tracing.change {
            require("factor of the slip rate", "above 1", factor, factor > 1.0)?;
            let requirement = "non-negative and finite";
            let legal = floor >= 0.0 && floor.is_finite();
            require("floor of the slip rate", requirement, floor, legal)?;
        }
        Ok(Self {
            tracing,
            since: None,
            rate: 0.0,
        })
    }

    /// The contact of a step that is kept.
    fn keep<'a, const C: usize>(&mut self, at: &Snapshot<'a, C>) -> Option<AtContact<'a, C>> {
        let contact = at.contact(self.tracing.contact);
        let Tracing { every, change, .. } = self.tracing;
        let mut kept = self.since.is_none();
        let since = self.since.map_or(0, |since| since + 1);
        let in_turn = every.is_some_and(|every| since >= every);
        kept |= in_turn || (every.is_none() && change.is_none());
        self.since = Some(if in_turn { 0 } else { since });
        if let Some((factor, floor)) = change {
            let rate = contact.max_slip_rate().max(floor);
            kept |= rate > 0.0 && (rate >= factor * self.rate || rate * factor <= self.rate);
            kept |= rate == 0.0 && self.rate > 0.0;
            if kept {
                self.rate = rate;
            }
        }
        kept.then_some(contact)
    }
}

/// The vertices of a contact in the order of their places, with these.
///
/// In the plane the place is the coordinate along the line that joins the ends of the contact \[m\]: x along an
/// axis x. In space, and at a point, vertices keep their order and have their number as a place.
fn along<const C: usize>(contact: &AtContact<'_, C>) -> (Vec<usize>, Vec<f64>) {
    let count = contact.len();
    let points: Vec<[f64; 3]> = (0..count).map(|k| contact.point(k)).collect();
    let in_space = contact.dimension() == 3;
    let difference = |a: &[f64; 3], b: &[f64; 3]| [a[0] - b[0], a[1] - b[1]];
    let length = |d: &[f64; 2]| d[0].hypot(d[1]);
    let farthest = |from: &[f64; 3]| {
        let ways = points.iter().map(|point| difference(point, from));
        ways.max_by(|a, b| length(a).total_cmp(&length(b)))
    };
    let end = farthest(&points[0]).unwrap_or_default();
    let end = [points[0][0] + end[0], points[0][1] + end[1], 0.0];
    let way = farthest(&end).unwrap_or_default();
    let mut order: Vec<usize> = (0..count).collect();
    if in_space || length(&way) == 0.0 {
        let numbers = order.iter().map(|&k| k as f64).collect();
        return (order, numbers);
    }
    let forward = if way[0].abs() >= way[1].abs() {
        way[0] > 0.0
    } else {
        way[1] > 0.0
    };
    let scale = if forward { 1.0 } else { -1.0 } / length(&way);
    // A zero that is not negative.
    let place = |k: usize| scale * (points[k][0] * way[0] + points[k][1] * way[1]) + 0.0;
    order.sort_by(|&a, &b| place(a).total_cmp(&place(b)));
    let places = order.iter().map(|&k| place(k)).collect();
    (order, places)
}

/// Traces of a contact as comma-separated values: a row a vertex for every step kept, in the order of the vertices
/// along the contact.
///
/// The columns are `time` \[s\], the place along the contact (`along` \[m\] in the plane; `x`, `y`, `z` in space), and
/// the quantities asked for. What is held does not grow with the run. A row that cannot be written ends the run,
/// and [`finish`](Self::finish) says why.
///
/// ```
/// use stickslip::fem::{P1, antiplane};
/// use stickslip::friction::Tresca;
/// use stickslip::{Condensed, Contact, Newmark, Quantity, Scene, Simulation, Steps, TraceWriter, Tracing};
///
/// let space = P1::grid([2.0, 1.0], [4, 2])?;
/// let (bottom, top) = (space.trace(|x| x[1] == 0.0)?, space.trace(|x| x[1] == 1.0)?);
/// let scene = Scene::new(antiplane(&space, 1e9)?)
///     .with_contact(Contact::new(&bottom, Tresca { coefficient: 0.6 }, 1e6))
///     .move_at(&top, [true], |_| [1e-3]);
/// let mut layer = Simulation::new(scene, Newmark::default(), Condensed::new())?;
/// let tracing = Tracing::of(0, &[Quantity::Slip, Quantity::Traction]).every(50);
/// let mut trace = TraceWriter::new(&layer.snapshot(), tracing, Vec::new())?;
/// layer.run(&Steps::constant(0.01).count(101), |at| trace.record(&at))?;
/// let text = String::from_utf8(trace.finish()?)?;
/// assert!(text.starts_with("time,along,slip,traction\n1e-2,0e0,0e0,"));
/// assert_eq!(text.lines().count(), 1 + 3 * 5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct TraceWriter<W> {
    rows: Lasting<W>,
    sampler: Sampler,
    order: Vec<usize>,
    along: Vec<f64>,
    in_space: bool,
}

impl<W: io::Write> TraceWriter<W> {
    /// Writes the names of the columns.
    ///
    /// # Errors
    /// [`RecordError::Contact`] for a contact that the scene does not have, [`RecordError::Setting`] for numbers out
    /// of range, [`RecordError::Write`].
    pub fn new<const C: usize>(
        at: &Snapshot<'_, C>,
        tracing: Tracing,
        writer: W,
    ) -> Result<Self, RecordError> {
        let sampler = Sampler::new(at, tracing)?;
        let contact = at.contact(sampler.tracing.contact);
        let (order, along) = along(&contact);
        let in_space = contact.dimension() == 3;
        let mut columns = vec!["time"];
        columns.extend_from_slice(if in_space {
            &["x", "y", "z"]
        } else {
            &["along"]
        });
        columns.extend(sampler.tracing.quantities.iter().map(|q| q.name()));
        Ok(Self {
            rows: Lasting::new(writer, &columns)?,
            sampler,
            order,
            along,
            in_space,
        })
    }

    /// Takes the step shown; breaks the run if it cannot be written.
    pub fn record<const C: usize>(&mut self, at: &Snapshot<'_, C>) -> ControlFlow<()> {
        let Some(contact) = self.sampler.keep(at) else {
            return ControlFlow::Continue(());
        };
        for (&k, &along) in self.order.iter().zip(&self.along) {
            let (point, places) = if self.in_space {
                (contact.point(k), 3)
            } else {
                ([along, 0.0, 0.0], 1)
            };
            let quantities = &self.sampler.tracing.quantities;
            let values = quantities.iter().map(|quantity| quantity.of(&contact, k));
            let begin = [at.time].into_iter().chain(point.into_iter().take(places));
            self.rows.row(begin.chain(values).map(Entry::Number));
        }
        self.rows.flow()
    }

    /// Writes what is still buffered, and gives the writer back.
    ///
    /// # Errors
    /// [`RecordError::Write`], also of a row before.
    pub fn finish(self) -> Result<W, RecordError> {
        self.rows.finish()
    }
}

/// Traces of a contact in memory, at most so many rows: for a picture.
///
/// When the memory is full, every second row is dropped, and from then on every second step that would have been
/// kept is passed over: the rows always lie evenly among the steps that [`Tracing`] keeps, and at least half of the
/// memory is in use.
///
/// ```
/// # use stickslip::problems::{AGING, FRICTION, LoadPath, SpringSlider};
/// # use stickslip::{Newmark, Point, Quantity, Simulation, Steps, TraceMemory, Tracing};
/// # let load = LoadPath::steady(1e-6);
/// # let slider = SpringSlider { stiffness: 1e9, normal_stress: 1e6, mass: 0.0, damping: 0.0, load };
/// # let scene = slider.steady(FRICTION, AGING, 1e-6)?;
/// let mut simulation = Simulation::new(scene, Newmark::default(), Point)?;
/// let tracing = Tracing::of(0, &[Quantity::Slip]);
/// let mut trace = TraceMemory::new(&simulation.snapshot(), tracing, 64)?;
/// simulation.run(&Steps::constant(0.1).count(1000), |at| trace.record(&at))?;
/// // Steps 1, 17, 33, ..., 993.
/// assert_eq!(trace.times().len(), 63);
/// assert!((trace.times()[1] - 1.7).abs() < 1e-12 && (trace.value(1, 0, 0) - 1.7e-6).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TraceMemory {
    sampler: Sampler,
    order: Vec<usize>,
    along: Vec<f64>,
    rows: usize,
    times: Vec<f64>,
    values: Vec<f64>,
    /// Of as many steps that the sampler keeps one becomes a row.
    stride: usize,
    passed: usize,
}

impl TraceMemory {
    /// Takes the memory for `rows` rows.
    ///
    /// # Errors
    /// [`RecordError::Contact`] for a contact that the scene does not have, [`RecordError::Setting`] for numbers out
    /// of range and fewer than two rows.
    pub fn new<const C: usize>(
        at: &Snapshot<'_, C>,
        tracing: Tracing,
        rows: usize,
    ) -> Result<Self, RecordError> {
        require("rows", "at least 2", rows as f64, rows >= 2)?;
        let sampler = Sampler::new(at, tracing)?;
        let (order, along) = along(&at.contact(sampler.tracing.contact));
        let width = order.len() * sampler.tracing.quantities.len();
        Ok(Self {
            sampler,
            order,
            along,
            rows,
            times: Vec::with_capacity(rows),
            values: Vec::with_capacity(rows * width),
            stride: 1,
            passed: 0,
        })
    }

    /// Takes the step shown.
    pub fn record<const C: usize>(&mut self, at: &Snapshot<'_, C>) {
        let Some(contact) = self.sampler.keep(at) else {
            return;
        };
        let is_row = self.passed.is_multiple_of(self.stride);
        self.passed += 1;
        if !is_row {
            return;
        }
        if self.times.len() == self.rows {
            self.thin();
            if !(self.passed - 1).is_multiple_of(self.stride) {
                return;
            }
        }
        self.times.push(at.time);
        for &k in &self.order {
            let quantities = &self.sampler.tracing.quantities;
            let values = quantities.iter().map(|quantity| quantity.of(&contact, k));
            self.values.extend(values);
        }
    }

    /// Drops every second row.
    fn thin(&mut self) {
        let width = self.width();
        let kept = self.times.len().div_ceil(2);
        for row in 1..kept {
            self.times[row] = self.times[2 * row];
            let from = 2 * row * width;
            self.values.copy_within(from..from + width, row * width);
        }
        self.times.truncate(kept);
        self.values.truncate(kept * width);
        self.stride *= 2;
    }

    fn width(&self) -> usize {
        self.order.len() * self.sampler.tracing.quantities.len()
    }

    /// The times of the rows \[s\].
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// The places of the vertices, increasing: along the contact in the plane \[m\], else their numbers.
    pub fn along(&self) -> &[f64] {
        &self.along
    }

    /// The vertices of the contact in the order of their places, as numbers in the contact.
    pub fn vertices(&self) -> &[usize] {
        &self.order
    }

    /// The quantity number `quantity`, in the order in which they were asked for, of the vertex at `along()[place]`
    /// in row `row`.
    ///
    /// # Panics
    /// If there is no such row, place or quantity.
    pub fn value(&self, row: usize, place: usize, quantity: usize) -> f64 {
        let count = self.sampler.tracing.quantities.len();
        let row = &self.values[row * self.width()..][..self.width()];
        row[place * count..][..count][quantity]
    }
}
