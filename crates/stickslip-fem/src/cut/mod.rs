//! Splitting a mesh along surfaces inside it.

mod fans;
mod pairs;
mod sheet;
mod side;
mod split_surface;

use crate::boundary::face;
use crate::fingerprint::fingerprint;
use crate::surfaces::{Surface, sorted};
use crate::{FemError, Mesh};
use fans::Fans;
use pairs::twice_paired;
pub(crate) use pairs::{Cut, Opposite, coinciding};
use sheet::Sheet;
pub(crate) use side::Side;
pub use split_surface::SplitSurface;

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
    /// Where faults meet, the order counts: split the faults that pass through first. A surface that ends on an earlier
    /// fault has a tip there, and one that passes through has both sides on either side of it, four copies.
    ///
    /// [`Trace::opposite`](crate::Trace::opposite) has the pairs of vertices. Refined meshes have the same pairs:
    /// uniform refinement and grading refine both sides alike.
    ///
    /// # Errors
    ///
    /// [`FemError::Unknown`]; [`FemError::RepeatedName`] if there is a part of the name of a side;
    /// [`FemError::NotManifold`], [`FemError::OneSided`], [`FemError::OpensNowhere`], or
    /// [`FemError::TooMany`].
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
    pub fn split(mut self, name: &str) -> Result<Self, FemError> {
        let Some(at) = self.surfaces().position(|(surface, _)| surface == name) else {
            return Err(FemError::Unknown {
                what: "surface inside the body",
                name: name.to_owned(),
                known: self.surfaces().map(|(name, _)| name.to_owned()).collect(),
            });
        };
        let names = ["+", "-"].map(|side| format!("{name}{side}"));
        let known = |side: &&String| {
            self.has_surface(side) || self.parts().any(|(part, _)| part == side.as_str())
        };
        if let Some(name) = names.iter().find(known) {
            let name = name.clone();
            return Err(FemError::RepeatedName { name });
        }
        let surface = self.surfaces.inner.remove(at);
        let sheet = Sheet::new(&self, &surface)?;
        let fans = Fans::new(&self, &surface, &sheet)?;
        self.opened(&surface, &sheet, fans, names)
    }

    /// Splits the mesh along several surfaces, one after the other; those that pass through others first.
    ///
    /// # Errors
    /// Those of [`Mesh::split`].
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
    /// # Ok::<(), stickslip_fem::FemError>(())
    /// ```
    pub fn split_all(
        self,
        names: impl IntoIterator<Item = impl AsRef<str>>,
    ) -> Result<Self, FemError> {
        let mut names = names.into_iter();
        names.try_fold(self, |mesh, name| mesh.split(name.as_ref()))
    }

    /// This mesh with the copies of the vertices of a surface, which is no longer one of its inner ones.
    fn opened(
        mut self,
        surface: &Surface<D>,
        sheet: &Sheet,
        fans: Fans,
        [plus, minus]: [String; 2],
    ) -> Result<Self, FemError> {
        let (mut pairs, mut upper, mut lower) = (Vec::new(), Vec::new(), Vec::new());
        let mut opened = vec![false; surface.faces.len()];
        for (k, (&common, sides)) in surface.faces.iter().zip(&sheet.sides).enumerate() {
            let [above, below] = sides.map(|side| fans.copy(&self, common, side));
            if above != below {
                opened[sheet.components[k]] = true;
                pairs.extend((0..D).map(|c| [above[c], below[c]]));
                upper.push(face(&fans.cells, sides[0]));
                lower.push(face(&fans.cells, sides[1]));
            }
        }
        let closed = |k: &&usize| !opened[**k];
        if let Some(&part) = sheet.components.iter().find(closed) {
            let corners = surface.faces[part].map(|p| self.vertices[p as usize]);
            let middle = corners.iter().sum::<nalgebra::SVector<f64, D>>() / D as f64;
            return Err(FemError::OpensNowhere {
                surface: surface.name.clone(),
                faces: sheet.components.iter().filter(|&&k| k == part).count(),
                at: middle.iter().copied().collect(),
            });
        }
        let places = self.boundary.len()..self.boundary.len() + upper.len();
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
        cuts.push(Cut {
            name: surface.name.clone(),
            pairs: sorted_pairs(pairs.into_iter()),
            twins: places.clone().map(|k| [k, k + upper.len()]).collect(),
        });
        let origin = |p: u32| {
            let copy = (p as usize).checked_sub(self.vertices.len());
            copy.map_or(p, |copy| fans.copied[copy])
        };
        if let Some((p, faces)) = cuts.iter().find_map(|cut| twice_paired(&cut.pairs)) {
            let p = origin(p);
            return Err(FemError::NotManifold {
                surface: surface.name.clone(),
                faces,
                vertices: vec![p],
                at: self.vertices[p as usize].iter().copied().collect(),
            });
        }

        let mut boundary: Vec<[u32; D]> = (0..self.boundary.len())
            .map(|place| fans.copy_of_boundary(&self, place))
            .collect();
        let added = upper.len();
        boundary.extend(upper.into_iter().chain(lower));
        self.groups.add_part(plus, places.clone().collect())?;
        self.groups
            .add_part(minus, places.map(|place| place + added).collect())?;
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

fn sorted_pairs(pairs: impl Iterator<Item = [u32; 2]>) -> Vec<[u32; 2]> {
    let mut pairs: Vec<[u32; 2]> = pairs.collect();
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}
