//! The record of a run on a plane: events, stations and pictures.

use serde_json::{Value, json};
use stickslip::Snapshot;
use stickslip::bie::Rectangles;
use stickslip::record::RuptureTimes;

use super::contours;
use super::events::Events;
use super::pictures::{self, Shots};
use super::plane::Setting;
use super::profiles::Profiles;
use super::space_time::SpaceTime;
use super::{Failed, Station, YEAR};
use crate::output::{Output, number};
use crate::plot::{self, COLORS, DARK, Panel, Points};

/// The slip rate anywhere at which an event begins [m/s].
pub(super) const EVENT: f64 = 1e-3;
/// The least log10 V of pictures.
const SLOWEST: f64 = -20.0;

/// The recorded quantities of a run.
pub(super) struct Record<'a> {
    setting: &'a Setting,
    cells: Rectangles,
    pub(super) events: Events,
    stations: Vec<Watch>,
    /// Time \[years\], log10 of the largest slip rate.
    largest: Points,
    profiles: Profiles,
    /// Along strike and down dip.
    rates: [SpaceTime; 2],
    shots: Shots,
    ruptures: RuptureTimes,
}

/// The record of a station.
struct Watch {
    station: Station,
    /// Time, slip, log10 V, shear stress.
    rows: Vec<[f64; 4]>,
    /// Slip at the onset of each event \[m\].
    slips: Vec<f64>,
}

impl<'a> Record<'a> {
    pub(super) fn new<const C: usize>(
        setting: &'a Setting,
        end: f64,
        cells: &Rectangles,
        at: &Snapshot<'_, C>,
    ) -> Result<Self, Failed> {
        let metres = setting.unit.1;
        let (along, down) = (cells.along_strike(), cells.down_dip());
        let [row, column] =
            [(down, setting.lines[0]), (along, setting.lines[1])].map(|(cells, place)| {
                let place = (place - cells.ends()[0]) / cells.length();
                (place as usize).min(cells.count() - 1)
            });
        let strike: Vec<_> = (0..along.count())
            .map(|column| (cells.index([column, row]), along.center(column) / metres))
            .collect();
        let depth: Vec<_> = (0..down.count())
            .rev()
            .map(|row| (cells.index([column, row]), -down.center(row) / metres))
            .collect();
        let stations = setting.stations.iter().map(|&position| Watch {
            station: Station::on_plane(cells, position),
            rows: Vec::new(),
            slips: Vec::new(),
        });
        Ok(Self {
            setting,
            cells: *cells,
            events: Events::new(EVENT, cells.count()),
            stations: stations.collect(),
            largest: Points::new(),
            rates: [&strike, &depth].map(|line| SpaceTime::new(line, end)),
            profiles: Profiles::new(strike, setting.intervals),
            shots: Shots::new(setting.rupture, setting.shots),
            ruptures: RuptureTimes::new(at, 0, [setting.rupture, 0.1 * EVENT])?,
        })
    }

    pub(super) fn see<const C: usize>(&mut self, at: &Snapshot<'_, C>) {
        let contact = at.contact(0);
        let seismic = self.events.record(at.time, &contact);
        let count = self.events.all().len();
        for watch in &mut self.stations {
            let (slip, rate) = (
                watch.station.slip(&contact),
                watch.station.log_rate(&contact),
            );
            watch
                .rows
                .push([at.time, slip, rate, watch.station.stress(&contact)]);
            if count > watch.slips.len() {
                watch.slips.push(slip);
            }
        }
        self.largest
            .push((at.time / YEAR, contact.max_slip_rate().log10()));
        self.profiles.record(at.time, seismic, &contact);
        self.rates
            .iter_mut()
            .for_each(|rates| rates.record(at.time, &contact));
        self.shots.record(at.time, &contact);
        self.ruptures.record(at);
    }

    /// Each station: slip from onset to onset, and from the last one to the end of the run.
    pub(super) fn stations(&self) -> Value {
        let each = self.stations.iter().map(|watch| {
            let [x, y] = watch.station.position;
            let last = watch.rows.last().map(|row| row[1]);
            let ends = watch.slips.iter().skip(1).copied().chain(last);
            let slips: Vec<f64> = watch
                .slips
                .iter()
                .zip(ends)
                .map(|(begin, end)| end - begin)
                .collect();
            let peak = watch
                .rows
                .iter()
                .map(|row| row[2])
                .fold(f64::NEG_INFINITY, f64::max);
            json!({
                "strike_km": x / 1e3,
                "down_dip_km": y / 1e3,
                "slip_per_event": slips,
                "peak_log10_slip_rate": peak,
            })
        });
        each.collect()
    }

    pub(super) fn write<const C: usize>(
        &self,
        output: &Output,
        [table, slip, rate, lines, plane, rupture, _]: [&str; 7],
        at: &Snapshot<'_, C>,
    ) -> Result<(), Failed> {
        let rows = self.stations.iter().flat_map(|watch| {
            let [x, y] = watch.station.position;
            let rows = watch.rows.iter();
            rows.map(move |[time, slip, rate, stress]| {
                [x, y, *time, *slip, *rate, *stress].map(number)
            })
        });
        output.table(
            table,
            "strike,down_dip,time,slip,log10_slip_rate,shear_stress",
            rows,
        )?;
        let Setting { unit, labels, .. } = self.setting;
        let [along, down] = ["along strike", "down dip"].map(|name| format!("{name} [{}]", unit.0));
        let panel = self
            .profiles
            .draw(Panel::new(&along, "slip [m]"), *labels, |x, slip| {
                Some((x, slip))
            });
        plot::draw(&output.path(slip), &[panel][..])?;
        self.draw_rates(output, rate)?;
        let [strike, depth] = &self.rates;
        pictures::lines(&output.path(lines), &[(&along, strike), (&down, depth)])?;
        let now = (&self.cells, &at.contact(0));
        self.shots.draw(&output.path(plane), now, *unit)?;
        contours::draw(&output.path(rupture), &self.cells, &self.ruptures, *unit)
    }

    /// Draws the largest slip rate, and those of the stations.
    fn draw_rates(&self, output: &Output, name: &str) -> Result<(), Failed> {
        let (unit, metres) = self.setting.unit;
        let panel = Panel::new("time [years]", "log10 of the largest slip rate [m/s]");
        let largest = panel.with("", DARK, 3, self.largest.clone());
        let names: Vec<String> = (self.stations.iter())
            .map(|watch| watch.station.position.map(|x| x / metres))
            .map(|[x, y]| format!("({x}, {y}) {unit}"))
            .collect();
        let mut panel = Panel::new("time [years]", "log10 of the slip rate [m/s], from -20");
        for ((watch, name), color) in self.stations.iter().zip(&names).zip(COLORS) {
            let curve = watch
                .rows
                .iter()
                .map(|row| (row[0] / YEAR, row[2].max(SLOWEST)));
            panel = panel.with(name, color, 2, curve.collect());
        }
        plot::draw(&output.path(name), &[largest, panel][..])
    }
}
