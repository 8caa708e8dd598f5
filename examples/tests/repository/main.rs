//! What holds of the files of the project as a whole: documents, and what its workspaces share.

mod documents;
mod imports;
mod rooms;
mod workspaces;

use std::path::{Path, PathBuf};

type Outcome<T = ()> = Result<T, Box<dyn std::error::Error>>;

/// The folder of the workspace.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}
