//! Friction of cells by depth.

use stickslip::friction::{FrictionLaw, RegularizedDieterichRuina};
use stickslip::problems::bp1;
use stickslip::state::LogTheta;

use super::super::Failed;
use super::FaultFile;
use super::layout::Layout;
use crate::table::{Format, Table};

/// The friction laws of cells, and their initial normal stress \[Pa\].
pub(super) struct Strengths {
    pub(super) laws: Vec<RegularizedDieterichRuina>,
    pub(super) normal_stress: Vec<f64>,
}

/// The columns of a table of friction, and whether it must have them.
const COLUMNS: [(&str, bool); 5] = [
    ("depth", true),
    ("a", true),
    ("b", true),
    ("slip_distance", false),
    ("normal_stress", false),
];

impl Strengths {
    /// Those of a table by depth, linear between its rows; without one those of BP1 by the distance down dip, or by depth.
    pub(super) fn new(settings: &FaultFile, cells: &Layout) -> Result<Self, Failed> {
        let Some(path) = &settings.friction else {
            let laws = cells
                .downward
                .iter()
                .map(|&distance| bp1::friction(distance));
            return Ok(Self {
                laws: laws.collect(),
                normal_stress: vec![bp1::NORMAL_STRESS; cells.count()],
            });
        };
        let table = Table::read(path, &Format::default())?;
        let rows = rows(&table)?;
        let mut own = Self {
            laws: Vec::new(),
            normal_stress: Vec::new(),
        };
        for cell in 0..cells.count() {
            let depth = -cells.centers[cell][2];
            let Some([_, a, b, slip_distance, normal_stress]) = at(&rows, depth) else {
                return Err(format!(
                    "{}: cell {cell} is at a depth of {depth} m, the table reaches from {} m to {} m; add a row",
                    table.file(),
                    rows.first().map_or(f64::NAN, |row| row[0]),
                    rows.last().map_or(f64::NAN, |row| row[0]),
                )
                .into());
            };
            own.laws.push(RegularizedDieterichRuina {
                a,
                b,
                slip_distance,
                ..bp1::friction(0.0)
            });
            own.normal_stress.push(normal_stress);
        }
        Ok(own)
    }

    /// The least ratio of shear to normal stress in steady sliding at a slip rate [m/s]: no cell starts above its own.
    pub(super) fn steady_ratio(&self, rate: f64) -> f64 {
        let steady = self.laws.iter().map(|law| {
            let state = LogTheta((law.slip_distance / rate).ln());
            law.coefficient(rate, state)
        });
        steady.fold(f64::INFINITY, f64::min)
    }
}

/// The rows of a table, in the order of [`COLUMNS`], by depth.
fn rows(table: &Table) -> Result<Vec<[f64; 5]>, Failed> {
    let known: Vec<&str> = (COLUMNS.iter())
        .filter(|(name, must)| *must || table.has(name))
        .map(|(name, _)| *name)
        .collect();
    let columns = table.columns(&known)?;
    let refuse = |line: usize, problem: String| -> Failed {
        format!("{}, line {line}: {problem}", table.file()).into()
    };
    if columns.dropped > 0 {
        return Err(format!(
            "{}: {} rows have an empty cell in one of the columns {}; fill them, or remove these rows",
            table.file(),
            columns.dropped,
            known.join(", ")
        )
        .into());
    }
    let usual = [
        f64::NAN,
        f64::NAN,
        f64::NAN,
        bp1::AGING.slip_distance,
        bp1::NORMAL_STRESS,
    ];
    let mut rows: Vec<[f64; 5]> = Vec::new();
    for (row, &line) in table.lines().iter().enumerate() {
        let mut values = usual;
        for (value, (name, _)) in values.iter_mut().zip(COLUMNS) {
            if let Some(place) = known.iter().position(|known| *known == name) {
                *value = columns.values[place][row];
            }
        }
        let [depth, a, b, slip_distance, normal_stress] = values;
        for (name, value, legal) in [
            ("depth", depth, depth >= 0.0),
            ("a", a, a > 0.0),
            ("b", b, b > 0.0),
            ("slip_distance", slip_distance, slip_distance > 0.0),
            ("normal_stress", normal_stress, normal_stress > 0.0),
        ] {
            if !(legal && value.is_finite()) {
                return Err(refuse(
                    line,
                    format!("{name} is {value}, must be above 0 and finite"),
                ));
            }
        }
        if let Some(before) = rows.last().filter(|before| before[0] >= depth) {
            let problem = format!(
                "depth {depth} m is not below {} m; sort the rows",
                before[0]
            );
            return Err(refuse(line, problem));
        }
        rows.push(values);
    }
    Ok(rows)
}

/// The values at a depth, linear between rows; none outside.
fn at(rows: &[[f64; 5]], depth: f64) -> Option<[f64; 5]> {
    let next = rows.partition_point(|row| row[0] < depth);
    let (end, begin) = (rows.get(next)?, rows.get(next.saturating_sub(1))?);
    if end[0] == depth || next == 0 {
        return (end[0] == depth).then_some(*end);
    }
    let share = (depth - begin[0]) / (end[0] - begin[0]);
    Some(std::array::from_fn(|k| {
        begin[k] + share * (end[k] - begin[k])
    }))
}

#[cfg(test)]
mod tests {
    use super::at;

    #[test]
    fn friction_is_linear_between_rows() {
        let rows = [0.0, 2.0, 6.0].map(|depth| [depth, 3.0 * depth, 1.0, 2.0, -depth]);
        for depth in [0.0, 0.5, 2.0, 5.0, 6.0] {
            assert_eq!(
                at(&rows, depth),
                Some([depth, 3.0 * depth, 1.0, 2.0, -depth])
            );
        }
        assert_eq!([at(&rows, -1.0), at(&rows, 6.1), at(&[], 0.0)], [None; 3]);
    }
}
