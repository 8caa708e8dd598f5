//! The tests of the crate `stickslip`: `tests/point` of spring sliders and faults by boundary integrals, `tests/simulation`
//! of bodies on a surface, `tests/two_sides` of faults inside bodies.
