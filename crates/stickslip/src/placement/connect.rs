//! The links between the sides of faults, and where faults meet.

use std::collections::{BTreeMap, BTreeSet};

use stickslip_solvers::{Link, Links};

use super::identify::identify;
use crate::scene::{AnyContact, Prescribed, Sides};
use crate::{BoundaryCondition, BoundaryPart, SceneError};

/// The contacts and boundary conditions of a scene.
pub(crate) struct Parts<'a, const C: usize> {
    pub(crate) contacts: &'a mut Vec<AnyContact<C>>,
    pub(crate) prescribed: &'a mut Vec<Prescribed<C>>,
    pub(crate) periodic: &'a [[BoundaryPart; 2]],
}

impl<const C: usize> Parts<'_, C> {
    /// Checks the parts, which have no vertex in some processes of several.
    fn check(&self, size: usize, partial: bool) -> Result<(), SceneError> {
        for given in self.prescribed.iter() {
            given.part.check(given.what(), size, partial)?;
        }
        let mut contacts = self.contacts.iter();
        contacts.try_for_each(|contact| {
            let what = match contact.sides.is_two() {
                true => "contact between two sides",
                false => "contact",
            };
            contact.part.check(what, size, partial)
        })
    }
}

/// The links of a scene.
#[derive(Default)]
pub(crate) struct Connections {
    pub(crate) links: Links,
    /// The vertices without a jump of their own, and the reason: copies where faults meet, and periodic boundaries.
    pub(crate) tied: Vec<(usize, BoundaryCondition)>,
}

/// A pair of vertices with the contacts and prescribed slip rates between them: (contact, place).
#[derive(Default)]
struct Edge {
    contacts: Vec<(usize, usize)>,
    slip_rates: Vec<(usize, usize)>,
}

/// Links the sides of the contacts between two sides, and those of periodic boundaries; checks the parts.
///
/// The jump of a pair is an unknown at its plus vertex, or at its minus vertex if a Dirichlet condition prescribes the
/// motion of the plus side alone. Where none prescribes a motion of the pair, its other unknown is the mean that does not
/// couple with the jump, by the `stiffness` of each vertex. Where faults meet, each has the jump of the copies between
/// which it alone lies: a copy on the plus side of several has the jumps of all of them. Its share of each surface is
/// that of the copy with the jump.
pub(crate) fn connect<const C: usize>(
    mut parts: Parts<'_, C>,
    size: usize,
    partial: bool,
    stiffness: impl Fn(usize) -> f64,
) -> Result<Connections, SceneError> {
    if partial && !parts.periodic.is_empty() {
        let requirement = "a body without periodic boundaries";
        return Err(SceneError::unsupported(
            "a run in several processes",
            requirement,
        ));
    }
    parts.check(size, partial)?;
    let images = identify(&mut parts, size)?;
    let anchors: BTreeSet<usize> = images.values().map(|&(base, _)| base).collect();
    let Parts {
        contacts,
        prescribed,
        ..
    } = parts;
    let mut edges: BTreeMap<usize, BTreeMap<usize, Edge>> = BTreeMap::new();
    let mut minus_sides = BTreeSet::new();
    for (index, contact) in contacts.iter().enumerate() {
        let Sides::Two(minus) = &contact.sides else {
            continue;
        };
        for (place, (&plus, &minus)) in contact.part.vertices.iter().zip(minus).enumerate() {
            check_minus(minus, size)?;
            let edge = edges.entry(plus).or_default().entry(minus).or_default();
            edge.contacts.push((index, place));
            minus_sides.insert(minus);
        }
    }
    for (index, given) in prescribed.iter().enumerate() {
        let pairs = given.part.vertices.iter().zip(given.minus.iter().flatten());
        for (place, (&plus, &minus)) in pairs.enumerate() {
            check_minus(minus, size)?;
            let edge = edges.entry(plus).or_default().entry(minus).or_default();
            edge.slip_rates.push((index, place));
            minus_sides.insert(minus);
        }
    }
    let held: BTreeSet<usize> = (prescribed.iter())
        .filter(|given| given.minus.is_none())
        .flat_map(|given| given.part.vertices.iter().copied())
        .collect();
    let mut all = Connections::default();
    let mut links = Vec::new();
    // Vertices on the minus side of several others are rare: only those are looked for.
    let mut times: BTreeMap<usize, usize> = BTreeMap::new();
    for minus in edges.values().flat_map(BTreeMap::keys) {
        *times.entry(*minus).or_default() += 1;
    }
    let simple = |plus: usize, below: &BTreeMap<usize, Edge>| {
        below.len() == 1
            && !minus_sides.contains(&plus)
            && below
                .keys()
                .all(|minus| times[minus] == 1 && !edges.contains_key(minus))
    };
    for (&plus, below) in &edges {
        if simple(plus, below) {
            for (&minus, edge) in below {
                let reversed = held.contains(&plus) && !held.contains(&minus);
                let (vertex, base) = if reversed {
                    (minus, plus)
                } else {
                    (plus, minus)
                };
                for &(contact, place) in edge.contacts.iter().filter(|_| reversed) {
                    contacts[contact].part.vertices[place] = vertex;
                }
                for &(given, place) in edge.slip_rates.iter().filter(|_| reversed) {
                    prescribed[given].part.vertices[place] = vertex;
                }
                let anchored = [plus, minus].iter().any(|copy| anchors.contains(copy));
                if anchored && reversed {
                    return Err(SceneError::Vertex {
                        what: "end of a fault at a periodic boundary",
                        vertex: plus,
                        requirement: "a place without Dirichlet conditions on the plus side alone",
                    });
                }
                let held = [plus, minus].iter().any(|copy| held.contains(copy));
                let share = match held || anchored {
                    true => 0.0,
                    false => part_of(stiffness(vertex), stiffness(base)),
                };
                links.push(Link {
                    reversed,
                    share,
                    ..Link::new(vertex, vec![base])
                });
            }
            continue;
        }
        let bases = bases_of(plus, &edges)?;
        if let Some(&copy) = bases.iter().chain([&plus]).find(|copy| held.contains(copy)) {
            return Err(junction(
                copy,
                "a place without Dirichlet conditions: end the fault before it",
            ));
        }
        if below.len() > 1 {
            if below.values().any(|edge| !edge.slip_rates.is_empty()) {
                return Err(junction(
                    plus,
                    "a place without a prescribed slip rate: end it before it",
                ));
            }
            let (number, _) = below
                .values()
                .flat_map(|edge| &edge.contacts)
                .next()
                .copied()
                .unwrap_or_default();
            let condition = BoundaryCondition::Contact(number + 1);
            all.tied.push((plus, condition));
        }
        links.push(Link::new(plus, bases.into_iter().collect()));
    }
    share(contacts, &edges)?;
    for (&vertex, &(base, number)) in &images {
        let mut bases = match edges.contains_key(&base) {
            true => bases_of(base, &edges)?,
            false => BTreeSet::new(),
        };
        bases.insert(base);
        links.push(Link::new(vertex, bases.into_iter().collect()));
        let condition = BoundaryCondition::Periodic(number);
        all.tied.push((vertex, condition));
    }
    all.links = Links::new(links);
    Ok(all)
}

fn check_minus(minus: usize, size: usize) -> Result<(), SceneError> {
    SceneError::check_index("vertex of the minus side", minus, size).map(|_| ())
}

/// `own/(own + other)`, to 8 binary digits: few enough for exact sums of its multiples, so that the jumps of two levels
/// of a hierarchy do not couple by rounding. It is 0 where neither is positive.
fn part_of(own: f64, other: f64) -> f64 {
    const PARTS: f64 = 256.0;
    let part = own / (own + other);
    if part > 0.0 && part < 1.0 {
        (part * PARTS).round().clamp(1.0, PARTS - 1.0) / PARTS
    } else {
        0.0
    }
}

/// All vertices below a copy.
fn bases_of(
    copy: usize,
    edges: &BTreeMap<usize, BTreeMap<usize, Edge>>,
) -> Result<BTreeSet<usize>, SceneError> {
    let (mut found, mut next) = (BTreeSet::new(), vec![copy]);
    while let Some(vertex) = next.pop() {
        for &below in edges.get(&vertex).into_iter().flat_map(BTreeMap::keys) {
            if below == copy {
                return Err(junction(
                    copy,
                    "one whose sides do not change along a way around it: end one fault before it",
                ));
            }
            if found.insert(below) {
                next.push(below);
            }
        }
    }
    let ends = found.iter().filter(|vertex| !edges.contains_key(vertex));
    if ends.count() != 1 {
        return Err(junction(
            copy,
            "one with a single copy on the minus side of all faults: end one fault before it",
        ));
    }
    Ok(found)
}

/// Moves the shares of copies on the plus side of several faults to the copies with the jumps of these.
fn share<const C: usize>(
    contacts: &mut [AnyContact<C>],
    edges: &BTreeMap<usize, BTreeMap<usize, Edge>>,
) -> Result<(), SceneError> {
    for (&copy, below) in edges.iter().filter(|(_, below)| below.len() > 1) {
        let bases = bases_of(copy, edges)?;
        for (&minus, edge) in below {
            let mut beneath = bases_of(minus, edges).unwrap_or_default();
            beneath.insert(minus);
            let own: Vec<usize> = bases.difference(&beneath).copied().collect();
            for &(contact, place) in &edge.contacts {
                let jump = own.iter().find_map(|vertex| {
                    let mut below = edges.get(vertex)?.values();
                    let (edge, None) = (below.next()?, below.next()) else {
                        return None;
                    };
                    Some((*vertex, edge))
                });
                let part = &mut contacts[contact].part;
                let weight = std::mem::take(&mut part.weights[place]);
                match (jump, own.len()) {
                    (Some((vertex, edge)), 1) => {
                        let same = edge.contacts.iter().find(|(other, _)| *other == contact);
                        match same {
                            Some(&(_, to)) => part.weights[to] += weight,
                            // Another contact continues this one behind the junction: its jump is that of both.
                            None => (part.vertices[place], part.weights[place]) = (vertex, weight),
                        }
                    }
                    // Both sides move alike: the fault ends here.
                    (None, 0) => {}
                    _ => {
                        return Err(junction(
                            copy,
                            "one of faults that end or pass through: end one fault before it",
                        ));
                    }
                }
            }
        }
    }
    Ok(())
}

fn junction(vertex: usize, requirement: &'static str) -> SceneError {
    SceneError::Vertex {
        what: "junction of faults",
        vertex,
        requirement,
    }
}
