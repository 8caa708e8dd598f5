//! Files from which a run goes on in any number of processes.

mod state;
mod table;

use std::fmt::Display;
use std::path::PathBuf;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use stickslip::integrate::Stepper;
use stickslip::record::FileError;
use stickslip::{Checkpoint, SceneError, Snapshot};

use crate::copies::Place;
use crate::{DistributedSpace, Error, World};
use state::{Globals, Owned};
use table::{Table, words_of};

/// A file from which a run goes on, in as many processes as before or in another number.
///
/// The first process writes and reads it, in the format of [`Checkpoint`]: beside the file, and then in its place, with
/// a checksum. It holds the state of the whole body, vertices by their places, so that it has the same bits whatever the
/// number of processes. The memory of the first process has to hold that state.
///
/// Another body is refused by the number of its components and contacts, and by the places of its vertices and of those
/// of its contacts. Laws, loads, boundary data, scheme, coupling and steps are known by their tags alone. A serial
/// program and one of several processes refuse each other's files.
///
/// All processes call each function together. Where it fails in one, that one has the reason, and the others
/// [`Error::Elsewhere`].
#[derive(Debug)]
pub struct SharedCheckpoint<'a, const D: usize> {
    space: &'a DistributedSpace<D>,
    file: Checkpoint,
}

/// The content of the file.
#[derive(Serialize, Deserialize)]
struct Contents {
    globals: Globals,
    /// The body, then its contacts.
    tables: Vec<Table>,
    /// As they are encoded, of a type that only the program knows.
    records: Vec<u8>,
}

impl<'a, const D: usize> SharedCheckpoint<'a, D> {
    /// The checkpoint at this path; nothing is read or written yet.
    pub fn at(space: &'a DistributedSpace<D>, path: impl Into<PathBuf>) -> Self {
        let file = Checkpoint::at(path);
        Self { space, file }
    }

    /// Adds a tag that must match on restart: parameters, scheme, step size. A file with
    /// other tags, or in another order, is refused.
    #[must_use]
    pub fn tagged(mut self, name: impl Into<String>, value: impl Display) -> Self {
        self.file = self.file.tagged(name, value);
        self
    }

    /// Writes the state shown, and the `records` of the first process.
    ///
    /// # Errors
    /// [`Error`]; the file that was there still is.
    pub fn save<T, const C: usize>(&self, at: &Snapshot<'_, C>, records: &T) -> Result<(), Error>
    where
        T: Serialize + ?Sized,
    {
        let world = self.space.world();
        let (owned, file) = (self.owned(at), self.known_by(at)?);
        let gathered = owned.iter().map(|owned| {
            let widths = owned.widths(world);
            Table::gather(
                world,
                &owned.places,
                words_of::<D>(),
                &owned.rows(&widths),
                widths,
            )
        });
        let tables = gathered.collect::<Result<Vec<_>, _>>()?;
        let written = if world.is_first() {
            write(&file, at, tables, records)
        } else {
            Ok(())
        };
        agreed(world, written)
    }

    /// Puts a simulation of the same scene into the state of the file, and returns the records. Where that fails the
    /// simulation is not to be used any more.
    ///
    /// # Errors
    /// [`Error`] for a file that cannot be read, is no checkpoint, is damaged, is of another body or
    /// with other tags, or holds other records.
    pub fn restore<T, const C: usize>(
        &self,
        stepper: &mut (impl Stepper<C> + ?Sized),
    ) -> Result<T, Error>
    where
        T: DeserializeOwned,
    {
        let world = self.space.world();
        let at = stepper.snapshot();
        let (mut owned, file) = (self.owned(&at), self.known_by(&at)?);
        let widths: Vec<Vec<usize>> = owned.iter().map(|owned| owned.widths(world)).collect();
        let mut state = at.state().clone();
        let read = if world.is_first() {
            self.read(&file, &owned, &widths)
        } else {
            Ok((Vec::new(), Vec::new()))
        };
        let (head, tables) = agreed(world, read)?;
        let head = world.broadcast(&head)?;
        for (k, (owned, widths)) in owned.iter_mut().zip(&widths).enumerate() {
            let rows = table::scatter(world, tables.get(k), &owned.places, words_of::<D>())?;
            let whole = rows.len() == owned.len() * widths.iter().sum::<usize>();
            let known = if whole {
                Ok(())
            } else {
                Err(self.other("place of a vertex"))
            };
            agreed(world, known)?;
            owned.take(&rows, widths);
        }
        state::put(&owned, &mut state);
        let other_records = |source: postcard::Error| FileError::Contents {
            path: self.file.path().into(),
            what: "the records asked for",
            source: Some(Box::new(source)),
        };
        let records = postcard::from_bytes::<(Globals, Vec<u8>)>(&head)
            .and_then(|(globals, records)| {
                globals.put(&mut state);
                postcard::from_bytes(&records)
            })
            .map_err(other_records);
        let records = agreed(world, records)?;
        let restored = stepper.restore(&state);
        agreed(world, restored.map_err(|source| self.unfit(source)))?;
        Ok(records)
    }

    /// The vertices of the body and of its contacts that this process owns.
    fn owned<const C: usize>(&self, at: &Snapshot<'_, C>) -> Vec<Owned> {
        let places = self.space.places();
        let contacts = (0..at.contact_count()).map(|index| {
            let contact = at.contact(index);
            let vertices = (0..contact.len()).map(|k| places[contact.vertex(k)]);
            let own: Vec<Place<D>> = vertices.collect();
            Owned::of_contact(&own, &at.state().contacts[index])
        });
        let contacts: Vec<Owned> = contacts.collect();
        let body = Owned::of_body(places, at.state());
        std::iter::once(body).chain(contacts).collect()
    }

    /// The file, by the tags of the run and by the body.
    fn known_by<const C: usize>(&self, at: &Snapshot<'_, C>) -> Result<Checkpoint, Error> {
        let contacts = at.contact_count();
        let mut file = (self.file.clone())
            .tagged("the kind of program", "one of several processes")
            .tagged("the number of components", C)
            .tagged("the number of contacts", contacts);
        for (index, owned) in self.owned(at).iter().enumerate() {
            let of = match index.checked_sub(1) {
                None => "the body".to_string(),
                Some(contact) => format!("contact {contact}"),
            };
            let (count, hash) =
                table::known_by(self.space.world(), &owned.places, words_of::<D>())?;
            file = file
                .tagged(format!("the number of vertices of {of}"), count)
                .tagged(format!("the set of places of {of}"), format!("{hash:016x}"));
        }
        Ok(file)
    }

    /// The data of no vertex, encoded, and the tables, if they are of a method with the same algorithmic fields.
    fn read(
        &self,
        file: &Checkpoint,
        owned: &[Owned],
        widths: &[Vec<usize>],
    ) -> Result<(Vec<u8>, Vec<Table>), FileError> {
        let contents: Contents = file.restore_gathered()?;
        if contents.tables.len() != owned.len() {
            return Err(self.other("number of contacts"));
        }
        for ((table, owned), expected) in contents.tables.iter().zip(owned).zip(widths) {
            let mut pairs = table.widths().iter().zip(expected).zip(owned.names());
            if let Some(((&found, &expected), what)) = pairs.find(|((a, b), _)| a != b) {
                return Err(self.unfit(SceneError::Length {
                    what,
                    expected,
                    found,
                }));
            }
        }
        let head = postcard::to_stdvec(&(contents.globals, contents.records));
        Ok((head.map_err(unencoded)?, contents.tables))
    }

    fn other(&self, what: &str) -> FileError {
        FileError::Mismatch {
            path: self.file.path().into(),
            kind: "checkpoint",
            what: format!("the {what}"),
            found: "absent".into(),
            expected: "present".into(),
        }
    }

    fn unfit(&self, source: SceneError) -> FileError {
        let (path, source) = (self.file.path().into(), Box::new(source));
        FileError::State { path, source }
    }
}

fn write<T, const C: usize>(
    file: &Checkpoint,
    at: &Snapshot<'_, C>,
    tables: Vec<Table>,
    records: &T,
) -> Result<(), FileError>
where
    T: Serialize + ?Sized,
{
    let contents = Contents {
        globals: Globals::of(at.state()),
        tables,
        records: postcard::to_stdvec(records).map_err(unencoded)?,
    };
    file.save_gathered(at.time, &contents)
}

fn unencoded(source: postcard::Error) -> FileError {
    FileError::Encode {
        what: "records",
        source: Box::new(source),
    }
}

/// The result of this process, if no process has failed.
fn agreed<T>(world: World, found: Result<T, FileError>) -> Result<T, Error> {
    let all = world.all(found.is_ok());
    let found = found?;
    if all {
        Ok(found)
    } else {
        Err(Error::Elsewhere)
    }
}
