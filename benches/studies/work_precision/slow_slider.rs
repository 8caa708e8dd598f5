//! The slider as faults are loaded: a thousand times more slowly, and with viscosity.

use nalgebra::SVector;
use stickslip::fem::{P1, body_force, elasticity, mass};
use stickslip::problems::pipping_slider::{END, PippingSlider, load_velocity};
use stickslip::{BlockMatrix, Cholesky, Components, Scene, SceneError};
use stickslip_cli::cli::Problem;

use crate::question::{Question, Wanted, contact};
use crate::study::{Effort, Study};
use crate::waves::{self, Waves};

/// The slip rate at `x0` [m/s] that counts as slip.
const SLIP: f64 = 1e-5;
/// So many times as slow as the paper's.
const SLOWER: f64 = 1e3;
/// Kelvin-Voigt viscosity over elasticity \[s\]: the longest wave loses half its amplitude in some
/// two periods.
const RELAXATION: f64 = 1e-3;

/// The first slip at `x0` \[s\]: Newmark's scheme with the midpoint state at constant steps of
/// 15 ms, 10549.261849, and 37.5 ms, 10549.261678, extrapolated; Sdirk2 gives 10549.26201 likewise.
const FIRST_SLIP: f64 = 10_549.261_88;

/// The logarithm of the largest slip rate there [m/s]: Newmark's scheme, its velocity to 1e-13, at
/// tolerances of 1e-7, -8.99988465, and 1e-8, -8.99987423, extrapolated; Sdirk2 gives -8.999872
/// likewise.
const LN_PEAK: f64 = -8.999_871;

const TOLERANCES: [f64; 6] = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6];

/// The time of the first slip, the largest slip rate, and the steps after it.
pub(crate) fn measure(effort: Effort) -> Result<([Study; 2], Vec<Waves>), Problem> {
    let slider = PippingSlider {
        refinements: 2,
        ..PippingSlider::default()
    };
    let space = slider.space()?;
    let centre = PippingSlider::centre(&space).ok_or("the mesh has no vertex at x0")?;
    let question = |wanted, until: [f64; 2]| Question {
        space: &space,
        body: Box::new(|_| body(&slider, &space)),
        vertex: centre,
        wanted,
        slip: SLIP,
        kink: SLOWER * END / 4.0,
        first_step: SLOWER * END / 1e4,
        until,
    };
    let first = question(Wanted::Slip(1), [FIRST_SLIP + 0.1, FIRST_SLIP + 100.0]);
    let peak = question(Wanted::Peak, [FIRST_SLIP + 7.0; 2]);
    let waves = waves::measure("slow slider", &first, FIRST_SLIP + 200.0, effort)?;
    let steps = if effort.quick {
        &[1.5][..]
    } else {
        &[1.5, 0.375, 0.15][..]
    };
    let studies = [
        Study {
            name: "slow-slider",
            reference: format!("first slip at {FIRST_SLIP} s"),
            error: "error of the first slip at x0 [s]",
            targets: vec![1e0, 1e-1, 1e-2],
            measurements: first.adaptive_and_constant(FIRST_SLIP, effort, &TOLERANCES, steps),
        },
        Study {
            name: "slow-slider-peak",
            reference: format!("largest slip rate at x0 {:.5e} m/s", LN_PEAK.exp()),
            error: "error of ln(largest slip rate at x0)",
            targets: vec![1e-1, 2e-2, 1e-3],
            measurements: peak.adaptive_and_constant(LN_PEAK, effort, &TOLERANCES, steps),
        },
    ];
    Ok((studies, waves))
}

/// The slider with its contact, slowly loaded and damped.
fn body(slider: &PippingSlider, space: &P1<2>) -> Result<Scene<BlockMatrix<2>, 2>, SceneError> {
    let stiffness = elasticity(space, &slider.elastic)?;
    let weight = SVector::from([0.0, -slider.density * slider.gravity]);
    let slowly = |time| [load_velocity(time / SLOWER) / SLOWER, 0.0];
    let viscosity = stiffness.clone().map(|block| block * RELAXATION);
    Ok(Scene::new(stiffness)
        .with_viscosity(viscosity)
        .on(space)
        .with_mass(mass(space, slider.density)?)
        .with_load(body_force(space, |_| weight))
        .with_contact(contact(&PippingSlider::bottom(space)?))
        .prescribe_velocity(&PippingSlider::top(space)?, Components::ALL, slowly)
        .in_equilibrium(Cholesky::new()))
}
