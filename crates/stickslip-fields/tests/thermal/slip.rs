//! Slip at a constant rate with constant friction: heat follows the pressure, `s = f (sigma - p) V/(rho c)`.

use std::f64::consts::TAU;

use stickslip_fields::ThermalPressurization;

use super::zones::{COEFFICIENT, HEAT_CAPACITY, Point, fluid, zone};

const FRICTION: f64 = 0.6;
/// The initial effective normal stress \[Pa\].
const STRESS: f64 = 45e6;
/// The slip rate [m/s].
const RATE: f64 = 1.0;

/// A fault that slips at a constant rate.
struct Slip {
    point: Point<ThermalPressurization>,
    time: f64,
    pressure: f64,
}

impl Slip {
    fn new([half_width, thermal, hydraulic]: [f64; 3], modes: usize) -> Self {
        let field = ThermalPressurization::new(1, zone(half_width, thermal), fluid(hydraulic));
        let field = field.and_then(|field| field.with_modes(modes));
        Self {
            point: Point::new(field.expect("the parameters are legal")),
            time: 0.0,
            pressure: 0.0,
        }
    }

    fn source(pressure: f64) -> f64 {
        FRICTION * (STRESS - pressure) * RATE / HEAT_CAPACITY
    }

    /// A step with a source that is linear in time and right at its end: the pressure there is affine in it.
    fn step(&mut self, dt: f64) {
        let begin = Self::source(self.pressure);
        let [without, unit] = [0.0, 1.0].map(|end| self.point.pressure_after([begin, end], dt));
        let per_source = unit - without;
        let feedback = FRICTION * RATE / HEAT_CAPACITY * per_source;
        let end = Self::source(without) / (1.0 + feedback);
        self.point.advance([begin, end], dt);
        self.pressure = self.point.pressure();
        self.time += dt;
    }

    /// Steps in proportion to the time, from the least on.
    fn until(&mut self, time: f64, (least, relative): (f64, f64)) {
        while self.time < time {
            let dt = (relative * self.time).max(least);
            let left = time - self.time;
            self.step(if dt > 0.75 * left { left } else { dt });
        }
    }

    /// The strength in units of the initial one.
    fn strength(&self) -> f64 {
        1.0 - self.pressure / STRESS
    }
}

/// Rice (J. Geophys. Res. 111, B05311, 2006), slip on a plane: `exp(x) erfc(sqrt x)` with `x = D/L*`,
/// `L* = 4 (rho c)^2 (sqrt(alpha_hy) + sqrt(alpha_th))^2/(f^2 Lambda^2 V)`, at a half width of 1e-5 m.
#[test]
fn slip_on_a_plane_weakens_as_by_rice() {
    let [thermal, hydraulic]: [f64; 2] = [1e-6, 4e-4];
    let ratio = HEAT_CAPACITY * (hydraulic.sqrt() + thermal.sqrt()) / (FRICTION * COEFFICIENT);
    let length = 4.0 * ratio * ratio / RATE;
    assert!((length - 3.5721).abs() < 1e-12, "{length}");
    let mut slip = Slip::new([1e-5, thermal, hydraulic], 42);
    for (x, strength) in [
        (0.01, 0.896456980),
        (0.1, 0.723578438),
        (0.5, 0.523156584),
        (1.0, 0.427583576),
        (2.0, 0.336204002),
        (5.0, 0.232326294),
        (10.0, 0.170577718),
    ] {
        slip.until(x * length / RATE, (1e-11, 0.01));
        let error = slip.strength() / strength - 1.0;
        assert!(error.abs() < 1e-4, "{x} {error:e}");
    }
}

/// A Gaussian layer of half width 2 cm (TPV105): strengths and temperatures by the Volterra equation of the layer, to nine
/// digits, and on a dense grid across it.
#[test]
fn slip_in_a_layer_weakens_and_heats() {
    let mut slip = Slip::new([0.02, 1e-6, 4e-4], 24);
    for (distance, strength, heating) in [
        (0.01, 0.995599052, 1.990287),
        (0.1, 0.958605804, 19.522483),
        (0.5, 0.833990862, 90.630127),
        (1.0, 0.730106729, 168.130054),
        (2.0, 0.601120978, 299.115080),
        (5.0, 0.425495713, 594.184815),
    ] {
        slip.until(distance / RATE, (1e-5, 2e-3));
        let errors = [
            slip.strength() / strength - 1.0,
            slip.point.heating() / heating - 1.0,
        ];
        assert!(
            errors.iter().all(|error| error.abs() < 1e-5),
            "{distance} {errors:?}"
        );
    }
}

/// Without diffusion strength falls exponentially with slip, `exp(-f Lambda D/(rho c h))`, `h = sqrt(2 pi) w`. Steps of second
/// order are extrapolated.
#[test]
fn undrained_adiabatic_slip_weakens_exponentially() {
    for half_width in [1e-4, 0.005, 0.02] {
        let thickness = TAU.sqrt() * half_width;
        let distance = HEAT_CAPACITY * thickness / (FRICTION * COEFFICIENT);
        let strength = |steps: u32| {
            let mut slip = Slip::new([half_width, 0.0, 0.0], 24);
            for _ in 0..steps {
                slip.step(distance / RATE / f64::from(steps));
            }
            slip.strength()
        };
        let [coarse, fine] = [200, 400].map(strength);
        let found = fine + (fine - coarse) / 3.0;
        assert!(
            (found * 1_f64.exp() - 1.0).abs() < 1e-8,
            "{half_width} {found}"
        );
    }
}

/// With a source that is constant in the step, and right at its end, the strength stays between 0 and the initial one at any
/// step, to the digits that are left where diffusivities are equal.
#[test]
fn pressure_that_friction_feeds_stays_below_the_normal_stress() {
    for dt in (-9..=15).map(|decade| 10_f64.powi(decade)) {
        for zone in [[0.02, 1e-6, 4e-4], [1e-5, 1e-6, 1e-6], [0.1, 0.0, 0.0]] {
            let unit = Slip::new(zone, 24).point.pressure_after([1.0; 2], dt);
            let strength = 1.0 / (1.0 + FRICTION * RATE / HEAT_CAPACITY * unit);
            assert!(
                strength > 0.0 && strength <= 1.0 + 1e-6,
                "{dt:e} {strength}"
            );
        }
    }
}
