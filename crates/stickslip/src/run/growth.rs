//! What extrapolation makes of waves that a step does not resolve.

use nalgebra::Matrix4;
use stickslip_time::{Motion, RateScheme};

/// The largest factor by which a step of a scheme, taken in `1, 2, ..., levels` parts and extrapolated in
/// powers `power` of their length, multiplies an oscillation `u'' = -u`, over steps of all lengths.
///
/// With `R(z)` the factor of the scheme that of two levels is `(4 R(z/2)^2 - R(z))/3` for `power = 2`; without
/// damping it tends to 5/3 in modulus.
pub(super) fn extrapolated_growth(scheme: &dyn RateScheme, levels: usize, power: i32) -> f64 {
    const PER_DECADE: i32 = 5;
    let steps =
        (-PER_DECADE..=6 * PER_DECADE).map(|k| 10_f64.powf(f64::from(k) / f64::from(PER_DECADE)));
    steps
        .map(|dt| {
            let mut sum = Matrix4::zeros();
            for level in 1..=levels {
                let part = step(scheme, dt / level as f64);
                let whole = (1..level).fold(part, |whole, _| part * whole);
                sum += whole * share(level, levels, power);
            }
            let factors = sum.complex_eigenvalues();
            factors
                .iter()
                .fold(0.0, |most: f64, factor| most.max(factor.norm()))
        })
        .fold(0.0, f64::max)
}

/// The weight of a level in the value at a length of zero, by Lagrange.
fn share(level: usize, levels: usize, power: i32) -> f64 {
    let x = |level: usize| (level as f64).powi(-power);
    let others = (1..=levels).filter(|&other| other != level);
    others
        .map(|other| x(other) / (x(other) - x(level)))
        .product()
}

/// A step for `u'' = -u` as a matrix on displacement, velocity, acceleration and what is carried on.
fn step(scheme: &dyn RateScheme, dt: f64) -> Matrix4<f64> {
    let mut columns = Matrix4::zeros();
    for (k, mut column) in columns.column_iter_mut().enumerate() {
        let unit = |j: usize| if j == k { 1.0 } else { 0.0 };
        let old = Motion {
            displacement: unit(0),
            velocity: unit(1),
            acceleration: unit(2),
            carried: unit(3),
        };
        let mut now = old;
        for (number, stage) in scheme.facts().stages.iter().enumerate() {
            if number > 0 {
                now.displacement =
                    old.displacement + stage.lead * (now.displacement - old.displacement);
                now.velocity = old.velocity + stage.lead * (now.velocity - old.velocity);
            }
            let rule = scheme.rule(stage.share * dt);
            let known = rule.acceleration.of_old(now) + rule.displacement.of_old(now);
            let resistance = rule.acceleration.new_velocity + rule.displacement.new_velocity;
            now = rule.motion(now, -known / resistance);
        }
        let motion = [
            now.displacement,
            now.velocity,
            now.acceleration,
            now.carried,
        ];
        column.copy_from_slice(&motion);
    }
    columns
}

#[cfg(test)]
mod tests {
    use super::*;
    use stickslip_time::{BackwardEuler, Newmark, Sdirk2};

    #[test]
    fn what_is_not_damped_grows_by_five_thirds() {
        let growth = extrapolated_growth(&Newmark::default(), 2, 2);
        // The phases of a whole step and of two halves pass opposition somewhere.
        assert!((growth - 5.0 / 3.0).abs() < 0.02, "{growth}");
        assert!((extrapolated_growth(&Newmark::default(), 1, 2) - 1.0).abs() < 1e-9);
    }

    #[test]
    fn what_is_damped_does_not_grow() {
        for levels in 1..=2 {
            let growth = extrapolated_growth(&BackwardEuler, levels, 1);
            assert!(growth <= 1.0 + 1e-9, "{levels}: {growth}");
        }
        // Damped as a whole, and yet not where two halves are nearly undamped.
        let growth = extrapolated_growth(&Sdirk2, 2, 2);
        assert!((1.0..1.1).contains(&growth), "{growth}");
        assert!((extrapolated_growth(&Sdirk2, 1, 2) - 1.0).abs() < 1e-3);
    }
}
