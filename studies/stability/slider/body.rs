//! The bodies: the paper's, and those that differ from it in one thing.

use stickslip::fem::Elastic;
use stickslip::problems::Slider;

use super::STEPS;
use crate::setup::{PAPER, Setup};

/// A body on its frictional bottom, moved at its top.
#[derive(Debug, Clone)]
pub(crate) struct Body {
    pub(crate) size: [f64; 2],
    pub(crate) cells: [usize; 2],
    pub(crate) refinements: usize,
    pub(crate) elastic: Elastic,
    /// None for a quasi-static body.
    pub(crate) density: Option<f64>,
    pub(crate) numbers: Setup,
    /// Parameters at odd frictional vertices, over those at even ones: `a`, `b`, `L`, `sigma_n`.
    pub(crate) contrast: [f64; 4],
    pub(crate) steps: usize,
}

impl Body {
    fn paper(refinements: usize) -> Self {
        let Slider {
            density, elastic, ..
        } = Slider::default();
        Self {
            size: [5.0, 1.0],
            cells: [5, 1],
            refinements,
            elastic,
            density: Some(density),
            numbers: Setup {
                slip_rate: 0.0,
                ..PAPER
            },
            contrast: [1.0; 4],
            steps: STEPS,
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
}

/// Bodies that differ from the paper's in one thing, under its name.
pub(crate) fn bodies(refinements: usize, quick: bool) -> Vec<(String, Body)> {
    let paper = Body::paper(refinements);
    let mut all = vec![("none".to_string(), paper.clone())];
    let with = |change: &dyn Fn(&mut Body)| {
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
    for (name, size, cells) in [
        ("flat cells 1e4 : 1", [5.0, 1e-4], [5, 1]),
        ("upright cells 1 : 1e4", [5e-4, 1.0], [5, 1]),
        ("flat cells 1e2 : 1", [5.0, 1e-2], [5, 1]),
        ("upright cells 1 : 1e2", [5e-2, 1.0], [5, 1]),
    ] {
        all.push((
            name.into(),
            with(&|body| (body.size, body.cells) = (size, cells)),
        ));
    }
    for (name, contrast) in [
        ("a, b varied by 1e6", [1e-6, 1e-6, 1.0, 1.0]),
        ("L varied by 1e6", [1.0, 1.0, 1e-6, 1.0]),
        ("sigma_n varied by 1e6", [1.0, 1.0, 1.0, 1e6]),
        ("a, b, L, sigma_n varied by 1e6", [1e-6, 1e-6, 1e6, 1e-6]),
    ] {
        all.push((name.into(), with(&|body| body.contrast = contrast)));
    }
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
            "a, b, L",
        ];
        all.retain(|(name, _)| some.iter().any(|some| name.starts_with(some)));
    }
    all
}
