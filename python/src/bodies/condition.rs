//! Dirichlet conditions.

use std::sync::Arc;

use pyo3::prelude::*;
use stickslip::{BlockMatrix, BoundaryPart, Components, Scene};

use super::friction::PerVertex;
use super::part::{AnyTrace, Part};
use crate::arguments::wrong_type;
use crate::errors::argument;
use crate::exit::attached;
use crate::raised::Raised;

/// A velocity: its components, or a function of time.
pub(super) enum Velocity {
    /// Components [m/s].
    Constant(Vec<f64>),
    /// A function of time \[s\].
    Function(Py<PyAny>),
}

impl<'a, 'py> FromPyObject<'a, 'py> for Velocity {
    type Error = PyErr;

    fn extract(given: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if given.is_callable() {
            return Ok(Self::Function(given.to_owned().unbind()));
        }
        match given.extract::<PerVertex>() {
            Ok(PerVertex::Uniform(value)) => Ok(Self::Constant(vec![value])),
            Ok(PerVertex::Each(values)) => Ok(Self::Constant(values)),
            _ => Err(wrong_type("components [m/s] or a function of time", &given)),
        }
    }
}

/// A fixed or driven part.
pub(super) struct Condition {
    part: BoundaryPart,
    components: Vec<bool>,
    velocity: Option<Arc<Velocity>>,
}

impl Condition {
    /// The condition on these components, all of them by default.
    pub(super) fn new(
        count: usize,
        part: &Part,
        components: Option<&str>,
        velocity: Option<Velocity>,
    ) -> PyResult<Self> {
        match &velocity {
            Some(Velocity::Constant(values))
                if values.len() != count || values.iter().any(|v| !v.is_finite()) =>
            {
                let requirement = format!("of {count} finite components");
                return Err(argument("velocity", &requirement, values));
            }
            _ => {}
        }
        let names = &"xyz"[..count];
        let components = components.unwrap_or(names);
        if components.is_empty() || components.chars().any(|c| !names.contains(c)) {
            let requirement = format!("of the letters {names:?}");
            return Err(argument("components", &requirement, components));
        }
        Ok(Self {
            part: boundary(part),
            components: names.chars().map(|c| components.contains(c)).collect(),
            velocity: velocity.map(Arc::new),
        })
    }

    /// The scene with this condition.
    pub(super) fn on<const C: usize>(
        &self,
        scene: Scene<BlockMatrix<C>, C>,
        raised: &Raised,
    ) -> Scene<BlockMatrix<C>, C> {
        let components = Components::from(std::array::from_fn(|c| self.components[c]));
        let Some(velocity) = &self.velocity else {
            return scene.fix(self.part.clone(), components);
        };
        let (velocity, raised) = (Arc::clone(velocity), raised.clone());
        scene.prescribe_velocity(
            self.part.clone(),
            components,
            move |time| match &*velocity {
                Velocity::Constant(values) => std::array::from_fn(|c| values[c]),
                Velocity::Function(function) => asked(function, time).unwrap_or_else(|error| {
                    raised.keep(error);
                    [f64::NAN; C]
                }),
            },
        )
    }
}

/// The value of a function of time.
fn asked<const C: usize>(function: &Py<PyAny>, time: f64) -> PyResult<[f64; C]> {
    attached(|py| {
        let value = function.bind(py).call1((time,))?;
        if C == 1
            && let Ok(one) = value.extract::<f64>()
        {
            return Ok([one; C]);
        }
        let values: Vec<f64> = value.extract()?;
        let given = format!("{values:?}");
        values.try_into().map_err(|_| {
            argument(
                "the value of velocity",
                &format!("of {C} components"),
                given,
            )
        })
    })
}

/// The part for a scene.
pub(super) fn boundary(part: &Part) -> BoundaryPart {
    match &part.trace {
        AnyTrace::Plane(trace) => trace.into(),
        AnyTrace::Space(trace) => trace.into(),
    }
}
