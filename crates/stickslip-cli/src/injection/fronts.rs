//! Fronts of pore pressure and slip.

use stickslip::ContactView;

use super::Output;
use super::fault::Grid;

/// The fronts at a time, and the largest values.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fronts {
    /// \[s\]
    pub(super) time: f64,
    /// The radius, or half the length, of the cells with more than a share of the largest pore pressure, and of the
    /// largest slip beyond that at the initial slip rate \[m\]; 0 if that is 0.
    pub(super) radii: [f64; 2],
    /// The largest pore pressure \[Pa\], slip \[m\] and slip rate [m/s].
    pub(super) largest: [f64; 3],
    /// The injected volume [m^3, on a line m^2].
    pub(super) volume: f64,
}

impl Fronts {
    pub(super) fn new(
        grid: &Grid,
        output: &Output,
        (time, creep): (f64, f64),
        contact: &ContactView<'_, 1>,
    ) -> Self {
        let extent = |share: f64, value: &dyn Fn(usize) -> f64| {
            let values = || (0..contact.len()).map(value);
            let largest = values().fold(0.0, f64::max);
            let inside = values().filter(|&own| largest > 0.0 && own > share * largest);
            (grid.radius(inside.count()), largest)
        };
        let (pressure, highest) = extent(output.pressure_share, &|k| contact.pore_pressure(k));
        // The whole fault creeps before the pressure arrives.
        let (slip, _) = extent(output.slip_share, &|k| contact.slip(k) - creep * time);
        let farthest = (0..contact.len()).map(|k| contact.slip(k));
        let totals = contact.totals();
        let volume = totals
            .iter()
            .find(|(total, _)| total.name == "injected_volume");
        Self {
            time,
            radii: [pressure, slip],
            largest: [
                highest,
                farthest.fold(0.0, f64::max),
                contact.max_slip_rate(),
            ],
            volume: volume.map_or(f64::NAN, |(_, volume)| *volume),
        }
    }
}
