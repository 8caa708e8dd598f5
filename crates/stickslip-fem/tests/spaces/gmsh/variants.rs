//! One body in all variants of the format, and what meshes may be like.

use std::collections::BTreeSet;
use std::path::Path;

use nalgebra::SVector;
use stickslip_fem::{Mesh, P1};
use stickslip_fem::{ReadError, gmsh};

use super::{VARIANTS, file};

fn volume<const D: usize>(mesh: &Mesh<D>, cells: &[usize]) -> f64 {
    cells.iter().map(|&cell| mesh.volume(cell)).sum()
}

fn material<'a, const D: usize>(mesh: &'a Mesh<D>, name: &str) -> &'a [usize] {
    mesh.materials()
        .find(|(material, _)| *material == name)
        .unwrap()
        .1
}

/// The cells, each from its smallest vertex on.
fn cells<const D: usize>(mesh: &Mesh<D>, which: &[usize]) -> BTreeSet<Vec<u32>> {
    let sorted = |&cell: &usize| {
        let mut corners = mesh.cell(cell).to_vec();
        corners.sort_unstable();
        corners
    };
    which.iter().map(sorted).collect()
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-12
}

fn variants<const D: usize>(body: &str) -> Vec<Mesh<D>> {
    let meshes: Vec<Mesh<D>> = VARIANTS
        .iter()
        .map(|variant| gmsh::read(file(body, variant)).unwrap())
        .collect();
    let first = &meshes[0];
    for mesh in &meshes {
        assert_eq!(mesh.vertex_count(), first.vertex_count());
        // Text has 16 digits.
        let distances = mesh
            .vertices()
            .iter()
            .zip(first.vertices())
            .map(|(x, y)| (x - y).norm());
        assert!(distances.fold(0.0, f64::max) < 1e-15);
        assert_eq!(mesh.boundary(), first.boundary());
        assert!(mesh.parts().eq(first.parts()));
        let all: Vec<usize> = (0..first.cell_count()).collect();
        assert_eq!(cells(mesh, &all), cells(first, &all));
        for (name, which) in first.materials() {
            assert_eq!(cells(mesh, material(mesh, name)), cells(first, which));
        }
        assert!(mesh.nonconforming_nodes(1e-9).unwrap().is_empty());
    }
    meshes
}

/// The part is that of the faces there by position, also on finer meshes.
fn is_part<const D: usize>(mesh: &Mesh<D>, name: &str, on: impl Fn(&SVector<f64, D>) -> bool) {
    let space = P1::new(mesh.clone()).refined(1).unwrap();
    assert_eq!(space.part(name).unwrap(), space.trace(on).unwrap());
}

#[test]
fn all_variants_of_a_plane_body_are_one_mesh() {
    for mesh in variants::<2>("plane") {
        is_part(&mesh, "fault", |x| near(x[1], 0.0));
        is_part(&mesh, "top", |x| near(x[1], 1.0));
        let end = P1::new(mesh.clone()).part("9").unwrap();
        assert!(near(end.measure(), 2.0));
        let outside = |x: &&SVector<f64, 2>| x[0] < 1.0 || x[0] < 2.0 - 1e-12 && x[1] > 0.0;
        assert_eq!(end.points().iter().filter(outside).count(), 0);
        assert!(mesh.parts().map(|(name, _)| name).eq(["fault", "top", "9"]));
        let rocks = [("granite", 1.0), ("sandstone", 1.0), ("both", 2.0)];
        assert!(
            mesh.materials()
                .map(|(name, _)| name)
                .eq(rocks.map(|(name, _)| name))
        );
        for (name, area) in rocks {
            assert!(near(volume(&mesh, material(&mesh, name)), area));
        }
        let space = P1::new(mesh).refined(1).unwrap();
        let rock = space
            .by_material(&[("granite", 1.0), ("sandstone", 2.0)])
            .unwrap();
        for (k, cell) in space.mesh().cells().enumerate() {
            let left = cell
                .iter()
                .all(|&p| space.mesh().vertices()[p as usize][0] <= 1.0 + 1e-12);
            assert_eq!(rock(&SVector::zeros(), k), if left { 1.0 } else { 2.0 });
        }
    }
}

#[test]
fn all_variants_of_a_block_are_one_mesh() {
    for mesh in variants::<3>("block") {
        is_part(&mesh, "fault", |x| near(x[2], 0.0));
        is_part(&mesh, "top", |x| near(x[2], 1.0));
        // The bottom and half of one side.
        assert!(near(
            P1::new(mesh.clone()).part("9").unwrap().measure(),
            1.5
        ));
        for (name, size) in [("granite", 0.5), ("sandstone", 0.5), ("both", 1.0)] {
            assert!(near(volume(&mesh, material(&mesh, name)), size));
        }
    }
}

#[test]
fn the_meshes_of_the_examples_are_the_bodies_they_say() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/meshes");
    let slider = gmsh::read::<2>(folder.join("slider.msh")).unwrap();
    assert!(near(volume(&slider, material(&slider, "rock")), 5.0));
    is_part(&slider, "fault", |x| near(x[1], 0.0));
    is_part(&slider, "top", |x| near(x[1], 1.0));
    assert!(near(
        P1::new(slider.clone()).part("sides").unwrap().measure(),
        2.0
    ));
    assert!(slider.nonconforming_nodes(1e-9).unwrap().is_empty());

    let block = gmsh::read::<3>(folder.join("block.msh")).unwrap();
    assert!(near(volume(&block, material(&block, "rock")), 5.0));
    is_part(&block, "fault", |x| near(x[2], 0.0));
    is_part(&block, "top", |x| near(x[2], 1.0));
    assert!(near(
        P1::new(block.clone()).part("sides").unwrap().measure(),
        12.0
    ));
    assert!(block.nonconforming_nodes(1e-9).unwrap().is_empty());
}

/// A triangle with an arc above: the centre of the arc and a line of construction are no parts of the body.
const ARC: &str = "$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
6
1 0 0 0
2 1 0 0
3 0.5 1 0
7 0.5 0.2 0
8 9 9 3
9 9 8 3
$EndNodes
$Elements
6
1 15 2 0 1 1
2 15 2 0 7 7
3 1 2 0 1 1 2
4 1 2 0 4 8 9
5 2 2 0 1 2 1 3
$EndElements
";

#[test]
fn geometry_outside_of_cells_is_left_out() {
    let mesh = gmsh::parse::<2>(ARC.replace("\n6\n1 15", "\n5\n1 15").as_bytes()).unwrap();
    assert_eq!((mesh.vertex_count(), mesh.cell_count()), (3, 1));
    // Element 5 is clockwise.
    assert_eq!(mesh.volume(0), 0.5);
    assert_eq!((mesh.parts().count(), mesh.materials().count()), (0, 0));
}

#[test]
fn lines_may_end_as_on_windows() {
    let text = ARC.replace("\n6\n1 15", "\n5\n1 15");
    let [unix, windows] =
        [text.clone(), text.replace('\n', "\r\n")].map(|text| gmsh::parse::<2>(text.as_bytes()));
    assert_eq!(unix.unwrap(), windows.unwrap());
}

#[test]
fn a_plane_may_lie_at_any_height() {
    let text = ARC.replace("\n6\n1 15", "\n5\n1 15");
    let high = text
        .replace("1 0 0 0\n", "1 0 0 7\n")
        .replace("2 1 0 0\n", "2 1 0 7\n");
    let high = high.replace("3 0.5 1 0\n", "3 0.5 1 7\n");
    assert_eq!(
        gmsh::parse::<2>(high.as_bytes()).unwrap(),
        gmsh::parse::<2>(text.as_bytes()).unwrap()
    );
}

#[test]
fn a_file_that_is_not_there_is_named() {
    let error = gmsh::read::<2>("no/such/file.msh").unwrap_err();
    assert!(matches!(&error, ReadError::Read { .. }));
    assert!(
        error
            .to_string()
            .starts_with("cannot read no/such/file.msh: ")
    );
}

/// The data of a node by its number are those of the vertex, in every variant.
#[test]
fn nodes_keep_their_numbers() {
    let text = std::fs::read_to_string(file("plane", "2.2-text")).unwrap();
    let lines = text.lines().skip_while(|&line| line != "$Nodes").skip(2);
    let nodes: Vec<(u64, [f64; 2])> = lines
        .take_while(|&line| line != "$EndNodes")
        .map(|line| {
            let mut words = line.split_whitespace();
            let tag = words.next().unwrap().parse().unwrap();
            let mut next = || words.next().unwrap().parse().unwrap();
            (tag, [next(), next()])
        })
        .collect();
    for variant in VARIANTS {
        let (mesh, tags) = gmsh::read_with_tags::<2>(file("plane", variant)).unwrap();
        assert_eq!(tags.tags().len(), mesh.vertex_count());
        let mut found = 0;
        for &(tag, point) in &nodes {
            // Centres of arcs and the like are no vertices.
            let Some(vertex) = tags.vertex(tag) else {
                continue;
            };
            assert_eq!(tags.tags()[vertex], tag);
            let distance = (mesh.vertices()[vertex] - SVector::from(point)).norm();
            assert!(distance < 1e-12, "{variant}: node {tag}");
            found += 1;
        }
        assert_eq!(found, mesh.vertex_count());
        assert_eq!(tags.vertex(0), None);
    }
}
