//! A command line, drawn.

use stickslip_studies::Draws;

/// Flags with a value, and the values they may have.
const VALUES: [(&str, &[&str]); 24] = [
    (
        "law",
        &[
            "dieterich",
            "ruina",
            "perrin-rice-zheng",
            "kato-tullis",
            "discontinuous",
            "none",
        ],
    ),
    ("friction", &["dieterich-ruina", "regularized", "tresca"]),
    (
        "scheme",
        &[
            "newmark",
            "backward-euler",
            "sdirk2",
            "generalized-alpha",
            "central-differences",
        ],
    ),
    ("solver", &["auto", "condensed", "tnnmg", "gauss-seidel"]),
    (
        "coupling",
        &["fixed-point", "accelerated", "monolithic", "staggered"],
    ),
    ("state-update", &["backward-euler", "midpoint"]),
    ("spectral-radius", &["0", "0.5", "1"]),
    ("tolerance", &["1e-14", "1e-12", "1e-6", "1"]),
    ("every", &["7", "1000000"]),
    ("density", &["5e-3", "5", "5e6", "5e9"]),
    ("young-modulus", &["1", "1e3", "1e9", "1e12"]),
    ("poisson-ratio", &["0", "0.45", "0.4999"]),
    ("normal-stress", &["0", "1", "1e12"]),
    ("a", &["1e-6", "1e-4", "1"]),
    ("b", &["0", "0.005", "0.05", "1"]),
    ("reference-friction", &["0", "0.01", "10"]),
    ("reference-velocity", &["1e-12", "1e-3", "1"]),
    ("slip-distance", &["1e-12", "1e-9", "1e-7", "1"]),
    (
        "initial-log-theta",
        &["-800", "-300", "0", "10", "100", "800"],
    ),
    ("no-gravity", &[]),
    ("mirrored", &[]),
    ("no-bridging", &[]),
    ("refinements", &["1", "2"]),
    ("adaptive", &["1", "1e-1", "1e-2", "1e-3", "1e-4"]),
];
/// Flags that are wrong, or at the end of what can be represented.
const WRONG: [&str; 12] = [
    "--spectral-radius=2",
    "--tolerance=0",
    "--every=0",
    "--density=nan",
    "--young-modulus=-1",
    "--poisson-ratio=0.5",
    "--normal-stress=-1",
    "--a=0",
    "--b=inf",
    "--reference-velocity=1e-320",
    "--slip-distance=1e300",
    "--no-such-flag",
];
/// Steps in 15 s.
const STEPS: [&str; 6] = ["1", "10", "100", "1000", "10000", "1000000"];
/// Steps that a run takes at most.
const TAKEN: [f64; 3] = [1.0, 20.0, 300.0];
/// The share of 15 s that an adaptive run may take.
const SHARES: [f64; 3] = [1e-3, 1e-1, 0.5];

/// Two in five flags of a command line, and always a mesh and an end that are small; one in ten has
/// something wrong.
pub(crate) fn draw(draws: &mut Draws) -> Vec<String> {
    let mut settings = Vec::new();
    let mut adaptive = false;
    for (flag, values) in VALUES {
        let wanted = draws.below(5) < 2;
        if !wanted && flag != "refinements" {
            continue;
        }
        adaptive |= flag == "adaptive";
        settings.push(match values {
            [] => format!("--{flag}"),
            _ => format!("--{flag}={}", draws.one_of(values)),
        });
    }
    if draws.below(10) == 0 {
        settings.push(draws.one_of(&WRONG).into());
    }
    let steps = draws.one_of(&STEPS);
    let until = if adaptive {
        draws.one_of(&SHARES)
    } else {
        draws.one_of(&TAKEN) / steps.parse::<f64>().unwrap_or(1.0)
    };
    settings.push(format!("--steps={steps}"));
    settings.push(format!("--until={}", until.min(1.0)));
    settings
}
