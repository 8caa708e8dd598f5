//! The parameters of a fit at one point: those of friction and machine, and those of the experiment.

use crate::parameter::Parameter;
use crate::parameters::Parameters;

/// The parameters of a curve.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Point {
    pub(crate) parameters: Parameters,
    /// The time by which the velocity changes are later than the history says \[s\].
    pub(crate) step_offset: f64,
    /// Friction at the first sample above that at the velocity of the load point.
    pub(crate) initial_stress: f64,
}

impl Point {
    /// Parameters, with steps at the times of the history and the slip rate of the load point at first.
    pub(crate) fn new(parameters: Parameters) -> Self {
        Self {
            parameters,
            step_offset: 0.0,
            initial_stress: 0.0,
        }
    }

    /// The value of a parameter.
    pub(crate) fn value(&self, parameter: Parameter) -> f64 {
        match parameter {
            Parameter::StepOffset => self.step_offset,
            Parameter::InitialStress => self.initial_stress,
            _ => parameter.of(&self.parameters),
        }
    }

    pub(crate) fn set(&mut self, parameter: Parameter, value: f64) {
        let parameters = &mut self.parameters;
        *match parameter {
            Parameter::A => &mut parameters.a,
            Parameter::B(i) => &mut parameters.states[i].b,
            Parameter::SlipDistance(i) => &mut parameters.states[i].slip_distance,
            Parameter::Stiffness => &mut parameters.stiffness,
            Parameter::InitialState(i) => &mut parameters.states[i].initial_state,
            Parameter::AgingVelocity(i) => &mut parameters.states[i].aging_velocity,
            Parameter::StressWeight(i) => &mut parameters.states[i].stress_weight,
            Parameter::ReferenceFriction => &mut parameters.reference_friction,
            Parameter::Trend => &mut parameters.trend,
            Parameter::StepOffset => &mut self.step_offset,
            Parameter::InitialStress => &mut self.initial_stress,
        } = value;
    }
}
