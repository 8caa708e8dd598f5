//! The two walls of an open mesh, and contacts on them.

use std::collections::{BTreeSet, HashMap};

use crate::scene::{Conditions, Sides};
use crate::{BoundaryPart, OpenWalls, SceneError};

/// The share of the contacts' extent below which two points coincide: above the rounding of coordinates in files, below
/// the edges of a graded mesh.
pub(crate) const NEAR: f64 = 1e-9;

/// Points by boxes of twice a distance, of which the points near a place lie in two along each axis.
pub(crate) struct Boxes {
    near: f64,
    boxes: HashMap<[i64; 3], Vec<usize>>,
}

impl Boxes {
    pub(crate) fn new(near: f64, capacity: usize) -> Self {
        let boxes = HashMap::with_capacity(capacity);
        Self { near, boxes }
    }

    pub(crate) fn add(&mut self, number: usize, point: &[f64; 3]) {
        let own = point.map(|x| (x / (2.0 * self.near)).floor() as i64);
        self.boxes.entry(own).or_default().push(number);
    }

    /// The numbers of all points near a place, and of others.
    pub(crate) fn around(&self, point: &[f64; 3]) -> impl Iterator<Item = usize> {
        let low = point.map(|x| (x / (2.0 * self.near) - 0.5).floor() as i64);
        (0..8_u8).flat_map(move |corner| {
            let place = [0, 1, 2].map(|c| low[c].saturating_add(i64::from(corner >> c & 1)));
            self.boxes.get(&place).into_iter().flatten().copied()
        })
    }
}

pub(crate) fn distance(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    (0..3).map(|c| (a[c] - b[c]).powi(2)).sum::<f64>().sqrt()
}

impl<const C: usize> Conditions<C> {
    /// Refuses walls without a contact between them, and contacts of both with rigid surfaces, unless they are allowed.
    pub(crate) fn check_walls(&self) -> Result<(), SceneError> {
        if self.open_walls {
            return Ok(());
        }
        self.check_split()?;
        let contacts = self.contacts.iter();
        let rigid = contacts.filter(|contact| !contact.sides.is_two());
        check_coincident(rigid.map(|contact| &contact.part))
    }

    /// Refuses a split surface whose walls are neither those of contacts nor of a periodic boundary, unless boundary
    /// conditions prescribe the motion of both, or all of their slip rate.
    fn check_split(&self) -> Result<(), SceneError> {
        if self.walls.is_empty() {
            return Ok(());
        }
        let mut joined: BTreeSet<usize> = BTreeSet::new();
        for contact in &self.contacts {
            // The reason why a contact joins nothing.
            if let Err(error) = &contact.laws {
                return Err(error.clone());
            }
            joined.extend(&contact.part.vertices);
            if let Sides::Two(minus) = &contact.sides {
                joined.extend(minus);
            }
        }
        let periodic = self.periodic.iter().flatten();
        joined.extend(periodic.flat_map(|part| &part.vertices));
        for given in &self.prescribed {
            // A slip rate in some components leaves the others open.
            if given.minus.is_none() || !given.components.contains(&false) {
                joined.extend(&given.part.vertices);
                joined.extend(given.minus.iter().flatten());
            }
        }
        for walls in &self.walls {
            let mut open = (walls.pairs.iter().zip(&walls.points))
                .filter(|(pair, _)| pair.iter().any(|vertex| !joined.contains(vertex)));
            if let Some((&vertices, &at)) = open.next() {
                let error = OpenWalls {
                    surface: walls.surface.clone(),
                    count: 1 + open.count(),
                    of: walls.pairs.len(),
                    vertices,
                    at,
                };
                return Err(error.into());
            }
        }
        Ok(())
    }
}

/// Refuses two coincident vertices of contacts.
fn check_coincident<'a>(parts: impl Iterator<Item = &'a BoundaryPart>) -> Result<(), SceneError> {
    let mut points: Vec<(usize, [f64; 3])> = parts
        .flat_map(|part| {
            part.vertices
                .iter()
                .copied()
                .zip(part.points.iter().copied())
        })
        .filter(|(_, point)| point.iter().all(|x| x.is_finite()))
        .collect();
    // Contacts that share a vertex meet there.
    points.sort_by_key(|&(vertex, _)| vertex);
    points.dedup_by_key(|&mut (vertex, _)| vertex);
    let extent = (0..3).map(|c| {
        let along = || points.iter().map(|(_, point)| point[c]);
        along().fold(f64::NEG_INFINITY, f64::max) - along().fold(f64::INFINITY, f64::min)
    });
    let near = NEAR * extent.fold(0.0, f64::max);
    if near == 0.0 {
        return Ok(());
    }
    let mut boxes = Boxes::new(near, points.len());
    for (k, (vertex, point)) in points.iter().enumerate() {
        if let Some(other) =
            (boxes.around(point)).find(|&other| distance(&points[other].1, point) <= near)
        {
            return Err(SceneError::Coincident {
                vertices: [points[other].0, *vertex],
                at: *point,
            });
        }
        boxes.add(k, point);
    }
    Ok(())
}
