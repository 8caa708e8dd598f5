//! Compiles the shim with the headers of PETSc and MPI, and links both.

fn main() {
    let petsc = std::env::var("PETSC_DIR").unwrap_or("/usr/lib/petscdir/petsc-real".into());
    cc::Build::new()
        .file("src/shim.c")
        .compiler("mpicc")
        .include(format!("{petsc}/include"))
        .include("/usr/include/petsc")
        .compile("shim");
    println!("cargo:rerun-if-changed=src/shim.c");
    println!("cargo:rerun-if-env-changed=PETSC_DIR");
    println!("cargo:rustc-link-search=native={petsc}/lib");
    println!("cargo:rustc-link-lib=petsc_real");
    println!("cargo:rustc-link-lib=mpi");
}
