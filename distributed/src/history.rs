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
    rows: Vec<Vec<f64>>,
}

impl SharedHistory {
    /// Of a vertex, which is `None` in all processes but its own.
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

    /// Adds time, displacement, velocity and state of the vertex, and the largest slip rate of all contacts.
    pub fn record<const C: usize>(&mut self, at: &Snapshot<'_, C>) {
        let mut row = vec![0.0; 2 * C + 1];
        if let Some(vertex) = self.vertex {
            row[..C].copy_from_slice(at.displacement[vertex].as_slice());
            row[C..2 * C].copy_from_slice(at.velocity[vertex].as_slice());
            let contact = at.contact(0);
            let place = (0..contact.len()).find(|&k| contact.vertex(k) == vertex);
            row[2 * C] = place.map_or(0.0, |k| contact.state(k));
        }
        self.world.sum_each(&mut row);
        row.insert(0, at.time);
        row.push(self.world.largest(at.max_slip_rate()));
        self.rows.push(row);
    }

    /// The rows so far, the same in all processes.
    pub fn rows(&self) -> &[Vec<f64>] {
        &self.rows
    }

    /// Writes a table with the columns `time, u.., v.., state, max_slip_rate` from the first process.
    ///
    /// # Errors
    /// Those of the file system.
    pub fn write(&self, path: &Path) -> io::Result<()> {
        if !self.world.is_first() {
            return Ok(());
        }
        let mut file = io::BufWriter::new(std::fs::File::create(path)?);
        for row in &self.rows {
            let values: Vec<String> = row.iter().map(|value| format!("{value:.17e}")).collect();
            writeln!(file, "{}", values.join(","))?;
        }
        file.flush()
    }
}
