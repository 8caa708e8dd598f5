//! The frictional surfaces of a mesh: parts of its boundary, and faults inside along which it is split.

use stickslip::Snapshot;
use stickslip::fem::{Mesh, P1, Trace};
use stickslip::nalgebra::SVector;

use crate::cli::Problem;
use crate::laws::Surface;

/// A frictional surface.
pub(super) struct Fault<const D: usize> {
    /// The name of its group.
    pub(super) name: String,
    /// The part that slides: the boundary part, or the plus side.
    pub(super) part: Trace<D>,
    /// The other side of a fault inside the body.
    pub(super) minus: Option<Trace<D>>,
}

/// Splits a mesh along those of the groups that are inside it, in their order.
///
/// # Errors
/// A group that is not there or is named twice, or that cannot be split.
pub(super) fn split<const D: usize>(mesh: Mesh<D>, names: &[String]) -> Result<Mesh<D>, Problem> {
    let mut inside = Vec::new();
    for (k, name) in names.iter().enumerate() {
        if names[..k].contains(name) {
            return Err(format!("--contact {name} is there twice").into());
        }
        if mesh.surfaces().any(|(surface, _)| surface == name) {
            inside.push(name);
        } else if !mesh.parts().any(|(part, _)| part == name) {
            let inside: Vec<_> = mesh.surfaces().map(|(name, _)| name).collect();
            let boundary: Vec<_> = mesh.parts().map(|(name, _)| name).collect();
            return Err(format!(
                "--contact {name}: no such group of faces; inside the body are {inside:?}, on its boundary {boundary:?}"
            )
            .into());
        }
    }
    Ok(mesh.split_all(inside)?)
}

impl<const D: usize> Fault<D> {
    /// The frictional surfaces of groups, after [`split`]: the branches of a group, `name.1` and others, follow it.
    ///
    /// # Errors
    /// A group that is not there.
    pub(super) fn all(space: &P1<D>, names: &[String]) -> Result<Vec<Self>, Problem> {
        let split = space.mesh().split_surfaces();
        let mut faults = Vec::with_capacity(names.len());
        for name in names {
            faults.push(Self::new(space, name)?);
            let branches = (1..).map(|number| format!("{name}.{number}"));
            let own = |branch: &String| {
                split.iter().any(|surface| surface.name == *branch) && !names.contains(branch)
            };
            for branch in branches.take_while(own) {
                faults.push(Self::new(space, &branch)?);
            }
        }
        Ok(faults)
    }

    fn new(space: &P1<D>, name: &str) -> Result<Self, Problem> {
        // A group inside the body and on its boundary slips inside.
        let named = |name: &str| space.mesh().parts().any(|(part, _)| part == name);
        let boundary = named(name) && !named(&format!("{name}+"));
        let (part, minus) = if boundary {
            (space.part(name)?, None)
        } else {
            let side = |sign: char| space.part(&format!("{name}{sign}"));
            (side('+')?, Some(side('-')?))
        };
        Ok(Self {
            name: name.to_owned(),
            part,
            minus,
        })
    }

    /// The surface for a contact.
    pub(super) fn surface(&self) -> Surface {
        match &self.minus {
            None => Surface::Rigid((&self.part).into()),
            Some(minus) => Surface::Sides(Box::new([(&self.part).into(), minus.into()])),
        }
    }

    /// The mean outward normal of the part that slides, by area; that of its first vertex for a closed part.
    pub(super) fn mean_normal(&self) -> SVector<f64, D> {
        let weighted = self.part.normals().iter().zip(self.part.weights());
        let sum: SVector<f64, D> = weighted.map(|(n, w)| n * *w).sum();
        if sum.norm() > 1e-3 * self.part.measure() {
            sum.normalize()
        } else {
            self.part.normals()[0]
        }
    }

    /// The positions of the part's vertices, in the plane in their order along it, from the end of smaller x.
    fn in_order(&self) -> Vec<usize> {
        let count = self.part.vertices().len();
        if D != 2 {
            return (0..count).collect();
        }
        let mut beside = vec![Vec::new(); count];
        for face in self.part.faces() {
            beside[face[0]].push(face[1]);
            beside[face[1]].push(face[0]);
        }
        let points = self.part.points();
        let mut starts: Vec<usize> = (0..count).collect();
        starts.sort_by(|&i, &j| {
            let ends = beside[i].len().cmp(&beside[j].len());
            let places = points[i].iter().zip(&points[j]);
            let places = places.map(|(a, b)| a.total_cmp(b)).find(|o| o.is_ne());
            ends.then(places.unwrap_or(std::cmp::Ordering::Equal))
        });
        let (mut order, mut seen) = (Vec::with_capacity(count), vec![false; count]);
        for start in starts {
            let mut next = Some(start).filter(|&k| !seen[k]);
            while let Some(k) = next {
                seen[k] = true;
                order.push(k);
                next = beside[k].iter().copied().find(|&other| !seen[other]);
            }
        }
        order
    }

    /// The position of each vertex of contact number `index` without tips, with its slip \[m\], its normal stress
    /// \[Pa\] and its opening \[m\]: in the plane in their order along the contact.
    pub(super) fn rows(&self, at: &Snapshot<'_, D>, index: usize) -> [Vec<Vec<f64>>; 3] {
        let contact = at.contact(index);
        let minus = self.minus.as_ref().and(self.part.opposite());
        let mut rows = [const { Vec::new() }; 3];
        for k in self.in_order() {
            let own = contact.position_of(self.part.vertices()[k]);
            let other = || minus.and_then(|opposite| contact.position_of(opposite[k]));
            let Some(place) = own.or_else(other) else {
                continue; // a tip
            };
            // Where faults cross, one of two copies has the jump and the area of both.
            if contact.weight(place) == 0.0 {
                continue;
            }
            let row = |value: f64| {
                let point = self.part.points()[k].iter().copied();
                point.chain([value]).collect::<Vec<f64>>()
            };
            let values = [
                contact.slip(place),
                contact.normal_stress(place),
                contact.opening(place),
            ];
            for (rows, value) in rows.iter_mut().zip(values) {
                rows.push(row(value));
            }
        }
        rows
    }
}
