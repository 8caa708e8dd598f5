//! Slip rates along a line in time, for pictures.

use stickslip::ContactView;

/// The largest number of rows and columns.
const ROWS: usize = 240;
const COLUMNS: usize = 640;

/// Slip rates of cells on a line over time and over steps: columns of a picture, each with the largest slip rate in it.
pub(crate) struct SpaceTime {
    /// Cells and their positions, increasing.
    line: Vec<(usize, f64)>,
    /// Even parts of the time \[s\] up to this end; empty ones have no steps.
    end: f64,
    times: Vec<Option<Vec<f64>>>,
    /// Each of as many steps.
    steps: Vec<Vec<f64>>,
    stride: usize,
    count: usize,
}

/// A field over two coordinates, the second one of the line.
pub(crate) struct Field {
    pub(crate) x: Vec<f64>,
    pub(crate) y: Vec<f64>,
    pub(crate) values: Vec<f64>,
}

impl SpaceTime {
    /// The slip rates of a line of cells, with increasing positions, up to a time \[s\].
    pub(crate) fn new(line: &[(usize, f64)], end: f64) -> Self {
        let every = line.len().div_ceil(ROWS).max(1);
        Self {
            line: line.iter().copied().step_by(every).collect(),
            end,
            times: vec![None; COLUMNS],
            steps: Vec::new(),
            stride: 1,
            count: 0,
        }
    }

    pub(crate) fn record<const C: usize>(&mut self, time: f64, contact: &ContactView<'_, C>) {
        self.record_of(time, |cell| contact.slip_rate(cell));
    }

    /// Records a quantity in the place of the slip rate.
    pub(crate) fn record_of(&mut self, time: f64, value: impl Fn(usize) -> f64) {
        let rates: Vec<f64> = self.line.iter().map(|&(cell, _)| value(cell)).collect();
        let column = (time / self.end * COLUMNS as f64) as usize;
        match &mut self.times[column.min(COLUMNS - 1)] {
            Some(largest) => raise(largest, &rates),
            none => *none = Some(rates.clone()),
        }
        match self.steps.last_mut() {
            Some(largest) if !self.count.is_multiple_of(self.stride) => raise(largest, &rates),
            _ => self.steps.push(rates),
        }
        self.count += 1;
        if self.steps.len() > 2 * COLUMNS {
            let pairs = self.steps.chunks(2).map(|pair| {
                let mut largest = pair[0].clone();
                pair.iter()
                    .skip(1)
                    .for_each(|rates| raise(&mut largest, rates));
                largest
            });
            self.steps = pairs.collect();
            self.stride *= 2;
        }
    }

    /// Over time, in units of `unit` seconds. Parts without steps are those before them.
    pub(crate) fn over_time(&self, unit: f64) -> Field {
        let part = self.end / COLUMNS as f64 / unit;
        let mut last = self.times.iter().flatten().next();
        let columns = self.times.iter().enumerate().filter_map(|(n, rates)| {
            last = rates.as_ref().or(last);
            Some((n as f64 * part, last?))
        });
        self.field(columns, self.end / unit)
    }

    /// Over the number of the step.
    pub(crate) fn over_steps(&self) -> Field {
        let columns = self.steps.iter().enumerate();
        let columns = columns.map(|(n, rates)| ((n * self.stride) as f64, rates));
        self.field(columns, self.count as f64)
    }

    /// Columns, and the last one again at the end.
    fn field<'a>(&self, columns: impl Iterator<Item = (f64, &'a Vec<f64>)>, end: f64) -> Field {
        let (mut x, mut values): (Vec<f64>, Vec<f64>) = (Vec::new(), Vec::new());
        for (place, rates) in columns {
            x.push(place);
            values.extend(rates);
        }
        let last = values.len().saturating_sub(self.line.len());
        values.extend_from_within(last..);
        x.push(end);
        let y = self.line.iter().map(|&(_, place)| place).collect();
        Field { x, y, values }
    }
}

fn raise(largest: &mut [f64], rates: &[f64]) {
    for (largest, rate) in largest.iter_mut().zip(rates) {
        *largest = largest.max(*rate);
    }
}
