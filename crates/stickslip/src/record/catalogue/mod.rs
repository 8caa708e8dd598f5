//! A catalogue of the events of a contact.

mod sums;

use nalgebra::SVector;

use crate::record::check::{check_index, positive, require};
use crate::record::threshold::time_of;
use crate::{ContactView, Event, SceneError, Snapshot};

/// A catalogue of the slip events of a contact: time, place, slip and size, see [`Event`].
///
/// Pass every step to [`record`](Self::record). The memory grows with the number of events only; a run with no more
/// events than the catalogue was built for allocates nothing. Tractions are evaluated while the contact slides faster
/// than the rate that ends an event. If a single step leads from below that rate to above the threshold, the tractions
/// before the event are those after this step.
///
/// An event at the first sample begins there. One that outlasts a run goes on in the next one, if the catalogue records
/// it, also after a checkpoint; [`under_way`](Self::under_way) shows it without an end.
///
/// The slip of an event is the length of the change of the slip vector; its friction work is along the path.
///
/// ```
/// use stickslip::problems::spring_slider::{AGING, FRICTION, LoadPath, SpringSlider};
/// use stickslip::record::EventCatalogue;
/// use stickslip::{RungeKutta, Steps};
///
/// // A block of 1 m^2 on a spring of 0.25 GPa/m.
/// let load = LoadPath::steady(1e-6);
/// let slider = SpringSlider { stiffness: 2.5e8, normal_stress: 1e6, mass: 0.0, damping: 5e6, load };
/// let mut block = RungeKutta::new(slider.steady(FRICTION, AGING, 1.01e-6)?)?;
/// let mut catalogue = EventCatalogue::new(&block.snapshot(), 0, [1e-4, 1e-5], 3e10, 16)?;
/// block.run(&Steps::adaptive(1e-6).until(3000.0), |at| catalogue.record(&at))?;
/// let last = catalogue.events().last().ok_or("no event")?;
/// // What the spring lost: its stiffness times the slip, less what the load point went on.
/// let moved = 1e-6 * (last.arrest - last.onset);
/// assert!((last.stress_drop / (2.5e8 * (last.mean_slip - moved)) - 1.0).abs() < 0.02);
/// assert_eq!(last.moment, 3e10 * last.mean_slip);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EventCatalogue<const C: usize> {
    contact: usize,
    threshold: f64,
    end: f64,
    shear_modulus: f64,
    /// The time of the last step \[s\], and the slip rates of the last and the present step [m/s].
    time: f64,
    rates: [Vec<f64>; 2],
    /// The slip after the last step without event, and before the event \[m\].
    slips: [Vec<SVector<f64, C>>; 2],
    /// The path of slip after the last step \[m\].
    paths: Vec<f64>,
    /// The shear traction after the last step, and before the event \[Pa\].
    tractions: [Vec<SVector<f64, C>>; 2],
    /// The pore pressure after the last step without event, and before the event \[Pa\]; empty without fields.
    pressures: [Vec<f64>; 2],
    /// The tractions are those of the last step.
    known: bool,
    passed: Vec<bool>,
    under_way: Option<Event>,
    events: Vec<Event>,
}

impl<const C: usize> EventCatalogue<C> {
    /// A catalogue for contact number `contact`, counted from 0, with memory for `room` events. Events begin at a slip
    /// rate of `threshold` and end at `end` [m/s], at most the threshold. The shear modulus \[Pa\] is that of the body
    /// next to the contact.
    ///
    /// # Errors
    /// [`SceneError::Index`] for a contact that the scene does not have, [`SceneError::Value`] for rates or a
    /// modulus that are not positive and finite, or an `end` above the threshold.
    pub fn new(
        at: &Snapshot<'_, C>,
        contact: usize,
        [threshold, end]: [f64; 2],
        shear_modulus: f64,
        room: usize,
    ) -> Result<Self, SceneError> {
        check_index("contact", contact, at.contact_count())?;
        positive("threshold", threshold)?;
        positive("rate that ends an event", end)?;
        let requirement = "no larger than the threshold";
        require(
            "rate that ends an event",
            requirement,
            end,
            end <= threshold,
        )?;
        positive("shear modulus", shear_modulus)?;
        let seen = at.contact(contact);
        let count = seen.len();
        let vectors = || vec![SVector::zeros(); count];
        let pressures = vec![0.0; if seen.field(0).is_some() { count } else { 0 }];
        let rates: Vec<f64> = (0..count).map(|k| seen.slip_rate(k)).collect();
        let mut catalogue = Self {
            contact,
            threshold,
            end,
            shear_modulus,
            time: at.time,
            rates: [rates.clone(), rates],
            slips: [vectors(), vectors()],
            paths: vec![0.0; count],
            tractions: [vectors(), vectors()],
            pressures: [pressures.clone(), pressures],
            known: false,
            passed: vec![false; count],
            under_way: None,
            events: Vec::with_capacity(room),
        };
        catalogue.wait(&seen, 0.0);
        catalogue.record(at);
        Ok(catalogue)
    }

    /// The slip rates at which events begin and end [m/s].
    pub fn rates(&self) -> [f64; 2] {
        [self.threshold, self.end]
    }

    /// The completed events, in their order.
    pub fn events(&self) -> &[Event] {
        &self.events
    }

    /// Whether an event is in progress.
    pub fn is_under_way(&self) -> bool {
        self.under_way.is_some()
    }

    /// The event in progress up to the step shown, the last one recorded, with NaN as its arrest.
    ///
    /// # Panics
    /// As of [`record`](Self::record).
    pub fn under_way(&self, at: &Snapshot<'_, C>) -> Option<Event> {
        let mut event = self.under_way?;
        self.add_up(&at.contact(self.contact), &mut event);
        Some(event)
    }

    /// Records the step shown.
    ///
    /// # Panics
    /// For a step of a scene with fewer contacts or vertices than the recorder's own.
    pub fn record(&mut self, at: &Snapshot<'_, C>) {
        let contact = at.contact(self.contact);
        let (mut fastest, mut largest) = (0, 0.0);
        for (k, rate) in self.rates[1].iter_mut().enumerate() {
            *rate = contact.slip_rate(k);
            if *rate > largest {
                (fastest, largest) = (k, *rate);
            }
        }
        if self.under_way.is_none() && largest >= self.threshold {
            self.begin(&contact, at.time);
        }
        if let Some(mut event) = self.under_way.take() {
            self.go_on(&contact, &mut event);
            if largest > event.peak_slip_rate {
                event.peak_slip_rate = largest;
                event.peak_time = at.time;
                event.peak_vertex = contact.vertex(fastest);
            }
            if largest < self.end {
                self.finish(&contact, &mut event, at.time, largest);
                self.events.push(event);
                self.known = true;
                for (k, slip) in self.slips[0].iter_mut().enumerate() {
                    *slip = contact.slip_vector(k);
                }
                self.look_at_pressures(&contact);
            } else {
                self.under_way = Some(event);
            }
        } else {
            self.wait(&contact, largest);
        }
        self.time = at.time;
        self.rates.swap(0, 1);
    }

    /// Keeps what an event after this step, without one, begins with.
    fn wait(&mut self, contact: &ContactView<'_, C>, largest: f64) {
        self.known = largest >= self.end;
        if self.known {
            look(contact, &mut self.tractions[0]);
        }
        for (k, (slip, path)) in self.slips[0].iter_mut().zip(&mut self.paths).enumerate() {
            (*slip, *path) = (contact.slip_vector(k), contact.slip_path(k));
        }
        self.look_at_pressures(contact);
    }

    fn look_at_pressures(&mut self, contact: &ContactView<'_, C>) {
        for (k, pressure) in self.pressures[0].iter_mut().enumerate() {
            *pressure = contact.pore_pressure(k);
        }
    }

    fn begin(&mut self, contact: &ContactView<'_, C>, time: f64) {
        let [old, new] = &self.rates;
        let times = old
            .iter()
            .zip(new)
            .enumerate()
            .filter_map(|(k, (old, new))| {
                let passes = *new >= self.threshold;
                passes.then(|| {
                    let at = time_of(self.threshold, (self.time, *old), (time, *new));
                    (at, k, *new)
                })
            });
        // Of those that exceed it at once, as at the start, the fastest.
        let first = times.min_by(|a, b| a.0.total_cmp(&b.0).then(b.2.total_cmp(&a.2)));
        let (onset, origin, _) = first.unwrap_or((time, 0, 0.0));
        if !self.known {
            look(contact, &mut self.tractions[0]);
        }
        let [last, before] = &mut self.tractions;
        before.copy_from_slice(last);
        let [last, before] = &mut self.slips;
        before.copy_from_slice(last);
        let [last, before] = &mut self.pressures;
        before.copy_from_slice(last);
        self.passed.fill(false);
        self.under_way = Some(Event {
            onset,
            arrest: f64::NAN,
            origin: contact.vertex(origin),
            hypocentre: contact.point(origin),
            peak_slip_rate: 0.0,
            peak_time: time,
            peak_vertex: contact.vertex(origin),
            vertices: 0,
            low: [f64::INFINITY; 3],
            high: [f64::NEG_INFINITY; 3],
            area: 0.0,
            largest_slip: 0.0,
            mean_slip: 0.0,
            moment: 0.0,
            stress_drop: 0.0,
            friction_work: 0.0,
            released: 0.0,
            pressure_change: 0.0,
        });
    }

    /// Adds the work of a step, and the vertices that exceed the threshold in it.
    fn go_on(&mut self, contact: &ContactView<'_, C>, event: &mut Event) {
        for k in 0..contact.len() {
            self.passed[k] |= self.rates[1][k] >= self.threshold;
            let (traction, path) = (contact.traction(k), contact.slip_path(k));
            let mean = 0.5 * (self.tractions[0][k].norm() + traction.norm());
            event.friction_work += contact.weight(k) * mean * (path - self.paths[k]);
            self.tractions[0][k] = traction;
            self.paths[k] = path;
        }
    }

    fn finish(&mut self, contact: &ContactView<'_, C>, event: &mut Event, time: f64, rate: f64) {
        let last = self.rates[0].iter().copied().fold(0.0, f64::max);
        event.arrest = time_of(self.end, (self.time, last), (time, rate));
        self.add_up(contact, event);
    }
}

/// The shear traction at every vertex \[Pa\].
fn look<const C: usize>(contact: &ContactView<'_, C>, tractions: &mut [SVector<f64, C>]) {
    for (k, traction) in tractions.iter_mut().enumerate() {
        *traction = contact.traction(k);
    }
}
