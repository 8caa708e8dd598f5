//! A writer of binary files in either order of bytes, made from the description of the format alone.

use stickslip_fem::{Mesh, gmsh};

#[derive(Clone, Copy)]
enum Order {
    Little,
    Big,
}

struct Binary {
    bytes: Vec<u8>,
    order: Order,
}

impl Binary {
    fn new(version: &str, order: Order) -> Self {
        let mut file = Self {
            bytes: Vec::new(),
            order,
        };
        file.text(&format!("$MeshFormat\n{version} 1 8\n"));
        file.int(1);
        file.text("\n$EndMeshFormat\n");
        file
    }

    fn text(&mut self, text: &str) {
        self.bytes.extend(text.as_bytes());
    }

    fn int(&mut self, value: i32) {
        self.bytes.extend(match self.order {
            Order::Little => value.to_le_bytes(),
            Order::Big => value.to_be_bytes(),
        });
    }

    fn ints<const N: usize>(&mut self, values: [i32; N]) {
        values.into_iter().for_each(|value| self.int(value));
    }

    fn sizes<const N: usize>(&mut self, values: [u64; N]) {
        for value in values {
            self.bytes.extend(match self.order {
                Order::Little => value.to_le_bytes(),
                Order::Big => value.to_be_bytes(),
            });
        }
    }

    fn real(&mut self, value: f64) {
        self.bytes.extend(match self.order {
            Order::Little => value.to_le_bytes(),
            Order::Big => value.to_be_bytes(),
        });
    }

    /// Three coordinates of a point.
    fn point(&mut self, x: &[f64]) {
        (0..3).for_each(|axis| self.real(x.get(axis).copied().unwrap_or(0.0)));
    }
}

/// Gmsh's number of the simplex of so many corners.
fn kind(corners: usize) -> i32 {
    [15, 1, 2, 4][corners - 1]
}

/// In version 4.1: the boundary as group 5, called "skin", the cells as group 7.
fn version_4<const D: usize>(mesh: &Mesh<D>, order: Order) -> Vec<u8> {
    let mut file = Binary::new("4.1", order);
    file.text(&format!(
        "$PhysicalNames\n1\n{} 5 \"skin\"\n$EndPhysicalNames\n",
        D - 1
    ));
    file.text("$Comments\n$ \n$EndComments\n$Entities\n");
    file.sizes(std::array::from_fn::<u64, 4, _>(|d| {
        u64::from(d == D || d + 1 == D)
    }));
    for group in [-5, 7] {
        file.int(1);
        (0..6).for_each(|_| file.real(f64::INFINITY));
        file.sizes([1]);
        file.int(group);
        file.sizes([1]);
        file.int(-1);
    }
    file.text("\n$EndEntities\n$Nodes\n");
    let count = mesh.vertex_count() as u64;
    file.sizes([1, count, 10, 10 * count]);
    // With parameters, one for each dimension of the entity.
    file.ints([D as i32, 1, 1]);
    file.sizes([count]);
    (1..=count).for_each(|p| file.sizes([10 * p]));
    for x in mesh.vertices() {
        file.point(x.as_slice());
        (0..D).for_each(|_| file.real(f64::NAN));
    }
    file.text("\n$EndNodes\n$Elements\n");
    let (faces, cells) = (mesh.boundary().len() as u64, mesh.cell_count() as u64);
    file.sizes([2, faces + cells, 1, 2 * (faces + cells)]);
    file.ints([D as i32 - 1, 1, kind(D)]);
    file.sizes([faces]);
    let mut tag = 0;
    let mut element = |file: &mut Binary, corners: &[u32]| {
        tag += 2;
        file.sizes([tag]);
        corners
            .iter()
            .for_each(|&p| file.sizes([10 * u64::from(p) + 10]));
    };
    mesh.boundary()
        .iter()
        .for_each(|face| element(&mut file, face));
    file.ints([D as i32, 1, kind(D + 1)]);
    file.sizes([cells]);
    mesh.cells().for_each(|cell| element(&mut file, cell));
    file.text("\n$EndElements\n");
    file.bytes
}

/// The same in version 2.2, all elements of a kind under one heading.
fn version_2<const D: usize>(mesh: &Mesh<D>, order: Order) -> Vec<u8> {
    let mut file = Binary::new("2.2", order);
    file.text(&format!("$Nodes\n{}\n", mesh.vertex_count()));
    for (p, x) in mesh.vertices().iter().enumerate() {
        file.int(10 * p as i32 + 10);
        file.point(x.as_slice());
    }
    let (faces, cells) = (mesh.boundary().len(), mesh.cell_count());
    file.text(&format!("\n$EndNodes\n$Elements\n{}\n", faces + cells));
    let mut tag = 0;
    let mut element = |file: &mut Binary, group: i32, corners: &[u32]| {
        tag += 2;
        file.ints([tag, group, 1]);
        corners.iter().for_each(|&p| file.int(10 * p as i32 + 10));
    };
    file.ints([kind(D), faces as i32, 2]);
    mesh.boundary()
        .iter()
        .for_each(|face| element(&mut file, 5, face));
    file.ints([kind(D + 1), cells as i32, 2]);
    mesh.cells().for_each(|cell| element(&mut file, 7, cell));
    file.text("\n$EndElements\n");
    file.text(&format!(
        "$PhysicalNames\n1\n{} 5 \"skin\"\n$EndPhysicalNames\n",
        D - 1
    ));
    file.bytes
}

/// Grids are numbered as meshes that are read.
fn comes_back<const D: usize>(mesh: &Mesh<D>) {
    for order in [Order::Little, Order::Big] {
        for bytes in [version_4(mesh, order), version_2(mesh, order)] {
            let read = gmsh::parse::<D>(&bytes).unwrap();
            assert_eq!(read.fingerprint(), mesh.fingerprint());
            assert_eq!(
                (read.vertices(), read.boundary()),
                (mesh.vertices(), mesh.boundary())
            );
            assert!(read.cells().eq(mesh.cells()));
            let skin: Vec<usize> = (0..mesh.boundary().len()).collect();
            assert!(read.parts().eq([("skin", skin.as_slice())]));
            let all: Vec<usize> = (0..mesh.cell_count()).collect();
            assert!(read.materials().eq([("7", all.as_slice())]));
        }
    }
}

#[test]
fn what_is_written_is_read_in_both_orders_of_bytes() {
    comes_back(&Mesh::<2>::grid([0.7, 1.9], [3, 4], stickslip_fem::GridDiagonal::Falling).unwrap());
    comes_back(&Mesh::<3>::grid([0.7, 1.9, 0.3], [2, 3, 1]).unwrap());
}
