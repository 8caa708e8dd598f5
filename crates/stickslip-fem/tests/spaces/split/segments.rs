//! A fault in several surfaces that continue one another is that fault.

use std::collections::BTreeMap;

use nalgebra::SVector;
use stickslip_fem::{FemError, GridDiagonal, Mesh, P1};

use super::check_sides;
use crate::common::Numbers;

/// The weight and the normals of each pair, of which the plus vertex is the first.
type Pairs<const D: usize> = BTreeMap<[usize; 2], (f64, Vec<SVector<f64, D>>)>;

fn pairs<const D: usize>(space: &P1<D>, names: &[String]) -> Pairs<D> {
    let mut all = Pairs::new();
    for name in names {
        check_sides(space, name);
        let plus = space.part(&format!("{name}+")).unwrap();
        let both = plus.vertices().iter().zip(plus.opposite().unwrap());
        for (k, (&p, &q)) in both.enumerate() {
            let (weight, normals) = all.entry([p, q]).or_insert((0.0, Vec::new()));
            *weight += plus.weights()[k];
            normals.push(plus.normals()[k]);
        }
    }
    all
}

/// Both have the same pairs, weights and, where a vertex is no tip, normals.
fn agree<const D: usize>(one: &P1<D>, whole: &[String], many: &P1<D>, parts: &[String]) {
    let ([one, many], space) = ([pairs(one, whole), pairs(many, parts)], one);
    assert!(one.keys().eq(many.keys()));
    for ([p, q], (weight, normals)) in &many {
        let (expected, whole) = &one[&[*p, *q]];
        assert!((weight / expected - 1.0).abs() < 1e-13);
        if p != q {
            let near = |n: &SVector<f64, D>| (n - whole[0]).norm() < 1e-13;
            assert!(normals.iter().all(near), "{}", space.mesh().vertices()[*p]);
            // Contacts that meet know by their bits that it is one.
            assert!(normals.iter().all(|n| *n == normals[0]));
        }
    }
}

/// A mesh with the faces of some surfaces in random groups, and their names in random order.
fn scattered<const D: usize>(
    mesh: &Mesh<D>,
    faults: &[&str],
    random: &mut Numbers,
) -> (Mesh<D>, Vec<String>) {
    let mut below = |n: usize| (random.next() * n as f64) as usize;
    let (mut named, mut names) = (mesh.clone(), Vec::<String>::new());
    for fault in faults {
        let (_, faces) = mesh.surfaces().find(|(name, _)| name == fault).unwrap();
        let count = 1 + below(4);
        let mut groups = vec![Vec::new(); count];
        let middle = |face: &[u32; D]| {
            let corners = face.iter().map(|&p| mesh.vertices()[p as usize]);
            corners.sum::<SVector<f64, D>>() / D as f64
        };
        let kind = below(3);
        let ends: Vec<_> = (0..count)
            .map(|_| middle(&faces[below(faces.len())]))
            .collect();
        for face in faces {
            let far = |k: &usize| (middle(face) - ends[*k]).norm();
            let group = match kind {
                // Each face by itself, or by the nearest of some points.
                0 => below(count),
                _ => (0..count).min_by(|a, b| far(a).total_cmp(&far(b))).unwrap(),
            };
            groups[group].push(*face);
        }
        for (k, faces) in groups
            .iter()
            .enumerate()
            .filter(|(_, faces)| !faces.is_empty())
        {
            let name = format!("{fault}{k}");
            named = named.with_surface(name.as_str(), faces).unwrap();
            names.insert(below(names.len() + 1), name);
        }
    }
    (named, names)
}

/// Random groups of the faces of some faults, in random order; those of a fault that passes through before those of one
/// that ends on it.
fn follows<const D: usize>(mesh: &Mesh<D>, faults: &[&str], ends: bool, seed: u64, sets: usize) {
    let mut random = Numbers(seed);
    let mut valid = 0;
    for set in 0..sets {
        let (named, mut parts) = scattered(mesh, faults, &mut random);
        if ends {
            parts.sort_by_key(|part| faults.iter().position(|fault| part.starts_with(fault)));
        }
        let mut whole: Vec<String> = Vec::new();
        for part in &parts {
            let fault = faults
                .iter()
                .find(|fault| part.starts_with(**fault))
                .unwrap();
            if !whole.iter().any(|name| name == fault) {
                whole.push((*fault).to_owned());
            }
        }
        let one = named.clone().split_all(&whole).unwrap();
        let many = match named.split_all(&parts) {
            Ok(many) => many,
            Err(FemError::OpensNowhere { surface, at, .. }) => {
                // None of its faces opens in the whole fault, either.
                assert!(D == 3 && parts.contains(&surface));
                let space = P1::new(one);
                let at = SVector::<f64, D>::from_iterator(at);
                for name in &whole {
                    let plus = space.part(&format!("{name}+")).unwrap();
                    for face in plus.faces() {
                        let middle = face
                            .map(|k| plus.points()[k])
                            .iter()
                            .sum::<SVector<f64, D>>();
                        assert!((middle / D as f64 - at).norm() > 1e-9);
                    }
                }
                continue;
            }
            Err(error) => unreachable!("{parts:?}: {error}"),
        };
        valid += 1;
        assert!(one.vertices() == many.vertices(), "{parts:?}");
        assert!(one.cells().eq(many.cells()), "{parts:?}");
        assert!(one.boundary() == many.boundary(), "{parts:?}");
        let [one, many] = [one, many].map(P1::new);
        agree(&one, &whole, &many, &parts);
        let sizes = |x: &SVector<f64, D>| 0.2 + 0.2 * (x[0] - 0.5).abs();
        if set % 8 == 0 {
            let [one, many] = [&one, &many].map(|space| space.clone().refined(1).unwrap());
            agree(&one, &whole, &many, &parts);
        }
        if set % 16 == 1 {
            let [one, many] = [&one, &many].map(|space| space.clone().graded(sizes).unwrap());
            assert!(one.mesh().vertices() == many.mesh().vertices());
            agree(&one, &whole, &many, &parts);
        }
    }
    assert!(valid > sets / 2, "{valid}");
}

fn moved<const D: usize>(
    mesh: &Mesh<D>,
    to: impl Fn(&SVector<f64, D>) -> SVector<f64, D>,
) -> Mesh<D> {
    let cells = mesh.cells().flatten().copied().collect();
    Mesh::new(mesh.vertices().iter().map(to).collect(), cells).unwrap()
}

/// Names faces by a predicate on the mesh before it is bent.
fn named<const D: usize>(
    flat: &Mesh<D>,
    bent: Mesh<D>,
    name: &str,
    on: impl Fn(&SVector<f64, D>) -> bool,
) -> Mesh<D> {
    let flat = flat.clone().with_surface_where(name, on).unwrap();
    let faces = flat.surfaces().last().unwrap().1.to_vec();
    bent.with_surface(name, &faces).unwrap()
}

fn plane() -> (Mesh<2>, Mesh<2>) {
    let flat = Mesh::<2>::grid([2.0, 2.0], [8, 8], GridDiagonal::Rising).unwrap();
    let bent = moved(&flat, |x| {
        let bump = x[1] * (2.0 - x[1]);
        SVector::from([
            x[0] + 0.1 * bump * (2.0 * x[1]).sin(),
            x[1] + 0.15 * bump * (3.0 * x[0]).sin(),
        ])
    });
    (flat, bent)
}

fn solid() -> (Mesh<3>, Mesh<3>) {
    let flat = Mesh::<3>::grid([2.0; 3], [4; 3]).unwrap();
    let bent = moved(&flat, |x| {
        let bump = x[2] * (2.0 - x[2]);
        let up = 0.1 * bump * (x[0] + 0.5 * x[1]).sin();
        SVector::from([x[0] + 0.05 * bump * x[1], x[1], x[2] + up])
    });
    (flat, bent)
}

#[test]
fn a_fault_in_groups_is_the_fault() {
    let (flat, bent) = plane();
    for (seed, [from, to]) in (0..).zip([[0.5, 1.5], [0.0, 1.5], [0.0, 2.0]]) {
        let mesh = named(&flat, bent.clone(), "fault", |x| {
            x[1] == 1.0 && (from..=to).contains(&x[0])
        });
        follows(&mesh, &["fault"], false, seed, 100);
    }
    let (flat, bent) = solid();
    for (seed, [from, to]) in (10..).zip([[0.5, 1.5], [0.0, 1.5], [0.0, 2.0]]) {
        let mesh = named(&flat, bent.clone(), "fault", |x| {
            x[2] == 1.0 && (from..=to).contains(&x[0]) && (x[1] <= 1.5 || to == 2.0)
        });
        follows(&mesh, &["fault"], false, seed, 100);
    }
}

#[test]
fn faults_in_groups_cross_and_end_on_one_another() {
    let (flat, bent) = plane();
    for (seed, least) in [(20, 0.5), (21, 1.0), (22, 0.0)] {
        let mesh = named(&flat, bent.clone(), "main", |x| x[1] == 1.0);
        let mesh = named(&flat, mesh, "other", |x| {
            x[0] == x[1] && (least..=1.5).contains(&x[0])
        });
        follows(&mesh, &["main", "other"], least == 1.0, seed, 200);
    }
    let (flat, bent) = solid();
    for (seed, least, most) in [(30, 0.5, 1.5), (31, 1.0, 2.0), (32, 0.0, 1.5)] {
        let mesh = named(&flat, bent.clone(), "main", |x| x[2] == 1.0);
        let mesh = named(&flat, mesh, "other", |x| {
            x[0] == x[2] && (least..=most).contains(&x[0])
        });
        follows(&mesh, &["main", "other"], least == 1.0, seed, 60);
    }
}
