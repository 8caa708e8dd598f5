//! Fields that keep the contract in ways of their own.

use stickslip_fields::{
    FaultField, FaultRates, FieldError, FieldSizes, GivenPressure, check_fault_field,
};

/// A pressure in closed form holds the time, in which it is not linear.
#[test]
fn given_pressures_keep_it() {
    let given = GivenPressure::new(3, 1e8, |time, pressure: &mut [f64]| {
        for (k, pressure) in pressure.iter_mut().enumerate() {
            *pressure += 1e6 * ((k + 1) as f64 * 1e-9 * time).sin();
        }
    });
    assert_eq!(check_fault_field(&given), Ok(()));
}

/// Slip feeds a damage zone, from which the fluid reaches the fault later: `y' = s - y/t`, `p' = (y - p)/t`. Its pressure
/// grows for a while after a pulse; a well adds to it all the time, and the memory holds what it has injected.
struct Delayed {
    well: f64,
}

/// The drainage time of both \[s\].
const TIME: f64 = 1e5;

impl FaultField for Delayed {
    fn sizes(&self) -> FieldSizes {
        FieldSizes {
            vertices: 1,
            memory: vec![0.0; 3],
            sources: 1,
        }
    }

    fn source(&self, at: &FaultRates<'_>, _memory: &[f64], source: &mut [f64]) {
        source[0] = 1e-3 * at.slip_rate[0] * at.friction[0];
    }

    fn advance(
        &self,
        from: &[f64],
        [begin, end]: [&[f64]; 2],
        dt: f64,
        to: &mut [f64],
    ) -> Result<(), FieldError> {
        let z = dt / TIME;
        let decay = (-z).exp();
        let [m0, m1, m2, m3] = moments(z);
        let [s0, ds] = [begin[0] + self.well, end[0] - begin[0]];
        to[0] = decay * from[0] + dt * (m0 * s0 + m1 * ds);
        to[1] = decay * (from[1] + z * from[0]) + dt * (m2 * s0 + m3 * ds);
        to[2] = from[2] + self.well * dt;
        Ok(())
    }

    fn pressure(&self, memory: &[f64], pressure: &mut [f64]) {
        pressure[0] += memory[1];
    }
}

/// `int_0^1 exp(-z x) [1, 1 - x, z x, z x (1 - x)] dx`.
fn moments(z: f64) -> [f64; 4] {
    if z < 2.0 {
        // Term by term: int x^n dx = 1/(n + 1), int x^n (1 - x) dx = 1/((n + 1) (n + 2)).
        let (mut moments, mut term) = ([0.0; 4], 1.0);
        for n in (0..40).map(f64::from) {
            moments[0] += term / (n + 1.0);
            moments[1] += term / ((n + 1.0) * (n + 2.0));
            moments[2] += term * z / (n + 2.0);
            moments[3] += term * z / ((n + 2.0) * (n + 3.0));
            term *= -z / (n + 1.0);
        }
        return moments;
    }
    let e = (-z).exp();
    let first = (1.0 - e) / z;
    let second = (1.0 - e - z * e) / (z * z);
    let third = (2.0 - e * (2.0 + 2.0 * z + z * z)) / (z * z * z);
    [first, first - second, z * second, z * (second - third)]
}

#[test]
fn delayed_pressures_and_wells_keep_it() {
    for well in [0.0, 3.0] {
        assert_eq!(check_fault_field(&Delayed { well }), Ok(()));
    }
}

/// Diffusion along cells between sealed ends, `p' = A p + s`, by TR-BDF2, with an error.
struct Line;

const CELLS: usize = 12;

/// The diffusivity over the square of a cell's length [1/s].
const RATE: f64 = 1e-3;

/// `A p`.
fn exchange(p: &[f64]) -> [f64; CELLS] {
    std::array::from_fn(|k| {
        let left = if k > 0 { p[k - 1] - p[k] } else { 0.0 };
        let right = if k + 1 < CELLS { p[k + 1] - p[k] } else { 0.0 };
        RATE * (left + right)
    })
}

/// Solves `(1 - q A) x = b`.
fn solve(q: f64, b: [f64; CELLS]) -> [f64; CELLS] {
    let off = -q * RATE;
    let neighbours = |k| if k == 0 || k + 1 == CELLS { 1.0 } else { 2.0 };
    let (mut pivots, mut x) = ([1.0 - off; CELLS], b);
    for k in 1..CELLS {
        let factor = off / pivots[k - 1];
        pivots[k] = 1.0 - off * neighbours(k) - factor * off;
        x[k] -= factor * x[k - 1];
    }
    x[CELLS - 1] /= pivots[CELLS - 1];
    for k in (0..CELLS - 1).rev() {
        x[k] = (x[k] - off * x[k + 1]) / pivots[k];
    }
    x
}

impl FaultField for Line {
    fn sizes(&self) -> FieldSizes {
        FieldSizes {
            vertices: CELLS,
            memory: vec![1e5; CELLS],
            sources: CELLS,
        }
    }

    fn source(&self, at: &FaultRates<'_>, _memory: &[f64], source: &mut [f64]) {
        for k in 0..CELLS {
            source[k] = 1e-4 * at.slip_rate[k] * at.friction[k];
        }
    }

    fn advance(
        &self,
        from: &[f64],
        [s0, s1]: [&[f64]; 2],
        dt: f64,
        to: &mut [f64],
    ) -> Result<(), FieldError> {
        let g = 2.0 - std::f64::consts::SQRT_2;
        let q = 0.5 * g * dt;
        let flow = exchange(from);
        let middle = solve(
            q,
            std::array::from_fn(|k| q * (2.0 * (flow[k] + s0[k]) + g * (s1[k] - s0[k]))),
        );
        let end = solve(
            q,
            std::array::from_fn(|k| middle[k] / (g * (2.0 - g)) + q * (flow[k] + s1[k])),
        );
        for k in 0..CELLS {
            to[k] = from[k] + end[k];
        }
        Ok(())
    }

    fn pressure(&self, memory: &[f64], pressure: &mut [f64]) {
        for (pressure, memory) in pressure.iter_mut().zip(memory) {
            *pressure += memory;
        }
    }

    fn error(
        &self,
        from: &[f64],
        _source: [&[f64]; 2],
        _dt: f64,
        to: &[f64],
        pressure_error: &mut [f64],
    ) {
        for k in 0..CELLS {
            pressure_error[k] += 1e-3 * (to[k] - from[k]);
        }
    }
}

#[test]
fn diffusion_of_second_order_keeps_it() {
    assert_eq!(check_fault_field(&Line), Ok(()));
}
