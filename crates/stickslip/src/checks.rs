//! What is wrong with a scene, found before its first step.

use nalgebra::SVector;
use stickslip_friction::{FrictionLaw, Nodal};
use stickslip_state::{StateLaw, StateVariable};
use stickslip_tnnmg::Operator;

use crate::scene::{Load, Scene};
use crate::{Patch, SceneError};

/// Checks a scene; returns the mask of components that are no unknowns.
pub(crate) fn check<Op: Operator<C>, L: FrictionLaw, S: StateLaw, const C: usize>(
    scene: &Scene<Op, L, S, C>,
) -> Result<Vec<[bool; C]>, SceneError> {
    let size = scene.stiffness.vertex_count();
    check_operator("stiffness matrix", &scene.stiffness, size)?;
    if let Some(mass) = &scene.mass {
        check_operator("mass matrix", mass, size)?;
    }
    if let Some(viscosity) = &scene.viscosity {
        check_operator("viscosity matrix", viscosity, size)?;
    }
    if let Load::Constant(load) = &scene.load {
        check_field("load", load, size)?;
    }
    for (what, field) in [
        ("initial displacement", &scene.initial.displacement),
        ("initial velocity", &scene.initial.velocity),
        ("initial acceleration", &scene.initial.acceleration),
    ] {
        if !field.is_empty() {
            check_field(what, field, size)?;
        }
    }
    let mut fixed = vec![[false; C]; size];
    for (patch, components) in &scene.held {
        mark("held boundary", patch, components, &mut fixed)?;
    }
    check_friction(scene, &fixed)?;
    for moved in &scene.moved {
        mark(
            "moved boundary",
            &moved.patch,
            &moved.components,
            &mut fixed,
        )?;
        if let Some(friction) = &scene.friction.patch {
            for &vertex in &moved.patch.vertices {
                if friction.vertices.contains(&vertex) {
                    return Err(SceneError::TouchingBoundaries {
                        other: "moved",
                        vertex,
                    });
                }
            }
        }
    }
    Ok(fixed)
}

/// Checks that a scene is a differential equation for displacement and state.
pub(crate) fn check_explicit<Op, L: FrictionLaw, S: StateLaw, const C: usize>(
    scene: &Scene<Op, L, S, C>,
) -> Result<(), SceneError> {
    for (holds, requirement) in [
        (scene.mass.is_none(), "a scene without mass"),
        (scene.friction.patch.is_some(), "friction"),
        (
            scene.held.is_empty() && scene.moved.is_empty(),
            "all components free",
        ),
        (
            !scene.initial.in_equilibrium,
            "an initial displacement that is given",
        ),
    ] {
        if !holds {
            return Err(SceneError::Explicit { requirement });
        }
    }
    Ok(())
}

fn check_friction<Op, L: FrictionLaw, S: StateLaw, const C: usize>(
    scene: &Scene<Op, L, S, C>,
    held: &[[bool; C]],
) -> Result<(), SceneError> {
    let Some(patch) = &scene.friction.patch else {
        return Ok(());
    };
    check_patch("frictional boundary", patch, held.len())?;
    let count = patch.vertices.len();
    for &vertex in &patch.vertices {
        if held[vertex].iter().all(|&held| held) {
            return Err(SceneError::TouchingBoundaries {
                other: "held",
                vertex,
            });
        }
    }
    length("friction law", &scene.friction.law, count)?;
    length("normal stress", &scene.friction.normal_stress, count)?;
    length("cohesion", &scene.friction.cohesion, count)?;
    length("state law", &scene.state.law, count)?;
    length("initial state", &scene.state.initial, count)?;
    for k in 0..count {
        scene.friction.law.at(k).validate()?;
        scene.state.law.at(k).validate()?;
        finite("normal stress", k, *scene.friction.normal_stress.at(k))?;
        let cohesion = *scene.friction.cohesion.at(k);
        finite("cohesion", k, cohesion)?;
        if cohesion < 0.0 {
            return Err(SceneError::Value {
                what: "cohesion",
                requirement: "non-negative",
                position: k,
                value: cohesion,
            });
        }
        let state = *scene.state.initial.at(k);
        finite("initial state", k, state.value())?;
        scene.state.law.at(k).validate_state(state)?;
    }
    Ok(())
}

/// A matrix with a value that is not finite gives a product that is not finite.
fn check_operator<Op: Operator<C>, const C: usize>(
    what: &'static str,
    operator: &Op,
    size: usize,
) -> Result<(), SceneError> {
    if operator.vertex_count() != size {
        return Err(SceneError::Length {
            what,
            expected: size,
            found: operator.vertex_count(),
        });
    }
    let mut product = vec![SVector::zeros(); size];
    operator.multiply_add(1.0, &vec![SVector::repeat(1.0); size], &mut product);
    check_field(what, &product, size)
}

fn check_field<const C: usize>(
    what: &'static str,
    field: &[SVector<f64, C>],
    size: usize,
) -> Result<(), SceneError> {
    if field.len() != size {
        return Err(SceneError::Length {
            what,
            expected: size,
            found: field.len(),
        });
    }
    field
        .iter()
        .enumerate()
        .try_for_each(|(i, value)| value.iter().try_for_each(|&value| finite(what, i, value)))
}

fn check_patch(what: &'static str, patch: &Patch, size: usize) -> Result<(), SceneError> {
    if patch.vertices.is_empty() {
        return Err(SceneError::EmptyBoundary { what });
    }
    if patch.weights.len() != patch.vertices.len() {
        return Err(SceneError::Length {
            what,
            expected: patch.vertices.len(),
            found: patch.weights.len(),
        });
    }
    for (position, (&vertex, &weight)) in patch.vertices.iter().zip(&patch.weights).enumerate() {
        let increasing = position == 0 || patch.vertices[position - 1] < vertex;
        if vertex >= size || !increasing {
            return Err(SceneError::Value {
                what,
                requirement: "a vertex of the mesh, above its predecessor",
                position,
                value: vertex as f64,
            });
        }
        if !(weight >= 0.0 && weight.is_finite()) {
            return Err(SceneError::Value {
                what,
                requirement: "given weights that are finite and not negative",
                position,
                value: weight,
            });
        }
    }
    Ok(())
}

fn mark<const C: usize>(
    what: &'static str,
    patch: &Patch,
    components: &[bool; C],
    fixed: &mut [[bool; C]],
) -> Result<(), SceneError> {
    check_patch(what, patch, fixed.len())?;
    for &vertex in &patch.vertices {
        for c in 0..C {
            fixed[vertex][c] |= components[c];
        }
    }
    Ok(())
}

fn length<T>(what: &'static str, nodal: &Nodal<T>, expected: usize) -> Result<(), SceneError> {
    match nodal {
        Nodal::PerVertex(values) if values.len() != expected => Err(SceneError::Length {
            what,
            expected,
            found: values.len(),
        }),
        _ => Ok(()),
    }
}

fn finite(what: &'static str, position: usize, value: f64) -> Result<(), SceneError> {
    if value.is_finite() {
        Ok(())
    } else {
        Err(SceneError::Value {
            what,
            requirement: "finite",
            position,
            value,
        })
    }
}
