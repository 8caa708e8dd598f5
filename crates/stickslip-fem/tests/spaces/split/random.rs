//! Random faces as a fault: a typed error or a valid split.

use stickslip_fem::{FemError, GridDiagonal, Mesh, P1};

use super::{check, check_sides};
use crate::common::{Numbers, irregular_2d, irregular_3d};

const SETS: usize = 1000;

/// The inner faces of a mesh.
fn inner<const D: usize>(mesh: &Mesh<D>) -> Vec<[u32; D]> {
    let all = mesh.clone().with_surface_where("all", |_| true).unwrap();
    all.surfaces().next().unwrap().1.to_vec()
}

fn survives<const D: usize>(mesh: &Mesh<D>, seed: u64) {
    let faces = inner(mesh);
    let mut random = Numbers(seed);
    let mut below = |n: usize| (random.next() * n as f64) as usize;
    let (mut valid, mut refined, mut branched) = (0, 0, 0);
    for _ in 0..SETS {
        // Loose faces, walks over neighbours, and faces of one plane; up to three surfaces.
        let mut names = Vec::new();
        let mut named = mesh.clone();
        for name in ["a", "b", "c"].iter().take(1 + below(3)) {
            let mut chosen: Vec<[u32; D]> = vec![faces[below(faces.len())]];
            let kind = below(3);
            for _ in 0..1 + below(12) {
                let last = chosen[chosen.len() - 1];
                let near: Vec<&[u32; D]> = (faces.iter())
                    .filter(|face| face.iter().filter(|p| last.contains(p)).count() == D - 1)
                    .filter(|face| {
                        let axis = D - 1;
                        let height = mesh.vertices()[last[0] as usize][axis];
                        kind < 2
                            || face
                                .iter()
                                .all(|&p| mesh.vertices()[p as usize][axis] == height)
                    })
                    .collect();
                let next = if kind == 0 || near.is_empty() {
                    faces[below(faces.len())]
                } else {
                    *near[below(near.len())]
                };
                if !chosen.contains(&next) {
                    chosen.push(next);
                }
            }
            named = named.with_surface(*name, &chosen).unwrap();
            names.push(*name);
        }
        let mut present = named.clone();
        for name in names {
            match present.clone().split(name) {
                Ok(after) => present = after,
                // All of its faces are those of others.
                Err(FemError::Unknown { .. }) => {}
                Err(error) => assert!(error.to_string().contains(name), "{error}"),
            }
        }
        let sheets = present.split_surfaces();
        let done: Vec<&str> = sheets.iter().map(|sheet| sheet.name.as_str()).collect();
        branched += usize::from(done.iter().any(|name| name.contains('.')));
        if !done.is_empty() {
            valid += 1;
            check(&named, &present, &done);
            if below(8) == 0 {
                refined += 1;
                let space = P1::new(present.clone()).refined(1).unwrap();
                done.iter().for_each(|name| check_sides(&space, name));
                let space = P1::new(present).graded(|x| 0.4 + 0.3 * x[0]).unwrap();
                done.iter().for_each(|name| check_sides(&space, name));
            }
        }
    }
    assert!(valid > SETS / 20 && refined > 0, "{valid} {refined}");
    assert!(branched > 0);
}

#[test]
fn random_faults_in_the_plane() {
    let grid = Mesh::<2>::grid([2.0, 2.0], [4, 4], GridDiagonal::Rising).unwrap();
    survives(&grid, 1);
    let irregular = P1::new(irregular_2d()).refined(1).unwrap();
    survives(irregular.mesh(), 2);
}

#[test]
fn random_faults_in_space() {
    survives(&Mesh::<3>::grid([2.0; 3], [3; 3]).unwrap(), 3);
    let irregular = P1::new(irregular_3d()).refined(1).unwrap();
    survives(irregular.mesh(), 4);
}
