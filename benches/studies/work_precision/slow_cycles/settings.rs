//! The bodies, and the schemes by which each is run.

use stickslip::{BackwardEuler, GeneralizedAlpha, Newmark, RateScheme, Sdirk2};

use crate::cycling_slider::CyclingSlider;

/// A body, and how it is run.
pub(super) struct Setting {
    pub(super) name: &'static str,
    pub(super) slider: CyclingSlider,
    /// The first is the reference.
    pub(super) runs: &'static [Run],
}

/// A scheme with the weight of the error of the motion, a tolerance, and the steps after which it
/// gives up.
#[derive(Debug, Clone, Copy)]
pub(super) struct Run {
    pub(super) scheme: Scheme,
    pub(super) motion: f64,
    pub(super) tolerance: f64,
    pub(super) max_steps: usize,
}

/// A scheme that is compared.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Scheme {
    Sdirk2,
    /// With this spectral radius.
    Alpha(f64),
    Newmark,
    BackwardEuler,
}

/// The viscous body: its longest wave loses half its amplitude in some two periods.
pub(super) const VISCOUS: CyclingSlider = CyclingSlider {
    refinements: 2,
    b: 0.019,
    load_velocity: 2.5e-9,
    ramp: 1e5,
    relaxation: 1e-3,
};

/// The elastic one has larger events: it is loaded faster, so that it has as many.
const ELASTIC: CyclingSlider = CyclingSlider {
    load_velocity: 6.5e-9,
    relaxation: 0.0,
    ..VISCOUS
};

pub(super) const SETTINGS: [Setting; 2] = [
    Setting {
        name: "viscous",
        slider: VISCOUS,
        runs: &[
            run(Scheme::Sdirk2, 1.0, 1e-4),
            run(Scheme::Sdirk2, 1.0, 1e-1),
            run(Scheme::Sdirk2, 1.0, 1e-2),
            run(Scheme::Sdirk2, 1.0, 1e-3),
            run(Scheme::Sdirk2, 0.1, 1e-2),
            run(Scheme::Alpha(0.5), 1.0, 1e-2),
            run(Scheme::Alpha(0.5), 1.0, 1e-3),
            run(Scheme::Alpha(0.0), 1.0, 1e-2),
            run(Scheme::Newmark, 1.0, 1e-1),
            run(Scheme::Newmark, 1.0, 1e-2),
            run(Scheme::Newmark, 1.0, 1e-3),
            run(Scheme::BackwardEuler, 1.0, 1e-2),
        ],
    },
    Setting {
        name: "elastic",
        slider: ELASTIC,
        runs: &[
            Run {
                max_steps: 10_000_000,
                ..run(Scheme::Sdirk2, 0.1, 1e-3)
            },
            run(Scheme::Sdirk2, 1.0, 1e-1),
            run(Scheme::Sdirk2, 0.1, 1e-1),
            run(Scheme::Sdirk2, 1.0, 1e-2),
            run(Scheme::Sdirk2, 0.1, 1e-2),
            run(Scheme::Alpha(0.0), 0.1, 1e-1),
            run(Scheme::Alpha(0.0), 0.1, 1e-2),
            Run {
                max_steps: 10_000_000,
                ..run(Scheme::Alpha(0.0), 0.1, 1e-3)
            },
            run(Scheme::Alpha(0.5), 0.1, 1e-2),
            run(Scheme::Newmark, 0.1, 1e-1),
            run(Scheme::Newmark, 0.1, 1e-2),
        ],
    },
];

const fn run(scheme: Scheme, motion: f64, tolerance: f64) -> Run {
    Run {
        scheme,
        motion,
        tolerance,
        max_steps: 250_000,
    }
}

impl Scheme {
    pub(super) fn name(self) -> String {
        match self {
            Self::Sdirk2 => "Sdirk2".into(),
            Self::Alpha(radius) => format!("GeneralizedAlpha({radius})"),
            Self::Newmark => "Newmark".into(),
            Self::BackwardEuler => "BackwardEuler".into(),
        }
    }

    pub(super) fn rate_scheme(self) -> Box<dyn RateScheme> {
        match self {
            Self::Sdirk2 => Box::new(Sdirk2),
            Self::Alpha(spectral_radius) => Box::new(GeneralizedAlpha { spectral_radius }),
            Self::Newmark => Box::new(Newmark::default()),
            Self::BackwardEuler => Box::new(BackwardEuler),
        }
    }
}
