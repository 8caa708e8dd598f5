//! The local axes of vertices: along the normals of contacts and the directions of Dirichlet conditions.
//!
//! A Dirichlet or tangential component is one along a local axis of its vertex. Where the local axes are the coordinate
//! axes, as on blocks, no rotation is needed. Elsewhere the axes of a vertex are, in this order,
//!
//! ```text
//! the directions that parts hold or move,   then the normals of contacts,   then what is left
//! ```
//!
//! Each is orthogonalised against the previous ones, and assigned to the component with the nearest coordinate axis.

use std::collections::BTreeMap;

use nalgebra::{SMatrix, SVector};
use stickslip_solvers::Frames;

use crate::numerics::NUMERICS;
use crate::scene::{AnyContact, NEW, Prescribed};
use crate::{BoundaryPart, SceneError};

/// The largest deviation, `1 - cos` of the angle, at which a direction counts as aligned with an axis.
const ALIGNED: f64 = 1e-9;
/// The local axes of all vertices.
pub(crate) struct Axes<const C: usize> {
    pub(crate) frames: Frames<C>,
    /// The unit normal of each vertex of each contact, in coordinates; none where the field has no normal component.
    pub(crate) normals: Vec<Vec<Option<SVector<f64, C>>>>,
}

impl<const C: usize> Axes<C> {
    /// The axes of a body of `size` vertices.
    pub(crate) fn new(
        prescribed: &[Prescribed<C>],
        contacts: &[AnyContact<C>],
        size: usize,
    ) -> Result<Self, SceneError> {
        let normals = normals(contacts)?;
        // Coordinates alone, and nothing to turn?
        let parts = prescribed.iter().map(|given| &given.part);
        let plain = parts.clone().all(|part| part.axes.is_empty())
            && normals.iter().flatten().flatten().all(is_aligned);
        let mut frames = Frames::none(size);
        if plain {
            return Ok(Self { frames, normals });
        }
        let mut directions: BTreeMap<usize, Vec<SVector<f64, C>>> = BTreeMap::new();
        for given in prescribed {
            // What fixes every component may do so in any frame.
            if given.components.iter().all(|&fixed| fixed) {
                continue;
            }
            for (position, &vertex) in given.part.vertices.iter().enumerate() {
                let axes = given.part.axes_at::<C>(position);
                let fixed = (0..C).filter(|&c| given.components[c]);
                let fixed = fixed.map(|c| aligned(axes.column(c).into_owned()));
                directions.entry(vertex).or_default().extend(fixed);
            }
        }
        for (contact, normals) in contacts.iter().zip(&normals) {
            for (&vertex, normal) in contact.part.vertices.iter().zip(normals) {
                let directions = directions.entry(vertex).or_default();
                directions.extend(normal);
            }
        }
        for (vertex, directions) in directions {
            if let Some(axes) = frame(&directions) {
                frames.set(vertex, axes);
            }
        }
        Ok(Self { frames, normals })
    }
}

/// The normals of all contacts; contacts that meet on a smooth surface share their mean, weighted by area.
fn normals<const C: usize>(
    contacts: &[AnyContact<C>],
) -> Result<Vec<Vec<Option<SVector<f64, C>>>>, SceneError> {
    let mut normals = Vec::with_capacity(contacts.len());
    let mut meeting: BTreeMap<usize, Vec<(usize, usize)>> = BTreeMap::new();
    for (index, contact) in contacts.iter().enumerate() {
        let part = &contact.part;
        let of_part = (0..part.vertices.len()).map(|k| normal(part, k));
        normals.push(of_part.collect::<Result<Vec<_>, _>>()?);
        if contacts.len() > 1 {
            for (k, &vertex) in part.vertices.iter().enumerate() {
                meeting.entry(vertex).or_default().push((index, k));
            }
        }
    }
    for places in meeting.values().filter(|places| places.len() > 1) {
        let own = |&(index, k): &(usize, usize)| -> Option<SVector<f64, C>> { normals[index][k] };
        let merged: Vec<_> = (places.iter().map(own))
            .map(|first| {
                let first = first?;
                let near = places.iter().filter_map(|&(index, k)| {
                    let normal = normals[index][k]?;
                    let smooth = normal.dot(&first) > NUMERICS.smooth;
                    smooth.then_some((normal, contacts[index].part.weights[k]))
                });
                let sum: SVector<f64, C> = near.clone().map(|(normal, w)| normal * w).sum();
                // Equal normals stay the bits they are, and parts without area have no mean.
                if sum.norm() == 0.0 || near.clone().all(|(normal, _)| normal == first) {
                    return Some(first);
                }
                Some(aligned(sum / sum.norm()))
            })
            .collect();
        for (&(index, k), normal) in places.iter().zip(merged) {
            normals[index][k] = normal;
        }
    }
    Ok(normals)
}

/// The normal of a vertex of a contact; none where the field has no normal component.
fn normal<const C: usize>(
    part: &BoundaryPart,
    k: usize,
) -> Result<Option<SVector<f64, C>>, SceneError> {
    let Some(given) = part.normals.get(k).filter(|_| C == part.dimension) else {
        return Ok(None);
    };
    let normal = SVector::<f64, C>::from_fn(|c, _| given[c]);
    if normal == SVector::<f64, C>::zeros() {
        return Err(SceneError::Normal {
            vertex: part.vertices[k],
            normal: *given,
            requirement: "one to slide along",
        });
    }
    Ok(Some(aligned(normal)))
}

/// A direction, or the axis with which it is aligned up to rounding.
fn aligned<const C: usize>(direction: SVector<f64, C>) -> SVector<f64, C> {
    let along = (0..C).find(|&c| (direction[c].abs() - 1.0).abs() <= ALIGNED);
    match along {
        Some(axis) => SVector::from_fn(|c, _| {
            if c == axis {
                direction[c].signum()
            } else {
                0.0
            }
        }),
        None => direction,
    }
}

fn is_aligned<const C: usize>(direction: &SVector<f64, C>) -> bool {
    direction.iter().filter(|&&x| x != 0.0).count() == 1
}

/// The local axes of a vertex; none if they are the coordinate axes.
fn frame<const C: usize>(directions: &[SVector<f64, C>]) -> Option<SMatrix<f64, C, C>> {
    if directions.iter().all(is_aligned) {
        return None;
    }
    let mut axes = [None; C];
    for direction in directions {
        let rest = beside(&axes, direction);
        let length = rest.norm();
        if length > NEW {
            let rest = rest / length;
            let free = (0..C).filter(|&c| axes[c].is_none());
            if let Some(c) = free.max_by(|&a, &b| rest[a].abs().total_cmp(&rest[b].abs())) {
                axes[c] = Some(rest * rest[c].signum());
            }
        }
    }
    for c in 0..C {
        if axes[c].is_some() {
            continue;
        }
        // That of its own coordinate, or of whichever leaves most.
        let unit = |d: usize| SVector::from_fn(|row, _| f64::from(u8::from(row == d)));
        let own = beside(&axes, &unit(c));
        let rest = if own.norm() > 0.5 {
            own
        } else {
            let all = (0..C).map(|d| beside(&axes, &unit(d)));
            all.max_by(|a, b| a.norm().total_cmp(&b.norm()))?
        };
        axes[c] = Some(rest / rest.norm());
    }
    let zeros = SVector::zeros();
    Some(SMatrix::from_columns(
        &axes.map(|axis| axis.unwrap_or(zeros)),
    ))
}

/// The part of a direction that is orthogonal to the given axes, projected twice against rounding.
fn beside<const C: usize>(
    axes: &[Option<SVector<f64, C>>; C],
    direction: &SVector<f64, C>,
) -> SVector<f64, C> {
    let once = |mut rest: SVector<f64, C>| {
        for axis in axes.iter().flatten() {
            rest -= axis * axis.dot(&rest);
        }
        rest
    };
    once(once(*direction))
}
