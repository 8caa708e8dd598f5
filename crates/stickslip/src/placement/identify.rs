//! The vertices of periodic boundaries, and the conditions at them.

use std::collections::{BTreeMap, HashMap};

use super::coincident::distance;
use super::connect::Parts;
use super::partners::{partners, sides_of};
use crate::laws::Places;
use crate::scene::{AnyContact, Prescribed, Sides};
use crate::{BoundaryPart, SceneError};

/// The vertices that move as others, with these and the number of their boundary, counted from 1.
pub(crate) type Images = BTreeMap<usize, (usize, usize)>;

/// Finds the vertices that move as others, and moves the conditions on them to these.
pub(crate) fn identify<const C: usize>(
    parts: &mut Parts<'_, C>,
    size: usize,
) -> Result<Images, SceneError> {
    let mut images = Images::new();
    if parts.periodic.is_empty() {
        return Ok(images);
    }
    let sides = sides_of(parts.contacts)?;
    for (index, [first, second]) in parts.periodic.iter().enumerate() {
        for (place, vertex) in partners(first, second, &sides, size)?
            .into_iter()
            .enumerate()
        {
            let (own, base) = (root(&images, second.vertices[place]), root(&images, vertex));
            if own != base {
                images.insert(own, (base, index + 1));
            }
        }
    }
    let linked: Vec<usize> = images.keys().copied().collect();
    for vertex in linked {
        let base = root(&images, vertex);
        images.entry(vertex).and_modify(|(own, _)| *own = base);
    }
    for given in parts.prescribed.iter_mut() {
        prescribe(given, &images);
    }
    for contact in parts.contacts.iter_mut() {
        slide(contact, &images)?;
    }
    Ok(images)
}

fn root(images: &Images, mut vertex: usize) -> usize {
    while let Some(&(base, _)) = images.get(&vertex) {
        vertex = base;
    }
    vertex
}

/// Moves Dirichlet conditions: of two at one vertex that of the vertex itself stays.
fn prescribe<const C: usize>(given: &mut Prescribed<C>, images: &Images) {
    let part = &mut given.part;
    let mut places: BTreeMap<usize, usize> = BTreeMap::new();
    for (place, vertex) in part.vertices.iter_mut().enumerate() {
        match images.get(vertex) {
            Some(&(base, _)) => {
                *vertex = base;
                places.entry(base).or_insert(place);
            }
            None => {
                places.insert(*vertex, place);
            }
        }
    }
    let places: Vec<usize> = places.into_values().collect();
    given.part = part.select(&places);
    if let Some(minus) = &mut given.minus {
        *minus = (places.iter().map(|&place| root(images, minus[place]))).collect();
    }
}

/// Moves the vertices of a contact; of two at one place one stays, with the area of both.
fn slide<const C: usize>(contact: &mut AnyContact<C>, images: &Images) -> Result<(), SceneError> {
    let part = &mut contact.part;
    let count = part.vertices.len();
    let minus = match &mut contact.sides {
        Sides::Two(minus) => &mut minus[..],
        Sides::Rigid => &mut [],
    };
    let mut own: HashMap<(usize, Option<usize>), usize> = HashMap::new();
    let (mut kept, mut moved) = (Vec::with_capacity(count), Vec::new());
    for place in 0..count {
        let (vertex, opposite) = (&mut part.vertices[place], minus.get_mut(place));
        let mut is_moved = false;
        for vertex in std::iter::once(&mut *vertex).chain(opposite) {
            if let Some(&(base, _)) = images.get(vertex) {
                (*vertex, is_moved) = (base, true);
            }
        }
        if is_moved {
            moved.push(place);
        } else {
            own.insert((part.vertices[place], minus.get(place).copied()), place);
            kept.push(place);
        }
    }
    for place in moved {
        let at = (part.vertices[place], minus.get(place).copied());
        match own.get(&at) {
            Some(&base) => merge(part, base, place),
            None => {
                own.insert(at, place);
                kept.push(place);
            }
        }
    }
    kept.sort_unstable_by_key(|&place| part.vertices[place]);
    if !kept.iter().copied().eq(0..count) {
        let places = kept;
        contact.keep(Places { count, places })?;
    }
    Ok(())
}

/// Adds the area of a vertex to that of another one, and takes the mean of their normals.
fn merge(part: &mut BoundaryPart, base: usize, place: usize) {
    let weights = [part.weights[base], part.weights[place]];
    part.weights[base] += weights[1];
    if let (Some(&own), Some(&other)) = (part.normals.get(base), part.normals.get(place))
        && own != other
    {
        let sum = [0, 1, 2].map(|c| weights[0] * own[c] + weights[1] * other[c]);
        let length = distance(&sum, &[0.0; 3]);
        part.normals[base] = sum.map(|n| if length > 0.0 { n / length } else { 0.0 });
    }
}
