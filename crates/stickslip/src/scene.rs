//! What is simulated: operators, friction, state, boundary data, loads, the initial state.

use nalgebra::SVector;
use stickslip_friction::{FrictionLaw, Nodal, Tresca};
use stickslip_state::StateLaw;
use stickslip_tnnmg::Operator;

use crate::Patch;

/// A body with friction on a part of its boundary.
///
/// Built step by step; what is left out is neither stored nor computed: without
/// [`with_mass`](Scene::with_mass) the scene is quasi-static, without
/// [`with_state`](Scene::with_state) it holds no state. Everything is checked when a
/// [`Simulation`](crate::Simulation) is made of it.
///
/// | part | needed | default |
/// | --- | --- | --- |
/// | stiffness `A` | always | |
/// | mass `M` | for inertia | quasi-static |
/// | viscosity `C` | for Kelvin-Voigt or radiation damping | none |
/// | load `l` | | zero |
/// | friction law, normal stress | for friction | no frictional boundary |
/// | cohesion, normal stress in time | | zero, constant |
/// | state law, initial state | where the friction law reads a state | no state |
/// | held and moved components | | all free |
/// | initial `u`, `v`, `a` | | zero |
///
/// ```
/// use nalgebra::SMatrix;
/// use stickslip::friction::Tresca;
/// use stickslip::{Newmark, Patch, Point, Scene, Simulation, Stepper};
///
/// // A block of 1 m^2 on a spring of 1 MN/m that is pulled at 1 mm/s: Coulomb's stick and slide.
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let (stiffness, load_velocity) = (1e6, 1e-3);
/// let scene = Scene::new(SMatrix::<f64, 1, 1>::new(stiffness))
///     .with_friction(Patch::point(1.0), Tresca { coefficient: 0.6 }, 1e5)
///     .with_load_history(move |time, load| load[0][0] = stiffness * load_velocity * time);
/// let mut simulation = Simulation::new(scene, Newmark::default(), Point)?;
/// simulation.run(100, 1.0, &mut |_| ())?;
/// let slid = simulation.snapshot().displacement[0][0];
/// assert!((slid - (100.0 * load_velocity - 0.6 * 1e5 / stiffness)).abs() < 1e-3);
/// # Ok(())
/// # }
/// ```
pub struct Scene<Op, L: FrictionLaw, S: StateLaw, const C: usize> {
    pub(crate) stiffness: Op,
    pub(crate) mass: Option<Op>,
    pub(crate) viscosity: Option<Op>,
    pub(crate) load: Load<C>,
    pub(crate) friction: Friction<L>,
    pub(crate) state: State<S>,
    pub(crate) held: Vec<(Patch, [bool; C])>,
    pub(crate) moved: Vec<Moved<C>>,
    pub(crate) initial: Initial<C>,
}

/// Fills a load, one vector a vertex \[N\], for a time \[s\].
type LoadHistory<const C: usize> = Box<dyn Fn(f64, &mut [SVector<f64, C>])>;

/// The external forces.
pub(crate) enum Load<const C: usize> {
    None,
    Constant(Vec<SVector<f64, C>>),
    History(LoadHistory<C>),
}

/// Sets the normal stress of the frictional vertices \[Pa\] for a time \[s\].
type StressHistory = Box<dyn Fn(f64, &mut [f64])>;

/// Where friction acts, by which law, under which normal stress and with which cohesion \[Pa\].
pub(crate) struct Friction<L> {
    pub(crate) patch: Option<Patch>,
    pub(crate) law: Nodal<L>,
    pub(crate) normal_stress: Nodal<f64>,
    pub(crate) stress_history: Option<StressHistory>,
    pub(crate) cohesion: Nodal<f64>,
}

/// How the state evolves, and from where.
pub(crate) struct State<S: StateLaw> {
    pub(crate) law: Nodal<S>,
    pub(crate) initial: Nodal<S::State>,
}

/// Components with a prescribed velocity.
pub(crate) struct Moved<const C: usize> {
    pub(crate) patch: Patch,
    pub(crate) components: [bool; C],
    pub(crate) velocity: Box<dyn Fn(f64) -> [f64; C]>,
}

/// The state of motion at time zero; an empty field is zero.
pub(crate) struct Initial<const C: usize> {
    pub(crate) in_equilibrium: bool,
    pub(crate) displacement: Vec<SVector<f64, C>>,
    pub(crate) velocity: Vec<SVector<f64, C>>,
    pub(crate) acceleration: Vec<SVector<f64, C>>,
}

impl<Op: Operator<C>, const C: usize> Scene<Op, Tresca, (), C> {
    /// A body with the stiffness matrix `A` [N/m]; no friction, mass, load or support yet.
    pub fn new(stiffness: Op) -> Self {
        Self {
            stiffness,
            mass: None,
            viscosity: None,
            load: Load::None,
            friction: Friction {
                patch: None,
                law: Nodal::Uniform(Tresca { coefficient: 0.0 }),
                normal_stress: Nodal::Uniform(0.0),
                stress_history: None,
                cohesion: Nodal::Uniform(0.0),
            },
            state: State {
                law: Nodal::Uniform(()),
                initial: Nodal::Uniform(()),
            },
            held: Vec::new(),
            moved: Vec::new(),
            initial: Initial {
                in_equilibrium: false,
                displacement: Vec::new(),
                velocity: Vec::new(),
                acceleration: Vec::new(),
            },
        }
    }
}

impl<Op, L: FrictionLaw, S: StateLaw, const C: usize> Scene<Op, L, S, C> {
    /// Friction on `patch` by `law` (one, or one a vertex) under a normal stress \[Pa\] (one, or one
    /// a vertex), of which only the modulus enters.
    ///
    /// With a law a vertex the type must be named: `with_friction::<Tresca>(&bottom, laws, stress)`.
    pub fn with_friction<M: FrictionLaw>(
        self,
        patch: impl Into<Patch>,
        law: impl Into<Nodal<M>>,
        normal_stress: impl Into<Nodal<f64>>,
    ) -> Scene<Op, M, S, C> {
        Scene {
            friction: Friction {
                patch: Some(patch.into()),
                law: law.into(),
                normal_stress: normal_stress.into(),
                stress_history: self.friction.stress_history,
                cohesion: self.friction.cohesion,
            },
            stiffness: self.stiffness,
            mass: self.mass,
            viscosity: self.viscosity,
            load: self.load,
            state: self.state,
            held: self.held,
            moved: self.moved,
            initial: self.initial,
        }
    }

    /// A part of the strength that no normal stress causes, and no state: the traction is
    /// `c + mu abs(sigma_n)` \[Pa\], with `c >= 0` (one, or one a vertex).
    #[must_use]
    pub fn with_cohesion(mut self, cohesion: impl Into<Nodal<f64>>) -> Self {
        self.friction.cohesion = cohesion.into();
        self
    }

    /// A normal stress that depends on time: `history` overwrites one value a frictional vertex
    /// \[Pa\], that of [`with_friction`](Scene::with_friction) when it is called, for the time \[s\]
    /// given. Only the modulus enters.
    #[must_use]
    pub fn with_normal_stress_history(
        mut self,
        history: impl Fn(f64, &mut [f64]) + 'static,
    ) -> Self {
        self.friction.stress_history = Some(Box::new(history));
        self
    }

    /// A state that evolves by `law` (one, or one a vertex) from `initial` (one, or one a vertex).
    ///
    /// The friction law must read this kind of state, or a simulation does not compile.
    pub fn with_state<T: StateLaw>(
        self,
        law: impl Into<Nodal<T>>,
        initial: impl Into<Nodal<T::State>>,
    ) -> Scene<Op, L, T, C> {
        Scene {
            state: State {
                law: law.into(),
                initial: initial.into(),
            },
            stiffness: self.stiffness,
            mass: self.mass,
            viscosity: self.viscosity,
            load: self.load,
            friction: self.friction,
            held: self.held,
            moved: self.moved,
            initial: self.initial,
        }
    }

    /// Inertia with the mass matrix `M` \[kg\].
    #[must_use]
    pub fn with_mass(mut self, mass: Op) -> Self {
        self.mass = Some(mass);
        self
    }

    /// A force `C v` against the motion, with the viscosity matrix `C` [N s/m], symmetric and
    /// positive semidefinite: Kelvin-Voigt viscosity of the body, or radiation damping.
    #[must_use]
    pub fn with_viscosity(mut self, viscosity: Op) -> Self {
        self.viscosity = Some(viscosity);
        self
    }

    /// A constant load, one vector a vertex \[N\].
    #[must_use]
    pub fn with_load(mut self, load: Vec<SVector<f64, C>>) -> Self {
        self.load = Load::Constant(load);
        self
    }

    /// A load that depends on time: `history` fills one vector a vertex \[N\], all zero when it is
    /// called, for the time \[s\] given.
    #[must_use]
    pub fn with_load_history(
        mut self,
        history: impl Fn(f64, &mut [SVector<f64, C>]) + 'static,
    ) -> Self {
        self.load = Load::History(Box::new(history));
        self
    }

    /// Keeps the marked components of the velocity at zero on `patch`.
    #[must_use]
    pub fn hold(mut self, patch: impl Into<Patch>, components: [bool; C]) -> Self {
        self.held.push((patch.into(), components));
        self
    }

    /// Prescribes the marked components of the velocity [m/s] on `patch` as a function of time \[s\].
    #[must_use]
    pub fn move_at(
        mut self,
        patch: impl Into<Patch>,
        components: [bool; C],
        velocity: impl Fn(f64) -> [f64; C] + 'static,
    ) -> Self {
        self.moved.push(Moved {
            patch: patch.into(),
            components,
            velocity: Box::new(velocity),
        });
        self
    }

    /// Starts from the displacement that balances the load of time zero without friction, with
    /// held and moved components at zero.
    #[must_use]
    pub fn in_equilibrium(mut self) -> Self {
        self.initial.in_equilibrium = true;
        self
    }

    /// Starts from this displacement, one vector a vertex \[m\].
    #[must_use]
    pub fn with_displacement(mut self, displacement: Vec<SVector<f64, C>>) -> Self {
        self.initial.displacement = displacement;
        self
    }

    /// Starts from this velocity, one vector a vertex [m/s].
    #[must_use]
    pub fn with_velocity(mut self, velocity: Vec<SVector<f64, C>>) -> Self {
        self.initial.velocity = velocity;
        self
    }

    /// Starts from this acceleration, one vector a vertex [m/s^2]; no use without mass.
    #[must_use]
    pub fn with_acceleration(mut self, acceleration: Vec<SVector<f64, C>>) -> Self {
        self.initial.acceleration = acceleration;
        self
    }
}
