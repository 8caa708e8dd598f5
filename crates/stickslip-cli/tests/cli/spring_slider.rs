//! `stickslip spring-slider` against an integration of its own.

use std::fs;

use serde_json::Value;

use crate::{Outcome, folder, program};

/// Friction of the default velocity step on a spring of stiffness K [Pa/m]: `a` = 0.005, `b` = 0.01, `L` = 10 um, 1 MPa,
/// from 1 to 10 um/s, by the classical method of Runge and Kutta in `ln V` and `ln theta`, whose steps resolve the spring.
fn peak(stiffness: f64) -> f64 {
    const A: f64 = 0.005;
    const B: f64 = 0.01;
    const L: f64 = 1e-5;
    const NORMAL_STRESS: f64 = 1e6;
    const LOAD: f64 = 1e-5;
    let rates = |[v, theta]: [f64; 2]| {
        let (v, theta) = (v.exp(), theta.exp());
        let aging = 1.0 / theta - v / L;
        let stress = stiffness * (LOAD - v) / NORMAL_STRESS;
        [(stress - B * aging) / A, aging]
    };
    let friction = |[v, theta]: [f64; 2]| {
        let known = 0.6 + A * (v.exp() / 1e-6).ln() + B * (theta.exp() * 1e-6 / L).ln();
        known.max(0.0)
    };
    let dt = 0.02 * A * NORMAL_STRESS / (stiffness * LOAD);
    let (mut y, mut peak) = ([1e-6_f64.ln(), 10_f64.ln()], 0.6_f64);
    let moved = |y: [f64; 2], k: [f64; 2], h: f64| [y[0] + h * k[0], y[1] + h * k[1]];
    // Twice as long as friction rises for.
    while friction(y) >= peak - 1e-6 {
        let k1 = rates(y);
        let k2 = rates(moved(y, k1, 0.5 * dt));
        let k3 = rates(moved(y, k2, 0.5 * dt));
        let k4 = rates(moved(y, k3, dt));
        for c in 0..2 {
            y[c] += dt / 6.0 * (k1[c] + 2.0 * k2[c] + 2.0 * k3[c] + k4[c]);
        }
        peak = peak.max(friction(y));
    }
    peak
}

#[test]
fn the_peak_of_friction_is_that_of_the_equations() -> Outcome {
    let folder = folder("spring-slider")?;
    for stiffness in [1e9, 1e10, 1e12] {
        let output = program("spring-slider")
            .args([
                "--until",
                "12",
                "--stiffness",
                &stiffness.to_string(),
                "--out",
            ])
            .arg(&folder)
            .output()?;
        assert!(
            output.status.success(),
            "{}",
            String::from_utf8(output.stderr)?
        );
        let summary: Value = serde_json::from_slice(&fs::read(folder.join("summary.json"))?)?;
        let found = summary["friction_max"].as_f64().ok_or("no friction")?;
        let exact = peak(stiffness);
        assert!((found - exact).abs() < 2e-6, "{stiffness}: {found} {exact}");
    }
    Ok(())
}

/// The history of a long run is bounded, and its summary counts all steps.
#[test]
fn a_long_run_has_a_bounded_history() -> Outcome {
    let folder = folder("spring-slider-long")?;
    let output = program("spring-slider")
        .args(["stick-slip", "--until", "2e5", "--out"])
        .arg(&folder)
        .output()?;
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8(output.stderr)?
    );
    let summary: Value = serde_json::from_slice(&fs::read(folder.join("summary.json"))?)?;
    let steps = summary["steps"].as_u64().ok_or("no steps")?;
    assert!(steps > 50_000, "{steps}");
    let rows = fs::read_to_string(folder.join("history.csv"))?
        .lines()
        .count();
    assert!((20_000..=40_002).contains(&rows), "{rows}");
    Ok(())
}
