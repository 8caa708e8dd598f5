//! The bodies: the paper's slider, a block in three dimensions, and those that differ from them in
//! one thing.

use stickslip::fem::Elastic;
use stickslip::problems::pipping_slider::PippingSlider;

use super::STEPS;
use super::units::{BINARY, KM_MT, SI, Units};
use crate::march::Pace;
use crate::setup::{PAPER, Setup};

/// A body on its frictional bottom, moved at its top or beside it.
#[derive(Debug, Clone)]
pub(crate) struct Body<const D: usize> {
    pub(crate) size: [f64; D],
    pub(crate) cells: [usize; D],
    pub(crate) refinements: usize,
    pub(crate) elastic: Elastic,
    /// None for a quasi-static body.
    pub(crate) density: Option<f64>,
    pub(crate) numbers: Setup,
    /// Parameters at odd frictional vertices, over those at even ones: `a`, `b`, `L`, `sigma_n`.
    pub(crate) contrast: [f64; 4],
    /// A guide with a constant coefficient along the top; what moves the body is at its right.
    pub(crate) guide: Option<f64>,
    pub(crate) pace: Pace,
    pub(crate) steps: usize,
    pub(super) units: Units,
    /// The tolerance of the coupling in these units; else that of metres and kilograms.
    pub(super) tolerance_in_units: bool,
}

impl<const D: usize> Body<D> {
    fn new(size: [f64; D], cells: [usize; D], refinements: usize) -> Self {
        let PippingSlider {
            density, elastic, ..
        } = PippingSlider::default();
        Self {
            size,
            cells,
            refinements,
            elastic,
            density: Some(density),
            numbers: Setup {
                slip_rate: 0.0,
                ..PAPER
            },
            contrast: [1.0; 4],
            guide: None,
            pace: Pace::Constant,
            steps: STEPS,
            units: SI,
            tolerance_in_units: true,
        }
    }

    /// The numbers at a frictional vertex.
    pub(crate) fn numbers_at(&self, k: usize) -> Setup {
        let Setup {
            a,
            ratio,
            slip_distance,
            normal_stress,
            ..
        } = self.numbers;
        let [of_a, of_b, of_length, of_stress] = if k % 2 == 1 { self.contrast } else { [1.0; 4] };
        Setup {
            a: a * of_a,
            ratio: ratio * (of_b / of_a),
            slip_distance: slip_distance * of_length,
            normal_stress: normal_stress * of_stress,
            ..self.numbers
        }
    }

    /// The same with cells that are `ratio` times as wide as high.
    fn stretched(&self, ratio: f64) -> Self {
        let mut body = self.clone();
        let (height, widths) = body.size.split_last_mut().expect("a body has a height");
        if ratio > 1.0 {
            *height /= ratio;
        } else {
            widths.iter_mut().for_each(|width| *width *= ratio);
        }
        body
    }
}

impl Body<2> {
    /// The paper's slider.
    pub(super) fn paper(refinements: usize) -> Self {
        Self::new([5.0, 1.0], [5, 1], refinements)
    }
}

impl Body<3> {
    /// A block of the paper's material.
    pub(super) fn block(refinements: usize) -> Self {
        Self::new([2.0, 2.0, 1.0], [2, 2, 1], refinements)
    }
}

/// Bodies that differ from `paper` in one thing, under its name.
pub(super) fn bodies<const D: usize>(paper: &Body<D>, quick: bool) -> Vec<(String, Body<D>)> {
    let mut all = vec![("none".to_string(), paper.clone())];
    let with = |change: &dyn Fn(&mut Body<D>)| {
        let mut body = paper.clone();
        change(&mut body);
        body
    };
    let numbers = |change: fn(&mut Setup, f64), value: f64| {
        let mut body = paper.clone();
        change(&mut body.numbers, value);
        body
    };
    type Change = fn(&mut Setup, f64);
    let lists: [(&str, &str, Change, &[f64]); 7] = [
        (
            "tau",
            " s",
            |s, x| s.dt = x,
            &[1e-12, 1e-9, 1e-6, 1.0, 1e3, 1e6],
        ),
        (
            "V(0)",
            " m/s",
            |s, x| s.slip_rate = x,
            &[5e-324, 1e-300, 1e-20, 1.0, 1e10],
        ),
        (
            "alpha(0)",
            "",
            |s, x| s.alpha = x,
            &[-800.0, -100.0, 100.0, 800.0],
        ),
        (
            "L",
            " m",
            |s, x| s.slip_distance = x,
            &[1e-12, 1e-9, 1e-7, 1.0],
        ),
        ("a", "", |s, x| s.a = x, &[1e-6, 1e-4, 1.0]),
        ("b/a", "", |s, x| s.ratio = x, &[0.0, 0.5, 2.0, 5.0, 150.0]),
        (
            "sigma_n",
            " Pa",
            |s, x| s.normal_stress = x,
            &[0.0, 1.0, 1e12],
        ),
    ];
    for (name, unit, change, values) in lists {
        for &value in values {
            all.push((format!("{name} = {value:e}{unit}"), numbers(change, value)));
        }
    }
    for nu in [0.0, 0.45, 0.49, 0.499, 0.4999] {
        all.push((
            format!("nu = {nu}"),
            with(&|body| body.elastic.poisson_ratio = nu),
        ));
    }
    all.push(("quasi-static".into(), with(&|body| body.density = None)));
    for ratio in [1e-6, 1e-3, 1e3, 1e6] {
        let body = with(&|body| body.density = Some(5e3 * ratio));
        all.push((format!("rho = {:e} kg/m^3", 5e3 * ratio), body));
    }
    for young_modulus in [1.0, 1e3, 1e9, 1e12] {
        let body = with(&|body| body.elastic.young_modulus = young_modulus);
        all.push((format!("E = {young_modulus:e} Pa"), body));
    }
    for (name, ratio) in [
        ("flat cells 1e4 : 1", 1e4),
        ("upright cells 1 : 1e4", 1e-4),
        ("flat cells 1e2 : 1", 1e2),
        ("upright cells 1 : 1e2", 1e-2),
    ] {
        all.push((name.into(), paper.stretched(ratio)));
    }
    for (name, contrast) in [
        ("a, b varied by 1e6", [1e-6, 1e-6, 1.0, 1.0]),
        ("L varied by 1e6", [1.0, 1.0, 1e-6, 1.0]),
        ("sigma_n varied by 1e6", [1.0, 1.0, 1.0, 1e6]),
        ("a, b, L, sigma_n varied by 1e6", [1e-6, 1e-6, 1e6, 1e-6]),
    ] {
        all.push((name.into(), with(&|body| body.contrast = contrast)));
    }
    for coefficient in [0.0, 0.1, 1e6] {
        let name = format!("two contacts, the other with mu = {coefficient:e}");
        all.push((name, with(&|body| body.guide = Some(coefficient))));
    }
    let guided = with(&|body| (body.guide, body.density) = (Some(0.1), None));
    all.push(("two contacts, quasi-static".into(), guided));
    all.push((
        "steps varied by 1e6".into(),
        with(&|body| (body.pace, body.steps) = (Pace::Varied, 20)),
    ));
    for tolerance in [1e-1, 1e-3, 1e-6] {
        let name = format!("adaptive steps, tolerance {tolerance:e}");
        let pace = Pace::Adaptive(tolerance);
        all.push((name, with(&|body| (body.pace, body.steps) = (pace, 30))));
    }
    all.push(("km, Mt".into(), with(&|body| body.units = KM_MT)));
    let binary = with(&|body| body.units = BINARY);
    all.push(("2^10 m, 2^30 kg".into(), binary));
    let absolute = |body: &mut Body<D>| (body.units, body.tolerance_in_units) = (KM_MT, false);
    all.push(("km, Mt, tolerance of SI".into(), with(&absolute)));
    if quick {
        let some = [
            "tau = 1e-12",
            "tau = 1e6",
            "V(0) = 1e10",
            "L = 1e-9",
            "sigma_n = 1e12",
            "nu = 0.4999",
            "quasi",
            "rho = 5e-3",
            "E = 1e0",
            "flat cells 1e4",
            "upright cells 1 : 1e4",
            "a, b, L",
            "two contacts, the other with mu = 1e-1",
            "steps varied",
            "adaptive steps, tolerance 1e-3",
            "km, Mt",
        ];
        all.retain(|(name, _)| some.iter().any(|some| name.starts_with(some)));
    }
    all
}
