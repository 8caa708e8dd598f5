//! The command line of the slider.

use std::num::NonZeroUsize;

use clap::Parser;
use serde::Serialize;
use stickslip::problems::pipping_slider::{
    FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider,
};

use super::choices::{Body, Coupling, Frequency, Scheme, Solver, Update, frequency};
use crate::checkpoints::Checkpoints;
use crate::cli::{Problem, count, finite, fraction, non_negative, poisson_ratio, positive, share};
use crate::laws::{Friction, Law, Laws};
use crate::output::Files;
use stickslip::fem::{Elastic, P1};
use stickslip::friction::DieterichRuina;
use stickslip::reduced::{Reduced, ReducedBody};
use stickslip::{
    BackwardEuler, BlockGaussSeidel, BlockMatrix, CentralDifferences, Condensed, Diagonal,
    FixedPoint, GeneralizedAlpha, Monolithic, Newmark, NonsmoothSolver, RateScheme, Scene,
    SceneError, Sdirk2, Simulation, Staggered, StateUpdate, Tnnmg,
};

/// Stick-slip of an elastic body that is pulled over a rigid surface: the main experiment of Pipping, Sander and
/// Kornhuber. Writes history.csv, history.png and summary.json.
#[derive(Debug, Clone, PartialEq, Parser, Serialize)]
#[command(name = "slider")]
#[serde(rename_all = "kebab-case")]
pub struct Arguments {
    /// The state law [default: dieterich; none with --friction tresca]
    #[serde(skip)]
    #[arg(long)]
    law: Option<Law>,
    /// The friction law; tresca without --law is a constant coefficient [default: dieterich-ruina; tresca with --law
    /// none]
    #[serde(skip)]
    #[arg(long)]
    friction: Option<Friction>,
    /// The time discretisation
    #[arg(long, default_value = "newmark")]
    pub scheme: Scheme,
    /// The solver of the velocity problems; not for central-differences, and not for a reduced body
    #[arg(long, default_value = "tnnmg")]
    pub solver: Solver,
    /// The whole body, or its Craig-Bampton reduction to the contact, with a dense solver
    #[arg(long, default_value = "full")]
    pub body: Body,
    /// The frequency up to which a reduced body keeps modes [Hz]; auto for those that the step resolves
    #[arg(long, value_name = "HZ", default_value = "auto", value_parser = frequency)]
    pub frequency: Frequency,
    /// The coupling of rate and state in a step [default: fixed-point, as in the paper; monolithic on a reduced body;
    /// staggered with central-differences]
    #[serde(skip)]
    #[arg(long)]
    coupling: Option<Coupling>,
    /// The rate at which the state is advanced [default: backward-euler, as in the paper; midpoint
    /// with central-differences]
    #[serde(skip)]
    #[arg(long)]
    state_update: Option<Update>,
    /// Uniform refinements of the mesh of ten triangles
    #[arg(long, value_name = "J", default_value_t = 4, value_parser = clap::value_parser!(u8).range(1..=10))]
    pub refinements: u8,
    /// The factor by which a step of generalised-alpha damps the fastest waves
    #[arg(long, default_value_t = 0.8, value_parser = share)]
    pub spectral_radius: f64,
    /// Time steps in the whole 15 s; a step is 15 s / N
    #[arg(long, value_name = "N", default_value = "10000", value_parser = count)]
    pub steps: NonZeroUsize,
    /// End at a failed step instead of splitting it into substeps
    #[arg(long, conflicts_with = "adaptive")]
    pub no_bridging: bool,
    /// Adapt the step to this local error of ln V and of the state; steps are 15 s / N at first, and
    /// 15 s / N times a power of two
    #[arg(long, value_name = "TOLERANCE", value_parser = positive)]
    pub adaptive: Option<f64>,
    /// Stop after so many adaptive steps
    #[arg(long, value_name = "N", default_value = "30000", value_parser = count)]
    pub max_steps: NonZeroUsize,
    /// The share of the 15 s after which to stop
    #[serde(skip)]
    #[arg(long, value_name = "FRACTION", default_value_t = 1.0, value_parser = fraction)]
    pub until: f64,
    /// The tolerance of the coupling of rate and state
    #[arg(long, default_value = "1e-10", value_parser = positive)]
    pub tolerance: f64,
    /// Without the weight of the body
    #[arg(long)]
    pub no_gravity: bool,
    /// With the diagonals of the mesh the other way
    #[arg(long)]
    pub mirrored: bool,
    /// Write every K-th step to history.csv; the last one always is
    #[arg(long, value_name = "K", default_value = "1", value_parser = count)]
    pub every: NonZeroUsize,
    /// The folder and the digits of the files.
    #[serde(skip)]
    #[command(flatten)]
    pub files: Files,
    /// The density [kg/m^2]
    #[arg(long, default_value_t = 5e3, value_parser = positive)]
    pub density: f64,
    /// Young's modulus [N/m]
    #[arg(long, default_value_t = 5e7, value_parser = positive)]
    pub young_modulus: f64,
    /// Poisson's ratio
    #[arg(long, default_value_t = 0.3, value_parser = poisson_ratio)]
    pub poisson_ratio: f64,
    /// The normal stress on the frictional boundary [N/m]
    #[arg(long, default_value_t = NORMAL_STRESS, value_parser = non_negative)]
    pub normal_stress: f64,
    /// The coefficient a of the direct effect
    #[arg(long, default_value_t = FRICTION.a, value_parser = positive)]
    pub a: f64,
    /// The coefficient b of the evolution effect
    #[arg(long, default_value_t = FRICTION.b, value_parser = non_negative)]
    pub b: f64,
    /// The coefficient of friction at the reference velocity
    #[arg(long, default_value_t = FRICTION.reference_friction, value_parser = non_negative)]
    pub reference_friction: f64,
    /// The reference velocity [m/s]
    #[arg(long, default_value_t = FRICTION.reference_velocity, value_parser = positive)]
    pub reference_velocity: f64,
    /// The characteristic slip distance [m]
    #[arg(long, default_value_t = FRICTION.slip_distance, value_parser = positive)]
    pub slip_distance: f64,
    /// The initial value of ln(theta / 1 s)
    #[arg(long, default_value_t = INITIAL_LOG_THETA, value_parser = finite)]
    pub initial_log_theta: f64,
    /// The checkpoint file and the restart.
    #[command(flatten)]
    #[serde(skip)]
    pub checkpoints: Checkpoints,
}

impl Arguments {
    /// Whether the physics and the steps are those of an empty command line.
    pub fn is_default(&self) -> bool {
        let Self {
            refinements,
            until,
            every,
            ..
        } = *self;
        let (files, solver) = (self.files.clone(), self.solver);
        let checkpoints = self.checkpoints.clone();
        let default = Self::parse_from(["slider"]);
        *self
            == Self {
                refinements,
                until,
                every,
                files,
                solver,
                checkpoints,
                ..default
            }
    }

    /// The laws of the contact.
    pub fn laws(&self) -> Result<Laws, Problem> {
        let parameters = DieterichRuina {
            a: self.a,
            b: self.b,
            reference_friction: self.reference_friction,
            reference_velocity: self.reference_velocity,
            slip_distance: self.slip_distance,
        };
        Laws::new(self.law, self.friction, parameters)
    }

    /// The body.
    pub fn slider(&self) -> PippingSlider {
        PippingSlider {
            refinements: self.refinements.into(),
            mirrored: self.mirrored,
            gravity: if self.no_gravity { 0.0 } else { 9.81 },
            density: self.density,
            elastic: Elastic {
                young_modulus: self.young_modulus,
                poisson_ratio: self.poisson_ratio,
            },
            lumped: self.scheme == Scheme::CentralDifferences,
            // With steps of one size from zero acceleration, as in the paper.
            recurrent: self.adaptive.is_none(),
        }
    }

    /// The scheme of this name.
    pub fn scheme(&self) -> Box<dyn RateScheme> {
        match self.scheme {
            Scheme::Newmark => Box::new(Newmark::default()),
            Scheme::BackwardEuler => Box::new(BackwardEuler),
            Scheme::Sdirk2 => Box::new(Sdirk2),
            Scheme::GeneralizedAlpha => Box::new(GeneralizedAlpha {
                spectral_radius: self.spectral_radius,
            }),
            Scheme::CentralDifferences => Box::new(CentralDifferences),
        }
    }

    /// The solver of this name.
    pub fn solver(&self, space: &P1<2>) -> Box<dyn NonsmoothSolver<BlockMatrix<2>, 2>> {
        match self.solver {
            _ if self.scheme == Scheme::CentralDifferences => Box::new(Diagonal::new()),
            Solver::Condensed => Box::new(Condensed::new()),
            Solver::Auto if self.refinements <= 8 => Box::new(Condensed::new()),
            Solver::Auto | Solver::Tnnmg => Box::new(Tnnmg::new(space.transfers())),
            Solver::GaussSeidel => Box::new(BlockGaussSeidel::new()),
        }
    }

    /// The body of a scene, reduced.
    pub fn reduced(&self, scene: &Scene<BlockMatrix<2>, 2>) -> Result<ReducedBody<2>, SceneError> {
        let body = Reduced::new(scene);
        match self.frequency {
            Frequency::Auto => body.for_time_step(self.step_size()),
            Frequency::Hertz(frequency) => body.up_to_frequency(frequency),
        }
    }

    /// A simulation with the requested coupling, state update and tolerance.
    pub fn coupled(&self, simulation: Simulation<2>) -> Result<Simulation<2>, SceneError> {
        simulation
            .with_coupling(self.coupling())
            .with_state_update(self.state_update())
            .with_absolute_tolerance(self.tolerance)
    }

    /// The coupling of this name.
    pub fn coupling(&self) -> Box<dyn stickslip::Coupling> {
        match self.coupling_name() {
            Coupling::FixedPoint => Box::new(FixedPoint::paper()),
            Coupling::Accelerated => Box::new(FixedPoint::accelerated()),
            Coupling::Monolithic => Box::new(Monolithic::default()),
            Coupling::Staggered => Box::new(Staggered::default()),
        }
    }

    /// The state update of this name.
    pub fn state_update(&self) -> StateUpdate {
        match self.update_name() {
            Update::BackwardEuler => StateUpdate::BackwardEuler,
            Update::Midpoint => StateUpdate::Midpoint,
        }
    }

    /// The coupling of rate and state in a step.
    pub(super) fn coupling_name(&self) -> Coupling {
        self.coupling.unwrap_or(match (self.scheme, self.body) {
            (Scheme::CentralDifferences, _) => Coupling::Staggered,
            (_, Body::Reduced) => Coupling::Monolithic,
            _ => Coupling::FixedPoint,
        })
    }

    /// The rate at which the state is advanced.
    pub(super) fn update_name(&self) -> Update {
        self.state_update.unwrap_or(match self.scheme {
            Scheme::CentralDifferences => Update::Midpoint,
            _ => Update::BackwardEuler,
        })
    }
}
