use thiserror::Error;

/// Why a mesh, a space or an operator could not be built.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum FemError {
    /// A parameter is out of its range.
    #[error(
        "{what} must be {requirement}, is {value:e}{}",
        cell.map_or_else(String::new, |cell| format!(" in cell {cell}"))
    )]
    Value {
        /// The parameter, with its unit: "Young's modulus \[Pa\]".
        what: &'static str,
        /// What holds for a legal value.
        requirement: &'static str,
        /// The value.
        value: f64,
        /// Index of the cell whose parameter it is, if it depends on the cell.
        cell: Option<usize>,
    },
    /// A list has another length than it must have.
    #[error("{found} {what}, expected {expected}")]
    Length {
        /// What it lists: "vectors of a field on the mesh".
        what: &'static str,
        /// The length that fits.
        expected: usize,
        /// The length given.
        found: usize,
    },
    /// Something has no members: the mesh no cells, samples no points, a trace no faces, a named group neither.
    #[error("no {what}{}", if name.is_empty() { String::new() } else { format!(" {name:?}") })]
    Empty {
        /// What is missing: "cells", "samples", "faces of the boundary that satisfy the predicate" or "members of the
        /// group".
        what: &'static str,
        /// The name of the group, else empty.
        name: String,
    },
    /// A vertex or a sample lacks something: finite coordinates or values, or a vertex a cell, without which its row
    /// of every operator would vanish.
    #[error("{what} {index} must have {requirement}")]
    Point {
        /// What it is: "vertex" or "sample".
        what: &'static str,
        /// Its index.
        index: usize,
        /// What it lacks.
        requirement: &'static str,
    },
    /// A cell or a material names something that does not exist.
    #[error("{by} names {what} {index}, the mesh has {count}")]
    OutOfRange {
        /// What is named: "vertex" or "cell".
        what: &'static str,
        /// The index that is named.
        index: usize,
        /// How many there are.
        count: usize,
        /// What names it, as "cell 3" or `material "granite"`.
        by: String,
    },
    /// A cell is flat up to rounding, or its vertices are in the wrong order. In a refined mesh new vertices of the
    /// boundary were moved so far that a part of the cell turns over or collapses.
    #[error(
        "{}cell {cell}{} is inverted or degenerate: volume {volume:e}",
        if level.is_some() { "a part of " } else { "" },
        level.map_or_else(String::new, |level| format!(" of level {level}"))
    )]
    DegenerateCell {
        /// Level of the mesh that was refined, 0 the coarsest; `None` for a cell of a mesh itself.
        level: Option<usize>,
        /// Index of the cell, of the one that was cut on that level.
        cell: usize,
        /// The signed volume of the cell or part [m^D].
        volume: f64,
    },
    /// Two cells lie on the same side of a face that they share, so that they overlap; with more than two
    /// cells at one face some always do.
    #[error("cells {cells:?} overlap: at the face of vertices {face:?} two lie on one side")]
    FoldedCells {
        /// Indices of the cells that share the face, increasing.
        cells: Vec<usize>,
        /// The vertices of the face, increasing.
        face: Vec<u32>,
    },
    /// Two cells have the same vertices, two samples the same point, or a named group lists a face or a cell twice.
    #[error(
        "{what} {} and {}{} are the same",
        .places[0],
        .places[1],
        if name.is_empty() { String::new() } else { format!(" of {name:?}") }
    )]
    Repeated {
        /// What they are: "cells", "samples", "faces of the part" or "cells of the material".
        what: &'static str,
        /// Their places in the list.
        places: [usize; 2],
        /// The name of the group, else empty.
        name: String,
    },
    /// Two parts of the boundary, two groups of cells or two values have one name.
    #[error("the name {name:?} is there twice")]
    RepeatedName {
        /// The name.
        name: String,
    },
    /// Vertices of a mesh and blocks of a matrix are numbered by `u32`.
    #[error("at least {count} {what} are too many: they are numbered by 32 bits")]
    TooMany {
        /// What they are: "vertices" or "blocks of a matrix".
        what: &'static str,
        /// A lower bound for their number, saturating.
        count: u64,
    },
    /// Cells cannot have that size: it must be finite, and not so small that rounding of coordinates changes shapes.
    #[error("size {value:e} m of cells at {at:?} is not finite or below {least:e} m")]
    CellSize {
        /// The size \[m\].
        value: f64,
        /// Where \[m\].
        at: Vec<f64>,
        /// The least size, 2^-32 of the largest coordinate \[m\].
        least: f64,
    },
    /// Cells still exceed their size: what new vertices of the boundary are moved onto makes cells grow.
    #[error("cells exceed their size after {rounds} rounds of bisection")]
    SizeNotReached {
        /// Number of rounds, each of which bisects the cells that exceed it most.
        rounds: usize,
    },
    /// A new vertex of the boundary may be moved by half of the edge that it halves, no farther: then the edge's parts
    /// are not longer than it was.
    #[error(
        "the midpoint {at:?} of an edge of {edge:e} m, cut from level {level}, is moved by {by:e} m, more than half of it"
    )]
    MovedAway {
        /// Level of the mesh that was refined, 0 the coarsest.
        level: usize,
        /// Where the vertex was \[m\].
        at: Vec<f64>,
        /// The length of the edge \[m\].
        edge: f64,
        /// By how much the vertex is moved \[m\]; not finite if its new place is not.
        by: f64,
    },
    /// A face of a named part does not belong to exactly one cell: it lies inside of the body, or is none of its faces.
    #[error(
        "face {index} of the part {part:?}, of vertices {face:?}, is not on the boundary: it belongs to {cells} cells"
    )]
    NotOnBoundary {
        /// Name of the part.
        part: String,
        /// Place of the face in the list.
        index: usize,
        /// The vertices of the face.
        face: Vec<u32>,
        /// The number of cells that it belongs to.
        cells: usize,
    },
    /// No part of the boundary or group of cells has the name.
    #[error("no {what} is called {name:?}; there are {known:?}")]
    Unknown {
        /// What it was to be: "part of the boundary" or "material".
        what: &'static str,
        /// The name asked for.
        name: String,
        /// Those there are.
        known: Vec<String>,
    },
    /// Values are given by names of materials, and a cell gets none or two of them.
    #[error(
        "cell {cell} of the materials {materials:?} has {values} values by their names, must have 1"
    )]
    CellValues {
        /// Index of the cell.
        cell: usize,
        /// How many values it has.
        values: usize,
        /// Without a value the first named group that it belongs to, if any; with two those that the values are for.
        materials: Vec<String>,
    },
    /// Linear interpolation needs samples on a full grid or on a line.
    #[error(
        "{samples} samples with {along:?} different coordinates along the axes are neither a full grid nor on a line: \
         take the nearest"
    )]
    Scattered {
        /// Number of samples.
        samples: usize,
        /// Different coordinates along each axis.
        along: Vec<usize>,
    },
    /// A part of the boundary or a matrix belongs to another mesh, maybe one of equal size.
    #[error("the {what} belongs to another mesh, {}; make both from one space", other_mesh(*.vertices, *.cells))]
    Mesh {
        /// What it is.
        what: &'static str,
        /// The fingerprint of the mesh at hand.
        expected: u64,
        /// That of its own mesh.
        found: u64,
        /// The vertices of the mesh at hand, and of its own.
        vertices: [usize; 2],
        /// The cells of the mesh at hand, and of its own.
        cells: [usize; 2],
    },
}

/// How two meshes differ in size, if they do.
fn other_mesh([expected, found]: [usize; 2], cells: [usize; 2]) -> String {
    if (expected, cells[0]) == (found, cells[1]) {
        return format!(
            "of as many vertices ({found}) and cells ({}) at other places",
            cells[1]
        );
    }
    format!(
        "of {found} vertices and {} cells, that at hand has {expected} and {}",
        cells[1], cells[0]
    )
}

impl FemError {
    /// Passes a legal value of a parameter.
    pub(crate) fn check(
        what: &'static str,
        requirement: &'static str,
        value: f64,
        legal: bool,
    ) -> Result<f64, Self> {
        if legal {
            return Ok(value);
        }
        Err(Self::Value {
            what,
            requirement,
            value,
            cell: None,
        })
    }

    /// Passes a value that is positive and finite.
    pub(crate) fn positive(what: &'static str, value: f64) -> Result<f64, Self> {
        let legal = value.is_finite() && value > 0.0;
        Self::check(what, "positive and finite", value, legal)
    }

    /// Passes a value that is finite and not negative.
    pub(crate) fn non_negative(what: &'static str, value: f64) -> Result<f64, Self> {
        let legal = value.is_finite() && value >= 0.0;
        Self::check(what, "finite and non-negative", value, legal)
    }

    /// Says of which cell a value is.
    pub(crate) fn in_cell(mut self, index: usize) -> Self {
        if let Self::Value { cell, .. } = &mut self {
            *cell = Some(index);
        }
        self
    }

    pub(crate) fn empty(what: &'static str) -> Self {
        Self::Empty {
            what,
            name: String::new(),
        }
    }

    pub(crate) fn repeated(what: &'static str, places: [usize; 2]) -> Self {
        Self::Repeated {
            what,
            places,
            name: String::new(),
        }
    }

    pub(crate) fn too_many(what: &'static str, count: u64) -> Self {
        Self::TooMany { what, count }
    }
}
