//! Imports run one way: no circle of more than four files in a crate, and none upward between the rooms of crate
//! `stickslip`, which docs/architecture.md lists from above.

use std::collections::BTreeMap;
use std::fs;

use crate::imports::{Imports, largest_circle};
use crate::{Outcome, root};

/// The rooms, the files and folders of `crates/stickslip/src`, with the number of their floor from below.
fn floors() -> Outcome<BTreeMap<String, usize>> {
    let page = fs::read_to_string(root().join("docs/architecture.md"))?;
    let list = page
        .split("```rooms\n")
        .nth(1)
        .and_then(|rest| rest.split("```").next());
    let floors = list.ok_or("no list of rooms")?.lines().rev().enumerate();
    let rooms = floors.flat_map(|(floor, line)| {
        let names = line.split("  ").next().unwrap_or_default();
        names
            .split_whitespace()
            .map(move |room| (room.to_owned(), floor))
    });
    Ok(rooms.collect())
}

#[test]
fn no_circle_has_more_than_four_files() -> Outcome {
    for entry in fs::read_dir(root().join("crates"))? {
        let src = entry?.path().join("src");
        if src.is_dir() {
            let imports = Imports::read(&src)?;
            let circle = largest_circle(&imports.pairs());
            assert!(circle.len() <= 4, "{}: {circle:?}", src.display());
        }
    }
    Ok(())
}

#[test]
fn no_import_runs_upward() -> Outcome {
    let floors = floors()?;
    let imports = Imports::read(&root().join("crates/stickslip/src"))?;
    let room = |file: &str| file.split(['/', '.']).next().unwrap_or_default().to_owned();
    let mut upward = Vec::new();
    for (from, to) in imports.pairs() {
        let rooms = [room(from), room(to)];
        let [low, high] = rooms.each_ref().map(|room| floors.get(room));
        let [Some(low), Some(high)] = [low, high] else {
            return Err(format!("no room of the list: {rooms:?}").into());
        };
        if low < high {
            upward.push((from, to));
        }
    }
    assert!(upward.is_empty(), "{upward:#?}");
    Ok(())
}
