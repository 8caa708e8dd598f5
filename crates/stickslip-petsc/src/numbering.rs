//! Numbers of vertices in all processes, by their places.

use std::collections::HashMap;

use crate::copies::{Place, word_of};
use crate::{Error, World};

/// Numbers the `owned` of some vertices of all processes one after the other, and finds the numbers of the `wanted`, of
/// which others may own some: the first number of each process, and the numbers that were wanted.
pub(crate) fn global_numbers<const D: usize>(
    world: World,
    places: &[Place<D>],
    owned: &[u32],
    wanted: &[u32],
) -> Result<(Vec<u64>, Vec<u64>), Error> {
    let counts = world.gather(owned.len() as u64)?;
    let sums = counts.iter().scan(0, |end, count| {
        let first = *end;
        *end += count;
        Some(first)
    });
    let firsts: Vec<u64> = sums.collect();
    // Each place has a process that knows who owns it.
    let mut known = vec![Vec::new(); world.size()];
    for (number, &vertex) in (firsts[world.rank()]..).zip(owned) {
        let (key, label) = &places[vertex as usize];
        let list = &mut known[keeper(key, world)];
        list.extend(key);
        list.extend([*label, number]);
    }
    let mut asked = vec![Vec::new(); world.size()];
    let mut order = vec![Vec::new(); world.size()];
    for (k, &vertex) in wanted.iter().enumerate() {
        let (key, label) = &places[vertex as usize];
        let keeper = keeper(key, world);
        asked[keeper].extend(key);
        asked[keeper].push(*label);
        order[keeper].push(k);
    }
    let known = world.all_to_all(&known)?;
    let table: HashMap<&[u64], u64> = (known.iter())
        .flat_map(|list| list.chunks_exact(D + 2))
        .map(|entry| (&entry[..=D], entry[D + 1]))
        .collect();
    let answer = |list: &Vec<u64>| {
        let keys = list.chunks_exact(D + 1);
        keys.map(|key| table.get(key).copied().unwrap_or(u64::MAX))
            .collect()
    };
    let asked = world.all_to_all(&asked)?;
    let answers: Vec<Vec<u64>> = asked.iter().map(answer).collect();
    let answers = world.all_to_all(&answers)?;
    let mut found = vec![u64::MAX; wanted.len()];
    for (number, k) in answers
        .into_iter()
        .flatten()
        .zip(order.into_iter().flatten())
    {
        found[k] = number;
    }
    if world.all(!found.contains(&u64::MAX)) {
        Ok((firsts, found))
    } else {
        Err(Error::NoOwner)
    }
}

/// The process that knows whose vertex is at a place.
fn keeper(key: &[u64], world: World) -> usize {
    (word_of(key.iter().copied()) % world.size() as u64) as usize
}
