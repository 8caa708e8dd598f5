//! Splitting a mesh along surfaces inside it.

mod branches;
mod fans;
mod joints;
mod pairs;
mod rims;
mod sheet;
mod side;
mod split_surface;
mod union;

use crate::boundary::face;
use crate::fingerprint::fingerprint;
use crate::surfaces::{Surface, sorted};
use crate::{FemError, Mesh};
use fans::Fans;
use joints::Joints;
use pairs::twice_paired;
pub(crate) use pairs::{Cut, Opposite, coinciding};
use sheet::Sheet;
pub(crate) use side::Side;
pub use split_surface::SplitSurface;
use union::Union;

impl<const D: usize> Mesh<D> {
    /// Splits the mesh along a named [surface](Mesh::with_surface) inside the body, for a fault with two deformable
    /// sides: `name+` and `name-` are named parts of the boundary then.
    ///
    /// ```text
    ///                 name+                    n points from - to +, to the upper side of a fault that is not
    ///    tip  ____o_____o_____o____  tip       vertical: the last component of its mean that is not zero is
    ///        *____o_____o_____o____*           positive. Of a fault in a plane x = const the plus side is that
    ///                                          of larger x, of a closed surface the outside.
    ///                 name-
    /// ```
    ///
    /// Each vertex of the surface gets a copy for every fan of cells that is left around it. At the edge of the surface
    /// inside the body (`*`, a tip) it keeps one, and faces without other vertices stay closed; where the surface leaves
    /// the body through its boundary it has two. The minus side keeps the numbers of the vertices, copies are numbered
    /// behind all. Cells, parts, materials and other surfaces stay; faces that are split leave the other surfaces. In
    /// space an edge between two tips stays closed, in refined meshes, too: take two cells or more across a fault.
    ///
    /// A surface that branches is divided into sheets. Of more than two faces that meet at a vertex (D = 2) or an edge
    /// (D = 3) those two are one sheet that continue one another most straightly, by the mean angle along all edges at
    /// which the same sheets meet; of the others two are if they are on different sides of it; what is left ends there.
    /// Sheets that are connected elsewhere pass through, and on the outer boundary of the body all end. Between
    /// angles that differ by rounding alone, as of a symmetric Y, the numbers of the vertices decide: give each branch a
    /// surface of its own there.
    ///
    /// ```text
    ///                   o  name.1        name+, name-       what passes through
    ///                 o                  name.1+, name.1-   what ends on it, or crosses it with fewer faces
    ///    ____o____o____o____o____ name   name.2+, name.2-   what ends on these, or meets them
    /// ```
    ///
    /// [`split_surfaces`](Self::split_surfaces) lists the names. One contact between the two sides of each is needed.
    ///
    /// Where faults of several names meet, name all of them at once, by [`split_all`](Self::split_all).
    ///
    /// [`Trace::opposite`](crate::Trace::opposite) has the pairs of vertices. Refined meshes have the same pairs:
    /// uniform refinement and grading refine both sides alike.
    ///
    /// # Errors
    ///
    /// [`FemError::Unknown`]; [`FemError::RepeatedName`] if there is a part or surface of the name of a side or branch;
    /// [`FemError::NotManifold`], [`FemError::OneSided`], [`FemError::OpensNowhere`], [`FemError::Continues`] if the mesh
    /// has been split before along a surface that ends where this one begins, or [`FemError::TooMany`].
    ///
    /// ```
    /// use stickslip_fem::{GridDiagonal, Mesh, P1};
    ///
    /// // A horizontal fault that enters from the left and ends in the middle.
    /// let mesh = Mesh::<2>::grid([4.0, 2.0], [4, 2], GridDiagonal::Rising)?
    ///     .with_surface_where("fault", |x| x[1] == 1.0 && x[0] <= 2.0)?
    ///     .split("fault")?;
    /// assert_eq!(mesh.vertex_count(), 15 + 2);
    /// let space = P1::new(mesh).refined(2)?;
    /// let [plus, minus] = [space.part("fault+")?, space.part("fault-")?];
    /// assert!(plus.normals().iter().all(|n| n[1] == -1.0));
    /// let opposite = plus.opposite().ok_or("one side of a fault")?;
    /// let tips: Vec<_> = (0..9).filter(|&k| opposite[k] == plus.vertices()[k]).collect();
    /// assert_eq!(tips.iter().map(|&k| plus.points()[k][0]).collect::<Vec<_>>(), [2.0]);
    /// assert_eq!(plus.weights(), minus.weights());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[doc(alias("fault", "split nodes", "crack", "interface"))]
    pub fn split(self, name: &str) -> Result<Self, FemError> {
        self.split_all([name])
    }

    /// Splits the mesh along several surfaces, those that pass through others first.
    ///
    /// Surfaces that continue one another at their rims are one surface to the cut: they open there, and have one
    /// orientation. Each pair of vertices on the common rim belongs to both, each with its own share of area.
    ///
    /// ```text
    ///            a+  |  b+                of two rims each continues the other; of four each the one
    ///   *____o_____o_|_o_____o____*       opposite to it; of three the last surface ends there
    ///   *____o_____o_|_o_____o____*
    ///            a-  |  b-
    /// ```
    ///
    /// A surface that ends on one that passes through has a tip there. One that passes through another, or goes on behind
    /// it under another name, has both sides on either side of it, four copies.
    ///
    /// # Errors
    /// Those of [`Mesh::split`]; [`FemError::Overlap`] if two of the surfaces have a face in common.
    ///
    /// ```
    /// use stickslip_fem::{GridDiagonal, Mesh};
    ///
    /// // A splay that ends on the main fault.
    /// let mesh = Mesh::<2>::grid([4.0, 2.0], [8, 4], GridDiagonal::Rising)?
    ///     .with_surface_where("main", |x| x[1] == 1.0)?
    ///     .with_surface_where("splay", |x| x[1] == x[0] - 1.0 && x[1] >= 1.0)?
    ///     .split_all(["main", "splay"])?;
    /// assert_eq!(mesh.vertex_count(), 9 * 5 + 9 + 2);
    ///
    /// // A fault in two groups slips at their joint, x = 2.
    /// let mesh = Mesh::<2>::grid([4.0, 2.0], [8, 4], GridDiagonal::Rising)?
    ///     .with_surface_where("a", |x| x[1] == 1.0 && x[0] <= 2.0)?
    ///     .with_surface_where("b", |x| x[1] == 1.0 && x[0] >= 2.0)?
    ///     .split_all(["a", "b"])?;
    /// assert_eq!(mesh.vertex_count(), 9 * 5 + 9);
    /// # Ok::<(), stickslip_fem::FemError>(())
    /// ```
    pub fn split_all(
        self,
        names: impl IntoIterator<Item = impl AsRef<str>>,
    ) -> Result<Self, FemError> {
        let names: Vec<_> = names.into_iter().collect();
        let (mesh, names) = self.divided(&names)?;
        let joints = mesh.joined(&names)?;
        let mut groups = joints.groups.iter();
        groups.try_fold(mesh, |mesh, members| {
            let members: Vec<&str> = members.iter().map(|&k| names[k].as_str()).collect();
            mesh.split_group(&members, &joints)
        })
    }

    /// Splits the mesh along surfaces that continue one another.
    fn split_group(mut self, names: &[&str], joints: &Joints<D>) -> Result<Self, FemError> {
        let mut sides = names.iter().flat_map(|name| side_names(name));
        let taken = |side: &String| {
            self.has_surface(side) || self.parts().any(|(part, _)| part == side.as_str())
        };
        if let Some(name) = sides.find(taken) {
            return Err(FemError::RepeatedName { name });
        }
        let inner = std::mem::take(&mut self.surfaces.inner);
        let own = |surface: &Surface<D>| names.contains(&surface.name.as_str());
        let (mut members, others): (Vec<_>, Vec<_>) = inner.into_iter().partition(own);
        members.sort_by_key(|surface| names.iter().position(|name| *name == surface.name));
        self.surfaces.inner = others;
        let union = Union::new(members);
        let sheet = Sheet::new(&self, &union, joints)?;
        let fans = Fans::new(&self, &union, &sheet)?;
        self.opened(&union, &sheet, fans)
    }

    /// This mesh with the copies of the vertices of surfaces, which are no longer among its inner ones.
    fn opened(mut self, union: &Union<D>, sheet: &Sheet, fans: Fans) -> Result<Self, FemError> {
        let (mut owners, mut pairs) = (Vec::new(), Vec::<[[u32; 2]; D]>::new());
        let (mut upper, mut lower) = (Vec::new(), Vec::new());
        let mut opened = vec![false; union.faces.len()];
        let mut named = vec![false; union.names.len()];
        for (k, (&common, sides)) in union.faces.iter().zip(&sheet.sides).enumerate() {
            let [above, below] = sides.map(|side| fans.copy(&self, common, side));
            if above != below {
                opened[sheet.components[k]] = true;
                owners.push(union.owners[k]);
                named[union.owners[k]] = true;
                pairs.push(std::array::from_fn(|c| [above[c], below[c]]));
                upper.push(face(&fans.cells, sides[0]));
                lower.push(face(&fans.cells, sides[1]));
            }
        }
        let closed = |k: &usize| !opened[sheet.components[*k]] || !named[union.owners[*k]];
        if let Some(first) = (0..union.faces.len()).find(closed) {
            let (owner, part) = (union.owners[first], sheet.components[first]);
            let corners = union.faces[first].map(|p| self.vertices[p as usize]);
            let middle = corners.iter().sum::<nalgebra::SVector<f64, D>>() / D as f64;
            let others = (0..union.faces.len())
                .filter(|&k| union.owners[k] == owner && sheet.components[k] == part);
            return Err(FemError::OpensNowhere {
                surface: union.names[owner].clone(),
                faces: others.count(),
                at: middle.iter().copied().collect(),
            });
        }
        let (start, added) = (self.boundary.len(), upper.len());
        let mut cuts = Vec::with_capacity(self.surfaces.cuts.len() + 1);
        for cut in &self.surfaces.cuts {
            let copies = |twin: &[usize; 2]| {
                let above = self.boundary[twin[0]];
                let below = above.map(|p| cut.minus(p));
                // The minus face has its vertices in another order.
                let [plus, minus] =
                    twin.map(|place| (self.boundary[place], fans.copy_of_boundary(&self, place)));
                let renumbered = |(old, new): ([u32; D], [u32; D]), p: u32| {
                    new[old.iter().position(|&q| q == p).unwrap_or(0)]
                };
                (0..D)
                    .map(|c| [renumbered(plus, above[c]), renumbered(minus, below[c])])
                    .collect::<Vec<_>>()
            };
            cuts.push(Cut {
                pairs: sorted_pairs(cut.twins.iter().flat_map(copies)),
                ..cut.clone()
            });
        }
        for (owner, name) in union.names.iter().enumerate() {
            let own: Vec<usize> = (0..added).filter(|&k| owners[k] == owner).collect();
            let places = |side: usize| own.iter().map(move |k| start + side * added + k);
            cuts.push(Cut {
                name: name.clone(),
                pairs: sorted_pairs(
                    own.iter()
                        .flat_map(|&k: &usize| -> [[u32; 2]; D] { pairs[k] }),
                ),
                twins: places(0).zip(places(1)).map(|(a, b)| [a, b]).collect(),
            });
            for (side, name) in side_names(name).into_iter().enumerate() {
                self.groups.add_part(name, places(side).collect())?;
            }
        }
        let origin = |p: u32| {
            let copy = (p as usize).checked_sub(self.vertices.len());
            copy.map_or(p, |copy| fans.copied[copy])
        };
        let touched = cuts
            .iter()
            .rev()
            .find_map(|cut| Some((cut, twice_paired(&cut.pairs)?)));
        if let Some((cut, (p, faces))) = touched {
            let p = origin(p);
            let own = union.names.contains(&cut.name);
            return Err(FemError::NotManifold {
                surface: if own { &cut.name } else { &union.names[0] }.clone(),
                faces,
                vertices: vec![p],
                at: self.vertices[p as usize].iter().copied().collect(),
            });
        }

        let mut boundary: Vec<[u32; D]> = (0..self.boundary.len())
            .map(|place| fans.copy_of_boundary(&self, place))
            .collect();
        boundary.extend(upper.into_iter().chain(lower));
        let mut inner = Vec::with_capacity(self.surfaces.inner.len());
        for other in &self.surfaces.inner {
            let sides = self.sides(&other.faces);
            let copies = other.faces.iter().zip(&sides).filter_map(|(&face, sides)| {
                let [first, second] = sides.places.map(|side| fans.copy(&self, face, side));
                (first == second).then(|| sorted(first))
            });
            let mut faces: Vec<[u32; D]> = copies.collect();
            faces.sort_unstable();
            if !faces.is_empty() {
                let name = other.name.clone();
                inner.push(Surface { name, faces });
            }
        }
        let copies = fans.copied.iter().map(|&p| self.vertices[p as usize]);
        let mut vertices = self.vertices.clone();
        vertices.extend(copies);
        self.surfaces.inner = inner;
        self.surfaces.cuts = cuts;
        Ok(Self {
            fingerprint: fingerprint(&vertices, &fans.cells),
            vertices,
            cells: fans.cells,
            boundary,
            ..self
        })
    }
}

/// The names of the plus and the minus side of a surface.
fn side_names(name: &str) -> [String; 2] {
    ["+", "-"].map(|side| format!("{name}{side}"))
}

fn sorted_pairs(pairs: impl Iterator<Item = [u32; 2]>) -> Vec<[u32; 2]> {
    let mut pairs: Vec<[u32; 2]> = pairs.collect();
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}
