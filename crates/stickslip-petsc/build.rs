//! Finds PETSc, compiles the shim with its headers and those of MPI, and links both.
//!
//! PETSc is that of `PETSC_DIR` and `PETSC_ARCH`, else that of pkg-config, else that of Debian.

use std::env;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

const DEBIAN: &str = "/usr/lib/petscdir/petsc-real";
/// As PETSc names its library, and as Debian names the one of real numbers.
const LIBRARIES: [&str; 2] = ["petsc", "petsc_real"];
const MODULES: [&str; 2] = ["PETSc", "petsc"];

/// The folders of headers and libraries, and the libraries to link.
#[derive(Default)]
struct Petsc {
    headers: Vec<PathBuf>,
    folders: Vec<PathBuf>,
    libraries: Vec<String>,
}

fn main() -> ExitCode {
    for variable in ["PETSC_DIR", "PETSC_ARCH", "PKG_CONFIG_PATH"] {
        println!("cargo:rerun-if-env-changed={variable}");
    }
    println!("cargo:rerun-if-changed=src/shim.c");
    let petsc = match find() {
        Ok(petsc) => petsc,
        Err(tried) => {
            eprintln!(
                "no PETSc:\n{tried}install it (Debian: libpetsc-real-dev), or set PETSC_DIR and PETSC_ARCH"
            );
            return ExitCode::FAILURE;
        }
    };
    cc::Build::new()
        .file("src/shim.c")
        .compiler("mpicc")
        .includes(&petsc.headers)
        .compile("shim");
    for folder in &petsc.folders {
        println!("cargo:rustc-link-search=native={}", folder.display());
        println!("cargo:rustc-link-arg=-Wl,-rpath,{}", folder.display());
    }
    for library in petsc.libraries.iter().map(String::as_str).chain(["mpi"]) {
        println!("cargo:rustc-link-lib={library}");
    }
    ExitCode::SUCCESS
}

/// PETSc, or a line for each place where it is not. A folder that was asked for is not replaced by another one.
fn find() -> Result<Petsc, String> {
    if let Ok(folder) = env::var("PETSC_DIR") {
        let architecture = env::var("PETSC_ARCH").ok();
        return in_folder(Path::new(&folder), architecture.as_deref())
            .map_err(|reason| format!("  PETSC_DIR, PETSC_ARCH: {reason}\n"));
    }
    let mut tried = String::new();
    for module in MODULES {
        match by_pkg_config(module) {
            Ok(petsc) => return Ok(petsc),
            Err(reason) => tried += &format!("  pkg-config {module}: {reason}\n"),
        }
    }
    in_folder(Path::new(DEBIAN), None).map_err(|reason| format!("{tried}  Debian: {reason}\n"))
}

/// The PETSc of a folder: sources with what an architecture adds to them, or an installation.
fn in_folder(folder: &Path, architecture: Option<&str>) -> Result<Petsc, String> {
    let built = architecture.map_or(folder.into(), |name| folder.join(name));
    let mut headers = vec![folder.join("include"), built.join("include")];
    headers.dedup();
    for file in ["petscksp.h", "petscconf.h"] {
        if !headers.iter().any(|folder| folder.join(file).is_file()) {
            return Err(format!("no {file} in {headers:?}"));
        }
    }
    let libraries = built.join("lib");
    let there = |name: &&str| {
        let files = ["so", "dylib"].map(|end| libraries.join(format!("lib{name}.{end}")));
        files.iter().any(|file| file.is_file())
    };
    let name = LIBRARIES.into_iter().find(there);
    let name = name.ok_or_else(|| format!("no library of {LIBRARIES:?} in {libraries:?}"))?;
    Ok(Petsc {
        headers,
        folders: vec![libraries],
        libraries: vec![name.into()],
    })
}

fn by_pkg_config(module: &str) -> Result<Petsc, String> {
    let command = Command::new("pkg-config")
        .args(["--cflags", "--libs", module])
        .output()
        .map_err(|error| error.to_string())?;
    if !command.status.success() {
        let message = String::from_utf8_lossy(&command.stderr);
        return Err(message.lines().next().unwrap_or("it fails").to_string());
    }
    let mut petsc = Petsc::default();
    for flag in String::from_utf8_lossy(&command.stdout).split_whitespace() {
        match flag.split_at_checked(2) {
            Some(("-I", folder)) => petsc.headers.push(folder.into()),
            Some(("-L", folder)) => petsc.folders.push(folder.into()),
            Some(("-l", library)) => petsc.libraries.push(library.into()),
            _ => {}
        }
    }
    Ok(petsc)
}
