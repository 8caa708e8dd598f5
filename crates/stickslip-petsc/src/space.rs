//! Linear finite elements on a mesh that no process has as a whole.

use std::sync::Arc;

use nalgebra::SVector;
use stickslip::BoundaryPart;
use stickslip::fem::{Assembled, FemError, Mesh, P1};

use crate::hierarchy::{Interpolation, Level, interpolations};
use crate::layout::Layout;
use crate::numbering::global_numbers;
use crate::partition::partition;
use crate::{DistributedMatrix, Error, World};

/// The part of a refined mesh that this process has: the cells at the vertices it owns.
///
/// All processes hold the coarse mesh. It is refined until each process has some of its cells, divided, and from there
/// on each refines its own cells and those that touch them. A vertex is known by its place, the same bits wherever it
/// is found, and belongs to the first of the processes that have a cell there.
#[derive(Debug)]
pub struct DistributedSpace<const D: usize> {
    local: P1<D>,
    layout: Arc<Layout>,
    /// The vertices of `local` that are owned, increasing.
    owned: Vec<u32>,
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
        let (mut mesh, mut level) = (coarse, 0);
        while level < refinements && mesh.cell_count() < CELLS * processes {
            mesh = refined(mesh)?;
            level += 1;
        }
        let cells = mesh.cell_count();
        if cells < processes {
            return Err(Error::TooFewCells { cells, processes });
        }
        let mut ranks = partition(&mesh, processes);
        let me = world.rank() as u32;
        let (mut levels, mut from_before) = (Vec::new(), None);
        for level in level..=refinements {
            let mut near = vec![false; mesh.vertex_count()];
            for (cell, &rank) in mesh.cells().zip(&ranks) {
                if rank == me {
                    cell.iter().for_each(|&p| near[p as usize] = true);
                }
            }
            let kept;
            (mesh, ranks, kept) = restricted(&mesh, &ranks, &near)?;
            levels.push(Level::new(&mesh, &kept, from_before.as_ref()));
            if level < refinements {
                let finer = P1::new(mesh).refined(1)?;
                from_before = finer.transfers().1.last().cloned();
                mesh = finer.mesh().clone();
                // The children of a cell follow one another.
                let children = |&rank: &u32| std::iter::repeat_n(rank, 1 << D);
                ranks = ranks.iter().flat_map(children).collect();
            }
        }
        // All cells at the vertices of own cells are here: the first process among them is known.
        let (mut owners, mut here) = (vec![NOWHERE; mesh.vertex_count()], Vec::new());
        here.resize(mesh.vertex_count(), false);
        for (cell, &rank) in mesh.cells().zip(&ranks) {
            for &p in cell {
                owners[p as usize] = rank.min(owners[p as usize]);
                here[p as usize] |= rank == me;
            }
        }
        let mine = here
            .iter()
            .zip(&owners)
            .map(|(&here, &owner)| here && owner == me);
        let mine: Vec<bool> = mine.collect();
        let (mesh, _, kept) = restricted(&mesh, &ranks, &mine)?;
        let owned = (0..).zip(&kept).filter(|&(_, &old)| mine[old]);
        let (owned, before): (Vec<u32>, Vec<u32>) =
            owned.map(|(new, &old)| (new, old as u32)).unzip();
        let interpolations = interpolations(world, &levels, before)?;
        Self::number(world, P1::new(mesh), owned, interpolations)
    }

    /// Numbers the owned vertices of all processes one after the other, and asks for the numbers of the others.
    fn number(
        world: World,
        local: P1<D>,
        owned: Vec<u32>,
        interpolations: Vec<Interpolation>,
    ) -> Result<Self, Error> {
        let mut numbers = vec![NOWHERE; local.vertex_count()];
        for (number, &vertex) in (0..).zip(&owned) {
            numbers[vertex as usize] = number;
        }
        let others: Vec<u32> = (0..)
            .zip(&numbers)
            .filter(|&(_, &number)| number == NOWHERE)
            .map(|(vertex, _)| vertex)
            .collect();
        let (firsts, found) = global_numbers(world, local.mesh().vertices(), &owned, &others)?;
        let mut found: Vec<(u64, u32)> = found.into_iter().zip(others).collect();
        found.sort_unstable();
        for (ghost, &(_, vertex)) in (owned.len() as u32..).zip(&found) {
            numbers[vertex as usize] = ghost;
        }
        let ghosts = found.iter().map(|&(number, _)| number).collect();
        let layout = Layout::new(world, owned.len(), &firsts, ghosts)?;
        Ok(Self {
            local,
            layout: Arc::new(layout),
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
        let trace = match self.local.trace(on) {
            Ok(trace) => BoundaryPart::from(&trace),
            Err(FemError::Empty { .. }) => BoundaryPart {
                dimension: D,
                ..BoundaryPart::point(0.0)
            },
            Err(error) => return Err(error.into()),
        };
        let own = |k: &usize| {
            let vertex = trace.vertices.get(*k).filter(|_| !trace.points.is_empty());
            vertex.is_some_and(|&vertex| (self.numbers[vertex] as usize) < self.owned.len())
        };
        let places: Vec<usize> = (0..trace.vertices.len()).filter(own).collect();
        Ok(BoundaryPart {
            vertices: (places.iter())
                .map(|&k| self.numbers[trace.vertices[k]] as usize)
                .collect(),
            weights: places.iter().map(|&k| trace.weights[k]).collect(),
            points: places.iter().map(|&k| trace.points[k]).collect(),
            normals: places.iter().map(|&k| trace.normals[k]).collect(),
            axes: Vec::new(),
            opposite: None,
            dimension: D,
            mesh: None,
        })
    }

    /// The vertex of this process at a place, up to rounding.
    pub fn vertex_at(&self, point: [f64; D]) -> Option<usize> {
        let vertex = self.local.vertex_at(point)?;
        let number = self.numbers[vertex] as usize;
        (number < self.owned.len()).then_some(number)
    }
}

fn refined<const D: usize>(mesh: Mesh<D>) -> Result<Mesh<D>, Error> {
    Ok(P1::new(mesh).refined(1)?.mesh().clone())
}

/// The cells with a marked vertex: their mesh, their processes, and which vertices these are.
fn restricted<const D: usize>(
    mesh: &Mesh<D>,
    ranks: &[u32],
    marked: &[bool],
) -> Result<(Mesh<D>, Vec<u32>, Vec<usize>), Error> {
    let keep = |cell: usize| mesh.cell(cell).iter().any(|&p| marked[p as usize]);
    let kept: Vec<usize> = (0..mesh.cell_count()).filter(|&cell| keep(cell)).collect();
    let mut vertices: Vec<usize> = (kept.iter())
        .flat_map(|&cell| mesh.cell(cell).iter().map(|&p| p as usize))
        .collect();
    vertices.sort_unstable();
    vertices.dedup();
    let ranks = kept.iter().map(|&cell| ranks[cell]).collect();
    Ok((mesh.restricted(keep)?, ranks, vertices))
}
