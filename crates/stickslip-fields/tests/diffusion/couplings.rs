//! Leak-off, dilatancy and permeability that evolves.

use stickslip_fields::{
    Diffusion, Dilatancy, FaultField, FaultRates, LeakOff, Line, PermeabilityEvolution,
};

use crate::march::{March, zone};

fn field(permeability: f64) -> Diffusion {
    Diffusion::new(
        Line::uniform([0.0, 30.0], 3).expect("line"),
        &zone(permeability),
    )
    .expect("field")
}

#[test]
fn leak_off_decays_exponentially() {
    let errors = [20_u32, 40, 80].map(|steps| {
        let leak = LeakOff {
            drainage_time: 1e4.into(),
            far_pressure: 2e6.into(),
        };
        let field = field(1e-13).with_leak_off(&leak).expect("leak-off");
        let mut march = March::new(&field);
        (0..steps).for_each(|_| march.step(2e4 / f64::from(steps)));
        let exact = 2e6 * -(-2.0_f64).exp_m1();
        let stored = march.total("stored_volume");
        assert!((march.total("leaked_volume") / stored + 1.0).abs() < 1e-14);
        march
            .pressure()
            .iter()
            .map(|p| (p / exact - 1.0).abs())
            .fold(0.0, f64::max)
    });
    assert!(errors[2] < 1e-4, "{errors:?}");
    assert!(
        errors
            .windows(2)
            .all(|pair| (pair[0] / pair[1]).log2() > 1.95),
        "{errors:?}"
    );
}

/// At constant `V` the porosity tends to `eps ln(V/V_0)` over `L/V`; pressure falls by its change over the storage.
#[test]
fn dilatancy_tends_to_its_steady_state() {
    let dilatancy = Dilatancy {
        coefficient: 1e-4,
        reference_velocity: 1e-9,
        slip_distance: 1e-2,
        initial_change: 0.0,
    };
    let errors = [50_u32, 100].map(|steps| {
        let field = field(1e-13).with_dilatancy(dilatancy).expect("dilatancy");
        let (rates, end) = ([1e-6; 3], 1.5e4);
        let sizes = field.sizes();
        let (mut memory, mut next) = (sizes.memory.clone(), sizes.memory);
        let mut source = [vec![0.0; 3], vec![0.0; 3]];
        let at = FaultRates {
            time: 0.0,
            slip_rate: &rates,
            friction: &[0.0; 3],
            state_rate: &[0.0; 3],
            normal_stress: &[0.0; 3],
        };
        for _ in 0..steps {
            let dt = end / f64::from(steps);
            // Heun's method for the porosity.
            field.source(&at, &memory, &mut source[0]);
            field
                .advance(&memory, [&source[0], &source[0]], dt, &mut next)
                .expect("advances");
            field.source(&at, &next, &mut source[1]);
            field
                .advance(&memory, [&source[0], &source[1]], dt, &mut next)
                .expect("advances");
            std::mem::swap(&mut memory, &mut next);
        }
        let exact = 1e-4 * 1e3_f64.ln() * -(-1.5_f64).exp_m1();
        let (mut porosity, mut pressure) = (vec![0.0; 3], vec![0.0; 3]);
        field.read(2, &memory, &mut porosity);
        field.pressure(&memory, &mut pressure);
        for (pressure, porosity) in pressure.iter().zip(&porosity) {
            assert!(
                (pressure / (-porosity / 1e-9) - 1.0).abs() < 1e-12,
                "{pressure:e}"
            );
        }
        (porosity[0] / exact - 1.0).abs()
    });
    assert!(
        errors[1] < 1e-4 && (errors[0] / errors[1]).log2() > 1.9,
        "{errors:?}"
    );
}

#[test]
fn permeability_is_exact_at_constant_slip_rates() {
    let evolution = PermeabilityEvolution {
        minimum: 1e-15.into(),
        maximum: 1e-12.into(),
        slip_distance: 0.5.into(),
        healing_time: 1e7.into(),
    };
    let field = field(1e-14)
        .with_permeability_evolution(&evolution)
        .expect("evolution");
    for v in [0.0, 1e-12_f64, 1e-8, 1e-3, 1.0] {
        let rate = v / 0.5 + 1e-7;
        let limit = (v / 0.5 * 1e-12 + 1e-7 * 1e-15) / rate;
        let sizes = field.sizes();
        let (mut memory, mut next) = (sizes.memory.clone(), sizes.memory);
        let (rates, mut time) = ([v; 3], 0.0);
        for dt in [1e-3, 1.0, 1e3, 1e6, 1e8] {
            field
                .advance(&memory, [&rates, &rates], dt, &mut next)
                .expect("advances");
            std::mem::swap(&mut memory, &mut next);
            time += dt;
            let exact = limit + (1e-14 - limit) * (-rate * time).exp();
            let mut found = vec![0.0; 3];
            field.read(1, &memory, &mut found);
            assert!(
                (found[0] / exact - 1.0).abs() < 1e-12,
                "{v:e} {time:e}: {:e} {exact:e}",
                found[0]
            );
        }
    }
}

/// Two cells whose conductance rises: their difference decays as `exp(-(2/C) int T dt)`.
#[test]
fn diffusion_under_evolving_permeability_is_of_second_order() {
    let evolution = PermeabilityEvolution {
        minimum: 0.0.into(),
        maximum: 1e-13.into(),
        slip_distance: 1e-2.into(),
        healing_time: f64::INFINITY.into(),
    };
    let errors = [20_u32, 40, 80].map(|steps| {
        let line = Line::uniform([0.0, 20.0], 2).expect("line");
        let field = Diffusion::new(line, &zone(1e-14)).expect("field");
        let field = field
            .with_permeability_evolution(&evolution)
            .expect("evolution");
        let field = field
            .with_initial_pressure(vec![1e6, 0.0])
            .expect("pressure");
        let sizes = field.sizes();
        let (mut memory, mut next) = (sizes.memory.clone(), sizes.memory);
        // The slip rate grows linearly: D(t) = V_1 t^2/2, and k = k_max - (k_max - k_0) exp(-D/L).
        let (end, most) = (2e3, 1e-5);
        let rate = |time: f64| [most * time / end; 2];
        for i in 0..steps {
            let dt = end / f64::from(steps);
            let [begin, end] = [f64::from(i), f64::from(i + 1)].map(|i| rate(i * dt));
            field
                .advance(&memory, [&begin, &end], dt, &mut next)
                .expect("advances");
            std::mem::swap(&mut memory, &mut next);
        }
        let mut pressure = vec![0.0; 2];
        field.pressure(&memory, &mut pressure);
        // Its integral by the error function.
        let scale = most / (2.0 * end * 1e-2);
        let gone = 0.5 * (std::f64::consts::PI / scale).sqrt() * libm::erf(scale.sqrt() * end);
        let integral = 1e-13 * end - 9e-14 * gone;
        // T = k w_h/(eta_f h), C = beta phi w_h h.
        let exact = 1e6 * (-2.0 * integral / (1e-3 * 1e-9 * 100.0)).exp();
        ((pressure[0] - pressure[1]) / exact - 1.0).abs()
    });
    assert!(errors[2] < 1e-3, "{errors:?}");
    assert!(
        errors
            .windows(2)
            .all(|pair| (pair[0] / pair[1]).log2() > 1.9),
        "{errors:?}"
    );
}
