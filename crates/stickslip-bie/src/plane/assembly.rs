//! The matrices of a plane in a half space, from the stresses of its corners.

use super::Rectangles;
use super::dislocation::Rock;
use super::layers::Layers;
use super::okada;
use super::whole_space::WholeSpace;

/// The stress components of a block, per unit slip.
pub(crate) struct Weights {
    pub(crate) components: [usize; 2],
    pub(crate) odd: bool,
    /// The stress components of slip along strike and up dip: shares of shear along strike, of shear up dip and of tension.
    pub(crate) image: [[f64; 3]; 2],
    /// The stress components of the block in a whole space.
    whole: [f64; 3],
}

impl Weights {
    pub(crate) fn is_zero(&self) -> bool {
        self.image
            .as_flattened()
            .iter()
            .all(|&weight| weight == 0.0)
    }

    /// The share of what the free surface adds at the image of a corner and the height `z`.
    pub(crate) fn of_image(&self, rock: &Rock, corner: [f64; 3], z: f64) -> f64 {
        let tractions = okada::image(&rock.dip, corner, false, z).map(|of| rock.traction(&of));
        self.of_tractions(&tractions)
    }

    fn of_tractions(&self, tractions: &[[f64; 3]; 2]) -> f64 {
        let terms = tractions.as_flattened().iter();
        let terms = terms.zip(self.image.as_flattened());
        terms.map(|(traction, weight)| traction * weight).sum()
    }
}

/// The forces on cells per slip.
pub(crate) fn shear<const C: usize>(
    cells: &Rectangles,
    rock: &Rock,
    space: &WholeSpace,
    directions: &[[f64; 2]; C],
) -> Layers {
    assemble(cells, rock, space, shear_weights(space.area(), directions))
}

/// The blocks of the forces on cells of this area.
pub(crate) fn shear_weights<const C: usize>(area: f64, directions: &[[f64; 2]; C]) -> Vec<Weights> {
    let mut weights = Vec::new();
    for (a, &[a0, a1]) in directions.iter().enumerate() {
        for (b, &[b0, b1]) in directions.iter().enumerate() {
            weights.push(Weights {
                components: [a, b],
                odd: false,
                image: [[-area * a0 * b0, 0.0, 0.0], [0.0, -area * a1 * b1, 0.0]],
                whole: [a0 * b0, a1 * b1, 0.0],
            });
            weights.push(Weights {
                components: [a, b],
                odd: true,
                image: [[0.0, -area * a1 * b0, 0.0], [-area * a0 * b1, 0.0, 0.0]],
                whole: [0.0, 0.0, a0 * b1 + a1 * b0],
            });
        }
    }
    weights
}

/// The compression at cells per slip.
pub(crate) fn normal<const C: usize>(
    cells: &Rectangles,
    rock: &Rock,
    space: &WholeSpace,
    directions: &[[f64; 2]; C],
) -> Layers {
    let mut weights = Vec::new();
    for (b, &[strike, dip]) in directions.iter().enumerate() {
        for (odd, image) in [
            (false, [[0.0; 3], [0.0, 0.0, -dip]]),
            (true, [[0.0, 0.0, -strike], [0.0; 3]]),
        ] {
            weights.push(Weights {
                components: [0, b],
                odd,
                image,
                whole: [0.0; 3],
            });
        }
    }
    assemble(cells, rock, space, weights)
}

/// Neighbours share their corners: one evaluation per corner and receiving row.
fn assemble(
    cells: &Rectangles,
    rock: &Rock,
    space: &WholeSpace,
    mut weights: Vec<Weights>,
) -> Layers {
    let (columns, rows) = (cells.along_strike().count(), cells.down_dip().count());
    let mut layers = Layers::new(columns, rows);
    weights.retain(|of| !of.is_zero());
    let blocks = weights.iter().map(|of| layers.block(of.components, of.odd));
    let mut blocks: Vec<_> = blocks.collect();
    let mut memory = layers.row_memory();
    let mut corners = vec![vec![0.0; (rows + 1) * (columns + 1)]; weights.len()];
    let mut entries = vec![0.0; columns];
    for receiver in 0..rows {
        set_corners(cells, rock, &weights, receiver, &mut corners);
        for source in 0..rows {
            for ((block, of), corners) in blocks.iter_mut().zip(&weights).zip(&corners) {
                let upper = &corners[source * (columns + 1)..][..columns + 1];
                let lower = &corners[(source + 1) * (columns + 1)..][..columns + 1];
                for (apart, entry) in entries.iter_mut().enumerate() {
                    *entry = (lower[apart + 1] - upper[apart + 1]) - (lower[apart] - upper[apart]);
                }
                let modes = layers.modes_of(&entries, of.odd, &mut memory);
                for (mode, value) in modes.enumerate() {
                    block.images.set(mode, receiver, source, value);
                }
            }
        }
    }
    for (block, of) in blocks.iter_mut().zip(&weights) {
        block.differences = differences(space, of, [columns, rows], &layers);
    }
    layers.finish(blocks);
    layers
}

/// The modes of the part of a whole space, by difference of rows from the least on; none if it is zero.
fn differences(
    space: &WholeSpace,
    of: &Weights,
    [columns, rows]: [usize; 2],
    layers: &Layers,
) -> Vec<f64> {
    if of.whole.iter().all(|&weight| weight == 0.0) {
        return Vec::new();
    }
    let correction = space.cross_correction();
    let mut memory = layers.row_memory();
    let mut differences = vec![0.0; memory.modes.len() * (2 * rows - 1)];
    let mut entries = vec![0.0; columns];
    for place in 0..2 * rows - 1 {
        let down = place as isize - (rows as isize - 1);
        for (apart, entry) in entries.iter_mut().enumerate() {
            let mut block = space.cells_apart([apart as isize, down]);
            if apart == 1 && down.abs() == 1 {
                block[2] += down as f64 * correction;
            }
            let whole = block.iter().zip(&of.whole);
            *entry = whole.map(|(value, weight)| value * weight).sum();
        }
        let modes = layers.modes_of(&entries, of.odd, &mut memory);
        for (mode, value) in modes.enumerate() {
            differences[mode * (2 * rows - 1) + place] = value;
        }
    }
    differences
}

/// The stress that the free surface adds in a row, of all corners: by edge down dip, then by the distance along strike,
/// from half a cell behind on.
fn set_corners(
    cells: &Rectangles,
    rock: &Rock,
    weights: &[Weights],
    receiver: usize,
    corners: &mut [Vec<f64>],
) {
    let [cos, sin] = [rock.dip.cos, rock.dip.sin];
    let (down_dip, length) = (cells.down_dip(), cells.along_strike().length());
    let columns = cells.along_strike().count();
    let at = down_dip.center(receiver);
    let q = -2.0 * at * sin * cos;
    for edge in 0..=down_dip.count() {
        let down = down_dip.ends()[0] + edge as f64 * down_dip.length();
        let eta = down - at * (cos * cos - sin * sin);
        for column in 0..=columns {
            let xi = (column as f64 - 0.5) * length;
            let gradients = okada::image(&rock.dip, [xi, eta, q], false, -at * sin);
            let tractions = gradients.map(|of| rock.traction(&of));
            for (of, corners) in weights.iter().zip(corners.iter_mut()) {
                corners[edge * (columns + 1) + column] = of.of_tractions(&tractions);
            }
        }
    }
}
