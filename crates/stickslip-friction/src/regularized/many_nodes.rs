//! Regularised friction of many nodes, several of them per instruction.

use stickslip_core::lanes::elementary::{exp, ln};
use stickslip_core::lanes::{LANES, Numbers, Parameter, Pass, load, run};
use stickslip_state::{LogTheta, StateVariable};

use super::balance::balance;
use crate::{FrictionLaw, RegularizedDieterichRuina, SlipRates};

/// The laws of the nodes, or one of all.
///
/// With `s = mu/a` the local problem is
/// ```text
/// s + c sinh(s) = t,   t = drive/a,   ln(c/2) = ln(viscosity) - offset - (b/a) alpha,   V = (a/viscosity) c sinh(s)
/// ```
///
/// with `offset = (mu0 + b ln(V0/L))/a - ln(V0/a)`. It has one solution, found by a guess and two steps of third order,
/// without a branch. The error of `ln V` is that of two roundings of `t` and one of `ln c`, `1.1e-16 (t + abs(ln(c/2)))`, for
/// `s > 3`, and below 1e-13 elsewhere.
pub(super) struct ManyNodes {
    laws: Vec<RegularizedDieterichRuina>,
    a: Parameter,
    per_a: Parameter,
    b: Parameter,
    offset: Parameter,
    /// `b/a`.
    slope: Parameter,
    /// `ln Vm` at `alpha = 0`.
    ln_cutoff: Parameter,
}

impl ManyNodes {
    pub(super) fn new(laws: &[RegularizedDieterichRuina]) -> Self {
        let of =
            |value: fn(&RegularizedDieterichRuina) -> f64| Parameter::new(laws.iter().map(value));
        Self {
            a: of(|law| law.a),
            per_a: of(|law| law.a.recip()),
            b: of(|law| law.b),
            offset: of(|law| {
                let at_zero = law.cut_off().coefficient_at_reference(LogTheta(0.0));
                at_zero / law.a - (law.reference_velocity.ln() - law.a.ln())
            }),
            slope: of(|law| law.b / law.a),
            ln_cutoff: of(|law| law.ln_cutoff_rate(LogTheta(0.0))),
            laws: laws.to_vec(),
        }
    }
}

struct Problems<'a, S> {
    of: &'a ManyNodes,
    /// The number of the first node.
    first: usize,
    viscosity: &'a [f64],
    drive: &'a [f64],
    states: &'a [S],
    slip_rates: &'a mut [f64],
    /// Whether a number was not normal, `c sinh(s)` included: the rate is NaN, and the node is to be computed by itself.
    has_others: &'a mut bool,
}

/// Whether a node is one of the pass: `y = c sinh(s)` below the normal numbers has lost digits that its rate has.
#[inline(always)]
fn is_normal(viscosity: f64, drive: f64, y: f64, slip_rate: f64) -> bool {
    (f64::MIN_POSITIVE..=f64::MAX).contains(&viscosity)
        & (drive <= f64::MAX)
        & ((y >= f64::MIN_POSITIVE) | (drive == 0.0))
        & (slip_rate <= f64::MAX)
}

impl<S: StateVariable> Pass for Problems<'_, S> {
    #[inline(always)]
    fn block(&mut self, at: usize, count: usize) {
        let first = self.first + at;
        let mut spare = [None; 6];
        let [of_a, per_a, of_offset, of_slope, of_viscosity, of_drive] = &mut spare;
        let a = self.of.a.load(first, of_a);
        let per_a = self.of.per_a.load(first, per_a);
        let offset = self.of.offset.load(first, of_offset);
        let slope = self.of.slope.load(first, of_slope);
        let viscosity = load(&self.viscosity[at..], of_viscosity);
        let drive = load(&self.drive[at..], of_drive);
        let (mut t, mut l) = ([0.0; LANES], [0.0; LANES]);
        for k in 0..LANES {
            t[k] = drive[k] * per_a[k];
            l[k] = ln(viscosity[k]) - offset[k];
        }
        let states = self.states[at..at + count].iter().zip(slope);
        for (l, (state, slope)) in l.iter_mut().zip(states) {
            *l -= slope * state.value();
        }
        let mut rates = balance(&t, &l);
        let mut all = true;
        for k in 0..LANES {
            let y = rates[k];
            let rate = y * (a[k] / viscosity[k]);
            let normal = is_normal(viscosity[k], drive[k], y, rate);
            rates[k] = if normal { rate } else { f64::NAN };
            all &= normal;
        }
        *self.has_others |= !all;
        self.slip_rates[at..at + count].copy_from_slice(&rates[..count]);
    }
}

struct Slopes<'a, S> {
    of: &'a ManyNodes,
    first: usize,
    slip_rates: &'a [f64],
    states: &'a [S],
    by_rate: &'a mut [f64],
    by_state: &'a mut [f64],
}

impl<S: StateVariable> Pass for Slopes<'_, S> {
    /// `a tanh(s)/V` and `b tanh(s)`, with `sinh(s) = V/(2 Vm)`.
    #[inline(always)]
    fn block(&mut self, at: usize, count: usize) {
        /// The `ln(V/Vm)` from which on `tanh(s)` is 1.
        const SLIDING: f64 = 40.0;
        let first = self.first + at;
        let mut spare = [None; 5];
        let [of_a, of_b, of_slope, of_cutoff, of_rates] = &mut spare;
        let a = self.of.a.load(first, of_a);
        let b = self.of.b.load(first, of_b);
        let slope = self.of.slope.load(first, of_slope);
        let ln_cutoff = self.of.ln_cutoff.load(first, of_cutoff);
        let rates = load(&self.slip_rates[at..], of_rates);
        let alpha = values(&self.states[at..at + count]);
        let (mut by_rate, mut by_state) = ([0.0; LANES], [0.0; LANES]);
        for k in 0..LANES {
            let excess = ln(rates[k]) - ln_cutoff[k] + slope[k] * alpha[k];
            let sinh = 0.5 * exp(if excess > SLIDING { SLIDING } else { excess });
            let tanh = sinh / (1.0 + sinh * sinh).sqrt();
            by_rate[k] = a[k] * tanh / rates[k];
            by_state[k] = b[k] * tanh;
        }
        self.by_rate[at..at + count].copy_from_slice(&by_rate[..count]);
        self.by_state[at..at + count].copy_from_slice(&by_state[..count]);
    }
}

#[inline(always)]
fn values<S: StateVariable>(states: &[S]) -> Numbers {
    let mut values = [0.0; LANES];
    for (value, state) in values.iter_mut().zip(states) {
        *value = state.value();
    }
    values
}

/// For the state of these laws, and for the state in units of friction.
impl<S: StateVariable> SlipRates<S> for ManyNodes {
    fn slip_rates(
        &self,
        first: usize,
        [viscosity, drive]: [&[f64]; 2],
        states: &[S],
        slip_rates: &mut [f64],
    ) {
        let mut has_others = false;
        let pass = Problems {
            of: self,
            first,
            viscosity,
            drive,
            states,
            slip_rates,
            has_others: &mut has_others,
        };
        run(states.len(), pass);
        let nodes = viscosity.iter().zip(drive).zip(states).enumerate();
        for (k, ((&viscosity, &drive), &state)) in nodes.filter(|_| has_others) {
            if slip_rates[k].is_nan() {
                let law = self.laws.get(first + k).unwrap_or(&self.laws[0]);
                slip_rates[k] = law.slip_rate(viscosity, drive, LogTheta(state.value()));
            }
        }
    }

    fn slopes(
        &self,
        first: usize,
        slip_rates: &[f64],
        states: &[S],
        [by_rate, by_state]: [&mut [f64]; 2],
    ) {
        let pass = Slopes {
            of: self,
            first,
            slip_rates,
            states,
            by_rate,
            by_state,
        };
        run(states.len(), pass);
    }
}
