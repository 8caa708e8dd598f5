//! Friction of many cells in any number of threads.

use rayon::ThreadPoolBuilder;
use stickslip_friction::{
    CellState, EvolutionLaw, QuasiDynamicFriction, RegularizedDieterichRuina,
};

#[test]
fn rates_in_threads_have_the_same_bits() -> Result<(), Box<dyn std::error::Error>> {
    const COUNT: usize = 40_000;
    let spread = |k: usize, low: f64, high: f64| -> Vec<f64> {
        let part = |i: usize| ((i * k) % COUNT) as f64 / COUNT as f64;
        (0..COUNT).map(|i| low + (high - low) * part(i)).collect()
    };
    let (normal, state) = (spread(11, 1e5, 1e8), spread(13, -10.0, 25.0));
    let ratios = spread(17, -1.5, 1.5);
    let shear: Vec<f64> = normal
        .iter()
        .zip(ratios)
        .map(|(n, ratio)| n * ratio)
        .collect();
    let laws: Vec<_> = spread(7, 0.005, 0.03)
        .into_iter()
        .map(|a| RegularizedDieterichRuina {
            a,
            b: 0.015,
            reference_friction: 0.6,
            reference_velocity: 1e-6,
            slip_distance: 8e-3,
        })
        .collect();
    for evolution in [EvolutionLaw::Aging, EvolutionLaw::Slip] {
        let friction =
            QuasiDynamicFriction::new(&laws, 4.6e6, CellState::LogTheta, evolution, 1e3)?;
        let rates = || {
            let (mut v, mut rate) = (vec![0.0; COUNT], vec![0.0; COUNT]);
            friction.rates(&shear, &normal, &state, &mut v, &mut rate);
            [v, rate]
        };
        let alone = ThreadPoolBuilder::new()
            .num_threads(1)
            .build()?
            .install(rates);
        assert!(alone[0].iter().any(|&v| v > 1e-9) && alone[0].iter().any(|&v| v < -1e-9));
        for threads in [2, 3, 7] {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build()?;
            assert!(pool.install(rates) == alone, "{threads}");
        }
    }
    Ok(())
}
