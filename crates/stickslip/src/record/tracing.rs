//! The steps and quantities of a trace.

use super::check::{check_index, require};
use crate::{ContactView, SceneError, Snapshot};

/// A quantity of a trace at a vertex of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Quantity {
    /// The slip, the length of the slip vector \[m\].
    Slip,
    /// The length of the path of slip \[m\].
    SlipPath,
    /// The slip rate [m/s].
    SlipRate,
    /// The state, in the state law's own variable.
    State,
    /// The shear traction \[Pa\]: in the plane with its sign, in space its modulus.
    Traction,
    /// The normal stress \[Pa\], positive in compression.
    NormalStress,
    /// The pore pressure of all fields \[Pa\].
    PorePressure,
    /// The normal stress less the pore pressure \[Pa\].
    EffectiveNormalStress,
    /// A reading of the fields, by its number among [`ContactView::readings`]; NaN if there are fewer.
    Reading(usize),
}

/// A contact with the readings that quantities ask for.
pub(super) struct Seen<'a, 'v, const C: usize> {
    contact: &'v ContactView<'a, C>,
    readings: Vec<(usize, Vec<f64>)>,
}

impl<'a, 'v, const C: usize> Seen<'a, 'v, C> {
    pub(super) fn new(contact: &'v ContactView<'a, C>, quantities: &[Quantity]) -> Self {
        let numbers = quantities.iter().filter_map(|quantity| match quantity {
            Quantity::Reading(number) => Some(*number),
            _ => None,
        });
        let readings = numbers.filter_map(|number| {
            let name = contact.readings().get(number)?.name;
            Some((number, contact.reading(name)?))
        });
        Self {
            contact,
            readings: readings.collect(),
        }
    }

    /// The value of a quantity at a vertex.
    pub(super) fn of(&self, quantity: Quantity, k: usize) -> f64 {
        let Quantity::Reading(number) = quantity else {
            return quantity.of(self.contact, k);
        };
        let mut readings = self.readings.iter();
        let own = readings.find(|(own, _)| *own == number);
        own.map_or(f64::NAN, |(_, values)| values[k])
    }
}

impl Quantity {
    /// The name of its column on a contact.
    pub(super) fn name<const C: usize>(self, contact: &ContactView<'_, C>) -> &'static str {
        match self {
            Self::NormalStress => "normal_stress",
            Self::PorePressure => "pore_pressure",
            Self::EffectiveNormalStress => "effective_normal_stress",
            Self::Reading(number) => {
                let readings = contact.readings();
                readings.get(number).map_or("reading", |own| own.name)
            }
            Self::Slip => "slip",
            Self::SlipPath => "slip_path",
            Self::SlipRate => "slip_rate",
            Self::State => "state",
            Self::Traction => "traction",
        }
    }

    fn of<const C: usize>(self, contact: &ContactView<'_, C>, k: usize) -> f64 {
        match self {
            Self::Slip => contact.slip(k),
            Self::SlipPath => contact.slip_path(k),
            Self::SlipRate => contact.slip_rate(k),
            Self::State => contact.state(k),
            Self::NormalStress => contact.normal_stress(k),
            Self::PorePressure => contact.pore_pressure(k),
            Self::EffectiveNormalStress => contact.effective_normal_stress(k),
            Self::Reading(_) => f64::NAN,
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

/// The choice of contact, steps and quantities for a trace.
///
/// The first step shown is kept. A later step is kept at a fixed interval of steps, or where the largest slip rate of
/// the contact has changed by a factor since the last step kept, or where either holds; by default every step.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Tracing {
    pub(super) contact: usize,
    pub(super) quantities: Vec<Quantity>,
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

    /// Keeps every step number `steps` after the last one kept by this formula.
    #[must_use]
    pub fn every(mut self, steps: usize) -> Self {
        self.every = Some(steps);
        self
    }

    /// Keeps a step if the largest slip rate has changed by `factor` or more, up or down, since the last one kept.
    /// Rates below `floor` [m/s] count as `floor`.
    #[must_use]
    pub fn on_change(mut self, factor: f64, floor: f64) -> Self {
        self.change = Some((factor, floor));
        self
    }
}

/// The decision on the steps to keep.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Sampler {
    pub(super) tracing: Tracing,
    /// The steps since the last one kept by number; none before the first.
    since: Option<usize>,
    /// The largest slip rate of the last step kept [m/s].
    rate: f64,
}

impl Sampler {
    pub(super) fn new<const C: usize>(
        at: &Snapshot<'_, C>,
        tracing: Tracing,
    ) -> Result<Self, SceneError> {
        check_index("contact", tracing.contact, at.contact_count())?;
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
    pub(super) fn keep<'a, const C: usize>(
        &mut self,
        at: &Snapshot<'a, C>,
    ) -> Option<ContactView<'a, C>> {
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

/// The vertices of a contact in the order of their positions, with these positions.
///
/// In the plane the position is the coordinate along the line that joins the ends of the contact \[m\]: x along an axis
/// x. In space, and at a point, vertices keep their order, and their number is the position.
pub(super) fn along<const C: usize>(contact: &ContactView<'_, C>) -> (Vec<usize>, Vec<f64>) {
    let count = contact.len();
    let points: Vec<[f64; 3]> = (0..count).map(|k| contact.point(k)).collect();
    let in_space = contact.dimension() == 3;
    let difference = |a: &[f64; 3], b: &[f64; 3]| [a[0] - b[0], a[1] - b[1]];
    let length = |d: &[f64; 2]| d[0].hypot(d[1]);
    let farthest = |from: &[f64; 3]| {
        let ways = points.iter().map(|point| difference(point, from));
        ways.max_by(|a, b| length(a).total_cmp(&length(b)))
    };
    // None of a contact without a vertex, as in some processes of several.
    let first = points.first().copied().unwrap_or_default();
    let end = farthest(&first).unwrap_or_default();
    let end = [first[0] + end[0], first[1] + end[1], 0.0];
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
