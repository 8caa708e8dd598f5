//! The slider with the laws, the scheme and the solver of the command line.

use stickslip::fem::{Elastic, P1, lumped_mass};
use stickslip::friction::{DieterichRuina, FrictionLaw, StateDependentTresca, Tresca};
use stickslip::problems::Slider;
use stickslip::state::{Dieterich, Discontinuous, LogTheta, Ruina, StateLaw};
use stickslip::{
    BackwardEuler, BlockGaussSeidel, BlockMatrix, CentralDifferences, Condensed, Diagonal,
    FixedPoint, GeneralizedAlpha, InterfacePotential, Monolithic, Newmark, NonsmoothSolver,
    RateScheme, Scene, SceneError, Sdirk2, Simulation, Staggered, StateUpdate, Stepper, Tnnmg,
};

use crate::arguments::{Arguments, Coupling, Friction, Scheme, Solver, Update};
use crate::common::cli::Problem;
use crate::common::state_law::Law;

/// A simulation whose laws, scheme and solver are forgotten.
type AnySimulation = Box<dyn Stepper<2>>;

/// The body of the command line.
pub(crate) fn slider(arguments: &Arguments) -> Slider {
    let paper = Slider::default();
    Slider {
        refinements: arguments.refinements.into(),
        mirrored: arguments.mirrored,
        gravity: if arguments.no_gravity {
            0.0
        } else {
            paper.gravity
        },
        density: arguments.density,
        elastic: Elastic {
            young_modulus: arguments.young_modulus,
            poisson_ratio: arguments.poisson_ratio,
        },
    }
}

/// The body with its friction, ready to move.
pub(crate) fn simulation(arguments: &Arguments, space: &P1<2>) -> Result<AnySimulation, Problem> {
    let &Arguments {
        a,
        b,
        reference_friction,
        reference_velocity,
        slip_distance,
        ..
    } = arguments;
    let by_rate_and_state = DieterichRuina {
        a,
        b,
        reference_friction,
        reference_velocity,
        slip_distance,
    };
    let by_state = StateDependentTresca {
        reference_friction,
        b,
        reference_velocity,
        slip_distance,
    };
    let constant = Tresca {
        coefficient: reference_friction,
    };
    let (law, friction) = arguments.laws()?;
    Ok(match friction {
        Friction::Tresca if law == Law::None => with_laws(arguments, space, constant, (), ())?,
        Friction::Tresca => with_friction(arguments, space, law, by_state)?,
        Friction::DieterichRuina => with_friction(arguments, space, law, by_rate_and_state)?,
    })
}

/// One of the state laws under a friction law that reads `alpha`.
fn with_friction<L>(
    arguments: &Arguments,
    space: &P1<2>,
    law: Law,
    friction: L,
) -> Result<AnySimulation, Problem>
where
    L: FrictionLaw<State = LogTheta> + Clone + 'static,
{
    let &Arguments {
        slip_distance,
        initial_log_theta,
        ..
    } = arguments;
    let alpha = LogTheta(initial_log_theta);
    Ok(match law {
        Law::Dieterich => with_laws(
            arguments,
            space,
            friction,
            Dieterich { slip_distance },
            alpha,
        )?,
        Law::Ruina => with_laws(arguments, space, friction, Ruina { slip_distance }, alpha)?,
        Law::Discontinuous => with_laws(arguments, space, friction, Discontinuous, alpha.into())?,
        Law::None => return Err("this friction law needs a state".into()),
    })
}

fn with_laws<L, S>(
    arguments: &Arguments,
    space: &P1<2>,
    friction: L,
    law: S,
    initial: S::State,
) -> Result<AnySimulation, SceneError>
where
    L: FrictionLaw + Clone + 'static,
    S: StateLaw + Clone + 'static,
    L::State: From<S::State>,
{
    let slider = slider(arguments);
    let scene = slider
        .scene(space)?
        .with_friction(&Slider::bottom(space)?, friction, arguments.normal_stress)
        .with_state(law, initial);
    let tnnmg = || Box::new(Tnnmg::new(space.hierarchy().prolongations()));
    let solver: Box<dyn NonsmoothSolver<BlockMatrix<2>, InterfacePotential<L, S>, 2>> =
        match arguments.solver {
            Solver::Auto if arguments.refinements <= 8 => Box::new(Condensed::new()),
            Solver::Condensed => Box::new(Condensed::new()),
            Solver::Auto | Solver::Tnnmg => tnnmg(),
            Solver::GaussSeidel => Box::new(BlockGaussSeidel::new()),
        };
    match arguments.scheme {
        Scheme::Newmark => in_time(arguments, scene, Newmark::default(), solver),
        Scheme::BackwardEuler => in_time(arguments, scene, BackwardEuler, solver),
        Scheme::Sdirk2 => in_time(arguments, scene, Sdirk2, solver),
        Scheme::GeneralizedAlpha => {
            let spectral_radius = arguments.spectral_radius;
            in_time(
                arguments,
                scene,
                GeneralizedAlpha { spectral_radius },
                solver,
            )
        }
        Scheme::CentralDifferences => {
            let scene = scene
                .with_mass(lumped_mass(space, slider.density)?)
                .balanced_by(&mut *tnnmg())?;
            in_time(
                arguments,
                scene,
                CentralDifferences,
                Box::new(Diagonal::new()),
            )
        }
    }
}

fn in_time<L, S, R>(
    arguments: &Arguments,
    scene: Scene<BlockMatrix<2>, L, S, 2>,
    scheme: R,
    solver: Box<dyn NonsmoothSolver<BlockMatrix<2>, InterfacePotential<L, S>, 2>>,
) -> Result<AnySimulation, SceneError>
where
    L: FrictionLaw + Clone + 'static,
    S: StateLaw + Clone + 'static,
    L::State: From<S::State>,
    R: RateScheme + 'static,
{
    let simulation = Simulation::new(scene, scheme, solver)?
        .with_tolerance(arguments.tolerance)?
        .with_state_update(match arguments.state_update() {
            Update::BackwardEuler => StateUpdate::BackwardEuler,
            Update::Midpoint => StateUpdate::Midpoint,
        });
    Ok(match arguments.coupling() {
        Coupling::FixedPoint => Box::new(simulation.with_coupling(FixedPoint::paper())),
        Coupling::Accelerated => Box::new(simulation.with_coupling(FixedPoint::accelerated())),
        Coupling::Monolithic => Box::new(simulation.with_coupling(Monolithic::default())),
        Coupling::Staggered => Box::new(simulation.with_coupling(Staggered::default())),
    })
}
