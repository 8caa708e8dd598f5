//! Good files with random damage: a typed error or a mesh, no panic, no memory beyond a multiple of the file.

use std::fs;

use stickslip_fem::{Mesh, P1, gmsh};

use super::{VARIANTS, file};

const MUTATIONS: u64 = 2000;

/// Bytes of memory for each byte of a file, and in all. Most is taken by an element in 64 groups: 8 bytes in each of two
/// lists, one of which has room for as many again, for at least 12 bytes of text.
const PER_BYTE: u64 = 64 * 8 * 3 / 12;
const IN_ALL: u64 = 1 << 14;

/// Marsaglia's xorshift generator.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    fn below(&mut self, bound: usize) -> usize {
        (self.next() % bound.max(1) as u64) as usize
    }
}

/// The beginnings of lines, and the end of the last one.
fn lines(bytes: &[u8]) -> Vec<usize> {
    let ends = bytes
        .iter()
        .enumerate()
        .filter(|(_, byte)| **byte == b'\n')
        .map(|(at, _)| at + 1);
    let mut starts: Vec<usize> = [0].into_iter().chain(ends).chain([bytes.len()]).collect();
    starts.dedup();
    starts
}

/// One kind of damage at a random place.
fn mutate(bytes: &mut Vec<u8>, random: &mut Random) {
    const WORDS: [&str; 12] = [
        "0",
        "-1",
        "1",
        "2",
        "3",
        "nan",
        "1e308",
        "4294967296",
        "18446744073709551615",
        "-2147483648",
        "$End",
        "\"",
    ];
    const NUMBERS: [u64; 6] = [0, 1, 2, u64::MAX, 1 << 31, 1 << 62];
    let at = random.below(bytes.len());
    let starts = lines(bytes);
    let line = |random: &mut Random| {
        let k = random.below(starts.len() - 1);
        starts[k]..starts[k + 1]
    };
    match random.below(8) {
        0 | 1 => bytes[at] ^= 1 << random.below(8),
        2 => bytes.truncate(at),
        3 => drop(bytes.drain(line(random))),
        4 => {
            let copy = bytes[line(random)].to_vec();
            bytes.splice(at..at, copy);
        }
        5 => {
            let (a, b) = (line(random), line(random));
            let (a, b) = if a.start < b.start { (a, b) } else { (b, a) };
            if a.end <= b.start {
                let swapped =
                    [&bytes[b.clone()], &bytes[a.end..b.start], &bytes[a.clone()]].concat();
                bytes.splice(a.start..b.end, swapped);
            }
        }
        6 => {
            // A word of the text.
            let blank = |byte: &u8| byte.is_ascii_whitespace();
            let start = bytes[..at]
                .iter()
                .rposition(blank)
                .map_or(0, |start| start + 1);
            let end = bytes[at..]
                .iter()
                .position(blank)
                .map_or(bytes.len(), |end| at + end);
            let word = WORDS[random.below(WORDS.len())];
            bytes.splice(start.min(end)..end, word.bytes());
        }
        _ => {
            // A number in binary.
            let number = NUMBERS[random.below(NUMBERS.len())].to_le_bytes();
            let width = [4, 8][random.below(2)].min(bytes.len() - at);
            bytes[at..at + width].copy_from_slice(&number[..width]);
        }
    }
}

/// Reads the bytes, and says whether they are a mesh.
fn read<const D: usize>(bytes: &[u8]) -> bool {
    let mut outcome = None;
    let memory = allocation_counter::measure(|| outcome = Some(gmsh::parse::<D>(bytes)));
    assert!(
        memory.bytes_max <= PER_BYTE * bytes.len() as u64 + IN_ALL,
        "{memory:?} for {}",
        bytes.len()
    );
    match outcome.unwrap() {
        Ok(mesh) => {
            let cells = mesh.cells().flatten().copied().collect();
            assert!(Mesh::new(mesh.vertices().to_vec(), cells).is_ok());
            let names: Vec<String> = mesh.parts().map(|(name, _)| name.to_owned()).collect();
            let space = P1::new(mesh);
            assert!(names.iter().all(|name| space.part(name).is_ok()));
            true
        }
        Err(error) => {
            assert!(!error.to_string().is_empty());
            false
        }
    }
}

fn survives<const D: usize>(body: &str) {
    for (k, variant) in (0..).zip(VARIANTS) {
        let good = fs::read(file(body, variant)).unwrap();
        assert!(read::<D>(&good));
        let mut random = Random(0x9e37_79b9_7f4a_7c15 + 2 * k + D as u64);
        let mut meshes = 0;
        for _ in 0..MUTATIONS {
            let mut bytes = good.clone();
            for _ in 0..1 + random.below(3) {
                if !bytes.is_empty() {
                    mutate(&mut bytes, &mut random);
                }
            }
            meshes += u64::from(read::<D>(&bytes));
            if random.below(8) == 0 {
                read::<2>(&bytes);
                read::<3>(&bytes);
                if let Ok(surface) = gmsh::parse_surface(&bytes) {
                    let mut vertices = surface.triangles.iter().flatten();
                    assert!(vertices.all(|&vertex| vertex < surface.points.len()));
                }
            }
        }
        // Some damage is none, or hits what is passed over; most is found.
        assert!(
            0 < meshes && meshes < MUTATIONS / 2,
            "{meshes} of {body} {variant}"
        );
    }
}

#[test]
fn damaged_files_of_a_plane_body_do_no_harm() {
    survives::<2>("plane");
}

#[test]
fn damaged_files_of_a_block_do_no_harm() {
    survives::<3>("block");
}

/// As many items as possible in few bytes: nodes alone, elements each in a group of its own, each in 64 groups.
#[test]
fn memory_is_a_multiple_of_the_file() {
    const MANY: usize = 3000;
    let listed = |item: &dyn Fn(usize) -> String| (1..=MANY).map(item).collect::<String>();
    let nodes = listed(&|k| format!("{k} 0 0 0\n"));
    read::<2>(
        format!("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{MANY}\n{nodes}$EndNodes\n")
            .as_bytes(),
    );

    let elements = listed(&|k| format!("1 15 1 {k} 1\n"));
    let text = format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 0 0\n$EndNodes\n$Elements\n{MANY}\n{elements}$EndElements\n"
    );
    read::<2>(text.as_bytes());

    // A strip of triangles over the nodes 0, 1, 2, ... along two lines.
    let groups: String = (0..64).map(|k| format!("{k} ")).collect();
    let tags: String = (0..MANY + 2).map(|k| format!("{k}\n")).collect();
    let points: String = (0..MANY + 2)
        .map(|k| format!("{} {} 0\n", k / 2, k % 2))
        .collect();
    let elements: String = (0..MANY)
        .map(|k| format!("0 {k} {} {}\n", k + 1, k + 2))
        .collect();
    let text = format!(
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 1 0\n1 0 0 0 0 0 0 64 {groups}0\n$EndEntities\n$Nodes\n\
         1 {0} 0 0\n2 1 0 {0}\n{tags}{points}$EndNodes\n$Elements\n1 {MANY} 0 0\n2 1 2 {MANY}\n{elements}$EndElements\n",
        MANY + 2
    );
    assert!(read::<2>(text.as_bytes()));
}

#[test]
fn counts_are_not_believed() {
    for count in ["18446744073709551615", "4294967295", "1000000000000"] {
        for text in [
            format!(
                "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 {count} 1 {count}\n2 1 0 {count}\n1\n"
            ),
            format!(
                "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Elements\n{count} {count} 1 1\n2 1 2 {count}\n1 1 2 3\n"
            ),
            format!(
                "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n{count} 0 0 {count}\n1 0 0 0 {count} 1\n"
            ),
            format!("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{count}\n1 0 0 0\n"),
            format!(
                "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Elements\n{count}\n1 2 {count} 1 1 1 2 3\n"
            ),
            format!("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{count}\n1 1 \"a\"\n"),
        ] {
            assert!(!read::<2>(text.as_bytes()) && !read::<3>(text.as_bytes()));
        }
    }
}
