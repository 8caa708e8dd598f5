//! Surfaces from STL files.

use std::fmt::Write;

use stickslip_bie::{SurfaceError, Triangles};

use super::meshes::grid;
use crate::Outcome;

/// Facets of a grid whose coordinates are exact in single precision.
fn facets() -> Vec<[[f64; 3]; 3]> {
    let (points, triangles) = grid([4, 3], |[x, y]| [250.0 * x, 0.5 * y, -100.0 - 125.0 * y]);
    let corners = triangles.into_iter();
    corners.map(|corners| corners.map(|p| points[p])).collect()
}

fn text(facets: &[[[f64; 3]; 3]]) -> String {
    let mut text = String::from("solid a\n");
    for facet in facets {
        text += "facet normal 0 0 0\n outer loop\n";
        for [x, y, z] in facet {
            let _ = writeln!(text, "  vertex {x:e} {y} {z}");
        }
        text += " endloop\nendfacet\n";
    }
    text + "endsolid a\n"
}

fn binary(facets: &[[[f64; 3]; 3]]) -> Vec<u8> {
    // Some programs begin the header of binary files as text begins.
    let mut bytes = b"solid, but binary".to_vec();
    bytes.resize(80, b' ');
    bytes.extend(u32::to_le_bytes(facets.len() as u32));
    for facet in facets {
        bytes.extend([0; 12]);
        let numbers = facet.as_flattened().iter();
        bytes.extend(numbers.flat_map(|&x| f32::to_le_bytes(x as f32)));
        bytes.extend([0; 2]);
    }
    bytes
}

#[test]
fn text_and_binary_are_the_same_surface() -> Outcome {
    let from_text = Triangles::from_stl(text(&facets()).as_bytes())?;
    let from_binary = Triangles::from_stl(&binary(&facets()))?;
    assert_eq!(from_text, from_binary);
    assert_eq!((from_text.count(), from_text.points().len()), (24, 20));
    assert_eq!(from_text.merged_points(), 72 - 20);
    assert!(matches!(
        Triangles::read_stl("no/such/file.stl"),
        Err(SurfaceError::File { path, .. }) if path == "no/such/file.stl"
    ));
    Ok(())
}

#[test]
fn broken_files_are_refused_with_their_place() {
    let message = |bytes: &[u8]| {
        Triangles::from_stl(bytes).map_or_else(|error| error.to_string(), |_| String::new())
    };
    let whole = text(&facets());
    assert_eq!(
        message(whole.replacen("0e0 0 -100", "0e0 zero -100", 1).as_bytes()),
        "STL cannot be read: line 4: a vertex must have 3 numbers: vertex 0e0 zero -100"
    );
    let cut = &whole[..whole.len() / 2];
    assert!(message(cut.as_bytes()).starts_with("STL cannot be read: "));
    assert!(message(b"solid empty\nendsolid").starts_with("the surface has no triangle"));
    assert!(message(b"").starts_with("STL cannot be read: no \"solid\""));
    let mut short = binary(&facets());
    short.truncate(700);
    assert!(message(&short).starts_with("STL cannot be read: "));
    short[0] = b'B';
    assert!(message(&short).contains("700 bytes, where its header says 24 triangles, 1284 bytes"));
}
