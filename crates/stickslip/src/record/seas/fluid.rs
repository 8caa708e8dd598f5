//! Pore pressure and Darcy velocity at a station.

use super::SeasPoint;
use super::place::Place;
use crate::ContactView;

/// A pascal in megapascals.
const MPA: f64 = 1e-6;

/// The pore pressure \[MPa\], and the Darcy velocity along a line, or along strike and down dip [m/s]; no number for a
/// velocity that no field of the contact shows.
pub(super) fn fluid<const C: usize>(
    contact: &ContactView<'_, C>,
    (point, place): (SeasPoint, &Place),
) -> Vec<f64> {
    let directions: &[&str] = match point {
        SeasPoint::Line(_) => &["darcy_velocity"],
        SeasPoint::Plane(_) => &["darcy_velocity_along_strike", "darcy_velocity_down_dip"],
    };
    let pressure = MPA * place.mean(|k| contact.pore_pressure(k));
    let velocities = directions.iter().map(|name| {
        let values = contact.reading(name);
        values.map_or(f64::NAN, |values| place.mean(|k| values[k]))
    });
    [pressure].into_iter().chain(velocities).collect()
}
