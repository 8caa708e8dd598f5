//! Checkpoint files: what is damaged or foreign is refused, what goes on is the same bits.

mod damage;
mod foreign;
mod gathered;
mod restart;

use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

use stickslip::problems::spring_slider::{AGING, FRICTION, LoadPath, SpringSlider};
use stickslip::record::FileError;
use stickslip::{Newmark, Point, Simulation, Steps};

use crate::Outcome;

type Block = Simulation<1>;

/// A folder of a test of its own, removed with all that is in it.
pub(crate) struct Place(PathBuf);

impl Place {
    pub(crate) fn new(name: &str) -> Outcome<Self> {
        static COUNT: AtomicUsize = AtomicUsize::new(0);
        let (process, number) = (std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
        let name = format!("stickslip-{name}-{process}-{number}");
        let folder = std::env::temp_dir().join(name);
        std::fs::create_dir_all(&folder)?;
        Ok(Self(folder))
    }

    pub(crate) fn file(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn slider() -> SpringSlider {
    SpringSlider {
        stiffness: 1e9,
        normal_stress: 1e6,
        mass: 5e3,
        damping: 0.0,
        load: LoadPath::steady(1e-6).then(10.0, 1e-5),
    }
}

fn block() -> Outcome<Block> {
    let scene = slider().steady(FRICTION, AGING, 1e-6)?;
    Ok(Simulation::new(scene, Newmark::default(), Point)?)
}

/// The block some steps later.
fn moved() -> Outcome<Block> {
    let mut block = block()?;
    block.run(&Steps::constant(0.1).count(3), |_| ())?;
    Ok(block)
}

/// Why a checkpoint was refused; what refuses it leaves the block alone and says so in one line.
fn refusal<T>(result: Result<T, FileError>, block: &Block) -> Outcome<FileError> {
    let error = result.err().ok_or("accepted")?;
    assert!(!error.to_string().contains('\n'), "{error}");
    assert_eq!(block.snapshot().step, 0);
    Ok(error)
}
