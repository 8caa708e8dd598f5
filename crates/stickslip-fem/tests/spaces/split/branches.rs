//! A fault that branches, in one group, is the fault of which each branch is a group.

use std::f64::consts::{PI, TAU};

use nalgebra::{Rotation3, SVector, Vector2, Vector3};
use stickslip_fem::{FemError, GridDiagonal, Mesh};

use super::{check, refusal};
use crate::common::Numbers;

/// Three legs from the origin: right, up and left.
const LEGS: [&str; 3] = ["right", "up", "left"];

/// A piecewise linear map of the plane that takes the half axes to random directions.
struct Star([Vector2<f64>; 4]);

impl Star {
    /// The map, and the two legs that continue one another most straightly.
    fn new(random: &mut Numbers) -> (Self, [usize; 2]) {
        let mut gaps = [0.0; 4].map(|_: f64| 0.3 + random.next());
        let scale = TAU / gaps.iter().sum::<f64>();
        gaps = gaps.map(|gap| gap * scale);
        let mut angle = TAU * random.next();
        let directions = gaps.map(|gap| {
            let (sin, cos) = angle.sin_cos();
            angle += gap;
            Vector2::new(cos, sin) * (0.5 + random.next())
        });
        let turns = [gaps[0], gaps[1], gaps[0] + gaps[1]].map(|between| (between - PI).abs());
        let least = (0..3).min_by(|&a, &b| turns[a].total_cmp(&turns[b]));
        (Self(directions), [[0, 1], [1, 2], [0, 2]][least.unwrap()])
    }

    fn map(&self, x: f64, y: f64) -> Vector2<f64> {
        let along =
            |value: f64, positive: usize| self.0[positive + if value < 0.0 { 2 } else { 0 }];
        along(x, 0) * x.abs() + along(y, 1) * y.abs()
    }

    /// Whether no cell is turned over: directions that follow one another differ by less than 180 degrees.
    fn is_one_to_one(&self) -> bool {
        (0..4).all(|k| self.0[k].perp(&self.0[(k + 1) % 4]) > 0.05)
    }
}

fn moved<const D: usize>(
    mesh: &Mesh<D>,
    to: impl Fn(&SVector<f64, D>) -> SVector<f64, D>,
) -> Mesh<D> {
    let points = mesh.vertices().iter().map(to).collect();
    let cells: Vec<u32> = mesh.cells().flatten().copied().collect();
    let faces: Vec<(String, Vec<[u32; D]>)> = (mesh.surfaces())
        .map(|(name, faces)| (name.to_owned(), faces.to_vec()))
        .collect();
    let moved = Mesh::new(points, cells).unwrap();
    (faces.iter()).fold(moved, |mesh, (name, faces)| {
        mesh.with_surface(name.as_str(), faces).unwrap()
    })
}

/// The faces of some surfaces as one.
fn together<const D: usize>(mesh: &Mesh<D>, names: &[&str]) -> Vec<[u32; D]> {
    let own = mesh.surfaces().filter(|(name, _)| names.contains(name));
    own.flat_map(|(_, faces)| faces.to_vec()).collect()
}

/// The mesh split along one surface of all faces is that split along several, up to names.
fn agrees<const D: usize>(mesh: &Mesh<D>, groups: &[&[&str]]) {
    let all: Vec<&str> = groups.iter().copied().flatten().copied().collect();
    let one = mesh
        .clone()
        .with_surface("fault", &together(mesh, &all))
        .unwrap();
    let one = one.split("fault").unwrap();
    let several = groups
        .iter()
        .enumerate()
        .fold(mesh.clone(), |several, (k, names)| {
            several
                .with_surface(format!("g{k}"), &together(mesh, names))
                .unwrap()
        });
    let names: Vec<String> = (0..groups.len()).map(|k| format!("g{k}")).collect();
    let several = several.split_all(&names).unwrap();
    assert_eq!(one.fingerprint(), several.fingerprint());
    assert_eq!(one.boundary(), several.boundary());
    let sheets = one.split_surfaces();
    assert_eq!(sheets.len(), groups.len());
    for (k, (sheet, group)) in sheets.iter().zip(several.split_surfaces()).enumerate() {
        let name = if k == 0 {
            "fault".to_owned()
        } else {
            format!("fault.{k}")
        };
        assert_eq!((&sheet.name, &sheet.pairs), (&name, &group.pairs));
    }
    let names: Vec<&str> = sheets.iter().map(|sheet| sheet.name.as_str()).collect();
    let mut named = mesh.clone();
    for (name, names) in names.iter().zip(groups) {
        named = named.with_surface(*name, &together(mesh, names)).unwrap();
    }
    check(&named, &one, &names);
}

#[test]
fn the_straightest_two_of_three_legs_pass_through_in_the_plane() {
    let mut random = Numbers(11);
    let grid = Mesh::<2>::grid([8.0, 8.0], [8, 8], GridDiagonal::Rising).unwrap();
    let grid = moved(&grid, |x| x - Vector2::repeat(4.0));
    let legs = [[0, 1], [1, 1], [0, -1]].map(|[axis, sign]| (axis as usize, f64::from(sign)));
    let grid = LEGS
        .iter()
        .zip(legs)
        .fold(grid, |grid, (name, (axis, sign))| {
            let on = |x: &Vector2<f64>| {
                let along = sign * x[axis];
                x[1 - axis] == 0.0 && (0.0..=3.0).contains(&along)
            };
            grid.with_surface_where(*name, on).unwrap()
        });
    let mut tried = 0;
    for _ in 0..60 {
        let (star, through) = Star::new(&mut random);
        if !star.is_one_to_one() {
            continue;
        }
        tried += 1;
        let mesh = moved(&grid, |x| star.map(x[0], x[1]));
        let branch = 3 - through[0] - through[1];
        agrees(&mesh, &[&through.map(|k| LEGS[k]), &[LEGS[branch]]]);
    }
    assert!(tried > 30, "{tried}");
}

#[test]
fn the_straightest_two_of_three_legs_pass_through_in_space() {
    let mut random = Numbers(12);
    let grid = Mesh::<3>::grid([4.0, 2.0, 4.0], [4, 2, 4]).unwrap();
    let grid = moved(&grid, |x| x - Vector3::new(2.0, 1.0, 2.0));
    let legs = [[0, 1], [2, 1], [0, -1]].map(|[axis, sign]| (axis as usize, f64::from(sign)));
    let grid = LEGS
        .iter()
        .zip(legs)
        .fold(grid, |grid, (name, (axis, sign))| {
            let on = |x: &Vector3<f64>| x[2 - axis] == 0.0 && sign * x[axis] >= 0.0;
            grid.with_surface_where(*name, on).unwrap()
        });
    let mut tried = 0;
    for _ in 0..40 {
        let (star, through) = Star::new(&mut random);
        let mut angle = || TAU * random.next();
        let turn = Rotation3::from_euler_angles(angle(), angle(), angle());
        let stretch = 0.5 + random.next();
        if !star.is_one_to_one() {
            continue;
        }
        tried += 1;
        let mesh = moved(&grid, |x| {
            let across = star.map(x[0], x[2]);
            turn * Vector3::new(across[0], stretch * x[1], across[1])
        });
        let branch = 3 - through[0] - through[1];
        agrees(&mesh, &[&through.map(|k| LEGS[k]), &[LEGS[branch]]]);
    }
    assert!(tried > 20, "{tried}");
}

/// Equal angles: the numbers of vertices decide, and rounding does not.
#[test]
fn symmetric_branches_are_divided_alike_wherever_they_lie() {
    let mut random = Numbers(13);
    let grid = Mesh::<2>::grid([8.0, 8.0], [8, 8], GridDiagonal::Rising).unwrap();
    let grid = moved(&grid, |x| x - Vector2::repeat(4.0));
    let through = |x: &Vector2<f64>| x[1] == 0.0 && x[0].abs() <= 3.0;
    let up = |x: &Vector2<f64>| x[0] == 0.0 && (0.0..=3.0).contains(&x[1]);
    let grid = grid.with_surface_where("through", through).unwrap();
    let grid = grid.with_surface_where("up", up).unwrap();
    let legs = together(&grid, &["through", "up"]);
    let grid = grid.with_surface("fault", &legs).unwrap();
    let mut first = None;
    for _ in 0..50 {
        let from = TAU * random.next();
        let star = Star([0.0, 120.0, 240.0, 300.0].map(|angle: f64| {
            let (sin, cos) = (from + angle.to_radians()).sin_cos();
            Vector2::new(cos, sin)
        }));
        let origin = Vector2::new(random.next(), random.next()) * 1e3;
        let mesh = moved(&grid, |x| star.map(x[0], x[1]) + origin)
            .split("fault")
            .unwrap();
        let pairs = mesh
            .split_surfaces()
            .into_iter()
            .map(|sheet| (sheet.name, sheet.pairs));
        let pairs: Vec<_> = pairs.collect();
        assert_eq!(pairs.len(), 2);
        assert_eq!(*first.get_or_insert(pairs.clone()), pairs);
    }
}

/// A fault by its name and the positions on it.
type Named<'a> = (&'a str, &'a dyn Fn(&Vector2<f64>) -> bool);

#[test]
fn faults_with_splays_on_splays_cross_and_close() {
    let grid = Mesh::<2>::grid([8.0, 8.0], [8, 8], GridDiagonal::Rising).unwrap();
    let named = |faults: &[Named<'_>]| {
        let each = faults.iter();
        each.fold(grid.clone(), |mesh, (name, on)| {
            mesh.with_surface_where(*name, on).unwrap()
        })
    };
    let main = |x: &Vector2<f64>| x[1] == 2.0;
    let first = |x: &Vector2<f64>| x[1] == x[0] + 1.0 && x[1] >= 2.0 && x[1] <= 7.0;
    let second = |x: &Vector2<f64>| x[0] == 6.0 && x[1] >= 2.0 && x[1] <= 5.0;
    let on_first = |x: &Vector2<f64>| x[0] == 3.0 && x[1] >= 4.0;
    let far = |x: &Vector2<f64>| x[1] == 1.0 && (3.0..=5.0).contains(&x[0]);
    let mesh = named(&[
        ("m", &main),
        ("a", &first),
        ("b", &second),
        ("c", &on_first),
        ("d", &far),
    ]);
    agrees(&mesh, &[&["m", "d"], &["a", "b"], &["c"]]);
    // A cross: the one of more faces passes through.
    let upright = |x: &Vector2<f64>| x[0] == 4.0 && (1.0..=5.0).contains(&x[1]);
    agrees(&named(&[("m", &main), ("u", &upright)]), &[&["m"], &["u"]]);
    // A ring is one surface at the corner from which a tail leaves it, however straight that goes on.
    let ring = |x: &Vector2<f64>| {
        let (on, inside) = ([2.0, 5.0], |x: f64| (2.0..=5.0).contains(&x));
        on.contains(&x[0]) && inside(x[1]) || on.contains(&x[1]) && inside(x[0])
    };
    let tail = |x: &Vector2<f64>| x[1] == 2.0 && x[0] >= 5.0;
    let faces = |on: &dyn Fn(&Vector2<f64>) -> bool| together(&named(&[("all", on)]), &["all"]);
    let axial = |[p, q]: &[u32; 2]| {
        let between = grid.vertices()[*q as usize] - grid.vertices()[*p as usize];
        between.amin() == 0.0
    };
    let ring: Vec<_> = faces(&ring).into_iter().filter(axial).collect();
    let mesh = grid.clone().with_surface("ring", &ring).unwrap();
    let mesh = mesh.with_surface("tail", &faces(&tail)).unwrap();
    agrees(&mesh, &[&["ring"], &["tail"]]);
    // A name that a branch needs is taken.
    let both = |x: &Vector2<f64>| main(x) || first(x);
    let mesh = named(&[("fault", &both), ("fault.1", &far)]);
    let error = refusal(mesh.split("fault"));
    assert_eq!(
        error,
        FemError::RepeatedName {
            name: "fault.1".into()
        }
    );
}

/// The through-going plane is connected around the ends of the rim; or both planes are.
#[test]
fn branches_end_along_their_rims() {
    let grid = Mesh::<3>::grid([4.0; 3], [4; 3]).unwrap();
    let mut random = Numbers(14);
    for (low, main_to) in [(2.0, 4.0), (1.0, 4.0), (1.0, 3.0)] {
        let mesh = grid
            .clone()
            .with_surface_where("main", |x| x[2] == 2.0 && x[0] <= main_to)
            .unwrap()
            .with_surface_where("wall", |x| x[0] == 2.0 && x[2] >= low && x[1] <= 2.0)
            .unwrap();
        let [a, b, c] = [(); 3].map(|()| 0.8 * random.next());
        // Planes stay planes; the angle between them is any.
        let mesh = moved(&mesh, |x| {
            Vector3::new(x[0] + a * x[2], x[1] + b * x[2], x[2] + c * x[1])
        });
        agrees(&mesh, &[&["main"], &["wall"]]);
    }
}
