//! A sweep over laws in several processes.

use std::fs;

use super::{Place, run, succeed};

/// The table of a sweep.
fn table(processes: usize, arguments: &[&str]) -> String {
    let place = Place::new();
    succeed("sweep", processes, arguments, &place.file(""));
    fs::read_to_string(place.file("sweep.csv")).expect("a table")
}

/// Status and row of each set.
fn sets(table: &str) -> Vec<(bool, &str)> {
    let rows = table.lines().skip(1);
    rows.map(|row| (row.contains("lost: "), row)).collect()
}

#[test]
fn a_sweep_writes_the_same_table_in_any_number_of_processes() {
    let arguments = ["--refinements", "1", "--sets", "5", "--steps", "100"];
    let one = table(1, &arguments);
    assert_eq!(sets(&one).len(), 5);
    for processes in [2, 3] {
        assert_eq!(one, table(processes, &arguments), "{processes}");
    }
}

/// Steps of 0.375 s are too long for the events of most sets: these have rows that say so, and others theirs.
#[test]
fn sets_that_are_lost_are_reported_and_the_others_kept() {
    let arguments = ["--refinements", "1", "--sets", "6", "--steps", "40"];
    let given_up = [&arguments[..], &["--no-bridging"]].concat();
    let [split, given_up] = [&arguments[..], &given_up].map(|arguments| table(2, arguments));
    let [split, given_up] = [&split, &given_up].map(|table| sets(table));
    assert!(split.iter().all(|(lost, _)| !lost), "{split:?}");
    let lost = given_up.iter().filter(|(lost, _)| *lost).count();
    assert!(0 < lost && lost < given_up.len(), "{given_up:?}");
    for (there, here) in split.iter().zip(&given_up) {
        assert!(here.0 || there == here, "{here:?}");
    }
}

#[test]
fn a_command_line_that_cannot_be_read_ends_as_in_the_serial_example() {
    let ended = run("sweep", 2, &["--sets", "0"]);
    assert_eq!(ended.status.code(), Some(2));
    let ended = run("sweep", 2, &["--sets", "2", "--out", "/dev/null/x"]);
    assert_eq!(ended.status.code(), Some(1));
}
