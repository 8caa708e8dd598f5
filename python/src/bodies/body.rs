//! A body with its boundary conditions.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use stickslip::fem::{Elastic, antiplane, elasticity};
use stickslip::{FixedPoint, Monolithic, StateUpdate};

use super::condition::{Condition, Velocity};
use super::friction::{Contact, Laws, More, PerVertex, Pressure};
use super::mesh::{AnySpace, Mesh};
use super::part::{AnyTrace, Part};
use super::reduced::Modes;
use super::simulation::{AnyStepper, BodySimulation};
use super::start::{Start, scheme_of};
use crate::arguments::{named, non_negative, positive};
use crate::errors::{self, argument};
use crate::exit::Call;
use crate::fields::{AnyField, Cells, Fields};
use crate::laws::{Evolution, Friction, Further, given, parameters};
use crate::memory::{REDUCED_PAIR, check_memory};
use crate::raised::Raised;

/// An elastic body on a mesh, in plane strain, antiplane strain or space:
///
///     density u'' - div sigma(u) = density gravity,    friction where contacts are
///
/// Args:
///     mesh: a Mesh.
///     E: Young's modulus [Pa], > 0.
///     nu: Poisson's ratio, > -1 and < 0.5.
///     density: [kg/m^3], >= 0; 0 is quasi-static.
///     gravity: acceleration [m/s^2], one component per direction.
///     antiplane: motion out of the plane only, with the shear modulus E/(2 (1 + nu)).
#[pyclass(module = "stickslip")]
pub(crate) struct Body {
    space: AnySpace,
    elastic: Elastic,
    pub(super) density: f64,
    pub(super) gravity: Vec<f64>,
    antiplane: bool,
    pub(super) conditions: Vec<Condition>,
    pub(super) contacts: Vec<Contact>,
}

#[pymethods]
impl Body {
    #[new]
    #[pyo3(signature = (mesh, *, E, nu, density=0.0, gravity=None, antiplane=false))]
    #[expect(non_snake_case, reason = "names of the field")]
    fn new(
        #[pyo3(from_py_with = named)] mesh: Bound<'_, Mesh>,
        #[pyo3(from_py_with = named)] E: f64,
        #[pyo3(from_py_with = named)] nu: f64,
        #[pyo3(from_py_with = named)] density: f64,
        #[pyo3(from_py_with = named)] gravity: Option<Vec<f64>>,
        #[pyo3(from_py_with = named)] antiplane: bool,
    ) -> PyResult<Self> {
        let elastic = Elastic {
            young_modulus: positive("E", E)?,
            poisson_ratio: (-1.0 < nu && nu < 0.5)
                .then_some(nu)
                .ok_or_else(|| argument("nu", "a Poisson's ratio > -1 and < 0.5", nu))?,
        };
        let space = mesh.get().space.clone();
        if antiplane && matches!(space, AnySpace::Space(_)) {
            return Err(argument(
                "antiplane",
                "false for a mesh in space",
                antiplane,
            ));
        }
        let mut body = Self {
            space,
            elastic,
            density: non_negative("density", density)?,
            gravity: Vec::new(),
            antiplane,
            conditions: Vec::new(),
            contacts: Vec::new(),
        };
        if let Some(gravity) = gravity {
            if gravity.len() != body.components() || gravity.iter().any(|g| !g.is_finite()) {
                let requirement = format!("of {} finite components", body.components());
                return Err(argument("gravity", &requirement, gravity));
            }
            body.gravity = gravity;
        }
        Ok(body)
    }

    /// Fixes a part.
    ///
    /// Args:
    ///     part: a Part of the body's mesh.
    ///     components: the letters of the fixed components, such as "x" or "xy"; by default all.
    #[pyo3(signature = (part, components=None))]
    fn fix(
        &mut self,
        #[pyo3(from_py_with = named)] part: Bound<'_, Part>,
        #[pyo3(from_py_with = named)] components: Option<&str>,
    ) -> PyResult<()> {
        let part = part.get();
        self.check(part, "part")?;
        let count = self.components();
        self.conditions
            .push(Condition::new(count, part, components, None)?);
        Ok(())
    }

    /// Prescribes the velocity of a part.
    ///
    /// Args:
    ///     part: a Part of the body's mesh.
    ///     velocity: its components [m/s], or a function of time [s] that returns them. It is called in every step.
    ///     components: the letters of the driven components; by default all.
    #[pyo3(signature = (part, velocity, components=None))]
    fn drive(
        &mut self,
        #[pyo3(from_py_with = named)] part: Bound<'_, Part>,
        #[pyo3(from_py_with = named)] velocity: Velocity,
        #[pyo3(from_py_with = named)] components: Option<&str>,
    ) -> PyResult<()> {
        let part = part.get();
        self.check(part, "part")?;
        let (count, velocity) = (self.components(), Some(velocity));
        self.conditions
            .push(Condition::new(count, part, components, velocity)?);
        Ok(())
    }

    /// Rate- and state-dependent friction of a part on a rigid surface, or on the opposite side of a split fault.
    ///
    /// Args:
    ///     part: a Part of the body's mesh; of a fault its plus side.
    ///     opposite: the minus side, for a fault inside the body.
    ///     normal_stress: [Pa], a number or one per vertex, positive in compression; or "body", that of the deformation.
    ///     a, b, Dc, mu0, V0, friction, law: as of SpringSlider; laws of your own, too.
    ///     theta: state at time 0 [s], > 0, a number or one per vertex.
    ///     cohesion: [Pa], >= 0.
    ///     allow_opening: under tension the strength is the cohesion, and sides under the normal stress of the body part;
    ///         else tension is an error.
    ///     fields: ThermalPressurization or ShearHeating of its vertices.
    #[pyo3(signature = (part, *, normal_stress, a=None, b=None, Dc=None, mu0=0.6, V0=1e-6, theta, opposite=None,
                        friction=None, law=None, cohesion=0.0, allow_opening=false, fields=Vec::new()),
           text_signature = "($self, part, *, normal_stress, a=None, b=None, Dc=None, mu0=0.6, V0=1e-06, theta, opposite=None, friction='cut-off', law='aging', cohesion=0.0, allow_opening=False, fields=[])")]
    #[expect(non_snake_case, reason = "names of the field")]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn contact(
        &mut self,
        #[pyo3(from_py_with = named)] part: Bound<'_, Part>,
        #[pyo3(from_py_with = named)] normal_stress: Pressure,
        #[pyo3(from_py_with = named)] a: Option<f64>,
        #[pyo3(from_py_with = named)] b: Option<f64>,
        #[pyo3(from_py_with = named)] Dc: Option<f64>,
        #[pyo3(from_py_with = named)] mu0: f64,
        #[pyo3(from_py_with = named)] V0: f64,
        #[pyo3(from_py_with = named)] theta: PerVertex,
        #[pyo3(from_py_with = named)] opposite: Option<Bound<'_, Part>>,
        friction: Option<&Bound<'_, PyAny>>,
        law: Option<&Bound<'_, PyAny>>,
        #[pyo3(from_py_with = named)] cohesion: f64,
        #[pyo3(from_py_with = named)] allow_opening: bool,
        #[pyo3(from_py_with = named)] fields: Vec<AnyField>,
    ) -> PyResult<()> {
        let _call = Call::begin()?;
        let parameters = || {
            let fitted = [given("a", a)?, given("b", b)?, given("Dc", Dc)?];
            parameters(fitted, [mu0, V0])
        };
        let positive = |theta: f64| theta > 0.0 && theta.is_finite();
        let theta = theta.checked("theta", part.get().count(), "finite and positive", positive)?;
        let laws = Laws::RateAndState(
            match friction {
                Some(friction) => Friction::of(friction, parameters)?,
                None => Friction::named("cut-off", parameters()?)?,
            },
            match law {
                Some(law) => Evolution::of(law, parameters, Further::default())?,
                None => Evolution::named("aging", &parameters()?, Further::default())?,
            },
            theta,
        );
        self.add(
            (part.get(), opposite.as_ref().map(Bound::get)),
            laws,
            normal_stress,
            (cohesion, allow_opening, &fields),
        )
    }

    /// Friction with a constant coefficient; the other arguments as of `contact`.
    ///
    /// Args:
    ///     coefficient: of friction, >= 0.
    #[pyo3(signature = (part, *, normal_stress, coefficient, opposite=None, cohesion=0.0, allow_opening=false,
                        fields=Vec::new()),
           text_signature = "($self, part, *, normal_stress, coefficient, opposite=None, cohesion=0.0, allow_opening=False, fields=[])")]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn coulomb(
        &mut self,
        #[pyo3(from_py_with = named)] part: Bound<'_, Part>,
        #[pyo3(from_py_with = named)] normal_stress: Pressure,
        #[pyo3(from_py_with = named)] coefficient: f64,
        #[pyo3(from_py_with = named)] opposite: Option<Bound<'_, Part>>,
        #[pyo3(from_py_with = named)] cohesion: f64,
        #[pyo3(from_py_with = named)] allow_opening: bool,
        #[pyo3(from_py_with = named)] fields: Vec<AnyField>,
    ) -> PyResult<()> {
        let laws = Laws::Coulomb(non_negative("coefficient", coefficient)?);
        self.add(
            (part.get(), opposite.as_ref().map(Bound::get)),
            laws,
            normal_stress,
            (cohesion, allow_opening, &fields),
        )
    }

    /// A simulation of the body from its initial state.
    ///
    /// Args:
    ///     scheme: "generalized-alpha", "newmark", "backward-euler" or "sdirk2".
    ///     solver: "condensed", a direct factorisation, or "tnnmg", multigrid on refined meshes.
    ///     equilibrium: whether it starts in equilibrium with its weight, contacts stuck; else without displacement.
    ///     zero_acceleration: whether the initial acceleration is zero instead of consistent with the forces.
    ///     coupling: of rate and state in a step: "monolithic", or "fixed-point" as in the paper.
    ///     state_update: "midpoint", of order 2, or "backward-euler" as in the paper; by default that of the scheme.
    ///     tolerance: of a step, relative to the forces, > 0.
    ///     absolute_tolerance: of a step in rates [m/s], in the place of tolerance.
    ///     reduced_up_to: Craig-Bampton reduction to the contacts and to the modes up to this frequency [Hz]: the cost of a
    ///         step depends on the number of vertices in contact, whose normal stress is prescribed. A body without
    ///         density has no modes, and is exact.
    ///     reduced_for_step: the same with the modes that steps of this size resolve [s], in the place of reduced_up_to.
    #[pyo3(signature = (*, scheme="generalized-alpha", solver="condensed", equilibrium=false, zero_acceleration=false,
                        coupling="monolithic", state_update=None, tolerance=None, absolute_tolerance=None,
                        reduced_up_to=None, reduced_for_step=None))]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn simulation(
        &self,
        py: Python<'_>,
        #[pyo3(from_py_with = named)] scheme: &str,
        #[pyo3(from_py_with = named)] solver: &str,
        #[pyo3(from_py_with = named)] equilibrium: bool,
        #[pyo3(from_py_with = named)] zero_acceleration: bool,
        #[pyo3(from_py_with = named)] coupling: &str,
        #[pyo3(from_py_with = named)] state_update: Option<&str>,
        #[pyo3(from_py_with = named)] tolerance: Option<f64>,
        #[pyo3(from_py_with = named)] absolute_tolerance: Option<f64>,
        #[pyo3(from_py_with = named)] reduced_up_to: Option<f64>,
        #[pyo3(from_py_with = named)] reduced_for_step: Option<f64>,
    ) -> PyResult<BodySimulation> {
        let _call = Call::begin()?;
        let multigrid = match solver {
            "condensed" => false,
            "tnnmg" => true,
            _ => return Err(argument("solver", "\"condensed\" or \"tnnmg\"", solver)),
        };
        let modes = match (reduced_up_to, reduced_for_step) {
            (None, None) => None,
            (Some(frequency), None) if frequency > 0.0 => Some(Modes::UpTo(frequency)),
            (Some(frequency), None) => {
                return Err(argument("reduced_up_to", "positive", frequency));
            }
            (None, Some(dt)) => Some(Modes::ForStep(positive("reduced_for_step", dt)?)),
            (Some(_), Some(_)) => {
                let text = "give reduced_up_to or reduced_for_step, one of them";
                return Err(PyValueError::new_err(text));
            }
        };
        if multigrid && modes.is_some() {
            return Err(argument(
                "solver",
                "\"condensed\" for a reduced body",
                solver,
            ));
        }
        if modes.is_some() {
            let vertices = self.contacts.iter().map(|contact| contact.count);
            let unknowns = vertices.sum::<usize>() * self.components();
            let name = match reduced_up_to {
                Some(_) => "reduced_up_to",
                None => "reduced_for_step",
            };
            check_memory(name, &[unknowns, unknowns], REDUCED_PAIR)?;
        }
        let start = Start {
            scheme: scheme_of(scheme)?,
            multigrid,
            modes,
            equilibrium,
            zero_acceleration,
            coupling: match coupling {
                "monolithic" => Box::new(Monolithic::default()),
                "fixed-point" => Box::new(FixedPoint::paper()),
                _ => {
                    let names = "\"monolithic\" or \"fixed-point\"";
                    return Err(argument("coupling", names, coupling));
                }
            },
            state_update: match state_update {
                None => None,
                Some("midpoint") => Some(StateUpdate::Midpoint),
                Some("backward-euler") => Some(StateUpdate::BackwardEuler),
                Some(other) => {
                    let names = "None, \"midpoint\" or \"backward-euler\"";
                    return Err(argument("state_update", names, other));
                }
            },
            tolerance: (tolerance.map(|x| positive("tolerance", x))).transpose()?,
            absolute_tolerance: (absolute_tolerance.map(|x| positive("absolute_tolerance", x)))
                .transpose()?,
        };
        let raised = Raised::default();
        let made = match &self.space {
            AnySpace::Plane(space) if self.antiplane => {
                let modulus =
                    self.elastic.young_modulus / (2.0 * (1.0 + self.elastic.poisson_ratio));
                let stiffness = antiplane(space, modulus);
                start
                    .begin(self, space, stiffness, &raised)
                    .map(AnyStepper::Antiplane)
            }
            AnySpace::Plane(space) => {
                let stiffness = elasticity(space, &self.elastic);
                start
                    .begin(self, space, stiffness, &raised)
                    .map(AnyStepper::Plane)
            }
            AnySpace::Space(space) => {
                let stiffness = elasticity(space, &self.elastic);
                start
                    .begin(self, space, stiffness, &raised)
                    .map(AnyStepper::Space)
            }
        };
        if let Some(error) = raised.take() {
            return Err(error);
        }
        let stepper = made.map_err(|error| errors::scene(py, &error))?;
        Ok(BodySimulation::new(stepper, raised))
    }
}

impl Body {
    /// The number of components of a velocity.
    fn components(&self) -> usize {
        match self.space {
            AnySpace::Plane(_) if self.antiplane => 1,
            AnySpace::Plane(_) => 2,
            AnySpace::Space(_) => 3,
        }
    }

    /// Refuses a part of a mesh of another dimension; one of another mesh is refused by the scene.
    fn check(&self, part: &Part, name: &str) -> PyResult<()> {
        match (&self.space, &part.trace) {
            (AnySpace::Plane(_), AnyTrace::Plane(_)) | (AnySpace::Space(_), AnyTrace::Space(_)) => {
                Ok(())
            }
            _ => Err(argument(
                name,
                "a part of the body's mesh",
                "one of another dimension",
            )),
        }
    }

    fn add(
        &mut self,
        (part, opposite): (&Part, Option<&Part>),
        laws: Laws,
        normal_stress: Pressure,
        (cohesion, opens, fields): (f64, bool, &[AnyField]),
    ) -> PyResult<()> {
        self.check(part, "part")?;
        if let Some(opposite) = opposite {
            self.check(opposite, "opposite")?;
        }
        let cohesion = non_negative("cohesion", cohesion)?;
        let count = part.count();
        let stress = normal_stress.stress(count)?;
        let more = More {
            cohesion,
            opens,
            fields: Fields::on(fields, &Cells::apart("a contact of a body", count))?,
        };
        let parts = (part, opposite);
        self.contacts.push(Contact::new(parts, laws, stress, more));
        Ok(())
    }
}
