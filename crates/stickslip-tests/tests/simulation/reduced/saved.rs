//! Files of reduced bodies: what is read is what was written, or refused.

use std::fs;
use std::path::PathBuf;

use stickslip::problems::pipping_slider::PippingSlider;
use stickslip::record::FileError;
use stickslip::reduced::{Reduced, ReducedBody};
use stickslip::{Components, DenseNewton, Newmark, Simulation, Steps};

use super::{Block, gravity, slider};
use crate::Outcome;
use crate::common::{STEP, bits, body};

/// A file that goes with the test.
struct Place(PathBuf);

impl Place {
    fn new(name: &str) -> Self {
        let name = format!("stickslip-reduced-{name}-{}", std::process::id());
        Self(std::env::temp_dir().join(name))
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        // Nothing is left to do if it is not there.
        let _ = fs::remove_file(&self.0);
    }
}

#[test]
fn a_body_from_a_file_moves_as_the_one_that_was_saved() -> Outcome {
    let paper = body(2);
    let space = paper.space()?;
    let place = Place::new("same");
    let made = Reduced::new(&slider(&paper, &space)?).up_to_frequency(100.0)?;
    made.save(&place.0)?;
    let read = ReducedBody::load(&place.0, &slider(&paper, &space)?)?;
    assert!(made.frequencies().eq(read.frequencies()));
    assert_eq!(made.first_left_out(), read.first_left_out());
    let mut runs = Vec::new();
    for body in [&made, &read] {
        let scene = body.reduce(slider(&paper, &space)?)?;
        let mut run = Simulation::new(scene, Newmark::default(), DenseNewton::new())?;
        run.run(&Steps::constant(10.0 * STEP).count(700), |_| ())?;
        let whole = body.displacement_under(&gravity(&paper, &space), &run.snapshot())?;
        runs.push((bits(&run.snapshot()), whole, body.left_out(10.0)?));
    }
    assert!(runs[0] == runs[1], "other bits");
    Ok(())
}

/// Loads, starts and viscosities of all kinds, and a body without inertia.
#[test]
fn what_is_read_writes_the_same_file() -> Outcome {
    let block = Block::new(1)?;
    let inertia = block.with_inertia()?;
    let space = &block.space;
    let (bottom, side) = (space.trace(|x| x[1] == 0.0)?, space.trace(|x| x[0] == 2.0)?);
    let stiffness = stickslip::fem::elasticity(space, &body(1).elastic)?;
    let law = stickslip::friction::Tresca { coefficient: 0.5 };
    let quasi_static = stickslip::Scene::new(stiffness)
        .with_contact(stickslip::Contact::new(&bottom, law, 1e4))
        .prescribe_velocity(&side, Components::ALL, |_| [1e-3, 0.0]);
    for (name, scene) in [("inertia", inertia), ("quasi-static", quasi_static)] {
        let (one, other) = (
            Place::new(&format!("{name}-1")),
            Place::new(&format!("{name}-2")),
        );
        Reduced::new(&scene)
            .with_vertices([5])
            .up_to_frequency(f64::INFINITY)?
            .save(&one.0)?;
        ReducedBody::load(&one.0, &scene)?.save(&other.0)?;
        assert!(
            fs::read(&one.0)? == fs::read(&other.0)?,
            "{name}: other bytes"
        );
    }
    Ok(())
}

#[test]
fn other_bodies_are_refused() -> Outcome {
    let paper = body(2);
    let space = paper.space()?;
    let place = Place::new("other");
    Reduced::new(&slider(&paper, &space)?)
        .up_to_frequency(100.0)?
        .save(&place.0)?;
    let mirrored = PippingSlider {
        mirrored: true,
        ..paper
    };
    let heavier = PippingSlider {
        density: 1.1 * paper.density,
        ..paper
    };
    let side = space.trace(|x| x[0] == 0.0 && x[1] > 0.0 && x[1] < 1.0)?;
    for (what, scene) in [
        (
            "the number of vertices",
            slider(&body(1), &body(1).space()?)?,
        ),
        ("the mesh", slider(&mirrored, &mirrored.space()?)?),
        ("the set of operators", slider(&heavier, &space)?),
        (
            "the set of prescribed components",
            slider(&paper, &space)?.fix(&side, Components::X),
        ),
        ("the set of prescribed components", paper.scene(&space)?),
    ] {
        let error = ReducedBody::load(&place.0, &scene).err();
        let Some(FileError::Mismatch {
            kind: "reduced body",
            what: found,
            ..
        }) = error
        else {
            return Err(format!("{what}: {error:?}").into());
        };
        assert_eq!(found, what);
    }
    Ok(())
}

/// Bytes changed all over the file, each of its header, and files that end there.
#[test]
fn damaged_files_are_refused() -> Outcome {
    let block = Block::new(0)?;
    let scene = block.with_inertia()?;
    let (place, damaged) = (Place::new("whole"), Place::new("damaged"));
    Reduced::new(&scene)
        .up_to_frequency(f64::INFINITY)?
        .save(&place.0)?;
    let whole = fs::read(&place.0)?;
    assert!(whole.len() > 500);
    let refusal = |bytes: &[u8]| -> Outcome<FileError> {
        fs::write(&damaged.0, bytes)?;
        Ok(ReducedBody::load(&damaged.0, &scene).err().ok_or("taken")?)
    };
    for place in (0..28).chain((28..whole.len()).step_by(29)) {
        let mut changed = whole.clone();
        changed[place] ^= 0x10;
        let error = refusal(&changed)?;
        let as_expected = match place {
            0..8 => matches!(
                error,
                FileError::Kind {
                    kind: "reduced body",
                    ..
                }
            ),
            8..12 => matches!(
                error,
                FileError::Version {
                    kind: "reduced body",
                    ..
                }
            ),
            _ => matches!(error, FileError::Damaged { .. }),
        };
        assert!(as_expected, "byte {place}: {error}");
    }
    for length in (0..28).chain((28..whole.len()).step_by(29)) {
        let error = refusal(&whole[..length])?;
        let as_expected = match length {
            0..8 => matches!(
                error,
                FileError::Kind {
                    kind: "reduced body",
                    ..
                }
            ),
            _ => matches!(error, FileError::Damaged { .. }),
        };
        assert!(as_expected, "{length} bytes: {error}");
    }
    let error = refusal(&[&whole[..], b"\0"].concat())?;
    assert!(matches!(error, FileError::Damaged { .. }), "{error}");
    let none = ReducedBody::load(place.0.with_extension("none"), &scene).err();
    assert!(matches!(none, Some(FileError::Read { .. })), "{none:?}");
    Ok(())
}

/// The checksum of everything but itself, as whoever forges a file writes it.
fn signed(whole: &[u8]) -> Vec<u8> {
    const BEGIN: usize = 12;
    let mut hash = xxhash_rust::xxh3::Xxh3Default::new();
    hash.update(&whole[..BEGIN]);
    hash.update(&whole[BEGIN + 16..]);
    let sum = hash.digest128().to_le_bytes();
    [&whole[..BEGIN], &sum, &whole[BEGIN + 16..]].concat()
}

/// Contents that are none, with the right checksum: no panic, and no memory on trust.
#[test]
fn forged_files_are_refused() -> Outcome {
    let block = Block::new(0)?;
    let scene = block.with_inertia()?;
    let (place, forged) = (Place::new("true"), Place::new("forged"));
    Reduced::new(&scene)
        .up_to_frequency(f64::INFINITY)?
        .save(&place.0)?;
    let whole = fs::read(&place.0)?;
    assert!(signed(&whole) == whole);
    let mut numbers_changed = 0;
    for place in (28..whole.len()).step_by(11) {
        for value in [0x00, 0xff] {
            let mut changed = whole.clone();
            changed[place] = value;
            fs::write(&forged.0, signed(&changed))?;
            let mut result = None;
            let memory = allocation_counter::measure(|| {
                result = Some(ReducedBody::load(&forged.0, &scene));
            });
            // What a deserialiser of sequences takes on trust, a megabyte, and a body of some kilobytes.
            assert!(memory.bytes_max < 4 << 20, "byte {place}: {memory:?}");
            match result.ok_or("not run")? {
                Ok(_) => numbers_changed += 1,
                Err(error) => assert!(
                    matches!(
                        error,
                        FileError::Contents {
                            what: "a reduced body",
                            ..
                        } | FileError::Mismatch {
                            kind: "reduced body",
                            ..
                        } | FileError::Scene(_)
                    ),
                    "byte {place}: {error}"
                ),
            }
        }
    }
    // Numbers alone may be others.
    assert!(numbers_changed > 0);
    Ok(())
}
