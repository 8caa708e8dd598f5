//! The root, the module of Python and several processes compile what they share once: by one table of profiles, with one
//! set of features and in one version.

use std::collections::BTreeSet;
use std::fs;

use crate::{Outcome, root};

/// The folders of the other workspaces.
const OTHERS: [&str; 2] = ["python", "crates/stickslip-petsc"];

fn read(path: &str) -> Outcome<String> {
    Ok(fs::read_to_string(root().join(path))?)
}

/// Names and versions of all packages of a workspace.
fn packages(workspace: &str) -> Outcome<BTreeSet<(String, String)>> {
    let lock = read(&format!("{workspace}/Cargo.lock"))?;
    let mut packages = BTreeSet::new();
    for package in lock.split("[[package]]").skip(1) {
        let value = |key: &str| {
            let line = package.lines().find_map(|line| line.strip_prefix(key));
            line.map(|value| value.trim_matches('"').to_owned())
        };
        let name = value("name = ").ok_or("a package without a name")?;
        let version = value("version = ").ok_or("a package without a version")?;
        packages.insert((name, version));
    }
    Ok(packages)
}

#[test]
fn profiles_of_tests_stand_in_one_table() -> Outcome {
    assert!(read(".cargo/config.toml")?.contains("[profile.dev]"));
    for manifest in OTHERS.iter().chain(&["."]) {
        let text = read(&format!("{manifest}/Cargo.toml"))?;
        assert!(!text.contains("[profile.dev"), "{manifest}");
    }
    Ok(())
}

/// Features add up over a workspace: each has all those of the package `stickslip-features`, and asks for no others of
/// the engine.
#[test]
fn features_are_those_of_one_package() -> Outcome {
    let features = |text: &str| -> BTreeSet<String> {
        let lines = text.lines();
        let engine = lines.filter(|line| line.starts_with("stickslip = {"));
        let lists = engine.filter_map(|line| Some(line.split_once("features = [")?.1.to_owned()));
        let names = lists.flat_map(|list| {
            let names = list.split(']').next().unwrap_or_default();
            let names = names
                .split(',')
                .map(|name| name.trim().trim_matches('"').to_owned());
            names.collect::<Vec<_>>()
        });
        names.collect()
    };
    let mut all = features(&read("crates/features/Cargo.toml")?);
    assert!(all.contains("rayon"), "{all:?}");
    // With checkpoint comes serde.
    all.insert("serde".to_owned());
    for manifest in OTHERS
        .iter()
        .chain(&["examples", "crates/stickslip-cli", "benches/studies"])
    {
        let text = read(&format!("{manifest}/Cargo.toml"))?;
        let own = features(&text);
        assert!(own.is_subset(&all), "{manifest}: {own:?}");
    }
    for manifest in OTHERS.iter().chain(&["examples"]) {
        let text = read(&format!("{manifest}/Cargo.toml"))?;
        assert!(text.contains("stickslip-features"), "{manifest}");
    }
    Ok(())
}

#[test]
fn shared_packages_have_one_version() -> Outcome {
    let all = packages(".")?;
    let names: BTreeSet<_> = all.iter().map(|(name, _)| name).collect();
    for workspace in OTHERS {
        let own = packages(workspace)?;
        let other: Vec<_> = own
            .iter()
            .filter(|package| names.contains(&package.0))
            .collect();
        assert!(other.len() > 50, "{workspace}: {}", other.len());
        for package in other {
            assert!(all.contains(package), "{workspace}: {package:?}");
        }
    }
    Ok(())
}
