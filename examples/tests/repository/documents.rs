//! The documents: every program in them is compiled by a test, every link leads somewhere, every page is in the book, every
//! feature is in the table.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use crate::{Outcome, root};

/// The files that compile programs of documents.
const INCLUDING: [&str; 1] = ["examples/documents.rs"];

/// The parts of the book, in the order of `docs/SUMMARY.md`.
const PARTS: [&str; 4] = ["Tutorials", "How-to", "Explanation", "Reference"];

/// The documents of the workspace, with their text: those beside the manifest, and those in `docs` and below.
fn documents() -> Outcome<Vec<(PathBuf, String)>> {
    let mut folders = vec![root().join("docs")];
    let mut paths = markdown_in(&root())?;
    while let Some(folder) = folders.pop() {
        paths.extend(markdown_in(&folder)?);
        for entry in fs::read_dir(&folder)? {
            let path = entry?.path();
            if path.is_dir() {
                folders.push(path);
            }
        }
    }
    let read = |path: PathBuf| Ok((path.clone(), fs::read_to_string(path)?));
    paths.into_iter().map(read).collect()
}

fn markdown_in(folder: &Path) -> Outcome<Vec<PathBuf>> {
    let entries: Result<Vec<_>, _> = fs::read_dir(folder)?.collect();
    let paths = entries?.into_iter().map(|entry| entry.path());
    Ok(paths
        .filter(|path| path.extension().is_some_and(|end| end == "md"))
        .collect())
}

/// The lines outside of code, with links in them.
fn prose(text: &str) -> impl Iterator<Item = &str> {
    let mut code = false;
    text.lines().filter(move |line| {
        let fence = line.trim_start().starts_with("```");
        code ^= fence;
        !code && !fence
    })
}

/// The targets of the links of a text.
fn links(text: &str) -> Vec<&str> {
    let after = prose(text).flat_map(|line| line.split("](").skip(1));
    after.filter_map(|rest| rest.split(')').next()).collect()
}

/// The anchor of a heading: letters in lower case, digits, and dashes for spaces.
fn anchor(heading: &str) -> String {
    let text = heading.trim_start_matches('#').trim().to_lowercase();
    let kept = text
        .chars()
        .filter(|&c| c.is_alphanumeric() || " -_".contains(c));
    kept.map(|c| if c == ' ' { '-' } else { c }).collect()
}

#[test]
fn every_program_is_compiled() -> Outcome {
    let mut including = String::new();
    for file in INCLUDING {
        including += &fs::read_to_string(root().join(file))?;
    }
    let mut found = 0;
    for (path, text) in documents()? {
        if !text
            .lines()
            .any(|line| line.trim_start().starts_with("```rust"))
        {
            continue;
        }
        found += 1;
        let name = path.strip_prefix(root())?.display().to_string();
        let included = including.contains(&format!("../{name}\")"));
        assert!(
            included,
            "no test compiles {name}: include it in one of {INCLUDING:?}"
        );
    }
    assert!(found > 5, "{found} documents with programs");
    Ok(())
}

#[test]
fn every_link_leads_somewhere() -> Outcome {
    let (mut found, mut broken) = (0, Vec::new());
    for (path, text) in documents()? {
        for link in links(&text)
            .into_iter()
            .filter(|link| !link.contains("://"))
        {
            found += 1;
            if !leads_somewhere(&path, link)? {
                broken.push(format!("{}: {link}", path.display()));
            }
        }
    }
    assert!(broken.is_empty(), "{broken:#?}");
    assert!(found > 50, "{found} links");
    Ok(())
}

/// Whether a link of a document is to a file that is there, and to a heading in it if it names one.
fn leads_somewhere(document: &Path, link: &str) -> Outcome<bool> {
    let (file, heading) = link.split_once('#').unwrap_or((link, ""));
    let target = if file.is_empty() {
        document.to_path_buf()
    } else {
        document.with_file_name(file)
    };
    if heading.is_empty() || !target.is_file() {
        return Ok(target.exists());
    }
    let text = fs::read_to_string(&target)?;
    let mut lines = prose(&text);
    Ok(lines.any(|line| line.starts_with('#') && anchor(line) == heading))
}

/// `docs/SUMMARY.md` is a table of contents as mdBook reads it: titles of parts, and one list entry per page.
#[test]
fn every_page_is_in_the_book_once() -> Outcome {
    let docs = root().join("docs");
    let summary = fs::read_to_string(docs.join("SUMMARY.md"))?;
    let mut lines = summary.lines().filter(|line| !line.is_empty());
    assert_eq!(lines.next(), Some("# Summary"));
    let (mut parts, mut listed) = (Vec::new(), BTreeSet::new());
    for line in lines {
        if let Some(part) = line.strip_prefix("# ") {
            parts.push(part);
            continue;
        }
        let entry = (line.strip_prefix("- ["))
            .and_then(|rest| rest.strip_suffix(')'))
            .and_then(|rest| rest.split_once("]("));
        let (_, page) = entry.ok_or(format!("neither part nor page: {line}"))?;
        assert!(listed.insert(docs.join(page)), "{page} is listed twice");
    }
    assert_eq!(parts, PARTS);
    let pages: BTreeSet<_> = (documents()?.into_iter())
        .map(|(path, _)| path)
        .filter(|path| path.starts_with(&docs) && !path.ends_with("SUMMARY.md"))
        .collect();
    assert_eq!(listed, pages);
    let book = fs::read_to_string(docs.join("book.toml"))?;
    assert!(book.lines().any(|line| line == "src = \".\""), "{book}");
    Ok(())
}

#[test]
fn headings_are_linked_as_they_are_shown() {
    assert_eq!(
        anchor("## A velocity step, and what fits it"),
        "a-velocity-step-and-what-fits-it"
    );
    assert_eq!(links("[a](b.md#c), ![d](e.png)"), ["b.md#c", "e.png"]);
    assert_eq!(links("```text\n[a](b)\n```\n[c](d)"), ["d"]);
}

/// The features of the crate by its manifest, and whether they are on by default.
fn features() -> Outcome<BTreeMap<String, bool>> {
    let manifest = fs::read_to_string(root().join("crates/stickslip/Cargo.toml"))?;
    let section = manifest.split("\n[features]\n").nth(1);
    let section = section.and_then(|rest| rest.split("\n[").next());
    let lines = section.ok_or("no features")?.lines();
    let pairs = lines.filter(|line| !line.starts_with('#'));
    let mut all: BTreeMap<_, _> = pairs.filter_map(|line| line.split_once(" = ")).collect();
    let default = all.remove("default").ok_or("no default features")?;
    let on = |name: &str| default.contains(&format!("\"{name}\""));
    Ok(all
        .into_keys()
        .map(|name| (name.to_string(), on(name)))
        .collect())
}

#[test]
fn every_feature_is_in_the_table() -> Outcome {
    let page = fs::read_to_string(root().join("crates/stickslip/src/lib.rs"))?;
    let lines = page
        .lines()
        .skip_while(|line| !line.starts_with("//! | feature | default |"));
    let rows = lines.skip(2).map_while(|line| line.strip_prefix("//! | "));
    let mut table = BTreeMap::new();
    for row in rows {
        let cells: Vec<_> = row.split(" | ").collect();
        let default = match cells.get(1) {
            Some(&"yes") => true,
            Some(&"no") => false,
            _ => return Err(format!("no default: {row}").into()),
        };
        table.insert(cells[0].trim_matches('`').to_string(), default);
    }
    assert_eq!(table, features()?);
    Ok(())
}
