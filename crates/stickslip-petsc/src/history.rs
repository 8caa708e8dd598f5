//! The history of one vertex, which one process has and the first one writes.

use std::io::{self, Write};
use std::path::Path;

use stickslip::Snapshot;

use crate::World;

/// Rows of numbers that every process adds to together, seen at a vertex of one of them.
#[derive(Debug)]
pub struct SharedHistory {
    world: World,
    vertex: Option<usize>,
    /// [`SCALARS`], displacement, velocity.
    rows: Vec<Vec<f64>>,
}

/// The quantity in a column of the table. Components that the vertex does not have are `NaN`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Column {
    /// The number of the step.
    Step,
    /// Time \[s\].
    Time,
    /// The iterations of the coupling in this step.
    CouplingIterations,
    /// The iterations of the solver.
    SolverIterations,
    /// The largest slip rate of all contacts \[m/s\].
    MaxSlipRate,
    /// The vertex' state in the first contact, zero where it is not there.
    State,
    /// Its normal stress in the first contact \[Pa\], zero where it is not there.
    NormalStress,
    /// A component of its displacement \[m\].
    Displacement(usize),
    /// The same less that of the first row \[m\].
    Slip(usize),
    /// A component of its velocity \[m/s\].
    Velocity(usize),
}

/// The columns of a row in front of displacement and velocity.
const SCALARS: [Column; 7] = [
    Column::Step,
    Column::Time,
    Column::CouplingIterations,
    Column::SolverIterations,
    Column::MaxSlipRate,
    Column::State,
    Column::NormalStress,
];

impl Column {
    /// Time, displacement and velocity of a body with so many components, with their names.
    pub fn motion(components: usize) -> Vec<(&'static str, Self)> {
        const DISPLACEMENT: [&str; 3] = ["displacement_x", "displacement_y", "displacement_z"];
        const VELOCITY: [&str; 3] = ["velocity_x", "velocity_y", "velocity_z"];
        let all = |names: [&'static str; 3], of: fn(usize) -> Self| {
            let names = names.into_iter().take(components);
            names.enumerate().map(move |(c, name)| (name, of(c)))
        };
        let time = [("time", Self::Time)].into_iter();
        time.chain(all(DISPLACEMENT, Self::Displacement))
            .chain(all(VELOCITY, Self::Velocity))
            .collect()
    }
}

impl SharedHistory {
    /// A history of a vertex, `None` in all processes but its own.
    pub fn new(world: World, vertex: Option<usize>) -> Self {
        let rows = Vec::new();
        Self {
            world,
            vertex,
            rows,
        }
    }

    /// Goes on behind the rows of an earlier run, the same in all processes.
    pub fn go_on_from(&mut self, rows: Vec<Vec<f64>>) {
        self.rows = rows;
    }

    /// Adds a row.
    pub fn record<const C: usize>(&mut self, at: &Snapshot<'_, C>) {
        let mut seen = vec![0.0; 2 + 2 * C];
        if let Some(vertex) = self.vertex {
            let contact = at.contact(0);
            let place = (0..contact.len()).find(|&k| contact.vertex(k) == vertex);
            seen[0] = place.map_or(0.0, |k| contact.state(k));
            seen[1] = place.map_or(0.0, |k| contact.normal_stress(k));
            seen[2..2 + C].copy_from_slice(at.displacement[vertex].as_slice());
            seen[2 + C..].copy_from_slice(at.velocity[vertex].as_slice());
        }
        self.world.sum_each(&mut seen);
        let mut row = vec![
            at.step as f64,
            at.time,
            at.report.coupling_iterations as f64,
            at.report.solver_iterations as f64,
            self.world.largest(at.max_slip_rate()),
        ];
        row.append(&mut seen);
        self.rows.push(row);
    }

    /// The rows so far, the same in all processes.
    pub fn rows(&self) -> &[Vec<f64>] {
        &self.rows
    }

    /// Writes a table from the first process: these columns, below their names. Its folder is made.
    ///
    /// # Errors
    /// Those of the file system.
    pub fn write(&self, path: &Path, columns: &[(&str, Column)]) -> io::Result<()> {
        if !self.world.is_first() {
            return Ok(());
        }
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder)?;
        }
        let mut file = io::BufWriter::new(std::fs::File::create(path)?);
        let names: Vec<&str> = columns.iter().map(|&(name, _)| name).collect();
        writeln!(file, "{}", names.join(","))?;
        for row in &self.rows {
            let cells = columns.iter().map(|&(_, column)| self.cell(row, column));
            writeln!(file, "{}", cells.collect::<Vec<_>>().join(","))?;
        }
        file.flush()
    }

    fn cell(&self, row: &[f64], column: Column) -> String {
        let (scalars, motion) = row.split_at(SCALARS.len());
        let components = motion.len() / 2;
        let component = |motion: &[f64], first: usize, c: usize| {
            let value = (c < components).then(|| motion[first + c]);
            value.unwrap_or(f64::NAN)
        };
        let at_first = |c| component(&self.rows[0][SCALARS.len()..], 0, c);
        let value = match column {
            Column::Displacement(c) => component(motion, 0, c),
            Column::Slip(c) => component(motion, 0, c) - at_first(c),
            Column::Velocity(c) => component(motion, components, c),
            _ => {
                let place = SCALARS.iter().position(|&scalar| scalar == column);
                place.map_or(f64::NAN, |place| scalars[place])
            }
        };
        match column {
            Column::Step | Column::CouplingIterations | Column::SolverIterations => {
                value.to_string()
            }
            _ => format!("{value:.16e}"),
        }
    }
}
