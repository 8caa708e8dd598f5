//! Files of reduced bodies.

mod contents;

use std::path::Path;
use std::sync::Arc;

use stickslip_solvers::{BlockMatrix, Symmetric};

use super::ReducedBody;
use super::build::{Rows, handles, mesh_of, operators};
use super::marks::marks;
use super::projector::{Interior, Projector};
use super::support::Support;
use crate::file::Format;
use crate::marks::Mark;
use crate::scene::common_mesh;
use crate::{FileError, Scene};
use contents::{Contents, of_body, of_support, triangle};

const FORMAT: Format = Format {
    kind: "reduced body",
    magic: *b"\x89body\r\n\x1a",
    version: 1,
};

impl<const C: usize> ReducedBody<C> {
    /// Writes the expensive results of a reduction to a file: modes and reduced operators.
    ///
    /// # Errors
    /// [`FileError::Write`].
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), FileError> {
        let path = path.as_ref();
        let projector = &self.projector;
        let head = (
            of_body::<C>(self.support.fixed.len(), self.origin, self.marks),
            &self.support.boundary,
            of_support(&self.support),
        );
        let contents = (
            projector.interior.memory_limit as u64,
            &projector.squares,
            &projector.masses,
            &projector.shapes,
            self.next,
            triangle(&self.stiffness),
            self.mass.as_ref().map(triangle),
            self.viscosity.as_ref().map(triangle),
        );
        let payload = postcard::to_stdvec(&(head, contents));
        let payload = payload.map_err(|source| FileError::Encode {
            what: "a reduced body",
            source: Box::new(source),
        })?;
        FORMAT.write(path, &payload)
    }

    /// Reads a body that [`save`](Self::save) has written, for scenes similar to `scene`.
    ///
    /// Mesh and operators are those of the scene; a file of another body, or of one with other boundary conditions, is
    /// refused. The interior is factorised again on first use: by loads, by an initial displacement, or for fields of
    /// the whole body.
    ///
    /// ```
    /// use stickslip::problems::pipping_slider::{FRICTION, PippingSlider};
    /// use stickslip::reduced::{Reduced, ReducedBody};
    /// use stickslip::Contact;
    ///
    /// let slider = PippingSlider { refinements: 1, ..PippingSlider::default() };
    /// let space = slider.space()?;
    /// let scene = || -> Result<_, stickslip::SceneError> {
    ///     let seam = Contact::new(&PippingSlider::bottom(&space)?, stickslip::friction::Tresca { coefficient: 0.6 }, 5e4);
    ///     Ok(slider.scene(&space)?.with_contact(seam))
    /// };
    /// # let path = std::env::temp_dir().join(format!("stickslip-doc-body-{}", std::process::id()));
    /// Reduced::new(&scene()?).up_to_frequency(100.0)?.save(&path)?;
    ///
    /// // Another program, another day.
    /// let body = ReducedBody::load(&path, &scene()?)?;
    /// let reduced = body.reduce(scene()?)?;
    /// # std::fs::remove_file(&path)?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`FileError`] for a file that cannot be read, is of another kind, is damaged or belongs to another body.
    pub fn load(
        path: impl AsRef<Path>,
        scene: &Scene<BlockMatrix<C>, C>,
    ) -> Result<Self, FileError> {
        let path = path.as_ref();
        scene.check()?;
        let mesh = common_mesh(&scene.conditions)?;
        let payload = FORMAT.read(path)?;
        let no_body = |source: Option<postcard::Error>| FileError::Contents {
            path: path.into(),
            what: "a reduced body",
            source: source.map(Into::into),
        };
        let undecoded = |source| no_body(Some(source));
        let (found, rest) = postcard::take_from_bytes::<Vec<Mark>>(&payload).map_err(undecoded)?;
        let (size, marks) = (scene.stiffness.rows(), marks(scene));
        FORMAT.compare(path, &found, &of_body::<C>(size, mesh, marks))?;
        let (head, rest) =
            postcard::take_from_bytes::<(Vec<usize>, Vec<Mark>)>(rest).map_err(undecoded)?;
        let (boundary, found) = head;
        let support = Support::new(scene, &boundary)?;
        FORMAT.compare(path, &found, &of_support(&support))?;
        let (contents, rest) = postcard::take_from_bytes::<Contents<C>>(rest).map_err(undecoded)?;
        let eliminated = support.eliminated();
        let handles = handles(&support, &eliminated);
        let interior = Interior {
            boundary: support.boundary.clone(),
            eliminated,
            memory_limit: usize::try_from(contents.memory_limit).unwrap_or(usize::MAX),
        };
        let units = handles.iter().flatten().map(|handle| handle.units.len());
        let counts = [size, interior.owners().len(), units.sum()];
        if !rest.is_empty() || !contents.suits(scene, counts) {
            return Err(no_body(None));
        }
        let (stiffness, mass, _) = operators(scene, &support)?;
        let mut projector = Projector::new(interior, None, stiffness, contents.shapes);
        projector.handles = counts[2];
        projector.squares = contents.squares;
        projector.masses = contents.masses;
        let rows = Rows::new(&support, &projector, &handles);
        let operator = |entries: Vec<f64>| {
            Symmetric::new(&rows.moves, |row, column| {
                entries[row * (row + 1) / 2 + column]
            })
        };
        Ok(Self {
            mesh: mesh_of(
                &support,
                mesh,
                marks,
                [projector.squares.len(), rows.moves.len()],
            ),
            marks,
            origin: mesh,
            next: contents.next,
            stiffness: operator(contents.stiffness),
            mass: contents.mass.map(operator),
            viscosity: contents.viscosity.map(operator),
            handles: rows.handles.into_iter().zip(handles).collect(),
            moves: rows.moves,
            inertia: mass,
            projector: Arc::new(projector),
            support: Arc::new(support),
        })
    }
}
