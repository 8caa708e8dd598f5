//! Sources that do not depend on the field.

use std::f64::consts::TAU;

use stickslip_fields::{FaultField, Reading, ThermalPressurization};

use super::zones::{COEFFICIENT, Point, fluid, heated, zone};

/// The temperature after a pulse falls as `1/sqrt(2 pi (w^2 + 2 alpha t))`: to 2e-6 of its peak with 24 modes up to
/// `2 alpha t/w^2 = 1e5`, and to 1e-4 with fewer modes for shorter times, or more for longer ones.
#[test]
fn a_pulse_spreads_as_a_gaussian() {
    for (modes, until, bound) in [
        (14, 1e2, 1e-4),
        (19, 1e4, 1e-4),
        (24, 1e5, 2e-6),
        (24, 1e12, 4e-4),
        (28, 1e12, 1e-4),
        (42, 1e10, 2e-6),
    ] {
        let (half_width, diffusivity) = (0.01, 1e-6);
        let unit: f64 = half_width * half_width / (2.0 * diffusivity);
        let pulse = 1e-9 * unit;
        let mut begin = heated(half_width, diffusivity, modes);
        begin.advance([1.0 / pulse; 2], pulse);
        let peak = 1.0 / (half_width * TAU.sqrt());
        for decade in -30..=120 {
            let time = 10_f64.powf(0.1 * f64::from(decade));
            if time > until {
                break;
            }
            let mut point = heated(half_width, diffusivity, modes);
            point.memory.clone_from(&begin.memory);
            point.advance([0.0; 2], time * unit);
            let error = point.heating() / peak - 1.0 / (1.0 + time).sqrt();
            // Of reading a rise of 40 K beside 483 K.
            assert!(error.abs() < bound + 1e-12, "{modes} {time:e} {error:e}");
        }
    }
}

/// With constant heat the temperature grows as `sqrt(1 + 2 alpha t/w^2) - 1`, and the pressure by the difference of two such
/// roots; nearly equal and equal diffusivities are their limit, `t/sqrt(1 + 2 alpha t/w^2)`.
#[test]
fn constant_heat_has_roots_of_time() {
    let (half_width, heat): (f64, f64) = (0.02, 11.0);
    let square = half_width * half_width;
    let peak = 1.0 / (half_width * TAU.sqrt());
    for (thermal, hydraulic) in [
        (1e-6, 4e-4),
        (1e-6, 1e-7),
        (1e-6, 1.5e-6),
        (1e-6, 1e-6 * (1.0 + 1e-5)),
        (1e-6, 1e-6 * (1.0 + 1e-9)),
        (1e-6, 1e-6 * (1.0 - 1e-12)),
        (1e-6, 1e-6),
        (1e-6, 0.0),
        (0.0, 1e-6),
        (0.0, 0.0),
    ] {
        let field = ThermalPressurization::new(1, zone(half_width, thermal), fluid(hydraulic));
        let mut point = Point::new(field.expect("the parameters are legal"));
        let mut time = 0.0;
        for dt in [1e-6, 1e-3, 1.0, 60.0, 1e3] {
            point.advance([heat; 2], dt);
            time += dt;
            let root = |alpha: f64| (2.0 * alpha * time / square + 1.0).sqrt();
            // (root(a) - root(b)) square/(a - b), as a quotient without cancellation.
            let mean = 2.0 * time / (root(thermal) + root(hydraulic));
            let pressure = COEFFICIENT * heat * peak * mean;
            let error = point.pressure() / pressure - 1.0;
            assert!(
                error.abs() < 1e-5,
                "{thermal:e} {hydraulic:e} {dt:e}: {error:e}"
            );
            let heating = heat * peak * 2.0 * time / (root(thermal) + 1.0);
            assert!(
                (point.heating() / heating - 1.0).abs() < 3e-6,
                "{thermal:e} {dt:e}"
            );
        }
    }
}

/// The temperature is the only reading.
#[test]
fn the_temperature_is_read() {
    let reading = Reading {
        name: "temperature",
        unit: "K",
    };
    assert_eq!(heated(0.01, 1e-6, 24).field.readings(), [reading]);
    let field = ThermalPressurization::new(1, zone(0.01, 1e-6), fluid(1e-4));
    assert_eq!(
        field.map(|field| field.readings().to_vec()),
        Ok(vec![reading])
    );
}
