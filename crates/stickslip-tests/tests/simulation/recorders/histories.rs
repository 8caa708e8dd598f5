//! Rows that are written and rows that are kept.

use std::io;

use stickslip::record::{FileError, PointHistories, Quantity, TraceMemory, TraceWriter, Tracing};
use stickslip::{Run, SceneError, Steps};

use crate::Outcome;
use crate::common::{STEP, Sliding, Solver, body, centre, paper_slider};

const ALL: [Quantity; 4] = [
    Quantity::Slip,
    Quantity::SlipRate,
    Quantity::State,
    Quantity::Traction,
];

fn slider() -> Outcome<(Sliding, usize)> {
    let body = body(1);
    let space = body.space()?;
    let x0 = centre(&space)?;
    Ok((paper_slider(&body, &space, Solver::Condensed, 1e-10)?, x0))
}

/// The numbers of a table, without its first line.
fn numbers(text: &[u8]) -> Outcome<Vec<Vec<f64>>> {
    let lines = std::str::from_utf8(text)?.lines().skip(1);
    let row = |line: &str| line.split(',').map(str::parse).collect::<Result<_, _>>();
    Ok(lines.map(row).collect::<Result<_, _>>()?)
}

/// Every number of every row is that of the step, bit for bit; beside a contact there is none.
#[test]
fn rows_of_points_read_back_bit_for_bit() -> Outcome {
    let (mut slider, x0) = slider()?;
    let top = slider.state().displacement.len() - 1;
    let mut points = PointHistories::new(&slider.snapshot(), &[x0, top], 7, Vec::new())?;
    let mut expected: Vec<Vec<f64>> = Vec::new();
    slider.run(&Steps::constant(STEP).count(100), |at| {
        if at.step % 7 == 0 {
            let contact = at.contact(0);
            for vertex in [x0, top] {
                let (u, v) = (at.displacement[vertex], at.velocity[vertex]);
                let mut row = vec![at.time, vertex as f64, u[0], u[1], v[0], v[1]];
                match contact.position_of(vertex) {
                    Some(k) => {
                        let traction = contact.traction(k);
                        row.extend([contact.state(k), contact.slip_rate(k)]);
                        row.extend([traction[0], traction[1]]);
                    }
                    None => row.extend([f64::NAN; 4]),
                }
                expected.push(row);
            }
        }
        points.record(&at)
    })?;
    let bits = |rows: Vec<Vec<f64>>| -> Vec<Vec<u64>> {
        let row = |row: Vec<f64>| row.into_iter().map(f64::to_bits).collect();
        rows.into_iter().map(row).collect()
    };
    assert_eq!(expected.len(), 2 * 14);
    assert_eq!(bits(numbers(&points.finish()?)?), bits(expected));
    Ok(())
}

/// The writer's rows are those in memory, along the bottom from left to right.
#[test]
fn traces_in_memory_and_on_paper_agree() -> Outcome {
    let (mut slider, _) = slider()?;
    let tracing = Tracing::of(0, &ALL).every(3);
    let mut memory = TraceMemory::new(&slider.snapshot(), tracing.clone(), 100)?;
    let mut writer = TraceWriter::new(&slider.snapshot(), tracing, Vec::new())?;
    slider.run(&Steps::constant(STEP).count(100), |at| {
        memory.record(&at);
        writer.record(&at)
    })?;
    let along: Vec<f64> = (0..=10).map(|k| 0.5 * f64::from(k)).collect();
    assert_eq!(memory.along(), along);
    assert_eq!(memory.times().len(), 34);
    let rows = numbers(&writer.finish()?)?;
    for (n, row) in rows.iter().enumerate() {
        let (step, place) = (n / along.len(), n % along.len());
        let mut kept = vec![memory.times()[step], along[place]];
        kept.extend((0..ALL.len()).map(|quantity| memory.value(step, place, quantity)));
        assert_eq!(*row, kept);
    }
    assert_eq!(rows.len(), 34 * along.len());
    Ok(())
}

/// Between two rows kept for a change the largest slip rate changes by the factor, and in no step between them.
#[test]
fn changes_of_the_slip_rate_make_rows() -> Outcome {
    let (mut slider, _) = slider()?;
    let (factor, floor) = (2.0, 1e-9);
    let tracing = Tracing::of(0, &[]).on_change(factor, floor);
    let mut memory = TraceMemory::new(&slider.snapshot(), tracing, 10_000)?;
    let mut rates = Vec::new();
    slider.run(&Steps::constant(STEP).count(6900), |at| {
        rates.push((at.time, at.max_slip_rate().max(floor)));
        memory.record(&at);
    })?;
    let mut rows = memory.times().iter().peekable();
    let mut last: Option<f64> = None;
    for (time, rate) in rates {
        let changed = last.is_none_or(|last| rate >= factor * last || factor * rate <= last);
        assert_eq!(
            rows.next_if(|row| **row == time).is_some(),
            changed,
            "{time} s"
        );
        last = if changed { Some(rate) } else { last };
    }
    assert!(rows.next().is_none() && memory.times().len() > 20);
    Ok(())
}

/// Rows in a bounded memory are evenly spaced from the first step on, and at least half of it is used.
#[test]
fn a_full_memory_drops_every_second_row() -> Outcome {
    for rows in [2, 5, 8] {
        let (mut slider, _) = slider()?;
        let mut memory = TraceMemory::new(&slider.snapshot(), Tracing::of(0, &ALL[..1]), rows)?;
        for step in 1..=100 {
            slider.run(&Steps::constant(STEP).count(1), |at| memory.record(&at))?;
            let times = memory.times();
            let steps: Vec<usize> = times.iter().map(|t| (t / STEP).round() as usize).collect();
            assert!(times.len() <= rows && (step < rows || 2 * times.len() >= rows));
            let stride = steps.get(1).map_or(1, |second| second - 1);
            let even = (0..steps.len()).map(|n| 1 + n * stride);
            assert!(
                stride.is_power_of_two() && even.eq(steps.iter().copied()),
                "{steps:?}"
            );
        }
    }
    Ok(())
}

/// A disk that is full after so many bytes.
struct Full(usize);

impl io::Write for Full {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0 = self
            .0
            .checked_sub(bytes.len())
            .ok_or(io::ErrorKind::StorageFull)?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// A row that cannot be written ends the run; vertices, contacts and settings that are none are refused.
#[test]
fn failures_say_why() -> Outcome {
    let (mut slider, x0) = slider()?;
    let mut points = PointHistories::new(&slider.snapshot(), &[x0], 1, Full(1000))?;
    let report = Run::run(&mut slider, &Steps::constant(STEP).count(100), |at| {
        points.record(&at)
    })?;
    assert!(report.accepted < 10, "{report:?}");
    let refused = points.finish().err();
    assert!(
        matches!(refused, Some(FileError::Write { path: None, .. })),
        "{refused:?}"
    );

    let at = slider.snapshot();
    let count = at.displacement.len();
    let refused = PointHistories::new(&at, &[count], 1, io::sink()).err();
    assert!(
        matches!(refused, Some(FileError::Scene(SceneError::Index { what: "vertex", index, .. })) if index == count),
        "{refused:?}"
    );
    let refused = TraceMemory::new(&at, Tracing::of(1, &ALL), 10).err();
    assert!(
        matches!(
            refused,
            Some(SceneError::Index {
                what: "contact",
                index: 1,
                count: 1
            })
        ),
        "{refused:?}"
    );
    for tracing in [
        Tracing::of(0, &ALL).every(0),
        Tracing::of(0, &ALL).on_change(1.0, 0.0),
        Tracing::of(0, &ALL).on_change(f64::NAN, 0.0),
        Tracing::of(0, &ALL).on_change(2.0, -1.0),
    ] {
        let refused = TraceWriter::new(&at, tracing, io::sink()).err();
        assert!(
            matches!(refused, Some(FileError::Scene(SceneError::Value { .. }))),
            "{refused:?}"
        );
    }
    Ok(())
}

/// Numbers of vertices, components, contacts and rows from outside of a program are refused, not a panic.
#[test]
fn an_index_out_of_range_is_an_error() -> Outcome {
    let (slider, _) = slider()?;
    let at = slider.snapshot();
    let (size, contact) = (at.velocity.len(), at.contact(0));
    let index = |what, index, count| SceneError::Index { what, index, count };
    assert_eq!(
        at.reaction_at(size).err(),
        Some(index("vertex", size, size))
    );
    let count = contact.len();
    assert_eq!(contact.check(count - 1), Ok(count - 1));
    assert_eq!(
        contact.check(count),
        Err(index("vertex of the contact", count, count))
    );
    assert_eq!(contact.position_of(size), None);
    assert!(at.contacts().nth(1).is_none());

    let mut memory = TraceMemory::new(&at, Tracing::of(0, &ALL), 2)?;
    assert_eq!(memory.get(0, 0, 0), None);
    memory.record(&at);
    assert_eq!(
        memory.get(0, count - 1, 3),
        Some(memory.value(0, count - 1, 3))
    );
    for (row, place, quantity) in [(1, 0, 0), (0, count, 0), (0, 0, 4)] {
        assert_eq!(memory.get(row, place, quantity), None);
    }
    Ok(())
}
