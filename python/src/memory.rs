//! Room for large objects, asked for before they are built: Rust ends the process where memory runs out.

use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;

/// The memory of a cell of a line \[B\], measured: fields, stages of a step and spectra.
pub(crate) const LINE_CELL: usize = 950;
/// Of a cell of a dipping line, with its images at a low rank.
pub(crate) const DIPPING_CELL: usize = 4000;
/// Of a pair of cells of a column of a plane below a free surface, whose products are dense down dip.
pub(crate) const PAIR_DOWN_DIP: usize = 20;
/// Of a triangle or tetrahedron, with those of coarser meshes.
pub(crate) const MESH_CELL: usize = 100;
/// Of a pair of unknowns in contact of a reduced body: its dense stiffness, mass, and a factor.
pub(crate) const REDUCED_PAIR: usize = 24;
/// Of a sample of an experiment.
pub(crate) const SAMPLE: usize = 25;

/// Refuses an argument that asks for the product of `counts` items of so many bytes where these cannot be had.
pub(crate) fn check_memory(name: &str, counts: &[usize], bytes: usize) -> PyResult<()> {
    let items = counts.iter().map(|&count| count as f64).product::<f64>();
    // A float saturates in the conversion, and the reservation fails.
    let size = (items * bytes as f64) as usize;
    let reserved = Vec::<u8>::new().try_reserve_exact(size);
    reserved.map_err(|_| {
        let size = items * bytes as f64 / 1e9;
        PyMemoryError::new_err(format!(
            "{name}: {items:.0} items need {size:.1} GB of memory, which cannot be had: give fewer"
        ))
    })
}
