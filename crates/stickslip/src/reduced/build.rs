//! From a scene to its reduction.

use std::f64::consts::TAU;
use std::sync::Arc;

use nalgebra::SVector;
use stickslip_tnnmg::{BlockMatrix, Operator, StaticResponses, Symmetric};

use super::ReducedBody;
use super::body::{Handle, marks};
use super::followed::followed;
use super::projector::Projector;
use super::support::Support;
use crate::contact::check::require;
use crate::scene::{check_scene, common_mesh};
use crate::{Scene, SceneError};

/// What a body without modes is missing for its viscosity.
const INERTIA: &str = "inertia, if there is viscosity inside the body";

pub(super) fn build<const C: usize>(
    scene: &Scene<BlockMatrix<C>, C>,
    kept: &[usize],
    memory_limit: usize,
    frequency: f64,
) -> Result<ReducedBody<C>, SceneError> {
    let positive = frequency > 0.0;
    require("frequency", "positive", 0, frequency, positive)?;
    check_scene(scene)?;
    let mesh = common_mesh(scene)?;
    let support = Support::new(scene, kept)?;
    let [stiffness, mass, viscosity] = operators(scene, &support)?;
    let stiffness = stiffness.ok_or(SceneError::Unreducible {
        requirement: "a stiffness",
    })?;
    let eliminated = support.eliminated();
    let mut responses =
        StaticResponses::new(&stiffness, &support.boundary, &eliminated, memory_limit)?;
    let handles = handles(&support, &eliminated);
    let shapes = (handles.iter().flatten())
        .flat_map(|handle| &handle.units)
        .map(|unit| follow(&mut responses, &stiffness, unit))
        .collect::<Result<Vec<_>, _>>()?;
    let modes = match &mass {
        None => None,
        Some(mass) => Some(responses.modes(mass, TAU * frequency)?),
    };
    if let (Some(modes), true) = (&modes, responses.interior() > 0)
        && modes.found.is_empty()
    {
        return Err(SceneError::BelowModes {
            frequency,
            first: modes.next.unwrap_or(f64::INFINITY) / TAU,
        });
    }
    let statics = responses.stiffness();
    let inertia = mass.as_ref().map(|mass| responses.condensed(mass));
    let damping = viscosity
        .as_ref()
        .map(|viscosity| responses.condensed(viscosity));
    let owners = responses.owners().to_vec();
    let (inertia, damping) = (inertia.transpose()?, damping.transpose()?);
    let mut projector = Projector::new(responses, stiffness, shapes);
    let (mut next, mut beyond) = (None, None);
    if let (Some(modes), Some(mass), Some(inertia)) = (modes, &mass, &inertia) {
        next = modes.next.map(|next| next / TAU);
        projector.add_modes(modes.found);
        if next.is_some() {
            beyond = followed(&mut projector, mass, (&statics, inertia), TAU * frequency)?;
        }
    }
    // Rows: the boundary, a vertex for each moved part, modes in blocks.
    let mut moves = vec![[false; C]; support.boundary.len()];
    for (vertex, c) in owners {
        if let Some(place) = support.place(vertex) {
            moves[place][c] = true;
        }
    }
    let mut vertices = Vec::with_capacity(handles.len());
    for handle in &handles {
        vertices.push(handle.as_ref().map(|handle| {
            moves.push(handle.components);
            moves.len() - 1
        }));
    }
    let mode_count = projector.squares.len();
    for first in (0..mode_count).step_by(C) {
        moves.push(std::array::from_fn(|c| first + c < mode_count));
    }
    let assemble = |columns: &[Vec<f64>]| {
        Symmetric::new(&moves, |row, column| {
            // The column of a shape knows all rows.
            if row < projector.count {
                columns[column][row]
            } else {
                columns[row][column]
            }
        })
    };
    let mut columns = projector.reduce(&projector.stiffness, statics)?;
    let first = projector.count + projector.handles;
    for (k, column) in columns[first..].iter_mut().enumerate() {
        // Orthogonal to whatever is in equilibrium, and to one another.
        column.fill(0.0);
        column[first + k] = projector.squares[k];
    }
    let reduced_stiffness = assemble(&columns);
    let reduce = |operator: &Option<BlockMatrix<C>>, boundary| match (operator, boundary) {
        (Some(operator), Some(boundary)) => projector
            .reduce(operator, boundary)
            .map(|columns| Some(assemble(&columns))),
        _ => Ok(None),
    };
    let reduced_mass = reduce(&mass, inertia)?;
    let reduced_viscosity = reduce(&viscosity, damping)?;
    if let (None, Some(viscosity)) = (&mass, &viscosity)
        && reaches_inside(viscosity, &support, &eliminated)
    {
        return Err(SceneError::Unreducible {
            requirement: INERTIA,
        });
    }
    let marks = marks(scene);
    let known = support.boundary.iter().map(|&vertex| vertex as u64);
    let known = known.chain([mesh.unwrap_or(0), marks, mode_count as u64]);
    Ok(ReducedBody {
        mesh: super::body::mix(known),
        marks,
        handles: vertices.into_iter().zip(handles).collect(),
        next,
        beyond,
        stiffness: reduced_stiffness,
        mass: reduced_mass,
        viscosity: reduced_viscosity,
        moves,
        inertia: mass,
        projector: Arc::new(projector),
        support: Arc::new(support),
    })
}

/// Stiffness, mass and viscosity in the frames of the vertices, on one pattern.
fn operators<const C: usize>(
    scene: &Scene<BlockMatrix<C>, C>,
    support: &Support<C>,
) -> Result<[Option<BlockMatrix<C>>; 3], SceneError> {
    let all: Vec<&BlockMatrix<C>> = std::iter::once(&scene.stiffness)
        .chain(&scene.mass)
        .chain(&scene.viscosity)
        .collect();
    let on_pattern = |what, given: &[&BlockMatrix<C>]| {
        if given.is_empty() {
            return Ok(None);
        }
        let terms = given.iter().map(|operator| (1.0, *operator));
        let others = all.iter().map(|operator| (0.0, *operator));
        let terms: Vec<_> = terms.chain(others).collect();
        let mut operator = BlockMatrix::combination(&terms);
        if !support.frames.is_empty() && !scene.turned && !operator.turn(&support.frames) {
            return Err(SceneError::Unturned { what });
        }
        Ok(Some(operator))
    };
    let mass: Vec<_> = scene.mass.iter().collect();
    let viscosity: Vec<_> = scene.viscosity.iter().collect();
    Ok([
        on_pattern("stiffness matrix", &[&scene.stiffness])?,
        on_pattern("mass matrix", &mass)?,
        on_pattern("viscosity matrix", &viscosity)?,
    ])
}

/// The moved parts beyond the boundary, each component by one; none for a part that lies on the boundary.
fn handles<const C: usize>(
    support: &Support<C>,
    eliminated: &[[bool; C]],
) -> Vec<Option<Handle<C>>> {
    let parts = support.parts.iter().map(|part| {
        let vertices = part.part.vertices.iter().enumerate();
        let inside: Vec<_> = vertices
            .filter(|&(_, &vertex)| support.place(vertex).is_none())
            .collect();
        if inside.is_empty() {
            return None;
        }
        let unit = |c: usize| {
            let unit = SVector::from_fn(|row, _| f64::from(u8::from(row == c)));
            let each = inside.iter().map(|&(position, &vertex)| {
                let (mut value, components) = part.at(position, &unit);
                for c in 0..C {
                    if !(components[c] && eliminated[vertex][c]) {
                        value[c] = 0.0;
                    }
                }
                (vertex, value)
            });
            each.collect::<Vec<_>>()
        };
        Some(Handle {
            components: part.components,
            units: (0..C).filter(|&c| part.components[c]).map(unit).collect(),
        })
    });
    parts.collect()
}

/// A moved part by one, and the interior in equilibrium with it.
fn follow<const C: usize>(
    responses: &mut StaticResponses<C>,
    stiffness: &BlockMatrix<C>,
    unit: &[(usize, SVector<f64, C>)],
) -> Result<Vec<SVector<f64, C>>, SceneError> {
    let size = stiffness.rows();
    let (mut shape, mut forces) = (vec![SVector::zeros(); size], vec![SVector::zeros(); size]);
    for (vertex, value) in unit {
        shape[*vertex] = *value;
    }
    stiffness.multiply_add(-1.0, &shape, &mut forces);
    let at_rest = vec![0.0; responses.owners().len()];
    responses.extend(stiffness, Some(&forces), &at_rest, &mut shape)?;
    Ok(shape)
}

/// Whether an operator acts on what is eliminated.
fn reaches_inside<const C: usize>(
    operator: &BlockMatrix<C>,
    support: &Support<C>,
    eliminated: &[[bool; C]],
) -> bool {
    let inside =
        |vertex: usize, c: usize| support.place(vertex).is_none() && !eliminated[vertex][c];
    operator.iter().any(|(block, (i, j))| {
        let (i, j) = (i as usize, j as usize);
        let mut entries = (0..C).flat_map(|r| (0..C).map(move |c| (r, c)));
        entries.any(|(r, c)| block[(r, c)] != 0.0 && (inside(i, r) || inside(j, c)))
    })
}
