//! Linear finite elements on a mesh that no process has as a whole.

use std::sync::Arc;

use nalgebra::SVector;
use stickslip::fem::{Assembled, ElementStiffness, FemError, Mesh, P1, Trace};
use stickslip::{BoundaryPart, OppositeSide};

use crate::copies::{Labelled, Place};
use crate::elements::Numbering;
use crate::hierarchy::{Interpolation, Level, interpolations};
use crate::layout::Layout;
use crate::numbering::global_numbers;
use crate::partition::partition;
use crate::{DistributedElements, DistributedMatrix, Error, World};

/// The part of a refined mesh that this process has: the cells at the vertices it owns.
///
/// All processes hold the coarse mesh. It is refined until each process has some of its cells, divided, and from there
/// on each refines its own cells and those that touch them. A vertex is known by its place, the same bits wherever it
/// is found, and by the side of a fault along which the coarse mesh was [split](Mesh::split); it belongs to the first of
/// the processes that have a cell at the place, so that both sides of a fault are in one process.
#[derive(Debug)]
pub struct DistributedSpace<const D: usize> {
    local: P1<D>,
    layout: Arc<Layout>,
    /// The vertices of `local` that are owned, increasing.
    owned: Vec<u32>,
    /// Their places.
    places: Vec<Place<D>>,
    /// For each vertex of `local` its number among owned ones and ghosts.
    numbers: Vec<u32>,
    /// From the next coarser mesh to the owned vertices, and so on below.
    pub(crate) interpolations: Arc<Vec<Interpolation>>,
}

/// The cells a process that are enough to cut a mesh evenly.
const CELLS: usize = 32;
const NOWHERE: u32 = u32::MAX;

impl<const D: usize> DistributedSpace<D> {
    /// A coarse mesh, refined uniformly so many times.
    ///
    /// # Errors
    /// [`Error::TooFewCells`], [`Error::Fem`], and failures of MPI.
    pub fn new(world: World, coarse: Mesh<D>, refinements: usize) -> Result<Self, Error> {
        let processes = world.size();
        let (mut mesh, mut level) = (Labelled::new(coarse), 0);
        while level < refinements && mesh.mesh.cell_count() < CELLS * processes {
            (mesh, _) = mesh.refined()?;
            level += 1;
        }
        let cells = mesh.mesh.cell_count();
        if cells < processes {
            return Err(Error::TooFewCells { cells, processes });
        }
        let mut ranks = partition(&mesh.mesh, processes);
        let me = world.rank() as u32;
        let (mut levels, mut from_before) = (Vec::new(), None);
        for level in level..=refinements {
            let mut near = vec![false; mesh.labels.len()];
            for (cell, &rank) in mesh.mesh.cells().zip(&ranks) {
                if rank == me {
                    cell.iter().for_each(|&p| near[p as usize] = true);
                }
            }
            for copies in mesh.copies() {
                let any = copies.iter().any(|&p| near[p as usize]);
                copies.iter().for_each(|&p| near[p as usize] = any);
            }
            let kept;
            (mesh, ranks, kept) = restricted(&mesh, &ranks, &near)?;
            levels.push(Level::new(&mesh, &kept, from_before.as_ref()));
            if level < refinements {
                (mesh, from_before) = mesh.refined()?;
                // The children of a cell follow one another.
                let children = |&rank: &u32| std::iter::repeat_n(rank, 1 << D);
                ranks = ranks.iter().flat_map(children).collect();
            }
        }
        // All cells at the places of vertices of own cells are here: the first process among them is known.
        let mut owners = vec![NOWHERE; mesh.labels.len()];
        for (cell, &rank) in mesh.mesh.cells().zip(&ranks) {
            for &p in cell {
                owners[p as usize] = rank.min(owners[p as usize]);
            }
        }
        for copies in mesh.copies() {
            let first = copies.iter().map(|&p| owners[p as usize]).min();
            copies
                .iter()
                .for_each(|&p| owners[p as usize] = first.unwrap_or(NOWHERE));
        }
        let mine: Vec<bool> = owners.iter().map(|&owner| owner == me).collect();
        let (mesh, _, kept) = restricted(&mesh, &ranks, &mine)?;
        let owned = (0..).zip(&kept).filter(|&(_, &old)| mine[old]);
        let (owned, before): (Vec<u32>, Vec<u32>) =
            owned.map(|(new, &old)| (new, old as u32)).unzip();
        let interpolations = interpolations(world, &levels, before)?;
        Self::number(world, mesh, owned, interpolations)
    }

    /// Numbers the owned vertices of all processes one after the other, and asks for the numbers of the others.
    fn number(
        world: World,
        local: Labelled<D>,
        owned: Vec<u32>,
        interpolations: Vec<Interpolation>,
    ) -> Result<Self, Error> {
        let mut numbers = vec![NOWHERE; local.labels.len()];
        for (number, &vertex) in (0..).zip(&owned) {
            numbers[vertex as usize] = number;
        }
        let others: Vec<u32> = (0..)
            .zip(&numbers)
            .filter(|&(_, &number)| number == NOWHERE)
            .map(|(vertex, _)| vertex)
            .collect();
        let places = local.places();
        let (firsts, found) = global_numbers(world, &places, &owned, &others)?;
        let mut found: Vec<(u64, u32)> = found.into_iter().zip(others).collect();
        found.sort_unstable();
        for (ghost, &(_, vertex)) in (owned.len() as u32..).zip(&found) {
            numbers[vertex as usize] = ghost;
        }
        let ghosts = found.iter().map(|&(number, _)| number).collect();
        let layout = Layout::new(world, owned.len(), &firsts, ghosts)?;
        Ok(Self {
            local: P1::new(local.mesh),
            layout: Arc::new(layout),
            places: owned
                .iter()
                .map(|&vertex| places[vertex as usize])
                .collect(),
            owned,
            numbers,
            interpolations: Arc::new(interpolations),
        })
    }

    /// The cells at the vertices of this process, on which loads and operators are assembled.
    pub fn local(&self) -> &P1<D> {
        &self.local
    }

    /// The number of vertices of this process.
    pub fn vertex_count(&self) -> usize {
        self.owned.len()
    }

    /// All processes.
    pub fn world(&self) -> World {
        self.layout.world
    }

    /// The number of vertices of the whole mesh.
    pub fn total_vertices(&self) -> usize {
        self.world().sum(self.owned.len() as f64) as usize
    }

    /// The places of the vertices of this process \[m\].
    pub fn points(&self) -> Vec<SVector<f64, D>> {
        self.field(self.local.mesh().vertices())
    }

    /// The places of the vertices of this process, with the labels of copies.
    pub(crate) fn places(&self) -> &[Place<D>] {
        &self.places
    }

    /// The owners of the vertices.
    pub(crate) fn layout(&self) -> &Arc<Layout> {
        &self.layout
    }

    /// A matrix from its assembly on [`local`](Self::local): `elasticity(space.local(), ..)` and its like.
    ///
    /// # Errors
    /// [`FemError::Mesh`] for one that was assembled on another mesh.
    pub fn matrix<const C: usize>(
        &self,
        local: &Assembled<C>,
    ) -> Result<DistributedMatrix<C>, Error> {
        local.check_mesh(self.local.mesh())?;
        let layout = self.layout.clone();
        Ok(DistributedMatrix::of_rows(
            layout,
            local,
            &self.owned,
            &self.numbers,
        ))
    }

    /// A stiffness by elements from that of [`local`](Self::local), for explicit steps: `element_stiffness(space.local(), ..)`
    /// and multiples of it.
    ///
    /// # Errors
    /// [`FemError::Mesh`] for one of another mesh.
    pub fn elements(&self, local: &ElementStiffness<D>) -> Result<DistributedElements<D>, Error> {
        let (expected, found) = (self.local.mesh().identity(), local.mesh());
        if expected != found {
            let what = "matrix";
            return Err(FemError::Mesh {
                what,
                expected,
                found,
            }
            .into());
        }
        let numbering = Numbering {
            owned: self.owned.clone(),
            numbers: self.numbers.clone(),
        };
        let layout = Arc::clone(&self.layout);
        Ok(DistributedElements::new(layout, numbering, local.clone()))
    }

    /// The values of a field on [`local`](Self::local) at the vertices of this process.
    pub fn field<T: Copy>(&self, local: &[T]) -> Vec<T> {
        self.owned
            .iter()
            .map(|&vertex| local[vertex as usize])
            .collect()
    }

    /// The share of this process of a part of the boundary, by a property of vertices; without vertices where it has
    /// none of it. A face inside of the body that has the property at all corners must not exist.
    ///
    /// # Errors
    /// None in the present version but those of a mesh that is refused.
    pub fn part(&self, on: impl Fn(&SVector<f64, D>) -> bool) -> Result<BoundaryPart, Error> {
        self.share(self.local.trace(on))
    }

    /// The share of this process of a named part of the coarse mesh, such as a side of a fault; without vertices where it
    /// has none of it. The two sides of a fault have the same pairs of vertices in the same process.
    ///
    /// # Errors
    /// [`FemError::Unknown`], with the names there are.
    pub fn named_part(&self, name: &str) -> Result<BoundaryPart, Error> {
        self.share(self.local.part(name))
    }

    /// The vertices of a trace that this process owns.
    fn share(&self, trace: Result<Trace<D>, FemError>) -> Result<BoundaryPart, Error> {
        let trace = match trace {
            Ok(trace) => BoundaryPart::from(&trace),
            Err(FemError::Empty { .. }) => BoundaryPart {
                dimension: D,
                ..BoundaryPart::point(0.0)
            },
            Err(error) => return Err(error.into()),
        };
        let number = |vertex: usize| self.numbers[vertex] as usize;
        let own = |k: &usize| {
            let vertex = trace.vertices.get(*k).filter(|_| !trace.points.is_empty());
            vertex.is_some_and(|&vertex| number(vertex) < self.owned.len())
        };
        let places: Vec<usize> = (0..trace.vertices.len()).filter(own).collect();
        let each = |of: &dyn Fn(usize) -> usize| places.iter().map(|&k| of(k)).collect();
        let opposite = trace.opposite.as_ref().map(|side| OppositeSide {
            vertices: each(&|k| number(side.vertices[k])),
            beside_tip: places.iter().map(|&k| side.beside_tip[k]).collect(),
        });
        Ok(BoundaryPart {
            vertices: each(&|k| number(trace.vertices[k])),
            weights: places.iter().map(|&k| trace.weights[k]).collect(),
            points: places.iter().map(|&k| trace.points[k]).collect(),
            normals: places.iter().map(|&k| trace.normals[k]).collect(),
            axes: Vec::new(),
            opposite,
            dimension: D,
            mesh: None,
        })
    }

    /// The vertex of this process at a place, up to rounding; one of both sides of a fault.
    pub fn vertex_at(&self, point: [f64; D]) -> Option<usize> {
        let vertex = self.local.vertex_at(point)?;
        let number = self.numbers[vertex] as usize;
        (number < self.owned.len()).then_some(number)
    }
}

/// The cells with a marked vertex: their mesh, their processes, and which vertices these are.
fn restricted<const D: usize>(
    mesh: &Labelled<D>,
    ranks: &[u32],
    marked: &[bool],
) -> Result<(Labelled<D>, Vec<u32>, Vec<usize>), Error> {
    let corners = |cell: usize| mesh.mesh.cell(cell).iter();
    let keep = |cell: usize| corners(cell).any(|&p| marked[p as usize]);
    let kept = (0..ranks.len()).filter(|&cell| keep(cell));
    let ranks = kept.map(|cell| ranks[cell]).collect();
    let (mesh, vertices) = mesh.restricted(keep)?;
    Ok((mesh, ranks, vertices))
}
