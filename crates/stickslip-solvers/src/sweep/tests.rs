//! Sweeps against vertices that are balanced one by one.

use nalgebra::{Matrix2, Vector2};
use proptest::prelude::*;
use stickslip_friction::{Radial, Tresca};

use super::Sweep;
use crate::block::invert_all;
use crate::colouring::Colouring;
use crate::{BlockMatrix, Energy, Matrix};

/// Vertices, each coupled to two on both sides.
const SIZE: usize = 33;

fn operator(values: &[f64]) -> BlockMatrix<2> {
    let mut blocks = sprs::TriMatI::new((SIZE, SIZE));
    for i in 0..SIZE {
        blocks.add_triplet(i, i, Matrix2::new(9.0, 0.5, 0.5, 8.0));
        for j in i + 1..SIZE.min(i + 3) {
            let [a, b] = [values[2 * i], values[2 * i + j - i]];
            let block = Matrix2::new(-a, b, 0.3 * b, -b);
            blocks.add_triplet(i, j, block);
            blocks.add_triplet(j, i, block.transpose());
        }
    }
    blocks.to_csr()
}

proptest! {
    /// One vertex after the other, those of wide slabs first; the residual is the gradient.
    #[test]
    fn a_sweep_over_slabs_balances_vertex_by_vertex(
        values in prop::collection::vec(0.0..1.0, 2 * SIZE + 2),
        start in prop::collection::vec(-1.0..1.0, 2 * SIZE),
        load in prop::collection::vec(-9.0..9.0, 2 * SIZE),
        stride in 1_usize..5,
    ) {
        let field = |values: &[f64]| values.chunks(2).map(Vector2::from_column_slice).collect::<Vec<_>>();
        let (operator, load, start) = (operator(&values), field(&load), field(&start));
        let vertices: Vec<_> = (0..SIZE).step_by(stride).collect();
        let mut fixed = vec![[false; 2]; SIZE];
        vertices.iter().for_each(|&vertex| fixed[vertex][1] = true);
        let potentials = vec![
            Radial { law: Tresca { coefficient: 0.5 }, force: 3.0, state: () };
            vertices.len()
        ];
        let energy = Energy {
            operator: &operator,
            load: &load,
            potentials: &potentials,
            vertices: &vertices,
            fixed: &fixed,
        };
        let mut sweep = Sweep::default();
        sweep.prepare(&energy)?;
        sweep.slabs = Colouring::of(SIZE, 2, 0);
        let nothing = vec![Vector2::zeros(); SIZE];
        let (mut v, mut moved, mut left) = (start.clone(), nothing.clone(), nothing);
        sweep.forward_with_residual((&energy, None), &mut v, &mut moved, &mut left);
        let (mut alone, mut inverses) = (start.clone(), Vec::new());
        invert_all(&operator, &fixed, &mut inverses)?;
        sweep.forward((&energy, None), &mut alone, &mut vec![Vector2::zeros(); SIZE]);
        prop_assert_eq!(&alone, &v);

        let mut by_inverses = start.clone();
        sweep.forward((&energy, Some(&inverses)), &mut by_inverses, &mut vec![Vector2::zeros(); SIZE]);

        let mut order = Vec::new();
        for narrow in [false, true] {
            sweep.slabs.for_each(|rows, is| order.extend(rows.filter(|_| is == narrow)));
        }
        let mut expected = start.clone();
        for &i in &order {
            expected[i] = energy.local_minimizer(i, &expected).expect("definite");
        }
        let (mut back, mut expected_back) = (start.clone(), start.clone());
        sweep.backward((&energy, None), &mut back, &mut moved.clone());
        for &i in order.iter().rev() {
            expected_back[i] = energy.local_minimizer(i, &expected_back).expect("definite");
        }
        for i in 0..SIZE {
            prop_assert!((v[i] - expected[i]).amax() < 1e-12);
            prop_assert!((by_inverses[i] - expected[i]).amax() < 1e-12);
            prop_assert!((back[i] - expected_back[i]).amax() < 1e-12);
            prop_assert!((moved[i] - (start[i] - v[i])).amax() < 1e-12);
            // Friction balances the rest where it acts.
            if i % stride != 0 {
                let rest = load[i] - operator.product_at(i, &v);
                prop_assert!((left[i] - rest).amax() < 1e-12);
            } else {
                prop_assert_eq!(left[i][1], 0.0);
            }
        }
    }
}
