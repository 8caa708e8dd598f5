//! Laws of vertices one after the other: the loops of laws that bring none for many vertices.

use super::contact_laws::ContactLaws;

#[inline]
pub(super) fn slip_rates<L: ContactLaws + ?Sized>(
    laws: &L,
    first: usize,
    [viscosity, drive, states]: [&[f64]; 3],
    slip_rates: &mut [f64],
) {
    for (i, rate) in slip_rates.iter_mut().enumerate() {
        *rate = laws.slip_rate(first + i, viscosity[i], drive[i], states[i]);
    }
}

#[inline]
pub(super) fn slopes<L: ContactLaws + ?Sized>(
    laws: &L,
    first: usize,
    [slip_rates, states]: [&[f64]; 2],
    [by_rate, by_state]: [&mut [f64]; 2],
) {
    for i in 0..slip_rates.len() {
        let response = laws.response(first + i, slip_rates[i], states[i]);
        (by_rate[i], by_state[i]) = (response.rate_slope, response.state_slope);
    }
}

#[inline]
pub(super) fn evolutions<L: ContactLaws + ?Sized>(
    laws: &L,
    first: usize,
    [slip_rates, states]: [&[f64]; 2],
    rates: &mut [f64],
) {
    for (i, rate) in rates.iter_mut().enumerate() {
        *rate = laws.evolution(first + i, slip_rates[i], states[i]);
    }
}
