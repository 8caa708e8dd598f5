//! Pressures within a step.

use stickslip_fields::{Diffusion, FaultField, Line, RateHistory, Well};

use super::march::{DAY, March, zone};

/// Those within a step differ from short steps to there by third order in the step, and the end is that of one step.
#[test]
fn pressures_within_a_step_are_of_third_order() -> Result<(), Box<dyn std::error::Error>> {
    let rates = RateHistory::linear_between(&[(0.0, 0.0), (40.0 * DAY, 1e-6)])?;
    let line = Line::uniform([-500.0, 500.0], 101)?;
    let diffusion = Diffusion::new(line, &zone(1e-13))?.with_well(Well::new(0.0, rates))?;
    let mut march = March::new(&diffusion);
    (0..400).for_each(|_| march.step(0.05 * DAY));
    let (from, shares) = (march.memory.clone(), [0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0]);
    let mut errors = Vec::new();
    for dt in [2.0 * DAY, DAY, 0.5 * DAY] {
        let mut pressures = vec![vec![0.0; 101]; shares.len()];
        let (mut to, mut whole) = (from.clone(), from.clone());
        diffusion.pressures_within(&from, dt, &shares, &mut pressures, &mut to)?;
        diffusion.advance(&from, [&[], &[]], dt, &mut whole)?;
        assert_eq!(to, whole);
        let mut end = vec![0.0; 101];
        diffusion.pressure(&to, &mut end);
        for (own, end) in pressures[5].iter().zip(&end) {
            assert!((own / end - 1.0).abs() < 1e-14);
        }
        let mut error = 0.0_f64;
        for (share, pressures) in shares.iter().zip(&pressures) {
            let mut fine = March::new(&diffusion);
            fine.memory.copy_from_slice(&from);
            (0..256).for_each(|_| fine.step(share * dt / 256.0));
            let mut expected = vec![0.0; 101];
            diffusion.pressure(&fine.memory, &mut expected);
            let apart = pressures.iter().zip(&expected).map(|(a, b)| (a - b).abs());
            error = apart.fold(error, f64::max);
        }
        errors.push(error);
    }
    let orders: Vec<f64> = errors.windows(2).map(|e| (e[0] / e[1]).log2()).collect();
    assert!(
        orders.iter().all(|order| *order > 2.5),
        "{errors:?} {orders:?}"
    );
    Ok(())
}
