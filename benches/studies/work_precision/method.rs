//! The methods that are compared on bodies.

use stickslip::fem::P1;
use stickslip::{
    BackwardEuler, BlockMatrix, CentralDifferences, Condensed, DenseNewton, Diagonal, FixedPoint,
    GeneralizedAlpha, Monolithic, Newmark, NonsmoothSolver, RateScheme, Scene, SceneError, Sdirk2,
    Simulation, Staggered, StateUpdate, Symmetric, Tnnmg,
};

type AnySolver<const C: usize> = Box<dyn NonsmoothSolver<BlockMatrix<C>, C>>;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Scheme {
    Newmark,
    BackwardEuler,
    Sdirk2,
    /// With a spectral radius of 0.8.
    GeneralizedAlpha,
    /// With a lumped mass, a diagonal solver and the staggered coupling, whatever else is chosen.
    CentralDifferences,
}

/// A way to go through time.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Method {
    pub(crate) scheme: Scheme,
    pub(crate) update: StateUpdate,
    pub(crate) monolithic: bool,
    pub(crate) tnnmg: bool,
    /// Reduce the body to its contact and its modes up to this frequency \[Hz\].
    pub(crate) reduced: Option<f64>,
    /// Adapt the step; the setting then is the tolerance, else the step \[s\].
    pub(crate) adaptive: bool,
}

/// Generalised-alpha with the midpoint state, rate and state at once, condensed.
pub(crate) const PLAIN: Method = Method {
    scheme: Scheme::GeneralizedAlpha,
    update: StateUpdate::Midpoint,
    monolithic: true,
    tnnmg: false,
    reduced: None,
    adaptive: false,
};
/// The pairing of the paper, rate and state at once, condensed.
pub(crate) const PAPER: Method = Method {
    scheme: Scheme::Newmark,
    update: StateUpdate::BackwardEuler,
    ..PLAIN
};
pub(crate) const EXPLICIT: Method = Method {
    scheme: Scheme::CentralDifferences,
    ..PLAIN
};
/// Generalised-alpha with steps that adapt.
pub(crate) const ADAPTIVE: Method = Method {
    adaptive: true,
    ..PLAIN
};

/// The schemes of second order that are compared at constant and at adaptive steps, by name.
pub(crate) const SECOND_ORDER: [(&str, Scheme); 3] = [
    ("Newmark", Scheme::Newmark),
    ("generalised-alpha", Scheme::GeneralizedAlpha),
    ("Sdirk2", Scheme::Sdirk2),
];

impl Method {
    /// The same with another scheme.
    pub(crate) fn by(self, scheme: Scheme) -> Self {
        Self { scheme, ..self }
    }

    /// The same with rate and state in turn.
    pub(crate) fn alternating(self) -> Self {
        Self {
            monolithic: false,
            ..self
        }
    }

    /// The same with velocity problems solved by multigrid.
    pub(crate) fn with_tnnmg(self) -> Self {
        Self {
            tnnmg: true,
            ..self
        }
    }

    /// The same on the body reduced to its contact, with modes up to a frequency \[Hz\].
    pub(crate) fn reduced_to(self, frequency: f64) -> Self {
        Self {
            reduced: Some(frequency),
            ..self
        }
    }

    /// Whether the mass is to be lumped.
    pub(crate) fn is_lumped(self) -> bool {
        self.scheme == Scheme::CentralDifferences
    }

    /// A scene in motion by this method.
    pub(crate) fn simulate<const C: usize>(
        self,
        scene: Scene<BlockMatrix<C>, C>,
        space: &P1<2>,
    ) -> Result<Simulation<C>, SceneError> {
        let simulation = Simulation::new(scene, self.rate_scheme(), self.solver(space))?;
        Ok(self.coupled(simulation))
    }

    /// A reduced scene in motion by this method.
    pub(crate) fn simulate_reduced<const C: usize>(
        self,
        scene: Scene<Symmetric<C>, C>,
    ) -> Result<Simulation<C>, SceneError> {
        let simulation = Simulation::new(scene, self.rate_scheme(), DenseNewton::new())?;
        Ok(self.coupled(simulation))
    }

    fn coupled<const C: usize>(self, simulation: Simulation<C>) -> Simulation<C> {
        let simulation = simulation.with_state_update(self.update);
        match self.scheme {
            Scheme::CentralDifferences => simulation.with_coupling(Staggered::default()),
            _ if self.monolithic => simulation.with_coupling(Monolithic::default()),
            _ => simulation.with_coupling(FixedPoint::paper()),
        }
    }

    fn rate_scheme(self) -> Box<dyn RateScheme> {
        match self.scheme {
            Scheme::Newmark => Box::new(Newmark::default()),
            Scheme::BackwardEuler => Box::new(BackwardEuler),
            Scheme::Sdirk2 => Box::new(Sdirk2),
            Scheme::GeneralizedAlpha => Box::new(GeneralizedAlpha::default()),
            Scheme::CentralDifferences => Box::new(CentralDifferences),
        }
    }

    fn solver<const C: usize>(self, space: &P1<2>) -> AnySolver<C> {
        if self.is_lumped() {
            Box::new(Diagonal::new())
        } else if self.tnnmg {
            Box::new(Tnnmg::new(space.transfers()))
        } else {
            Box::new(Condensed::new())
        }
    }
}
