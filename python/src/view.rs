//! Arrays over memory of the library: views of objects that do not change, vectors as rows.
#![allow(unsafe_code)]

use numpy::ndarray::{ArrayView, ArrayView2, Dimension};
use numpy::{Element, PyArray, PyArray1, PyArray2, PyArrayMethods};
use pyo3::PyClass;
use pyo3::prelude::*;
use pyo3::pyclass::boolean_struct::True;
use stickslip::nalgebra::SVector;

/// A read-only array over numbers of `owner`, which it keeps alive: nothing is copied.
pub(crate) fn view<'py, T, E, D>(
    owner: &Bound<'py, T>,
    numbers: impl for<'a> FnOnce(&'a T) -> ArrayView<'a, E, D>,
) -> PyResult<Bound<'py, PyArray<E, D>>>
where
    T: PyClass<Frozen = True> + Sync,
    E: Element,
    D: Dimension,
{
    let numbers = numbers(owner.get());
    // SAFETY: The numbers live as long as the object does, whatever that is, or for ever, by the type of the function
    // above. The object is frozen: no one has a mutable reference to it while it lives, and the array is its container.
    let array = unsafe { PyArray::borrow_from_array(&numbers, owner.clone().into_any()) };
    // An array without its own memory stays so.
    array.call_method1("setflags", (false,))?;
    Ok(array)
}

/// Vectors as rows of an array.
pub(crate) fn rows<const D: usize>(vectors: &[SVector<f64, D>]) -> ArrayView2<'_, f64> {
    const { assert!(size_of::<SVector<f64, D>>() == size_of::<[f64; D]>()) };
    // SAFETY: A vector of nalgebra is an array of its numbers and no more.
    let arrays =
        unsafe { std::slice::from_raw_parts(vectors.as_ptr().cast::<[f64; D]>(), vectors.len()) };
    ArrayView2::from(arrays)
}

/// An array of its own with vectors as rows, in their memory.
pub(crate) fn into_rows<const D: usize>(
    py: Python<'_>,
    vectors: Vec<SVector<f64, D>>,
) -> PyResult<Bound<'_, PyArray2<f64>>> {
    let count = vectors.len();
    // The standard library maps in place.
    let arrays: Vec<[f64; D]> = vectors.into_iter().map(Into::into).collect();
    PyArray1::from_vec(py, arrays.into_flattened()).reshape([count, D])
}
