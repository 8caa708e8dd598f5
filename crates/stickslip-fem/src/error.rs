use thiserror::Error;

/// Why a mesh, a space or an operator could not be built.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum FemError {
    /// A mesh needs at least one cell.
    #[error("mesh without cells")]
    NoCells,
    /// The flat list of cells must hold D + 1 vertices a cell.
    #[error("{length} vertex indices do not make whole cells of {corners} corners")]
    CellLength {
        /// Length of the list.
        length: usize,
        /// Vertices a cell, D + 1.
        corners: usize,
    },
    /// A coordinate is infinite or not a number.
    #[error("vertex {vertex} has a coordinate that is not finite")]
    NotFinite {
        /// Index of the vertex.
        vertex: usize,
    },
    /// A cell names a vertex that does not exist.
    #[error("cell {cell} names vertex {vertex}, the mesh has {vertices}")]
    VertexOutOfRange {
        /// Index of the cell.
        cell: usize,
        /// The vertex it names.
        vertex: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// A cell is flat up to rounding, or its vertices are in the wrong order.
    #[error("cell {cell} is inverted or degenerate: volume {volume:e}")]
    DegenerateCell {
        /// Index of the cell.
        cell: usize,
        /// Its signed volume [m^D].
        volume: f64,
    },
    /// A vertex belongs to no cell, so that its row of every operator would vanish.
    #[error("vertex {vertex} belongs to no cell")]
    UnusedVertex {
        /// Index of the vertex.
        vertex: usize,
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
    /// A field that is not one of the mesh.
    #[error("a field of {found} vectors on a mesh of {expected} vertices")]
    Length {
        /// The vertices.
        expected: usize,
        /// The length of the field.
        found: usize,
    },
    /// Two cells have the same vertices.
    #[error("cells {} and {} have the same vertices", .cells[0], .cells[1])]
    RepeatedCell {
        /// Indices of the cells.
        cells: [usize; 2],
    },
    /// A distance must be finite and not negative.
    #[error("distance {value:e} m is not finite and non-negative")]
    Distance {
        /// The distance \[m\].
        value: f64,
    },
    /// The size of a box must be positive and finite.
    #[error("size {size:e} of the box along axis {axis} is not positive and finite")]
    GridSize {
        /// The axis, from 0.
        axis: usize,
        /// Its size \[m\].
        size: f64,
    },
    /// A box needs at least one cell along each axis.
    #[error("no cells along axis {axis} of the box")]
    GridCells {
        /// The axis, from 0.
        axis: usize,
    },
    /// Vertices are numbered by `u32`.
    #[error("a mesh of at least {vertices} vertices is too large: they are numbered by 32 bits")]
    TooManyVertices {
        /// A lower bound for their number, saturating.
        vertices: u64,
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
    /// New vertices of the boundary are moved so far that cells turn over or collapse.
    #[error("a part of cell {cell} of level {level} is inverted or degenerate: volume {volume:e}")]
    CurvedCell {
        /// Level of the mesh that was refined, 0 the coarsest.
        level: usize,
        /// Index of the cell that was cut, on that level.
        cell: usize,
        /// The signed volume of the part [m^D].
        volume: f64,
    },
    /// Entries of a sparse matrix are numbered by `u32`.
    #[error("a matrix of {entries} blocks is too large: they are numbered by 32 bits")]
    TooManyEntries {
        /// Number of blocks.
        entries: usize,
    },
    /// No face of the boundary satisfies the predicate with all its vertices.
    #[error("no face of the boundary satisfies the predicate")]
    EmptyTrace,
    /// A named part of the boundary or group of cells has no members.
    #[error("the group {name:?} is empty")]
    EmptyGroup {
        /// Its name.
        name: String,
    },
    /// Two parts of the boundary, two groups of cells or two values have one name.
    #[error("the name {name:?} is there twice")]
    RepeatedName {
        /// The name.
        name: String,
    },
    /// A face of a named part does not belong to exactly one cell: it lies inside of the body, or is none of its faces.
    #[error(
        "face {index} of the part {part:?}, of vertices {face:?}, is not on the boundary: it belongs to {cells} cells"
    )]
    FaceNotOnBoundary {
        /// Name of the part.
        part: String,
        /// Place of the face in the list.
        index: usize,
        /// The vertices of the face.
        face: Vec<u32>,
        /// The number of cells that it belongs to.
        cells: usize,
    },
    /// A named part lists a face twice.
    #[error("faces {} and {} of the part {part:?} have the same vertices", .indices[0], .indices[1])]
    RepeatedFace {
        /// Name of the part.
        part: String,
        /// Places of the face in the list.
        indices: [usize; 2],
    },
    /// A named group lists a cell that does not exist.
    #[error("the material {material:?} names cell {cell}, the mesh has {cells}")]
    CellOutOfRange {
        /// Name of the group.
        material: String,
        /// The cell it names.
        cell: usize,
        /// Number of cells.
        cells: usize,
    },
    /// A named group lists a cell twice.
    #[error("the material {material:?} names cell {cell} twice")]
    RepeatedInMaterial {
        /// Name of the group.
        material: String,
        /// The cell.
        cell: usize,
    },
    /// No part of the boundary has the name.
    #[error("no part of the boundary is called {name:?}; there are {known:?}")]
    UnknownPart {
        /// The name asked for.
        name: String,
        /// Those there are.
        known: Vec<String>,
    },
    /// No group of cells has the name.
    #[error("no material is called {name:?}; there are {known:?}")]
    UnknownMaterial {
        /// The name asked for.
        name: String,
        /// Those there are.
        known: Vec<String>,
    },
    /// Values are given by name, and a cell belongs to no named group.
    #[error("cell {cell} belongs to no material")]
    NoMaterial {
        /// Index of the cell.
        cell: usize,
    },
    /// Values are given by name, and none for the groups of a cell.
    #[error("no value for cell {cell} of the material {material:?}")]
    NoValue {
        /// Index of the cell.
        cell: usize,
        /// The first group that it belongs to.
        material: String,
    },
    /// Values are given by name, and two of them for one cell.
    #[error("two values for cell {cell}, by the materials {:?} and {:?}", .materials[0], .materials[1])]
    TwoValues {
        /// Index of the cell.
        cell: usize,
        /// The groups that the values are for.
        materials: [String; 2],
    },
    /// A field by samples needs at least one.
    #[error("no samples")]
    NoSamples,
    /// Samples are a value for each point, and numbered by `u32`.
    #[error("{values} values for {points} points")]
    SampleCount {
        /// Number of points.
        points: usize,
        /// Number of values.
        values: usize,
    },
    /// A coordinate or the value of a sample is infinite or not a number.
    #[error("sample {sample} has a coordinate or value that is not finite")]
    SampleNotFinite {
        /// Its place in the list.
        sample: usize,
    },
    /// Two samples are at one point.
    #[error("samples {} and {} are at the same point", .samples[0], .samples[1])]
    RepeatedSample {
        /// Their places in the list.
        samples: [usize; 2],
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
    /// A part of the boundary belongs to another mesh, maybe one of equal size.
    #[error("the part belongs to mesh {found:016x}, not to mesh {expected:016x}")]
    OtherMesh {
        /// The fingerprint of the mesh at hand.
        expected: u64,
        /// That of the part's mesh.
        found: u64,
    },
    /// Data over the vertices has another length than there are vertices.
    #[error("{found} values for {expected} vertices")]
    VertexCount {
        /// Number of vertices.
        expected: usize,
        /// Number of values.
        found: usize,
    },
    /// The data of a cell are out of range.
    #[error("cell {cell}: {source}")]
    Cell {
        /// Index of the cell.
        cell: usize,
        /// What is wrong with them.
        source: Box<FemError>,
    },
    /// Young's modulus must be positive and finite.
    #[error("Young's modulus {value:e} Pa is not positive and finite")]
    YoungModulus {
        /// The modulus \[Pa\].
        value: f64,
    },
    /// Poisson's ratio must lie between -1 and 1/2.
    #[error("Poisson's ratio {value:e} does not lie strictly between -1 and 1/2")]
    PoissonRatio {
        /// The ratio.
        value: f64,
    },
    /// The shear modulus must be positive and finite.
    #[error("shear modulus {value:e} Pa is not positive and finite")]
    ShearModulus {
        /// The modulus \[Pa\].
        value: f64,
    },
    /// Viscosities must be finite and not negative.
    #[error("viscosity {value:e} Pa s is not finite and non-negative")]
    Viscosity {
        /// The viscosity [Pa s].
        value: f64,
    },
    /// Impedances must be finite and not negative.
    #[error("impedance {value:e} Pa s/m is not finite and non-negative")]
    Impedance {
        /// The impedance [Pa s/m].
        value: f64,
    },
    /// The density must be positive and finite.
    #[error("density {value:e} kg/m^D is not positive and finite")]
    Density {
        /// The density [kg/m^D].
        value: f64,
    },
}
