//! Groups of faces that branch: several sheets, each of which passes through a branching rim or ends there.

mod junctions;

use std::cmp::Reverse;
use std::collections::{BTreeSet, HashSet};

use super::joints::leaving;
use super::pairs::coinciding;
use super::rims::Rim;
use crate::forest::Forest;
use crate::surfaces::Surface;
use crate::{FemError, Mesh};
use junctions::Junction;

impl<const D: usize> Mesh<D> {
    /// This mesh with the surfaces of some names that branch divided: sheet `k > 0` of a surface is named `name.k`. Also
    /// all names then, each sheet behind those on which it ends.
    pub(super) fn divided(
        mut self,
        names: &[impl AsRef<str>],
    ) -> Result<(Self, Vec<String>), FemError> {
        let mut all = Vec::with_capacity(names.len());
        for name in names.iter().map(AsRef::as_ref) {
            all.push(name.to_owned());
            let inner = &self.surfaces.inner;
            let Some(place) = inner.iter().position(|own| own.name == name) else {
                continue;
            };
            let numbers = sheet_numbers(&self, &inner[place].faces);
            let sheets = numbers.iter().max().map_or(1, |last| last + 1);
            if sheets == 1 {
                continue;
            }
            let faces = std::mem::take(&mut self.surfaces.inner[place].faces);
            let mut divided = vec![Vec::new(); sheets];
            for (face, number) in faces.into_iter().zip(numbers) {
                divided[number].push(face);
            }
            for (number, faces) in divided.into_iter().enumerate() {
                if number == 0 {
                    self.surfaces.inner[place].faces = faces;
                    continue;
                }
                let name = format!("{name}.{number}");
                if self.has_surface(&name) || self.parts().any(|(part, _)| part == name) {
                    return Err(FemError::RepeatedName { name });
                }
                all.push(name.clone());
                self.surfaces.inner.push(Surface { name, faces });
            }
        }
        Ok((self, all))
    }
}

/// The number of the sheet of each face of a surface: 0 for all faces of one that does not branch.
fn sheet_numbers<const D: usize>(mesh: &Mesh<D>, faces: &[[u32; D]]) -> Vec<usize> {
    let copies = coinciding(&mesh.surfaces.cuts, mesh.vertex_count());
    let rims = Rim::all(faces, &copies);
    let meetings = || rims.chunk_by(|a, b| a.key == b.key);
    let branching: HashSet<[u32; 2]> = (meetings().filter(|meeting| meeting.len() > 2))
        .map(|meeting| meeting[0].key)
        .collect();
    if branching.is_empty() {
        return vec![0; faces.len()];
    }
    // Where more than two faces meet on the outer boundary of the body, all leave it.
    let leaves = leaving(mesh, &copies, &branching);
    let mut sheets = Forest::new(faces.len());
    for pair in meetings().filter(|meeting| meeting.len() == 2) {
        sheets.join(pair[0].face as u32, pair[1].face as u32);
    }
    let inside =
        meetings().filter(|at| branching.contains(&at[0].key) && !leaves.contains(&at[0].key));
    junctions::join(Junction::all(mesh, faces, inside, &mut sheets), &mut sheets);
    let of_faces: Vec<u32> = (0..faces.len() as u32)
        .map(|face| sheets.root(face))
        .collect();

    // The sheets by their first faces, with those on which they end, those that they touch, and their sizes.
    let mut roots = of_faces.clone();
    roots.sort_unstable();
    roots.dedup();
    let own: Vec<usize> = (of_faces.iter())
        .map(|root| roots.partition_point(|other| other < root))
        .collect();
    let mut ends_on = vec![BTreeSet::new(); roots.len()];
    for meeting in meetings().filter(|meeting| meeting.len() > 2) {
        let count = |sheet| meeting.iter().filter(|rim| own[rim.face] == sheet).count();
        let here = || meeting.iter().map(|rim| own[rim.face]);
        for end in here().filter(|&sheet| count(sheet) == 1) {
            ends_on[end].extend(here().filter(|&sheet| count(sheet) > 1));
        }
    }
    let mut at_vertices: Vec<(u32, usize)> = (faces.iter().zip(&own))
        .flat_map(|(face, &sheet)| face.map(|p| (copies[p as usize], sheet)))
        .collect();
    at_vertices.sort_unstable();
    at_vertices.dedup();
    let mut touched = vec![BTreeSet::new(); roots.len()];
    for here in at_vertices.chunk_by(|a, b| a.0 == b.0) {
        for (k, &(_, one)) in here.iter().enumerate() {
            for &(_, other) in &here[..k] {
                touched[one].insert(other);
                touched[other].insert(one);
            }
        }
    }
    let mut sizes = vec![0_usize; roots.len()];
    own.iter().for_each(|&sheet| sizes[sheet] += 1);
    let numbers = numbered(&ends_on, &touched, &sizes);
    own.into_iter().map(|sheet| numbers[sheet]).collect()
}

/// The least numbers with which sheets that touch differ, and each is larger than those on which it ends; of several
/// that could be next the one of most faces is. In a circle of sheets of which each ends on the next it is, too.
fn numbered(
    ends_on: &[BTreeSet<usize>],
    touched: &[BTreeSet<usize>],
    sizes: &[usize],
) -> Vec<usize> {
    let mut numbers: Vec<Option<usize>> = vec![None; sizes.len()];
    let ready = |sheet: usize, numbers: &[Option<usize>]| {
        ends_on[sheet].iter().all(|&on| numbers[on].is_some())
    };
    let next = |numbers: &[Option<usize>]| {
        let left = (0..sizes.len()).filter(|&sheet| numbers[sheet].is_none());
        left.max_by_key(|&sheet| (ready(sheet, numbers), sizes[sheet], Reverse(sheet)))
    };
    while let Some(sheet) = next(&numbers) {
        let below = ends_on[sheet].iter().filter_map(|&on| numbers[on]).max();
        let taken = |number: &usize| touched[sheet].iter().any(|&t| numbers[t] == Some(*number));
        numbers[sheet] = (below.map_or(0, |below| below + 1)..).find(|number| !taken(number));
    }
    numbers.into_iter().flatten().collect()
}
