//! Files that are whole or not there.

use std::io::{BufWriter, Write};
use std::path::Path;

use tempfile::Builder;

use crate::cli::Problem;

/// Writes a file under a temporary name in its folder, and renames it once it is whole: a program that is killed, and one
/// that fails, leave what was there before.
///
/// # Errors
/// In one line: the file cannot be written.
pub(crate) fn write_whole(
    path: &Path,
    fill: impl FnOnce(&mut dyn Write) -> Result<(), Problem>,
) -> Result<(), Problem> {
    let failed =
        |error: &dyn std::fmt::Display| format!("cannot write {}: {error}", path.display());
    let folder = path.parent().unwrap_or(Path::new("."));
    let mut builder = Builder::new();
    builder.prefix(".stickslip-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // Those of any new file, less what the user's mask takes.
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    let beside = builder
        .tempfile_in(folder)
        .map_err(|error| failed(&error))?;
    let mut file = BufWriter::new(beside);
    fill(&mut file).map_err(|error| failed(&error))?;
    let beside = file.into_inner().map_err(|error| failed(&error))?;
    beside.persist(path).map_err(|error| failed(&error.error))?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn a_file_that_fails_leaves_the_one_before_it() -> Result<(), Problem> {
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("table.csv");
        write_whole(&path, |file| Ok(file.write_all(b"whole")?))?;
        let failed = write_whole(&path, |file| {
            file.write_all(b"part")?;
            Err("the end".into())
        });
        assert!(failed.is_err_and(|error| error.to_string().ends_with("the end")));
        assert_eq!(fs::read(&path)?, b"whole");
        assert_eq!(fs::read_dir(folder.path())?.count(), 1);
        Ok(())
    }
}
