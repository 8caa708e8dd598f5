//! Files of Gmsh: all variants say the same, broken ones are refused, none does harm.

use std::path::{Path, PathBuf};

mod broken;
mod mutated;
mod surfaces;
mod variants;
mod written;

const VARIANTS: [&str; 4] = ["4.1-text", "4.1-binary", "2.2-text", "2.2-binary"];

/// The file of a body (`plane` or `block`) in a variant of the format.
fn file(body: &str, variant: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/meshes");
    folder.join(format!("{body}-{variant}.msh"))
}
