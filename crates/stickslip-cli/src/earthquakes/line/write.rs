//! The table and the pictures of a line.

use super::super::{Failed, pictures};
use super::Line;
use crate::output::{Output, number};
use crate::plot::{self, DARK, Panel};

impl Line<'_> {
    /// Writes the history at the station that detects events, and draws slip and slip rates.
    pub(super) fn write(
        &self,
        output: &Output,
        [history, slip, rate, map, _]: [&str; 5],
    ) -> Result<(), Failed> {
        let columns = "time,slip,log10_slip_rate,shear_stress,normal_stress";
        let columns = if self.follows {
            columns
        } else {
            columns.rsplit_once(',').map_or(columns, |pair| pair.0)
        };
        let count = columns.split(',').count();
        let rows = self.rows.iter();
        output.table(
            history,
            columns,
            rows.map(|row| row.map(number).into_iter().take(count)),
        )?;
        let panel = self.profiles.draw(
            Panel::new("slip [m]", "depth [km]").downward(),
            ["every 5 years", "every second of events"],
            |depth, slip| Some((slip, depth)),
        );
        plot::draw(&output.path(slip), &[panel][..])?;
        let panel = Panel::new("time [years]", "log10 of the largest slip rate [m/s]");
        let panel = panel.with("", DARK, 3, self.largest.clone());
        plot::draw(&output.path(rate), &[panel][..])?;
        pictures::lines(&output.path(map), &[("depth [km]", &self.rates)])
    }
}
