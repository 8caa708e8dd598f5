//! Rows of numbers by the place of a vertex, in the first process.

use serde::{Deserialize, Serialize};

use crate::copies::{Place, word_of};
use crate::{Error, World};

/// A row for each vertex of a set, by place: the same in whatever processes the vertices were.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Table {
    /// The numbers per vertex of each field; none where there is no such field.
    widths: Vec<usize>,
    /// The words of the place of each vertex, as numbers, increasing as words.
    places: Vec<f64>,
    /// The fields of each vertex, one after the other.
    rows: Vec<f64>,
}

impl Table {
    /// Sends the rows of every process to the first, one a place, whose words they follow. It alone has the table
    /// afterwards, the others an empty one.
    pub(super) fn gather(
        world: World,
        places: &[u64],
        words: usize,
        rows: &[f64],
        widths: Vec<usize>,
    ) -> Result<Self, Error> {
        let width: usize = widths.iter().sum();
        let mut sent = Vec::with_capacity(places.len() + rows.len());
        for (k, place) in places.chunks_exact(words).enumerate() {
            let row = &rows[width * k..width * (k + 1)];
            sent.extend(place.iter().copied().chain(row.iter().map(|x| x.to_bits())));
        }
        let gathered = world.to_first(sent)?;
        let entries = gathered
            .iter()
            .flat_map(|list| list.chunks_exact(words + width));
        let mut entries: Vec<&[u64]> = entries.collect();
        entries.sort_unstable_by_key(|entry| &entry[..words]);
        let numbers = |range: std::ops::Range<usize>| {
            let numbers = entries.iter().flat_map(move |entry| &entry[range.clone()]);
            numbers.map(|&word| f64::from_bits(word)).collect()
        };
        Ok(Self {
            places: numbers(0..words),
            rows: numbers(words..words + width),
            widths,
        })
    }

    /// The numbers per vertex of each field.
    pub(super) fn widths(&self) -> &[usize] {
        &self.widths
    }
}

/// Asks the first process, which has the table, for the rows at the places of each; without those of places that there
/// are not.
pub(super) fn scatter(
    world: World,
    table: Option<&Table>,
    places: &[u64],
    words: usize,
) -> Result<Vec<f64>, Error> {
    let asked = world.to_first(places.to_vec())?;
    let (known, rows, width) = table.map_or((Vec::new(), &[][..], 0), |table| {
        let known = table.places.iter().map(|x| x.to_bits());
        (known.collect(), &table.rows[..], table.widths.iter().sum())
    });
    let known: Vec<&[u64]> = known.chunks_exact(words).collect();
    let answer = |places: &Vec<u64>| {
        let places = places.chunks_exact(words);
        let found = places.filter_map(|place| known.binary_search(&place).ok());
        let rows = found.filter_map(|k| rows.get(width * k..width * (k + 1)));
        rows.flatten().map(|x| x.to_bits()).collect()
    };
    let answers: Vec<Vec<u64>> = asked.iter().map(answer).collect();
    let answered = world.all_to_all(&answers)?;
    Ok(answered.into_iter().flatten().map(f64::from_bits).collect())
}

/// The words of a place: those of the position, and the label of the copy.
pub(super) const fn words_of<const D: usize>() -> usize {
    D + 1
}

/// The words of places, one after the other.
pub(super) fn words<const D: usize>(places: &[Place<D>]) -> Vec<u64> {
    let words = |&(key, label): &Place<D>| key.into_iter().chain([label]);
    places.iter().flat_map(words).collect()
}

/// The number of places in all processes, and a hash that does not depend on their distribution.
pub(super) fn known_by(world: World, places: &[u64], words: usize) -> Result<(u64, u64), Error> {
    let places = places.chunks_exact(words);
    let count = places.len() as u64;
    let hash = places
        .map(|place| word_of(place.iter().copied()))
        .fold(0, u64::wrapping_add);
    let counts = world.gather(count)?;
    let hashes = world.gather(hash)?;
    Ok((
        counts.iter().sum(),
        hashes.into_iter().fold(0, u64::wrapping_add),
    ))
}
