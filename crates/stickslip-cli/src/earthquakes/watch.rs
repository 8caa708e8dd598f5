//! Histories at stations of a problem with fluid injection.

use serde_json::{Map as Object, Value, json};
use stickslip::Snapshot;

use super::{DAY, Failed, Station};
use crate::output::{Output, number};
use crate::plot::{self, COLORS, Panel, Points};

/// The record of a station.
pub(crate) struct Watch {
    pub(crate) station: Station,
    /// Its name in pictures.
    name: String,
    /// Time \[days\], and log10 V, slip \[m\] and pore pressure \[MPa\].
    curves: [Points; 3],
    /// The requested times \[s\], and the values then.
    times: &'static [f64],
    pub(crate) known: Vec<Known>,
    peak: [f64; 2],
}

/// Slip \[m\], log10 V and pore pressure \[Pa\] at a time.
pub(crate) struct Known {
    pub(crate) slip: f64,
    pub(crate) log_rate: f64,
    pub(crate) pressure: f64,
}

impl Watch {
    /// The record of a station with a name, which also keeps its values at these times \[s\].
    pub(crate) fn new(station: Station, name: String, times: &'static [f64]) -> Self {
        Self {
            station,
            name,
            curves: Default::default(),
            times,
            known: Vec::new(),
            peak: [f64::NEG_INFINITY, 0.0],
        }
    }

    /// Records a step.
    pub(crate) fn see<const C: usize>(&mut self, at: &Snapshot<'_, C>) {
        let (contact, day) = (at.contact(0), at.time / DAY);
        let known = Known {
            slip: self.station.slip(&contact),
            log_rate: self.station.log_rate(&contact),
            pressure: self.station.pore_pressure(&contact),
        };
        if known.log_rate > self.peak[0] {
            self.peak = [known.log_rate, day];
        }
        let values = [known.log_rate, known.slip, 1e-6 * known.pressure];
        let curves = self.curves.iter_mut().zip(values);
        curves.for_each(|(curve, value)| curve.push((day, value)));
        if self.times.contains(&at.time) {
            self.known.push(known);
        }
    }

    /// Its values at the requested times, by day, and its peak.
    pub(crate) fn summary(&self) -> Value {
        let by_day = |value: fn(&Known) -> f64| -> Object<String, Value> {
            let known = self.times.iter().zip(&self.known);
            known
                .map(|(time, known)| ((time / DAY).to_string(), json!(value(known))))
                .collect()
        };
        let [x, z] = self.station.position;
        json!({
            "strike_m": x,
            "depth_m": z,
            "slip": by_day(|known| known.slip),
            "log10_slip_rate": by_day(|known| known.log_rate),
            "pore_pressure": by_day(|known| known.pressure),
            "peak_log10_slip_rate": self.peak[0],
            "peak_day": self.peak[1],
        })
    }

    /// Prints its values at the requested times.
    pub(crate) fn say(&self) -> Result<(), Failed> {
        say!("at {}", self.name)?;
        for (time, known) in self.times.iter().zip(&self.known) {
            let Known {
                slip,
                log_rate,
                pressure,
            } = known;
            let (day, pressure) = (time / DAY, 1e-6 * pressure);
            say!(
                "  day {day:>7.3}: slip {slip:.5e} m, log10 V {log_rate:.4}, p {pressure:.6} MPa"
            )?;
        }
        Ok(())
    }
}

/// Writes and draws the histories of stations.
pub(crate) fn write(
    output: &Output,
    [table, picture]: [&str; 2],
    watches: &[Watch],
) -> Result<(), Failed> {
    let rows = watches.iter().flat_map(|watch| {
        let [x, z] = watch.station.position;
        let [rates, slips, pressures] = &watch.curves;
        let rows = rates.iter().zip(slips).zip(pressures);
        rows.map(move |((rate, slip), pressure)| {
            [x, z, rate.0 * DAY, slip.1, rate.1, 1e6 * pressure.1].map(number)
        })
    });
    let columns = "strike,depth,time,slip,log10_slip_rate,pore_pressure";
    output.table(table, columns, rows)?;
    let panel = |title, curve: usize| {
        let mut panel = Panel::new("time [days]", title);
        for (watch, color) in watches.iter().zip(COLORS) {
            panel = panel.with(&watch.name, color, 3, watch.curves[curve].clone());
        }
        panel
    };
    let panels = [
        panel("slip [m]", 1),
        panel("log10 of the slip rate [m/s]", 0),
        panel("pore pressure [MPa]", 2),
    ];
    plot::draw(&output.path(picture), &panels)
}
