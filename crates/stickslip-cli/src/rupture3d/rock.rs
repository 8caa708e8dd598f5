//! The rock beside the fault: one of two halves, from a size of cells or from a file.

use stickslip::fem::{FemError, P1, Trace, gmsh};
use stickslip::nalgebra::Vector3;

use super::{Arguments, Benchmark};
use crate::cli::Problem;
use crate::memory;

/// The largest memory of a run of TPV102 over its vertices \[byte\], its mesh and tables included: 1859 of 338 477 vertices
/// (`--cell 200`), 1836 of 1 238 568 (`--cell 100`).
const BYTES: f64 = 1859.0;

/// A box of rock at `y > 0`, with the fault at `y = 0`.
pub(super) struct Rock {
    /// The space.
    pub space: P1<3>,
    /// Its corners \[m\].
    corners: [Vector3<f64>; 2],
    /// The distance along strike of `x = 0` \[m\].
    begin: f64,
    /// The direction of depth along `z`.
    down: f64,
    /// Whether it is one of two halves along strike, at `x > 0`.
    pub even: bool,
}

impl Rock {
    /// With cells of the size that the arguments ask for, or from their file.
    ///
    /// # Errors
    /// Cells that need more memory than there is, a file that is not a mesh of such a box.
    pub(super) fn new(arguments: &Arguments) -> Result<Self, Problem> {
        let problem = arguments.problem;
        match &arguments.mesh {
            Some(path) => {
                let space = P1::new(gmsh::read(path)?);
                from_space(space, problem)
                    .map_err(|error| format!("{}: {error}", path.display()).into())
            }
            None => graded(arguments),
        }
    }

    /// The distance along strike and the depth of a point \[m\].
    pub(super) fn place(&self, x: &[f64]) -> [f64; 2] {
        [x[0] + self.begin, self.down * x[2]]
    }

    /// The component of a vector down dip.
    pub(super) fn down(&self, z: f64) -> f64 {
        self.down * z
    }

    /// The fault: the faces within the extent of a benchmark.
    pub(super) fn fault(&self, problem: Benchmark) -> Result<Trace<3>, FemError> {
        self.space.trace(|x| x[1] == 0.0 && self.slips(problem, x))
    }

    /// Whether there is rock beyond the fault in its plane.
    pub(super) fn is_larger_than(&self, problem: Benchmark) -> bool {
        let mut vertices = self.space.mesh().vertices().iter();
        vertices.any(|x| x[1] == 0.0 && !self.slips(problem, x))
    }

    /// Whether a point is within the extent of a benchmark along strike and down dip.
    pub(super) fn slips(&self, problem: Benchmark, x: &Vector3<f64>) -> bool {
        let ([along, depth], [x, z]) = (problem.extent(), self.place(x.as_slice()));
        x.abs() <= along && z <= depth
    }

    /// The sides that absorb waves: all but the fault, the surface and the middle of two halves.
    pub(super) fn absorbing(&self) -> Result<Trace<3>, FemError> {
        let ([low, high], bottom) = (&self.corners, self.bottom());
        self.space.trace(|x| {
            x[0] == high[0] || x[1] == high[1] || x[2] == bottom || (!self.even && x[0] == low[0])
        })
    }

    /// The coordinate of the bottom \[m\].
    fn bottom(&self) -> f64 {
        self.corners[usize::from(self.down > 0.0)][2]
    }
}

/// The longest edge of a fault \[m\].
pub(super) fn longest_edge(fault: &Trace<3>) -> f64 {
    let points = fault.points();
    let edges = fault
        .faces()
        .iter()
        .flat_map(|face| [0, 1, 2].map(|k| (points[face[k]] - points[face[(k + 1) % 3]]).norm()));
    edges.fold(0.0, f64::max)
}

/// With fine cells at what slips.
fn graded(arguments: &Arguments) -> Result<Rock, Problem> {
    let (problem, margin) = (arguments.problem, arguments.margin);
    let ([along, depth], even) = (problem.extent(), problem.is_even());
    let begin = if even { 0.0 } else { -along - margin };
    let lengths = [along + margin - begin, margin, depth + margin];
    // Cubes whose halves become cells.
    let counts = lengths.map(|length| (length / 6e3).ceil().max(1.0) as usize);
    let size = |x: &Vector3<f64>| {
        let beyond = [(x[0] + begin).abs() - along, x[1], x[2] - depth];
        let distance = beyond.map(|distance| distance.max(0.0));
        arguments.cell + arguments.growth * Vector3::from(distance).norm()
    };
    let available = memory::available();
    let most = available.map_or(u32::MAX, |bytes| (bytes / BYTES) as u32);
    let coarse = P1::grid(lengths, counts)?;
    let space = coarse.graded_within(size, most).map_err(|error| -> Problem {
        match (&error, available) {
            (FemError::AboveLimit { count, .. }, Some(bytes)) => format!(
                "cells of {} m are {count} vertices or more, which take {:.0} GiB of memory; {:.0} GiB are available: take larger --cell or --growth",
                arguments.cell,
                *count as f64 * BYTES / memory::GIB,
                bytes / memory::GIB
            )
            .into(),
            _ => error.into(),
        }
    })?;
    Ok(Rock {
        space,
        corners: [Vector3::zeros(), lengths.into()],
        begin,
        down: 1.0,
        even,
    })
}

/// From a mesh; its depth is along `z` or against it.
fn from_space(space: P1<3>, problem: Benchmark) -> Result<Rock, String> {
    let vertices = space.mesh().vertices();
    let [mut low, mut high] = [f64::INFINITY, -f64::INFINITY].map(Vector3::repeat);
    for x in vertices {
        (low, high) = (low.inf(x), high.sup(x));
    }
    let ([along, depth], span) = (problem.extent(), |axis: usize| {
        format!("from {} m to {} m", low[axis], high[axis])
    });
    if low[1] != 0.0 {
        return Err(format!(
            "no fault at y = 0 with the rock at y > 0: the mesh spans y {}",
            span(1)
        ));
    }
    let down = if high[2] == 0.0 {
        -1.0
    } else if low[2] == 0.0 {
        1.0
    } else {
        return Err(format!(
            "no free surface at z = 0: the mesh spans z {}",
            span(2)
        ));
    };
    let even = problem.is_even() && low[0] == 0.0;
    if high[0] < along || (!even && low[0] > -along) {
        return Err(format!(
            "the fault of {} slips up to {along} m along strike, and the mesh spans x {}",
            problem.name(),
            span(0)
        ));
    }
    if high[2] - low[2] < depth {
        return Err(format!(
            "the fault of {} slips down to {depth} m, and the mesh spans z {}",
            problem.name(),
            span(2)
        ));
    }
    let sides = |x: &Vector3<f64>, axis: usize, end: f64| x[axis] == end;
    let boundary = space.mesh().boundary().iter();
    let outside = boundary.map(|face| face.map(|p| vertices[p as usize]));
    for corners in outside {
        let flat = (0..3).any(|axis| {
            [low[axis], high[axis]]
                .iter()
                .any(|end| corners.iter().all(|x| sides(x, axis, *end)))
        });
        if !flat {
            let [x, y, z]: [f64; 3] = ((corners[0] + corners[1] + corners[2]) / 3.0).into();
            return Err(format!(
                "the mesh is not a box: a face of its boundary at ({x}, {y}, {z}) m is on none of the six sides"
            ));
        }
    }
    Ok(Rock {
        space,
        corners: [low, high],
        begin: 0.0,
        down,
        even,
    })
}
