//! The record of a run, which can be kept in a file and continued.

use serde::{Deserialize, Serialize};
use stickslip::Snapshot;
use stickslip::record::RuptureTimes;

use super::Arguments;
use super::problem::{Prestress, ROCK};
use super::rock::Rock;
use crate::cli::Problem;

/// The slip rate of a half at which a vertex ruptures [m/s].
const RUPTURED: f64 = 0.5e-3;

/// The columns of a station: time, slip, slip rate and shear stress along strike and down dip, across the fault; effective normal
/// stress, pore pressure and temperature.
pub(super) type Row = [f64; 10];

/// The history of a vertex of the fault.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Station {
    /// Its place along strike and down dip \[m\].
    pub place: [f64; 2],
    /// The position among the vertices of the fault.
    position: usize,
    /// One row a step.
    pub rows: Vec<Row>,
}

/// What is recorded.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Record {
    /// The stations of the benchmark.
    pub stations: Vec<Station>,
    /// The times at which vertices rupture.
    pub front: RuptureTimes,
    /// Time, moment \[N m\] and its rate, of the whole fault.
    pub moment: Vec<[f64; 3]>,
    /// The largest slip rate of each vertex so far, across the fault [m/s].
    pub peak: Vec<f64>,
    /// The slip of each vertex, across the fault \[m\].
    slip: Vec<f64>,
    /// The wall time of the steps \[s\].
    pub seconds: f64,
    /// What the moment of the computed part is multiplied by.
    parts: f64,
    /// The direction of depth.
    down: f64,
    heated: bool,
}

impl Record {
    /// Opens a record before the first step. The first row of a station is the initial stress.
    pub(super) fn new(
        arguments: &Arguments,
        rock: &Rock,
        prestress: &Prestress,
        at: &Snapshot<'_, 3>,
    ) -> Result<Self, Problem> {
        let (problem, contact) = (arguments.problem, at.contact(0));
        let vertices = 0..contact.len();
        let points: Vec<_> = vertices.map(|k| rock.place(&contact.point(k))).collect();
        let places = arguments.stations();
        let [along, down] = problem.extent();
        if let Some([x, depth]) = places
            .iter()
            .find(|[x, depth]| x.abs() > along || !(0.0..=down).contains(depth))
        {
            return Err(format!(
                "the station at {x} m along strike and {depth} m deep is outside the fault, up to {along} m along strike and {down} m deep"
            ).into());
        }
        let station = |wanted: [f64; 2]| {
            // The other half along strike is the same.
            let x = if rock.even {
                wanted[0].abs()
            } else {
                wanted[0]
            };
            let far = |k: &usize| (points[*k][0] - x).hypot(points[*k][1] - wanted[1]);
            let nearest = (0..points.len()).min_by(|a, b| far(a).total_cmp(&far(b)));
            let position = nearest.unwrap_or(0);
            let (rate, shear) = (2.0 * problem.initial_rate(), prestress.shear[position]);
            let normal = prestress.normal[position];
            let mut row = [0.0, 0.0, rate, shear, 0.0, 0.0, 0.0, normal, 0.0, f64::NAN];
            if problem.is_heated() {
                let temperature = contact.reading("temperature");
                row[9] = temperature.map_or(f64::NAN, |all| all[position]);
            }
            Station {
                place: wanted,
                position,
                rows: vec![row],
            }
        };
        let doubled = |twice: bool| if twice { 2.0 } else { 1.0 };
        Ok(Self {
            stations: places.into_iter().map(station).collect(),
            front: RuptureTimes::new(at, 0, [RUPTURED, 1e-9 * RUPTURED])?,
            moment: Vec::new(),
            peak: vec![0.0; points.len()],
            slip: vec![0.0; points.len()],
            seconds: 0.0,
            parts: doubled(rock.even) * doubled(problem.is_below_its_image()),
            down: rock.down(1.0),
            heated: problem.is_heated(),
        })
    }

    /// Records a step.
    pub(super) fn see(&mut self, at: &Snapshot<'_, 3>) {
        let contact = at.contact(0);
        let temperature = self
            .heated
            .then(|| contact.reading("temperature"))
            .flatten();
        for station in &mut self.stations {
            let k = station.position;
            let (slip, rate) = (contact.slip_vector(k) * 2.0, contact.slip_velocity(k) * 2.0);
            let (stress, down) = (contact.traction(k), self.down);
            station.rows.push([
                at.time,
                slip[0],
                rate[0],
                stress[0],
                down * slip[2],
                down * rate[2],
                down * stress[2],
                contact.effective_normal_stress(k),
                contact.pore_pressure(k),
                temperature.as_ref().map_or(f64::NAN, |all| all[k]),
            ]);
        }
        self.front.record(at);
        let [density, _, c_s] = ROCK;
        // Both halves slip by as much.
        let rigidity = 2.0 * self.parts * density * c_s.powi(2);
        let mut moment = [at.time, 0.0, 0.0];
        for (k, (peak, slip)) in self.peak.iter_mut().zip(&mut self.slip).enumerate() {
            let (area, rate) = (contact.weight(k), contact.slip_rate(k));
            *slip = 2.0 * contact.slip(k);
            moment[1] += 0.5 * rigidity * area * *slip;
            moment[2] += rigidity * area * rate;
            *peak = peak.max(2.0 * rate);
        }
        self.moment.push(moment);
    }

    /// The slip of each vertex, across the fault \[m\].
    pub(super) fn slip(&self) -> &[f64] {
        &self.slip
    }

    /// The number of steps so far.
    pub(super) fn steps(&self) -> usize {
        self.moment.len()
    }
}

impl Station {
    /// The magnitude of slip or slip rate, whose components are in two columns.
    pub(super) fn magnitude(row: &Row, [along, down]: [usize; 2]) -> f64 {
        row[along].hypot(row[down])
    }

    /// The last step.
    pub(super) fn last(&self) -> Row {
        self.rows[self.rows.len() - 1]
    }
}
