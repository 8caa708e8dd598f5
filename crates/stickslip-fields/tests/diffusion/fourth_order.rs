//! Flow of fourth order on planes.

use std::f64::consts::PI;

use proptest::prelude::*;
use stickslip_fields::{Boundary, Diffusion, GaussianSource, Hydraulics, Plane, RateHistory, Side};

use crate::march::{March, zone};

/// `cos(pi x/a) cos(2 pi y/b)` between sealed sides.
#[test]
fn a_wave_decays_at_its_rate_to_fourth_order() {
    let errors = [8_usize, 16].map(|n| {
        let plane = Plane::new([[0.0, 100.0], [0.0, 150.0]], [n, 2 * n]).expect("plane");
        let wave = |[x, y]: [f64; 2]| (PI * x / 100.0).cos() * (2.0 * PI * y / 150.0).cos();
        let waves: Vec<f64> = (0..plane.count())
            .map(|cell| wave(plane.center(cell)))
            .collect();
        let field = Diffusion::new(plane, &zone(1e-13))
            .and_then(|field| field.with_initial_pressure(waves.clone()))
            .and_then(Diffusion::with_fourth_order)
            .expect("field");
        let mut march = March::new(&field);
        let rate = 0.1 * ((PI / 100.0).powi(2) + (2.0 * PI / 150.0).powi(2));
        (0..4000).for_each(|_| march.step(1.0 / rate / 4000.0));
        let pairs = march.pressure().into_iter().zip(&waves);
        pairs.fold(0.0, |most: f64, (p, wave)| {
            most.max((p - wave * (-1.0_f64).exp()).abs())
        })
    });
    let order = (errors[0] / errors[1]).log2();
    assert!(order > 3.7 && errors[1] < 1e-4, "{errors:?}: {order}");
}

/// In time it stays of second order.
#[test]
fn steps_converge() {
    let plane = Plane::new([[0.0, 100.0], [0.0, 20.0]], [20, 4]).expect("plane");
    let waves: Vec<f64> = (0..80)
        .map(|cell| (PI * plane.center(cell)[0] / 100.0).cos())
        .collect();
    let field = Diffusion::new(plane, &zone(1e-13))
        .and_then(|field| field.with_initial_pressure(waves.clone()))
        .and_then(Diffusion::with_fourth_order)
        .expect("field");
    let end = 1.0 / (0.1 * (PI / 100.0).powi(2));
    let errors = [5_u32, 10, 20].map(|steps| {
        let mut march = March::new(&field);
        (0..steps).for_each(|_| march.step(end / f64::from(steps)));
        (march.pressure()[0] / waves[0] / (-1.0_f64).exp() - 1.0).abs()
    });
    assert!(
        errors
            .windows(2)
            .all(|pair| (pair[0] / pair[1]).log2() > 1.9),
        "{errors:?}"
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]
    /// Volume is conserved for any permeabilities, sealed cells and sides.
    #[test]
    fn volume_is_conserved(
        exponents in prop::collection::vec(prop_oneof![Just(-40.0), -15.0..-12.0_f64], 48),
        steps in prop::collection::vec(0.0..6.0_f64, 5),
        given in any::<bool>(),
    ) {
        let mut permeability: Vec<f64> =
            exponents.iter().map(|e| if *e < -30.0 { 0.0 } else { 10.0_f64.powf(*e) }).collect();
        permeability[20] = 1e-13;
        let hydraulics = Hydraulics { permeability: permeability.into(), ..zone(0.0) };
        let plane = Plane::new([[0.0, 80.0], [0.0, 60.0]], [8, 6]).expect("plane");
        let center = plane.center(20);
        let rates = RateHistory::constant(1e-6).expect("rate");
        let side = if given { Boundary::Pressure(10.0) } else { Boundary::Sealed };
        let field = Diffusion::new(plane, &hydraulics)
            .and_then(|field| field.with_side(Side::End, side))
            .and_then(|field| field.with_gaussian_source(GaussianSource::new(center, 15.0, rates)))
            .and_then(Diffusion::with_fourth_order)
            .expect("field");
        let mut march = March::new(&field);
        for step in steps {
            march.step(10.0_f64.powf(step));
        }
        let total = |name| march.total(name);
        let (injected, stored, drained) = (total("injected_volume"), total("stored_volume"), total("drained_volume"));
        let most = injected.abs() + stored.abs() + drained.abs();
        prop_assert!((injected - stored - drained).abs() < 1e-11 * most, "{injected:e} {stored:e} {drained:e}");
        prop_assert!(march.pressure().iter().all(|p| p.is_finite()));
    }
}
