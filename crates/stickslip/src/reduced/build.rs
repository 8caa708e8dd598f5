//! Construction of the reduction of a scene.

use std::f64::consts::TAU;
use std::sync::Arc;

use nalgebra::SVector;
use stickslip_solvers::{BlockMatrix, MeshId, Operator, Symmetric};

use super::body::Handle;
use super::follow::{follow, reaches_inside};
use super::marks::{marks, mix};
use super::projector::{Interior, Projector};
use super::support::Support;
use super::{Reduced, ReducedBody};
use crate::checks::require;
use crate::scene::common_mesh;
use crate::{Scene, SceneError};

/// The requirement for viscosity in a body without modes.
const INERTIA: &str = "inertia, if there is viscosity inside the body";

/// The choice of retained modes.
#[derive(Clone, Copy)]
pub(super) enum Modes {
    /// The modes up to a frequency \[Hz\].
    UpTo(f64),
    /// The modes that steps of this size resolve \[s\].
    Resolved(f64),
}

/// The largest relative increase of a mode's period by a step that resolves it.
const LONGER: f64 = 0.2;
/// The highest frequency of modes that slip excites, relative to the first one.
const EXCITED: f64 = 5.5;

pub(super) fn build<const C: usize>(
    reduced: &Reduced<'_, C>,
    modes: Modes,
) -> Result<ReducedBody<C>, SceneError> {
    let (what, value) = match modes {
        Modes::UpTo(frequency) => ("frequency", frequency),
        Modes::Resolved(dt) => ("step size", dt),
    };
    let Reduced {
        scene,
        kept,
        memory_limit,
    } = reduced;
    // Without inertia there are no modes, whatever is asked for.
    let legal = value > 0.0 || value == 0.0 && scene.mass.is_none();
    require(what, "positive", 0, value, legal)?;
    scene.check()?;
    scene.conditions.check_walls()?;
    let mesh = common_mesh(&scene.conditions)?;
    let support = Support::new(scene, kept)?;
    let (stiffness, mass, viscosity) = operators(scene, &support)?;
    let eliminated = support.eliminated();
    let interior = Interior {
        boundary: support.boundary.clone(),
        eliminated,
        memory_limit: *memory_limit,
    };
    let eliminated = &interior.eliminated;
    if let (None, Some(viscosity)) = (&mass, &viscosity)
        && reaches_inside(viscosity, &support, eliminated)
    {
        return Err(SceneError::unsupported(SceneError::REDUCTION, INERTIA));
    }
    let mut responses = interior.factorized(&stiffness)?;
    let handles = handles(&support, eliminated);
    let shapes = (handles.iter().flatten())
        .flat_map(|handle| &handle.units)
        .map(|unit| follow(&mut responses, &stiffness, unit))
        .collect::<Result<Vec<_>, _>>()?;
    let found = match &mass {
        Some(mass) if responses.interior() > 0 => {
            let found = match modes {
                Modes::UpTo(frequency) => responses.modes(mass, TAU * frequency)?,
                Modes::Resolved(dt) => {
                    let resolved = (12.0 * LONGER).sqrt() / dt;
                    responses.modes_from(mass, |first| resolved.min(EXCITED * first))?
                }
            };
            if let (Modes::UpTo(frequency), true, Some(first)) =
                (modes, found.found.is_empty(), found.next)
            {
                let first = first / TAU;
                return Err(SceneError::BelowModes { frequency, first });
            }
            Some(found)
        }
        _ => None,
    };
    let statics = responses.stiffness();
    let inertia = mass.as_ref().map(|mass| responses.condensed(mass));
    let damping = viscosity
        .as_ref()
        .map(|viscosity| responses.condensed(viscosity));
    let (inertia, damping) = (inertia.transpose()?, damping.transpose()?);
    let mut projector = Projector::new(interior, Some(responses), stiffness, shapes);
    let mut next = None;
    if let Some(found) = found {
        next = found.next.map(|next| next / TAU);
        projector.add_modes(found.found);
    }
    let rows = Rows::new(&support, &projector, &handles);
    let assemble = |columns: &[Vec<f64>]| {
        Symmetric::new(&rows.moves, |row, column| {
            // The column of a shape knows all rows.
            if row < projector.count() {
                columns[column][row]
            } else {
                columns[row][column]
            }
        })
    };
    let reduced_stiffness = assemble(&projector.reduce_stiffness(&statics)?);
    let reduce = |operator: &Option<BlockMatrix<C>>, boundary: &Option<Vec<f64>>| {
        let (Some(operator), Some(boundary)) = (operator, boundary) else {
            return Ok(None);
        };
        let columns = projector.reduce(operator, boundary)?;
        Ok::<_, SceneError>(Some(assemble(&columns)))
    };
    let reduced_mass = reduce(&mass, &inertia)?;
    let reduced_viscosity = reduce(&viscosity, &damping)?;
    let marks = marks(scene);
    Ok(ReducedBody {
        mesh: mesh_of(
            &support,
            mesh,
            marks,
            [projector.squares.len(), rows.moves.len()],
        ),
        marks,
        origin: mesh,
        handles: rows.handles.into_iter().zip(handles).collect(),
        next,
        stiffness: reduced_stiffness,
        mass: reduced_mass,
        viscosity: reduced_viscosity,
        moves: rows.moves,
        inertia: mass,
        projector: Arc::new(projector),
        support: Arc::new(support),
    })
}

/// The vertices of a reduced body: the boundary, one for each driven part, modes in blocks.
pub(super) struct Rows<const C: usize> {
    /// The components that are coordinates.
    pub(super) moves: Vec<[bool; C]>,
    /// The vertex of each driven part that has one.
    pub(super) handles: Vec<Option<usize>>,
}

impl<const C: usize> Rows<C> {
    pub(super) fn new(
        support: &Support<C>,
        projector: &Projector<C>,
        handles: &[Option<Handle<C>>],
    ) -> Self {
        let mut moves = vec![[false; C]; support.boundary.len()];
        for &(vertex, c) in &projector.owners {
            if let Some(place) = support.place(vertex) {
                moves[place][c] = true;
            }
        }
        let mut vertices = Vec::with_capacity(handles.len());
        for handle in handles {
            vertices.push(handle.as_ref().map(|handle| {
                moves.push(handle.components);
                moves.len() - 1
            }));
        }
        let modes = projector.squares.len();
        for first in (0..modes).step_by(C) {
            moves.push(std::array::from_fn(|c| first + c < modes));
        }
        Self {
            moves,
            handles: vertices,
        }
    }
}

/// The identity of a reduced body of so many `vertices`, its fingerprint from those of its mesh and its operators.
pub(super) fn mesh_of<const C: usize>(
    support: &Support<C>,
    mesh: Option<MeshId>,
    marks: u64,
    [modes, vertices]: [usize; 2],
) -> MeshId {
    let known = support.boundary.iter().map(|&vertex| vertex as u64);
    let mesh = mesh.map_or(0, |mesh| mesh.fingerprint);
    MeshId {
        vertices,
        elements: None,
        fingerprint: mix(known.chain([mesh, marks, modes as u64])),
    }
}

/// Stiffness, mass and viscosity.
type Matrices<const C: usize> = (
    BlockMatrix<C>,
    Option<BlockMatrix<C>>,
    Option<BlockMatrix<C>>,
);

/// The matrices of a scene in the local frames of the vertices, on one sparsity pattern.
pub(super) fn operators<const C: usize>(
    scene: &Scene<BlockMatrix<C>, C>,
    support: &Support<C>,
) -> Result<Matrices<C>, SceneError> {
    let on_pattern = |what, [stiffness, mass, viscosity]: [f64; 3]| {
        let terms = std::iter::once((stiffness, &scene.stiffness));
        let terms: Vec<_> = terms
            .chain(scene.viscosity.iter().map(|term| (viscosity, term)))
            .collect();
        let mass = scene.mass.as_ref().map(|term| (mass, term));
        let mut operator = BlockMatrix::combination_with(&terms, mass);
        if !support.basis.is_empty()
            && !scene.conditions.turned
            && !operator.change_basis(&support.basis)
        {
            return Err(SceneError::NoBasis { what });
        }
        Ok(operator)
    };
    let mass = || on_pattern("mass matrix", [0.0, 1.0, 0.0]);
    let viscosity = || on_pattern("viscosity matrix", [0.0, 0.0, 1.0]);
    Ok((
        on_pattern("stiffness matrix", [1.0, 0.0, 0.0])?,
        scene.mass.as_ref().map(|_| mass()).transpose()?,
        scene.viscosity.first().map(|_| viscosity()).transpose()?,
    ))
}

/// The driven parts outside the boundary as unit displacements per component; none for a part on the boundary.
pub(super) fn handles<const C: usize>(
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
