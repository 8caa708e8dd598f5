//! Heat and fluid across a fault, against closed forms and solutions of others.

mod closed_forms;
mod extremes;
mod inputs;
mod slip;
mod vertices;
mod zones;
