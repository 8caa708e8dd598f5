//! The classical Runge-Kutta method in `ln(V/V0)` and `theta`, with small steps.

use stickslip_lab::{LoadHistory, Parameters};

/// The state law: `theta'` as a function of `V` \[m/s\], `theta` \[s\] and `L` \[m\].
pub(crate) type Rate = fn(f64, f64, f64) -> f64;

pub(crate) fn aging(v: f64, theta: f64, l: f64) -> f64 {
    1.0 - v * theta / l
}

pub(crate) fn slip(v: f64, theta: f64, l: f64) -> f64 {
    let x = v * theta / l;
    -x * x.ln()
}

/// `w'` and `theta_i'` with `w = ln(V/V0)`, from `a w' + sum b_i theta_i'/theta_i = k (V_lp - V)`.
fn slope(parameters: &Parameters, rates: &[Rate], load: f64, y: &[f64]) -> Vec<f64> {
    let v = parameters.reference_velocity * y[0].exp();
    let mut f = vec![parameters.stiffness * (load - v)];
    for (i, state) in parameters.states.iter().enumerate() {
        let rate = rates[i](v, y[i + 1], state.slip_distance);
        f[0] -= state.b * rate / y[i + 1];
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
    y.extend(
        parameters
            .states
            .iter()
            .map(|state| state.slip_distance / before),
    );
    let mut found = vec![mu(&y)];
    for pair in times.windows(2) {
        let mut t = pair[0];
        while t < pair[1] {
            // A sample lies at every change of the load.
            let velocity = load.velocity(0.5 * (pair[0] + pair[1]));
            let v = v0 * y[0].exp();
            let mut fastest = parameters.stiffness * v.max(velocity) / parameters.a;
            for (state, theta) in parameters.states.iter().zip(&y[1..]) {
                fastest = fastest.max(v / state.slip_distance).max(1.0 / theta);
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
