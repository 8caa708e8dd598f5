//! Bits that flip, files that end too early, numbers that are none.

use std::fs::{self, File};
use std::io::{Seek, SeekFrom, Write};

use stickslip::Checkpoint;
use stickslip::record::FileError;

use super::{Place, block, moved, refusal};
use crate::Outcome;

/// Every bit of a file in turn, and every place at which it may be cut.
#[test]
fn flipped_bits_and_cut_files_are_refused() -> Outcome {
    let place = Place::new("damage")?;
    let file = Checkpoint::at(place.file("whole")).tagged("law", "aging");
    file.save(&moved()?.snapshot(), &[1.0, 2.0])?;
    let whole = fs::read(file.path())?;
    let mut block = block()?;
    let damaged = Checkpoint::at(place.file("damaged")).tagged("law", "aging");

    fs::write(damaged.path(), &whole)?;
    let mut bytes = File::options().write(true).open(damaged.path())?;
    assert!(8 * whole.len() >= 1000);
    for bit in 0..8 * whole.len() {
        let (at, byte) = (bit / 8, whole[bit / 8]);
        for (written, flipped) in [(byte ^ (1 << (bit % 8)), true), (byte, false)] {
            bytes.seek(SeekFrom::Start(at as u64))?;
            bytes.write_all(&[written])?;
            if !flipped {
                continue;
            }
            let result = damaged.restore::<[f64; 2], 1>(&mut block);
            let error = refusal(result, &block)?;
            let as_expected = match at {
                0..8 => matches!(
                    error,
                    FileError::Kind {
                        kind: "checkpoint",
                        ..
                    }
                ),
                8..12 => matches!(
                    error,
                    FileError::Version {
                        kind: "checkpoint",
                        ..
                    }
                ),
                _ => matches!(error, FileError::Damaged { .. }),
            };
            assert!(as_expected, "bit {bit}: {error}");
        }
    }
    for length in (0..whole.len()).rev() {
        bytes.set_len(length as u64)?;
        let result = damaged.restore::<[f64; 2], 1>(&mut block);
        let error = refusal(result, &block)?;
        let as_expected = if length < 8 {
            matches!(
                error,
                FileError::Kind {
                    kind: "checkpoint",
                    ..
                }
            )
        } else {
            matches!(error, FileError::Damaged { .. })
        };
        assert!(as_expected, "{length} bytes: {error}");
    }
    let longer = [&whole[..], b"\0"].concat();
    fs::write(damaged.path(), longer)?;
    let error = refusal(damaged.restore::<[f64; 2], 1>(&mut block), &block)?;
    assert!(matches!(error, FileError::Damaged { .. }), "{error}");
    Ok(())
}

/// Records of another type are refused; where their first number is taken for a length, no such memory is taken.
#[test]
fn other_records_are_refused_without_memory_for_them() -> Outcome {
    let place = Place::new("records")?;
    let file = Checkpoint::at(place.file("file"));
    let mut block = block()?;
    file.save(&moved()?.snapshot(), &(u64::MAX, 1.0))?;
    let mut result = Ok(Vec::<f64>::new());
    let memory = allocation_counter::measure(|| result = file.restore(&mut block));
    // What a deserialiser of sequences takes on trust, a megabyte, beside the few kilobytes of the file.
    assert!(memory.bytes_max < 2 << 20, "{memory:?}");
    let error = refusal(result, &block)?;
    assert!(
        matches!(
            error,
            FileError::Contents {
                what: "the records asked for",
                source: Some(_),
                ..
            }
        ),
        "{error:?}"
    );
    // Fewer numbers than there are.
    let error = refusal(file.restore::<u64, 1>(&mut block), &block)?;
    assert!(
        matches!(
            error,
            FileError::Contents {
                what: "the records asked for",
                source: Some(_),
                ..
            }
        ),
        "{error:?}"
    );
    Ok(())
}

/// Every kind of number comes back bit for bit, payloads of what is not a number included.
#[test]
fn numbers_come_back_bit_for_bit() -> Outcome {
    let place = Place::new("numbers")?;
    let file = Checkpoint::at(place.file("file"));
    let mut numbers: Vec<u64> = [
        0.0,
        -0.0,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::NAN,
        -f64::NAN,
        f64::MIN_POSITIVE,
        f64::from_bits(1),
        f64::MAX,
    ]
    .map(f64::to_bits)
    .into();
    numbers.extend([0x7ff8_dead_beef_0001, 0xfff8_0000_0000_0042]);
    // Any bits: multiples of an odd number reach all of them.
    numbers.extend((0..10_000_u64).map(|k| k.wrapping_mul(0x9e37_79b9_7f4a_7c15)));
    let values: Vec<f64> = numbers.iter().copied().map(f64::from_bits).collect();
    let before = moved()?;
    file.save(&before.snapshot(), &values)?;
    let mut after = block()?;
    let back: Vec<f64> = file.restore(&mut after)?;
    assert!(back.iter().map(|x| x.to_bits()).eq(numbers));
    // The state: it leads to the same file.
    let again = Checkpoint::at(place.file("again"));
    again.save(&after.snapshot(), &values)?;
    assert_eq!(fs::read(file.path())?, fs::read(again.path())?);
    Ok(())
}
