//! Red refinement: every edge is halved, every cell becomes 2^D cells of 2^-D its volume.
//!
//! A child corner (i, j) is the midpoint of the parent's vertices i and j, or vertex i itself if i = j.
//! The order of the corners is the algorithm: it makes the second and further refinements of a tetrahedron
//! choose the diagonal of the inner octahedron so that no more than three shapes ever occur.
//! Source: J. Bey, "Tetrahedral grid refinement", Computing 55 (1995).
//!
//! In that order two of the eight children are reflected. A mesh stores all cells positively ordered: a reflected cell
//! is stored with its first two vertices exchanged and marked as `mirrored`. Bisected cells are refined as stored.

use crate::boundary::split_face;
use crate::curve::Curve;
use crate::edges::Edges;
use crate::fingerprint::fingerprint;
use crate::marks::Marks;
use crate::numbering::{ranks, sweep_order};
use crate::simplex::MAX_CORNERS;
use crate::surfaces::{Surface, Surfaces, sorted};
use crate::weights::Weights;
use crate::{FemError, Mesh, Prolongation};

type Corner = (usize, usize);

/// Children and whether they are reflected.
const TRIANGLES: &[(&[Corner], bool)] = &[
    (&[(0, 0), (0, 1), (0, 2)], false),
    (&[(0, 1), (1, 1), (1, 2)], false),
    (&[(0, 2), (1, 2), (2, 2)], false),
    (&[(0, 1), (1, 2), (0, 2)], false),
];

const TETRAHEDRA: &[(&[Corner], bool)] = &[
    (&[(0, 0), (0, 1), (0, 2), (0, 3)], false),
    (&[(0, 1), (1, 1), (1, 2), (1, 3)], false),
    (&[(0, 2), (1, 2), (2, 2), (2, 3)], false),
    (&[(0, 3), (1, 3), (2, 3), (3, 3)], false),
    (&[(0, 1), (0, 2), (0, 3), (1, 3)], false),
    (&[(0, 1), (0, 2), (1, 2), (1, 3)], true),
    (&[(0, 2), (0, 3), (1, 3), (2, 3)], false),
    (&[(0, 2), (1, 2), (1, 3), (2, 3)], true),
];

/// The refined mesh and the interpolation to it; new vertices of a curve are moved onto it.
pub(crate) fn refine<const D: usize>(
    mesh: &Mesh<D>,
    curve: Option<&Curve<'_, D>>,
) -> Result<(Mesh<D>, Prolongation), FemError> {
    let edges = Edges::of(mesh);
    let coarse = mesh.vertex_count();
    let fine = coarse + edges.count();
    if u32::try_from(fine).is_err() {
        return Err(FemError::too_many("vertices", fine as u64));
    }
    let mut points = mesh.vertices.clone();
    let mut weights = Weights::new(coarse, edges.count());
    for (p, q) in edges.iter() {
        let ends = [p, q].map(|end| &mesh.vertices[end as usize]);
        points.push(match curve {
            Some(curve) if curve.holds(&weights, p, q) => curve.middle(ends)?,
            _ => 0.5 * (ends[0] + ends[1]),
        });
        weights.halve(p, q);
    }
    let order = sweep_order(&points);
    let ranks = ranks(&order);
    let midpoint = |p: u32, q: u32| ranks[coarse + edges.find(p, q)];

    let children = if D == 2 { TRIANGLES } else { TETRAHEDRA };
    let mut cells = Vec::with_capacity(mesh.cells.len() * children.len());
    let mut mirrored = Vec::with_capacity(mesh.cell_count() * children.len());
    for (index, cell) in mesh.cells().enumerate() {
        let reflected = match &mesh.marks {
            Marks::Reflected(mirrored) => mirrored[index],
            Marks::Bisected(_) => false,
        };
        let mut parent = [0; MAX_CORNERS];
        parent[..=D].copy_from_slice(cell);
        if reflected {
            parent.swap(0, 1);
        }
        let mut corners = [[0; MAX_CORNERS]; MAX_CORNERS];
        for i in 0..=D {
            corners[i][i] = ranks[parent[i] as usize];
            for j in i + 1..=D {
                corners[i][j] = midpoint(parent[i], parent[j]);
            }
        }
        for &(child, odd) in children {
            let first = cells.len();
            cells.extend(child.iter().map(|&(i, j)| corners[i][j]));
            if odd != reflected {
                cells.swap(first, first + 1);
            }
            mirrored.push(odd != reflected);
        }
    }
    let rank = |p: u32| ranks[p as usize];
    let boundary: Vec<_> = mesh
        .boundary
        .iter()
        .flat_map(|&face| split_face(face, rank, midpoint))
        .collect();
    let prolongation = weights.prolongation(&order)?;
    let vertices: Vec<_> = order.iter().map(|&old| points[old as usize]).collect();
    if let Some(curve) = curve {
        for (index, cell) in cells.chunks_exact(D + 1).enumerate() {
            curve.check(&vertices, cell, index / children.len())?;
        }
    }
    let parents = |count: usize, parts: usize| (0..count).map(move |k| k / parts);
    let groups = mesh.groups.inherited(
        parents(boundary.len(), 1 << (D - 1)),
        parents(mirrored.len(), children.len()),
    );
    let surfaces = inherited_surfaces(mesh, &boundary, rank, midpoint);
    Ok((
        Mesh {
            fingerprint: fingerprint(&vertices, &cells),
            vertices,
            cells,
            marks: Marks::Reflected(mirrored),
            boundary,
            groups,
            surfaces,
        },
        prolongation,
    ))
}

/// The surfaces and faults of a mesh on its refinement of this boundary.
fn inherited_surfaces<const D: usize>(
    mesh: &Mesh<D>,
    boundary: &[[u32; D]],
    rank: impl Fn(u32) -> u32 + Copy,
    midpoint: impl Fn(u32, u32) -> u32 + Copy,
) -> Surfaces<D> {
    let inner = mesh.surfaces.inner.iter().map(|surface| {
        let faces = surface.faces.iter();
        let children = faces.flat_map(|&face| split_face(face, rank, midpoint));
        let mut faces: Vec<[u32; D]> = children.map(sorted).collect();
        faces.sort_unstable();
        let name = surface.name.clone();
        Surface { name, faces }
    });
    let cuts = mesh.surfaces.cuts.iter().map(|cut| {
        let mut pairs: Vec<[u32; 2]> = cut.pairs.iter().map(|pair| pair.map(rank)).collect();
        for [plus, _] in &cut.twins {
            let above = mesh.boundary[*plus];
            let below = above.map(|p| cut.minus(p));
            let edges = (0..D).flat_map(|i| (0..i).map(move |j| (i, j)));
            pairs.extend(edges.map(|(i, j)| [above, below].map(|face| midpoint(face[i], face[j]))));
        }
        let parents = (0..boundary.len()).map(|k| k >> (D - 1));
        cut.inherited(boundary, parents, pairs)
    });
    Surfaces {
        inner: inner.collect(),
        cuts: cuts.collect(),
    }
}
