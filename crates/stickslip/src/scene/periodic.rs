//! Periodic boundaries: pairs of vertices that move together.

use std::collections::{BTreeMap, BTreeSet};

use stickslip_solvers::Operator;

use super::coincident::{Boxes, NEAR, distance};
use super::{Scene, SceneError};
use crate::BoundaryPart;
use crate::contact::{AnyContact, Sides};

impl<Op: Operator<C>, const C: usize> Scene<Op, C> {
    /// Makes the body periodic: each vertex of `second` moves as the vertex of `first` from which a translation `t`
    /// leads to it, the same for all vertices. Call it once for each direction.
    ///
    /// ```text
    /// v(x + t) = v(x),    forces on x and x + t add
    /// ```
    ///
    /// Loads and masses at both vertices add, a Dirichlet condition at one of them is one for both (of a part with both
    /// that at `first`), and a contact that extends from end to end has one vertex there, in `first`, with the area of both. Values per vertex
    /// are still those of all vertices of the part. A difference of the initial displacements stays: a mean strain.
    ///
    /// Where a fault with two sides reaches the boundary, its jump is that at the other end. Which of the coinciding
    /// vertices belong together follows from the contacts between them: a fault reaches both ends, or none. Steps need a
    /// format of matrices with a change of basis, as a `BlockMatrix` has, and central differences `Condensed`, since
    /// `Diagonal` refuses a mass at two places. A `VtkSeries` takes the body, not the contact, whose trace has one vertex
    /// more.
    ///
    /// ```
    /// use stickslip::fem::{Elastic, GridDiagonal, Mesh, P1, elasticity};
    /// use stickslip::friction::Tresca;
    /// use stickslip::{Components, Condensed, Contact, GeneralizedAlpha, Scene, Simulation};
    ///
    /// // Two layers of 1 m, one on the other and without ends, sheared by 0.1 mm; they slide at 0.3 MPa.
    /// let mesh = Mesh::<2>::grid([4.0, 2.0], [4, 4], GridDiagonal::Rising)?
    ///     .with_surface_where("fault", |x| x[1] == 1.0)?
    ///     .split("fault")?;
    /// let space = P1::new(mesh).refined(1)?;
    /// let (left, right) = (space.trace(|x| x[0] == 0.0)?, space.trace(|x| x[0] == 4.0)?);
    /// let law = Tresca { coefficient: 0.3 };
    /// let fault = Contact::between(&space.part("fault+")?, &space.part("fault-")?, law, 1e6);
    /// let rock = Elastic { young_modulus: 75e9, poisson_ratio: 0.25 };
    /// let scene = Scene::new(elasticity(&space, &rock)?)
    ///     .with_periodic(&left, &right)
    ///     .fix(&space.trace(|x| x[1] == 0.0)?, Components::ALL)
    ///     .prescribe_velocity(&space.trace(|x| x[1] == 2.0)?, Components::ALL, |_| [1e-4, 0.0])
    ///     .with_contact(fault);
    /// let mut layers = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;
    /// layers.step(1.0)?;
    /// let at = layers.snapshot();
    /// let fault = at.contact(0);
    /// assert_eq!(fault.len(), 8);
    /// let slip = 1e-4 - 2.0 * 0.3e6 / 30e9;
    /// assert!((0..8).all(|k| (fault.slip(k) - slip).abs() < 1e-12));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Of the construction of a simulation: [`SceneError::NotPeriodic`] if the vertices do not match,
    /// [`SceneError::Length`] if their numbers differ, [`SceneError::Contradiction`] for different Dirichlet conditions at
    /// both vertices, [`SceneError::Vertex`] where the plus side of a fault alone is prescribed at its end,
    /// [`SceneError::Unsupported`] for several processes and `RungeKutta`.
    #[must_use]
    #[doc(alias("periodic boundary conditions", "PBC", "multi-point constraint", "tie"))]
    pub fn with_periodic(
        mut self,
        first: impl Into<BoundaryPart>,
        second: impl Into<BoundaryPart>,
    ) -> Self {
        self.periodic.push([first.into(), second.into()]);
        self
    }
}

/// The sides of contacts on which a vertex lies.
pub(super) type ContactSides = BTreeMap<usize, BTreeSet<(usize, bool)>>;

pub(super) fn sides_of<const C: usize>(
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
pub(super) fn partners(
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
