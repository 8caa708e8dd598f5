//! The options by name, as the sources have them.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use super::cases::CASES;
use crate::Outcome;

/// The options of a reduction, whose test is their own.
const OF_REDUCTION: [&str; 2] = ["with_vertices", "with_memory_limit"];
/// An option of faults inside a body, tested with their two sides (`tests/two_sides/creep.rs`).
const OF_FAULTS: &str = "prescribe_slip_rate";
/// Options of parts of a boundary, which contacts and conditions show.
const PARTS: &str = "part.rs";

/// The methods of the sources in a folder that take an object by value and return it changed.
fn options(folder: &str) -> Outcome<BTreeSet<String>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../stickslip/src")
        .join(folder);
    let mut found = BTreeSet::new();
    for file in fs::read_dir(folder)? {
        let path = file?.path();
        if path.extension().is_none_or(|kind| kind != "rs") || path.ends_with(PARTS) {
            continue;
        }
        let text = fs::read_to_string(path)?;
        for method in text.split("\n    pub fn ").skip(1) {
            let Some((name, rest)) = method.split_once(['(', '<']) else {
                continue;
            };
            let head = rest.split_once(" {").map_or(rest, |(head, _)| head);
            let takes = head.contains("mut self,")
                || head.contains("(mut self")
                || head.starts_with("mut self");
            let takes = takes || head.starts_with("self") || head.contains("\n        self,");
            let gives = ["-> Self", "-> Contact<"]
                .iter()
                .any(|kind| head.contains(kind));
            if takes && gives {
                found.insert(name.to_owned());
            }
        }
    }
    Ok(found)
}

/// An option that is new has to be in the walk.
#[test]
fn the_walk_has_every_option() -> Outcome {
    let mut known: BTreeSet<String> = CASES.iter().map(|case| case.name.to_owned()).collect();
    known.extend(OF_REDUCTION.map(String::from));
    known.insert(OF_FAULTS.to_owned());
    let mut found = BTreeSet::new();
    for folder in ["scene", "reduced"] {
        found.append(&mut options(folder)?);
    }
    assert_eq!(found, known);
    Ok(())
}
