//! Passes over all cells, compiled for the widest registers of the processor.

use super::block::{Block, CELLS, Fields, Numbers, Shared};

/// The most blocks of one task, some 12 microseconds of work: a call within the threads takes about one. And the most
/// that are not worth a call of the threads from outside of them, which takes some 80 microseconds.
#[cfg(feature = "rayon")]
const BLOCKS: [usize; 2] = [16, 256];

/// One or two components of the traction, and everything that a pass reads and writes, one number per cell.
pub(super) struct Pass<'a, const C: usize> {
    pub(super) blocks: &'a [Block],
    pub(super) shared: Shared,
    pub(super) shear_stress: [&'a [f64]; C],
    pub(super) normal_stress: &'a [f64],
    pub(super) state: &'a [f64],
    pub(super) slip_rate: [&'a mut [f64]; C],
    pub(super) state_rate: &'a mut [f64],
    pub(super) is_slip_law: bool,
}

impl<const C: usize> Pass<'_, C> {
    /// With the widest registers, if the feature `simd` is on, in threads, if `rayon` is. Bits depend on neither: no
    /// operation is fused, and cells are independent.
    pub(super) fn run(self) {
        #[cfg(feature = "rayon")]
        {
            let inside = rayon::current_thread_index().is_some();
            let least = BLOCKS[usize::from(!inside)];
            if self.blocks.len() > least && rayon::current_num_threads() > 1 {
                self.run_in_threads();
                return;
            }
        }
        self.run_in_one();
    }

    #[cfg(feature = "rayon")]
    pub(super) fn run_in_threads(self) {
        if self.blocks.len() <= BLOCKS[0] {
            self.run_in_one();
            return;
        }
        let [first, second] = self.halves();
        rayon::join(|| first.run_in_threads(), || second.run_in_threads());
    }

    fn run_in_one(self) {
        #[cfg(feature = "simd")]
        pulp::Arch::new().dispatch(self);
        #[cfg(not(feature = "simd"))]
        self.run_as_compiled();
    }

    #[cfg(feature = "rayon")]
    fn halves(self) -> [Self; 2] {
        let middle = self.blocks.len() / 2;
        let at = middle * CELLS;
        let (blocks, other_blocks) = self.blocks.split_at(middle);
        let (normal_stress, other_normal_stress) = self.normal_stress.split_at(at);
        let (state, other_state) = self.state.split_at(at);
        let (state_rate, other_state_rate) = self.state_rate.split_at_mut(at);
        let mut other_slip_rate = [const { None }; C];
        let mut others = other_slip_rate.iter_mut();
        let slip_rate = self.slip_rate.map(|rates| {
            let (own, other) = rates.split_at_mut(at);
            if let Some(place) = others.next() {
                *place = Some(other);
            }
            own
        });
        let first = Self {
            blocks,
            shear_stress: self.shear_stress.map(|stress| &stress[..at]),
            normal_stress,
            state,
            slip_rate,
            state_rate,
            ..self
        };
        let second = Self {
            blocks: other_blocks,
            shear_stress: self.shear_stress.map(|stress| &stress[at..]),
            normal_stress: other_normal_stress,
            state: other_state,
            slip_rate: other_slip_rate.map(Option::unwrap_or_default),
            state_rate: other_state_rate,
            ..self
        };
        [first, second]
    }

    /// With the instructions of the calling function.
    #[inline(always)]
    pub(super) fn run_as_compiled(self) {
        if self.is_slip_law {
            self.all::<true>();
        } else {
            self.all::<false>();
        }
    }

    #[inline(always)]
    fn all<const SLIP_LAW: bool>(self) {
        let mut fields = Fields {
            shear: [0.0; CELLS],
            normal: [0.0; CELLS],
            state: [0.0; CELLS],
        };
        let mut shear = [[0.0; CELLS]; C];
        let (mut slip_rate, mut state_rate) = ([0.0; CELLS], [0.0; CELLS]);
        for (index, block) in self.blocks.iter().enumerate() {
            let begin = index * CELLS;
            let end = self.state.len().min(begin + CELLS);
            let count = end - begin;
            for c in 0..C {
                shear[c][..count].copy_from_slice(&self.shear_stress[c][begin..end]);
            }
            fields.normal[..count].copy_from_slice(&self.normal_stress[begin..end]);
            fields.state[..count].copy_from_slice(&self.state[begin..end]);
            fields.shear = modulus(&shear);
            block.rates::<SLIP_LAW>(self.shared, &fields, &mut slip_rate, &mut state_rate);
            for c in 0..C {
                let along = along::<C>(&slip_rate, &shear[c], &fields.shear);
                self.slip_rate[c][begin..end].copy_from_slice(&along[..count]);
            }
            self.state_rate[begin..end].copy_from_slice(&state_rate[..count]);
        }
    }
}

#[inline(always)]
fn modulus<const C: usize>(shear: &[Numbers; C]) -> Numbers {
    let mut moduli = [0.0; CELLS];
    for i in 0..CELLS {
        if C == 1 {
            moduli[i] = shear[0][i].abs();
        } else {
            let mut square = 0.0;
            for component in shear {
                square += component[i] * component[i];
            }
            moduli[i] = square.sqrt();
        }
    }
    moduli
}

/// The component of the rate along the traction. Without a traction there is no rate.
#[inline(always)]
fn along<const C: usize>(rate: &Numbers, component: &Numbers, modulus: &Numbers) -> Numbers {
    let mut along = [0.0; CELLS];
    for i in 0..CELLS {
        if C == 1 {
            along[i] = rate[i].copysign(component[i]);
        } else {
            let cosine = component[i] / modulus[i];
            let cosine = if modulus[i] == 0.0 { 0.0 } else { cosine };
            along[i] = rate[i] * cosine;
        }
    }
    along
}

#[cfg(feature = "simd")]
impl<const C: usize> pulp::WithSimd for Pass<'_, C> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        self.run_as_compiled();
    }
}
