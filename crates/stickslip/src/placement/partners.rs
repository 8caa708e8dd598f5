//! The vertices of a periodic boundary that belong together.

use std::collections::{BTreeMap, BTreeSet};

use super::coincident::{Boxes, NEAR, distance};
use crate::scene::{AnyContact, Sides};
use crate::{BoundaryPart, SceneError};

/// The sides of contacts on which a vertex lies.
pub(crate) type ContactSides = BTreeMap<usize, BTreeSet<(usize, bool)>>;

pub(crate) fn sides_of<const C: usize>(
    contacts: &[AnyContact<C>],
) -> Result<ContactSides, SceneError> {
    let mut sides = ContactSides::new();
    for (index, contact) in contacts.iter().enumerate() {
        if let Err(error) = &contact.laws {
            return Err(error.clone());
        }
        let mut add = |vertices: &[usize], plus| {
            for &vertex in vertices {
                sides.entry(vertex).or_default().insert((index, plus));
            }
        };
        add(&contact.part.vertices, true);
        if let Sides::Two(minus) = &contact.sides {
            add(minus, false);
        }
    }
    Ok(sides)
}

/// Whether a vertex is on the minus side of a contact, and on the plus side of one.
fn walls_of(sides: &ContactSides, vertex: usize) -> [bool; 2] {
    let on = |side| {
        sides
            .get(&vertex)
            .is_some_and(|own| own.iter().any(|&(_, plus)| plus == side))
    };
    [false, true].map(on)
}

/// The vertex of the first part for each of the second one. Of several at one place it is that on the same sides of
/// contacts.
pub(crate) fn partners(
    first: &BoundaryPart,
    second: &BoundaryPart,
    sides: &ContactSides,
    size: usize,
) -> Result<Vec<usize>, SceneError> {
    let what = "periodic boundary";
    let expected = first.vertices.len();
    for part in [first, second] {
        part.check(what, size, false)?;
        for found in [part.vertices.len(), part.points.len()] {
            if found != expected {
                return Err(SceneError::Length {
                    what,
                    expected,
                    found,
                });
            }
        }
    }
    let least = |part: &BoundaryPart, c: usize| {
        let along = part.points.iter().map(|point| point[c]);
        along.fold(f64::INFINITY, f64::min)
    };
    let translation = [0, 1, 2].map(|c| least(second, c) - least(first, c));
    let refused = |place: usize, requirement| SceneError::NotPeriodic {
        vertex: second.vertices[place],
        at: second.points[place],
        translation,
        requirement,
    };
    let length = distance(&translation, &[0.0; 3]);
    if !(length > 0.0 && length.is_finite()) {
        return Err(refused(0, "a part elsewhere as its other side"));
    }
    let near = NEAR * length;
    let mut boxes = Boxes::new(near, expected);
    let moved = |k: usize| [0, 1, 2].map(|c| first.points[k][c] + translation[c]);
    (0..expected).for_each(|k| boxes.add(k, &moved(k)));
    let mut taken = BTreeSet::new();
    let partner = |(place, point): (usize, &[f64; 3])| {
        let around = boxes.around(point);
        let mut found: Vec<usize> = around
            .filter(|&k| distance(&moved(k), point) <= near)
            .map(|k| first.vertices[k])
            .collect();
        if found.len() > 1 {
            let own = second.vertices[place];
            // Another contact of the same fault may begin at the boundary.
            let alike = found
                .iter()
                .any(|vertex| sides.get(vertex) == sides.get(&own));
            found.retain(|vertex| match alike {
                true => sides.get(vertex) == sides.get(&own),
                false => walls_of(sides, *vertex) == walls_of(sides, own),
            });
        }
        match found[..] {
            [vertex] if taken.insert(vertex) => Ok(vertex),
            [] => Err(refused(place, "a vertex of the other side")),
            _ => Err(refused(
                place,
                "one vertex of the other side alone, on the same sides of contacts,",
            )),
        }
    };
    second.points.iter().enumerate().map(partner).collect()
}
