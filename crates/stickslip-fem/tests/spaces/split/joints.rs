//! Which of the surfaces that meet continue one another.

use std::collections::HashSet;

use stickslip_fem::{FemError, GridDiagonal, Mesh, P1};

use super::{check, check_sides, refusal};

/// A square grid of 4 x 4 with surfaces, by the ends of their faces.
fn square(surfaces: &[(&str, &[[u32; 2]])]) -> Mesh<2> {
    let grid = Mesh::<2>::grid([4.0, 4.0], [4, 4], GridDiagonal::Rising).unwrap();
    let all = surfaces.iter();
    all.fold(grid, |mesh, (name, faces)| {
        mesh.with_surface(*name, faces).unwrap()
    })
}

/// The number of vertices that a split adds, and of copies of the middle of the square.
fn added(surfaces: &[(&str, &[[u32; 2]])], names: &[&str]) -> [usize; 2] {
    let mesh = square(surfaces);
    let before = mesh.vertex_count();
    let mesh = mesh.split_all(names).unwrap();
    let middle = (mesh.vertices().iter()).filter(|x| x.as_slice() == [2.0, 2.0]);
    [mesh.vertex_count() - before, middle.count()]
}

/// Columns of five vertices: west, east, north, south of the middle vertex, 12, and north-east of it.
const WEST: &[[u32; 2]] = &[[2, 7], [7, 12]];
const EAST: &[[u32; 2]] = &[[12, 17], [17, 22]];
const NORTH: &[[u32; 2]] = &[[12, 13], [13, 14]];
const SOUTH: &[[u32; 2]] = &[[10, 11], [11, 12]];
const ALONG: &[[u32; 2]] = &[[2, 7], [7, 12], [12, 17], [17, 22]];
const SLANTED: &[[u32; 2]] = &[[12, 18], [18, 24]];

#[test]
fn of_ends_those_opposite_continue_one_another() {
    // Two halves, in a line or not, are one surface.
    assert_eq!(added(&[("w", WEST), ("e", EAST)], &["e", "w"]), [5, 2]);
    assert_eq!(added(&[("w", WEST), ("n", NORTH)], &["w", "n"]), [5, 2]);
    // Of three the last one ends there.
    let three = [("w", WEST), ("e", EAST), ("n", NORTH)];
    assert_eq!(added(&three, &["w", "e", "n"]), [7, 2]);
    assert_eq!(added(&three, &["n", "w", "e"]), [7, 2]);
    // Four are two surfaces that cross, in any order.
    let four = [("w", WEST), ("e", EAST), ("n", NORTH), ("s", SOUTH)];
    for names in [
        ["w", "e", "n", "s"],
        ["w", "n", "e", "s"],
        ["s", "w", "n", "e"],
    ] {
        assert_eq!(added(&four, &names), [11, 4]);
    }
    // Two on different sides of one that passes through go on behind it, two on the same side end there.
    let across = [("n", NORTH), ("s", SOUTH), ("main", ALONG)];
    for names in [["main", "n", "s"], ["n", "s", "main"], ["n", "main", "s"]] {
        assert_eq!(added(&across, &names), [11, 4]);
    }
    let splays = [("n", NORTH), ("o", SLANTED), ("main", ALONG)];
    for names in [["main", "n", "o"], ["n", "o", "main"]] {
        assert_eq!(added(&splays, &names), [9, 2]);
    }
    // Where surfaces meet at the boundary of the body, each leaves it.
    let corner = [
        ("up", &[[11, 12], [10, 11]][..]),
        ("oblique", &[[10, 16], [16, 22]]),
    ];
    assert_eq!(added(&corner, &["up", "oblique"])[0], 5);
}

#[test]
fn surfaces_are_split_at_once_and_do_not_overlap() {
    let mesh = square(&[("w", WEST), ("e", EAST), ("all", ALONG)]);
    let error = refusal(mesh.clone().split("w").unwrap().split("e"));
    let expected = FemError::Continues {
        surface: "e".into(),
        earlier: "w".into(),
        vertices: vec![12],
        at: vec![2.0, 2.0],
    };
    assert_eq!(error, expected);
    for names in [["w", "all"], ["all", "w"]] {
        let FemError::Overlap { surfaces, face, at } = refusal(mesh.clone().split_all(names))
        else {
            unreachable!("both have a face");
        };
        let both: HashSet<String> = surfaces.into_iter().collect();
        assert_eq!(both, HashSet::from(["w".into(), "all".into()]));
        assert_eq!((face, at), (vec![2, 7], vec![0.5, 2.0]));
    }
}

/// A wall that stands on the middle of the edge at which a level fault ends: both open between the ends of the wall.
#[test]
fn a_strand_continues_a_part_of_an_edge() {
    let mesh = Mesh::<3>::grid([2.0; 3], [4; 3]).unwrap();
    let mesh = mesh
        .with_surface_where("level", |x| x[2] == 1.0 && x[0] <= 1.0)
        .unwrap()
        .with_surface_where("wall", |x| {
            x[0] == 1.0 && x[2] >= 1.0 && (0.5..=1.5).contains(&x[1])
        })
        .unwrap();
    for names in [["level", "wall"], ["wall", "level"]] {
        let after = mesh.clone().split_all(names).unwrap();
        check(&mesh, &after, &names);
        // Two rows of five, the joint, and the wall above it without its edges.
        assert_eq!(after.vertex_count() - mesh.vertex_count(), 10 + 1 + 2);
        let space = P1::new(after).refined(1).unwrap();
        let open = |name: &str| {
            check_sides(&space, name);
            let plus = space.part(&format!("{name}+")).unwrap();
            let pairs = plus.vertices().iter().zip(plus.opposite().unwrap());
            let at = pairs
                .zip(plus.points())
                .filter(|((p, q), x)| p != q && x[0] == 1.0 && x[2] == 1.0);
            let mut along: Vec<f64> = at.map(|(_, x)| x[1]).collect();
            along.sort_by(f64::total_cmp);
            along
        };
        assert_eq!(open("level"), [0.75, 1.0, 1.25]);
        assert_eq!(open("wall"), [0.75, 1.0, 1.25]);
    }
}
