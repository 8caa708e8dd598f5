//! The classical Runge-Kutta method in `ln(V/V0)` and `theta`, with small steps.

use stickslip_lab::{LoadHistory, Parameters, StateParameters};

/// A state in sliding.
pub(crate) struct At {
    /// The slip rate \[m/s\].
    v: f64,
    /// `theta` \[s\].
    theta: f64,
    state: StateParameters,
    /// The rate of friction [1/s].
    stress_rate: f64,
}

/// The state law: `theta'`.
pub(crate) type Rate = fn(&At) -> f64;

pub(crate) fn aging(at: &At) -> f64 {
    1.0 - at.v * at.theta / at.state.slip_distance
}

pub(crate) fn slip(at: &At) -> f64 {
    let x = at.v * at.theta / at.state.slip_distance;
    -x * x.ln()
}

/// Of half the `theta` of the law, which is compared with `L`.
pub(crate) fn perrin_rice_zheng(at: &At) -> f64 {
    0.5 * (1.0 - (at.v * at.theta / at.state.slip_distance).powi(2))
}

pub(crate) fn kato_tullis(at: &At) -> f64 {
    (-at.v / at.state.aging_velocity).exp() + slip(at)
}

pub(crate) fn nagata(at: &At) -> f64 {
    aging(at) - at.state.stress_weight / at.state.b * at.theta * at.stress_rate
}

/// `theta` of steady sliding, between a hundredth and a hundred times `L/V`.
fn steady(rate: Rate, v: f64, state: StateParameters) -> f64 {
    let (mut low, mut high) = (-5.0_f64, 5.0_f64);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        let theta = middle.exp() * state.slip_distance / v;
        let at = At {
            v,
            theta,
            state,
            stress_rate: 0.0,
        };
        if rate(&at) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    low.exp() * state.slip_distance / v
}

/// `w'` and `theta_i'` with `w = ln(V/V0)`, from `a w' + sum b_i theta_i'/theta_i = k (V_lp - V)`.
fn slope(parameters: &Parameters, rates: &[Rate], load: f64, y: &[f64]) -> Vec<f64> {
    let v = parameters.reference_velocity * y[0].exp();
    let stress_rate = parameters.stiffness * (load - v);
    let mut f = vec![stress_rate];
    for (i, &state) in parameters.states.iter().enumerate() {
        let theta = y[i + 1];
        let rate = rates[i](&At {
            v,
            theta,
            state,
            stress_rate,
        });
        f[0] -= state.b * rate / theta;
        f.push(rate);
    }
    f[0] /= parameters.a;
    f
}

/// Friction at the times, with steps by which no unknown of a linearised step changes by more than `relative`.
pub(crate) fn friction(
    parameters: &Parameters,
    rates: &[Rate],
    load: &LoadHistory,
    times: &[f64],
    relative: f64,
) -> Vec<f64> {
    let v0 = parameters.reference_velocity;
    let mu = |y: &[f64]| {
        let states = parameters.states.iter().zip(&y[1..]);
        let terms = states.map(|(s, theta)| s.b * (v0 * theta / s.slip_distance).ln());
        parameters.reference_friction + parameters.a * y[0] + terms.sum::<f64>()
    };
    // Just before the first sample: a history that changes there has not changed yet.
    let before = load.velocity(times[0] - 1e-6);
    let mut y = vec![(before / v0).ln()];
    let states = parameters.states.iter().zip(rates);
    y.extend(states.map(|(state, rate)| state.initial_state.exp() * steady(*rate, before, *state)));
    let mut found = vec![mu(&y)];
    for pair in times.windows(2) {
        let mut t = pair[0];
        while t < pair[1] {
            // A sample lies at every change of the load.
            let velocity = load.velocity(0.5 * (pair[0] + pair[1]));
            let v = v0 * y[0].exp();
            let mut fastest = parameters.stiffness * v.max(velocity) / parameters.a;
            for (state, theta) in parameters.states.iter().zip(&y[1..]) {
                let weakening = state.stress_weight / state.b * parameters.stiffness;
                fastest = fastest.max(v / state.slip_distance).max(1.0 / theta);
                fastest = fastest.max(weakening * v.max(velocity));
            }
            let h = (relative / fastest).min(pair[1] - t);
            let moved = |k: &[f64], h: f64| -> Vec<f64> {
                y.iter().zip(k).map(|(y, k)| y + h * k).collect()
            };
            let f = |y: &[f64]| slope(parameters, rates, velocity, y);
            let k1 = f(&y);
            let k2 = f(&moved(&k1, 0.5 * h));
            let k3 = f(&moved(&k2, 0.5 * h));
            let k4 = f(&moved(&k3, h));
            let mean: Vec<f64> = (0..y.len())
                .map(|i| (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]) / 6.0)
                .collect();
            y = moved(&mean, h);
            t = if t + h >= pair[1] { pair[1] } else { t + h };
        }
        found.push(mu(&y));
    }
    found
}
