//! Files of what no simulation has as a whole.

use stickslip::Checkpoint;
use stickslip::record::FileError;

use super::{Place, block, moved, refusal};
use crate::Outcome;

#[test]
fn what_was_gathered_comes_back_under_its_tags_alone() -> Outcome {
    let place = Place::new("gathered")?;
    let file = Checkpoint::at(place.file("file")).tagged("law", "aging");
    let contents = (vec![0.1, -0.0, f64::MIN_POSITIVE], "records".to_string());
    file.save_gathered(1.5, &contents)?;
    let (numbers, records): (Vec<f64>, String) = file.restore_gathered()?;
    let bits = |numbers: &[f64]| numbers.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
    assert_eq!((bits(&numbers), records), (bits(&contents.0), contents.1));
    for other in [
        Checkpoint::at(file.path()).tagged("law", "slip"),
        Checkpoint::at(file.path()),
        file.clone().tagged("vertices", 3),
    ] {
        let refused = other.restore_gathered::<(Vec<f64>, String)>().err();
        assert!(
            matches!(
                refused,
                Some(FileError::Mismatch {
                    kind: "checkpoint",
                    ..
                })
            ),
            "{refused:?}"
        );
    }
    let refused = file.restore_gathered::<Vec<f64>>().err();
    assert!(
        matches!(
            refused,
            Some(FileError::Contents {
                what: "the records asked for",
                source: Some(_),
                ..
            })
        ),
        "{refused:?}"
    );
    Ok(())
}

/// A simulation goes on from no file that was gathered, and the other way round.
#[test]
fn a_scene_and_what_was_gathered_refuse_each_other() -> Outcome {
    let place = Place::new("gathered")?;
    let file = Checkpoint::at(place.file("file")).tagged("law", "aging");
    file.save_gathered(0.3, &())?;
    let mut block = block()?;
    let error = refusal(file.restore::<(), 1>(&mut block), &block)?;
    assert!(
        matches!(
            error,
            FileError::Mismatch {
                kind: "checkpoint",
                ..
            }
        ),
        "{error}"
    );
    file.save(&moved()?.snapshot(), &())?;
    let error = refusal(file.restore_gathered::<()>(), &block)?;
    assert!(
        matches!(
            error,
            FileError::Mismatch {
                kind: "checkpoint",
                ..
            }
        ),
        "{error}"
    );
    Ok(())
}
