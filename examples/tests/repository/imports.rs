//! Which file of a crate imports which, as its `use` statements and paths say.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use crate::Outcome;

/// The place of a module, or of an item in it: names from the root of the crate on.
type Place = Vec<String>;

/// The files of a crate by the modules they are, with their imports.
pub(crate) struct Imports {
    files: BTreeMap<Place, String>,
    /// What a module hands on from others, by its name there.
    handed_on: BTreeMap<Place, BTreeMap<String, Place>>,
    imported: BTreeMap<Place, BTreeSet<Place>>,
}

impl Imports {
    /// Reads the files below a folder `src`.
    pub(crate) fn read(src: &Path) -> Outcome<Self> {
        let mut files = BTreeMap::new();
        collect(src, &mut Vec::new(), &mut files)?;
        let (mut handed_on, mut imported) = (BTreeMap::new(), BTreeMap::new());
        for (module, file) in &files {
            let (mut on, mut all) = (BTreeMap::new(), BTreeSet::new());
            let text = fs::read_to_string(src.join(file))?;
            for (path, is_handed_on) in paths(&tokens(&text)) {
                let Some(place) = absolute(&path, module, &files) else {
                    continue;
                };
                match place.last().filter(|_| is_handed_on) {
                    Some(name) => drop(on.insert(name.clone(), place.clone())),
                    None => drop(all.insert(place)),
                }
            }
            handed_on.insert(module.clone(), on);
            imported.insert(module.clone(), all);
        }
        Ok(Self {
            files,
            handed_on,
            imported,
        })
    }

    /// The module in which an item is defined that modules may hand on.
    fn home(&self, place: &[String], left: usize) -> Place {
        let known = |&length: &usize| self.files.contains_key(&place[..length]);
        let length = (0..=place.len()).rev().find(known).unwrap_or(0);
        let (module, rest) = place.split_at(length);
        let next = rest
            .first()
            .and_then(|name| self.handed_on[module].get(name));
        match next.filter(|next| left > 0 && next[..] != *place) {
            Some(next) => self.home(&[next, &rest[1..]].concat(), left - 1),
            None => module.to_vec(),
        }
    }

    /// Pairs of files, the first of which imports from the second. What a root imports is left out.
    pub(crate) fn pairs(&self) -> BTreeSet<(&str, &str)> {
        let mut pairs = BTreeSet::new();
        for (module, places) in &self.imported {
            for place in places {
                let home = self.home(place, 8);
                if home != *module && !home.is_empty() && !module.is_empty() {
                    pairs.insert((&*self.files[module], &*self.files[&home]));
                }
            }
        }
        pairs
    }
}

/// The largest set of files that all reach one another.
pub(crate) fn largest_circle(pairs: &BTreeSet<(&str, &str)>) -> Vec<String> {
    let reached = |from: &str| {
        let (mut all, mut next) = (BTreeSet::new(), vec![from.to_owned()]);
        while let Some(file) = next.pop() {
            for (_, to) in pairs.iter().filter(|(of, _)| *of == file) {
                if all.insert((*to).to_owned()) {
                    next.push((*to).to_owned());
                }
            }
        }
        all
    };
    let all: BTreeMap<&str, _> = pairs
        .iter()
        .map(|(from, _)| (*from, reached(from)))
        .collect();
    let circle = |from: &str| -> Vec<String> {
        let both = all[from].iter();
        let both = both.filter(|to| all.get(&***to).is_some_and(|back| back.contains(from)));
        both.cloned().collect()
    };
    let circles = all.keys().map(|from| circle(from));
    circles.max_by_key(Vec::len).unwrap_or_default()
}

fn collect(folder: &Path, module: &mut Place, files: &mut BTreeMap<Place, String>) -> Outcome {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let name = path.file_stem().and_then(|name| name.to_str());
        let name = name.ok_or("a file without a name")?.to_owned();
        if path.is_dir() {
            module.push(name);
            collect(&path, module, files)?;
            module.pop();
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let own = (name != "mod" && name != "lib" && name != "main").then(|| name.clone());
            let place = module.iter().cloned().chain(own).collect();
            let folders = module.iter().map(|folder| format!("{folder}/"));
            files.insert(place, folders.collect::<String>() + &name + ".rs");
        }
    }
    Ok(())
}

/// Names and signs of a source, without comments and texts.
fn tokens(text: &str) -> Vec<String> {
    let (mut tokens, mut rest) = (Vec::new(), text);
    while let Some(first) = rest.chars().next() {
        let is_name = |c: char| c.is_alphanumeric() || c == '_';
        let length = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if first == '"' {
            let inside = rest[1..].replace("\\\\", "__").replace("\\\"", "__");
            inside.find('"').map_or(rest.len(), |end| end + 2)
        } else if is_name(first) {
            let length = rest.find(|c| !is_name(c)).unwrap_or(rest.len());
            tokens.push(rest[..length].to_owned());
            length
        } else {
            let length = if rest.starts_with("::") {
                2
            } else {
                first.len_utf8()
            };
            if !first.is_whitespace() {
                tokens.push(rest[..length].to_owned());
            }
            length
        };
        rest = &rest[length..];
    }
    tokens
}

/// The paths of a source, and whether a `pub use` hands them on.
fn paths(tokens: &[String]) -> Vec<(Place, bool)> {
    let mut paths = Vec::new();
    let mut at = 0;
    while at < tokens.len() {
        let is_use = tokens[at] == "use";
        let is_root = tokens[at] == "crate" || tokens[at] == "super";
        // A visibility, `pub(in super::super)`, is no import.
        let is_scope = at > 0 && tokens[at - 1] == "in";
        let begins = is_root && !is_scope && tokens.get(at + 1).is_some_and(|next| next == "::");
        if !is_use && !begins {
            at += 1;
            continue;
        }
        let is_handed_on = is_use && at > 0 && (tokens[at - 1] == "pub" || tokens[at - 1] == ")");
        let mut found = Vec::new();
        at = tree(tokens, at + usize::from(is_use), &[], &mut found);
        paths.extend(found.into_iter().map(|path| (path, is_handed_on)));
    }
    paths
}

/// Reads a tree of paths behind `prefix`; returns where it ends.
fn tree(tokens: &[String], mut at: usize, prefix: &[String], found: &mut Vec<Place>) -> usize {
    let mut path = prefix.to_vec();
    let name = |at: usize| tokens.get(at).map_or("", String::as_str);
    loop {
        if name(at) == "{" {
            at += 1;
            while at < tokens.len() && name(at) != "}" {
                at = tree(tokens, at, &path, found).max(at);
                at += usize::from(name(at) == ",");
            }
            return at + 1;
        }
        path.push(name(at).to_owned());
        at += 1;
        if name(at) == "as" {
            at += 2;
        }
        if name(at) != "::" {
            found.push(path);
            return at;
        }
        at += 1;
    }
}

/// A path from the root of the crate on; none for a path into another crate.
fn absolute(path: &[String], module: &[String], files: &BTreeMap<Place, String>) -> Option<Place> {
    let (first, rest) = path.split_first()?;
    let own = [module, &path[..1]].concat();
    match first.as_str() {
        "crate" => Some(rest.to_vec()),
        "self" => Some([module, rest].concat()),
        "super" => {
            let up = path.iter().take_while(|name| *name == "super").count();
            let module = module.get(..module.len().checked_sub(up)?)?;
            Some([module, &path[up..]].concat())
        }
        _ if files.contains_key(&own) => Some([module, path].concat()),
        _ => None,
    }
}
