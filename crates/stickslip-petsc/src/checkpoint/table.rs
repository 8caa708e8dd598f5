//! Rows of numbers by the place of a vertex, in the first process.

use nalgebra::SVector;
use serde::{Deserialize, Serialize};

use crate::numbering::key;
use crate::{Error, World};

/// A row for each vertex of a set, by place: the same in whatever processes the vertices were.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Table {
    /// The numbers per vertex of each field; none where there is no such field.
    widths: Vec<usize>,
    /// The coordinates of each vertex, by their bits increasing.
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
        dimension: usize,
        rows: &[f64],
        widths: Vec<usize>,
    ) -> Result<Self, Error> {
        let width: usize = widths.iter().sum();
        let mut words = Vec::with_capacity(places.len() + rows.len());
        for (k, place) in places.chunks_exact(dimension).enumerate() {
            let row = &rows[width * k..width * (k + 1)];
            words.extend(place.iter().copied().chain(row.iter().map(|x| x.to_bits())));
        }
        let gathered = world.to_first(words)?;
        let entries = gathered
            .iter()
            .flat_map(|list| list.chunks_exact(dimension + width));
        let mut entries: Vec<&[u64]> = entries.collect();
        entries.sort_unstable_by_key(|entry| &entry[..dimension]);
        let numbers = |range: std::ops::Range<usize>| {
            let words = entries.iter().flat_map(move |entry| &entry[range.clone()]);
            words.map(|&word| f64::from_bits(word)).collect()
        };
        Ok(Self {
            places: numbers(0..dimension),
            rows: numbers(dimension..dimension + width),
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
    dimension: usize,
) -> Result<Vec<f64>, Error> {
    let asked = world.to_first(places.to_vec())?;
    let (known, rows, width) = table.map_or((Vec::new(), &[][..], 0), |table| {
        let known = table.places.iter().map(|x| x.to_bits());
        (known.collect(), &table.rows[..], table.widths.iter().sum())
    });
    let known: Vec<&[u64]> = known.chunks_exact(dimension).collect();
    let answer = |places: &Vec<u64>| {
        let places = places.chunks_exact(dimension);
        let found = places.filter_map(|place| known.binary_search(&place).ok());
        let rows = found.filter_map(|k| rows.get(width * k..width * (k + 1)));
        rows.flatten().map(|x| x.to_bits()).collect()
    };
    let answers: Vec<Vec<u64>> = asked.iter().map(answer).collect();
    let answered = world.all_to_all(&answers)?;
    Ok(answered.into_iter().flatten().map(f64::from_bits).collect())
}

/// The words of places, one after the other.
pub(super) fn words<const D: usize>(places: &[SVector<f64, D>]) -> Vec<u64> {
    places.iter().flat_map(key).collect()
}

/// The number of places in all processes, and a hash that does not depend on their distribution.
pub(super) fn known_by(
    world: World,
    places: &[u64],
    dimension: usize,
) -> Result<(u64, u64), Error> {
    let places = places.chunks_exact(dimension);
    let count = places.len() as u64;
    let hash = places.map(mixed).fold(0, u64::wrapping_add);
    let counts = world.gather(count)?;
    let hashes = world.gather(hash)?;
    Ok((
        counts.iter().sum(),
        hashes.into_iter().fold(0, u64::wrapping_add),
    ))
}

/// A word of a place. Source: G. Steele, D. Lea, C. Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014.
fn mixed(place: &[u64]) -> u64 {
    place
        .iter()
        .fold(0x9e37_79b9_7f4a_7c15, |hash: u64, &word| {
            let mut z = (hash ^ word).wrapping_add(0x9e37_79b9_7f4a_7c15);
            z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            z ^ (z >> 31)
        })
}
