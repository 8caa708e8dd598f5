//! A block on a spring: one point, no mesh, no matrix.
//!
//! Its laws have parameters of the order measured on granite and its gouge. Source: C. Marone, "Laboratory-derived
//! friction laws and their application to seismic faulting", Annu. Rev. Earth Planet. Sci. 26 (1998).

mod load_path;

pub use load_path::LoadPath;

use nalgebra::{SMatrix, SVector};
use stickslip_friction::{DieterichRuina, FrictionLaw};
use stickslip_state::{Dieterich, Reads, StateError, StateLaw, StateVariable, increasing_root};

use crate::{BoundaryPart, Contact, Scene, SceneError};

/// Dieterich-Ruina friction, velocity weakening: `a < b`.
pub const FRICTION: DieterichRuina = DieterichRuina {
    a: 0.010,
    b: 0.015,
    reference_friction: 0.6,
    reference_velocity: 1e-6,
    slip_distance: 1e-5,
};

/// The aging law, with the characteristic slip distance of [`FRICTION`].
pub const AGING: Dieterich = Dieterich {
    slip_distance: 1e-5,
};

/// A block of 1 m^2 on a rigid surface under a normal stress. A spring pulls it, and the other end of the spring, the
/// load point, moves at a prescribed velocity:
///
/// ```text
/// m u'' + eta u' + tau(V, alpha) = K (x(t) - u)
/// ```
///
/// | | `mass` | `damping` |
/// | --- | --- | --- |
/// | quasi-static | 0 | 0 |
/// | with radiation damping ("quasi-dynamic") | 0 | `G/(2 c_s)` |
/// | with inertia | positive | any |
///
/// It starts in steady sliding, or at any rate with any state, with the spring stretched to balance friction. Terms
/// that are zero are omitted from the scene.
///
/// ```
/// use stickslip::problems::spring_slider::{AGING, FRICTION, LoadPath, SpringSlider};
/// use stickslip::{GeneralizedAlpha, Point, Simulation, Steps};
///
/// // A velocity step from 1 to 10 um/s at 10 s.
/// let slider = SpringSlider {
///     stiffness: 1e9,
///     normal_stress: 1e6,
///     mass: 0.0,
///     damping: 0.0,
///     load: LoadPath::steady(1e-6).then(10.0, 1e-5),
/// };
/// let scene = slider.steady(FRICTION, AGING, 1e-6)?;
/// let mut simulation = Simulation::new(scene, GeneralizedAlpha::default(), Point)?;
/// let steps = Steps::adaptive(1e-5).until(100.0).stopping_at(slider.load.kinks());
/// simulation.run(&steps, |_| ())?;
/// assert!((simulation.snapshot().max_slip_rate() / 1e-5 - 1.0).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct SpringSlider {
    /// `K` [Pa/m].
    pub stiffness: f64,
    /// `sigma_n` \[Pa\].
    pub normal_stress: f64,
    /// `m`, per area [kg/m^2].
    pub mass: f64,
    /// `eta` [Pa s/m].
    #[doc(alias = "radiation damping")]
    pub damping: f64,
    /// The motion of the load point.
    pub load: LoadPath,
}

/// The scene of a block on a spring with its laws.
pub type SpringScene = Scene<SMatrix<f64, 1, 1>, 1>;

impl SpringSlider {
    /// The critical stiffness of a quasi-static slider, `(b - a) sigma_n / L` [Pa/m]: steady sliding on a softer spring
    /// is unstable.
    pub fn critical_stiffness(normal_stress: f64, a: f64, b: f64, slip_distance: f64) -> f64 {
        (b - a) * normal_stress.abs() / slip_distance
    }

    /// The scene that starts in steady sliding at `slip_rate` > 0 [m/s].
    ///
    /// # Errors
    /// [`SceneError::State`] where the state law has no steady state at this rate, and the errors of
    /// [`scene`](Self::scene).
    pub fn steady<L, S>(
        &self,
        friction: L,
        law: S,
        slip_rate: f64,
    ) -> Result<SpringScene, SceneError>
    where
        L: FrictionLaw + 'static,
        S: StateLaw + 'static,
        L::State: Reads<S::State>,
    {
        let state = steady_state(&law, slip_rate)?;
        self.scene(friction, law, slip_rate, state)
    }

    /// The scene that starts at `slip_rate` >= 0 [m/s] with the state `state`.
    ///
    /// # Errors
    /// [`SceneError::Value`] for a stiffness that is not positive, and for mass, damping or slip
    /// rate below zero or not finite, and for a load path that goes back in time; [`SceneError::State`] for a
    /// state out of its range.
    pub fn scene<L, S>(
        &self,
        friction: L,
        law: S,
        slip_rate: f64,
        state: S::State,
    ) -> Result<SpringScene, SceneError>
    where
        L: FrictionLaw + 'static,
        S: StateLaw + 'static,
        L::State: Reads<S::State>,
    {
        for (what, value) in [
            ("mass", self.mass),
            ("damping", self.damping),
            ("slip rate", slip_rate),
        ] {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(illegal(what, "finite and non-negative", value));
            }
        }
        if !(self.stiffness > 0.0 && self.stiffness.is_finite()) {
            return Err(illegal("stiffness", "finite and positive", self.stiffness));
        }
        self.load.validate()?;
        law.validate_state(state)?;
        let &Self {
            stiffness,
            normal_stress,
            mass,
            damping,
            ..
        } = self;
        let traction = normal_stress.abs() * friction.coefficient(slip_rate, L::State::read(state));
        let stretch = (traction + damping * slip_rate) / stiffness;
        let load = self.load.clone();
        let contact =
            Contact::new(BoundaryPart::point(1.0), friction, normal_stress).with_state(law, state);
        let mut scene = Scene::new(SMatrix::<f64, 1, 1>::new(stiffness))
            .with_contact(contact)
            .with_load_history(move |time, force| force[0][0] = stiffness * load.position(time))
            .with_displacement(vec![SVector::from([-stretch])])
            .with_velocity(vec![SVector::from([slip_rate])]);
        if mass > 0.0 {
            scene = scene.with_mass(SMatrix::<f64, 1, 1>::new(mass));
        }
        if damping > 0.0 {
            scene = scene.with_viscosity(SMatrix::<f64, 1, 1>::new(damping));
        }
        Ok(scene)
    }
}

/// The steady state of `law` at a slip rate [m/s].
///
/// # Errors
/// [`StateError`] where it does not exist, or the slip rate is not positive.
pub fn steady_state<S: StateLaw>(law: &S, slip_rate: f64) -> Result<S::State, StateError> {
    law.validate()?;
    StateError::check_positive("slip rate [m/s]", slip_rate)?;
    let root = increasing_root(0.0, |value| {
        let state = S::State::from_value(value);
        (
            -law.evolution(state, slip_rate),
            -law.evolution_state_slope(state, slip_rate),
        )
    });
    root.map(S::State::from_value)
        .map_err(|error| error.in_step(0.0, slip_rate, f64::INFINITY))
}

fn illegal(what: &'static str, requirement: &'static str, value: f64) -> SceneError {
    SceneError::Value {
        what,
        requirement,
        position: 0,
        value,
    }
}
