//! Arrays of NumPy.

use stickslip::Steps;
use stickslip::record::{FileError, NpyArray, Quantity, TraceMemory, Tracing};

use super::{Folder, YEAR, bp1_cycle};
use crate::Outcome;

/// The bytes of a file by the description of the format.
fn bytes(header: &str, values: &[f64]) -> Vec<u8> {
    let mut file = b"\x93NUMPY\x01\x00".to_vec();
    file.extend(
        u16::try_from(header.len())
            .unwrap_or_default()
            .to_le_bytes(),
    );
    file.extend(header.as_bytes());
    file.extend(values.iter().flat_map(|value| value.to_le_bytes()));
    file
}

#[test]
fn a_trace_reads_back_bit_for_bit() -> Outcome {
    let folder = Folder::new("npy")?;
    let mut cycle = bp1_cycle(1e3)?;
    let quantities = [Quantity::Slip, Quantity::SlipRate];
    let mut trace = TraceMemory::new(&cycle.snapshot(), Tracing::of(0, &quantities), 32)?;
    cycle.run(&Steps::adaptive(1e-4).until(20.0 * YEAR), |at| {
        trace.record(&at)
    })?;
    let [values, times] = ["slip.npy", "times.npy"].map(|name| folder.join(name));
    trace.save_npy(&values)?;
    NpyArray::from(trace.times()).save(&times)?;
    let (read, times) = (NpyArray::read(values)?, NpyArray::read(times)?);
    assert_eq!(
        (times.shape(), times.values()),
        (&[trace.times().len()][..], trace.times())
    );
    assert_eq!(read.shape(), [trace.times().len(), 40, 2]);
    for row in 0..trace.times().len() {
        for place in 0..40 {
            for quantity in 0..2 {
                let index = (row * 40 + place) * 2 + quantity;
                assert_eq!(read.values()[index], trace.value(row, place, quantity));
            }
        }
    }
    Ok(())
}

/// Magic number, version 1.0, a header that ends with a line end at a multiple of 64 bytes.
#[test]
fn files_are_those_of_the_format() -> Outcome {
    let folder = Folder::new("bytes")?;
    let path = folder.join("a.npy");
    NpyArray::new(&[2, 1], vec![1.5, -0.0])?.save(&path)?;
    let found = std::fs::read(&path)?;
    let dictionary = "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 1,), }";
    let header = format!("{dictionary:117}\n");
    assert_eq!(found, bytes(&header, &[1.5, -0.0]));
    assert_eq!(found.len() % 64, 16);
    Ok(())
}

#[test]
fn other_files_are_refused() -> Outcome {
    let folder = Folder::new("refused")?;
    let path = folder.join("a.npy");
    let header = "{'descr': '<f8', 'fortran_order': False, 'shape': (3,), }\n";
    let good = bytes(header, &[1.0, 2.0, 3.0]);
    std::fs::write(&path, &good)?;
    assert_eq!(NpyArray::read(&path)?.values(), [1.0, 2.0, 3.0]);
    // A number without axes.
    std::fs::write(&path, bytes(&header.replace("(3,)", "()"), &[7.0]))?;
    let read = NpyArray::read(&path)?;
    assert_eq!((read.shape(), read.values()), (&[][..], &[7.0][..]));
    for (from, to) in [
        ("<f8", "<f4"),
        ("<f8", ">f8"),
        ("False", "True"),
        ("(3,)", "(3,-1)"),
        ("shape", "form"),
    ] {
        std::fs::write(&path, bytes(&header.replace(from, to), &[1.0, 2.0, 3.0]))?;
        assert!(
            matches!(NpyArray::read(&path), Err(FileError::Kind { .. })),
            "{to}"
        );
    }
    for length in [0, 5, 9, 40, good.len() - 1] {
        std::fs::write(&path, &good[..length])?;
        assert!(NpyArray::read(&path).is_err(), "{length}");
    }
    assert!(NpyArray::new(&[2, 2], vec![0.0; 3]).is_err());
    assert!(NpyArray::new(&[usize::MAX, 2], vec![0.0; 3]).is_err());
    let missing = folder.join("none").join("a.npy");
    assert!(matches!(
        NpyArray::from(&[1.0][..]).save(missing),
        Err(FileError::Write { .. })
    ));
    Ok(())
}
