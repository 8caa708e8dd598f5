//! Products: threads, memory, precision, parts of them.

use stickslip_bie::hmatrix::{Approximation, HMatrix, HMatrixError};

use super::{Points, error, exact, noise, product, sheet, smooth};
use crate::Outcome;

fn matrix(approximation: Approximation) -> Result<HMatrix, HMatrixError> {
    let points = Points {
        places: sheet(30),
        shape: [3, 2],
        pair: smooth,
    };
    points.compress(&approximation)
}

#[cfg(feature = "rayon")]
#[test]
fn products_have_the_same_bits_in_any_number_of_threads() -> Outcome {
    let x = noise(1800);
    let in_threads = |threads: usize| -> Outcome<Vec<f64>> {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()?;
        // Made there, too.
        // Made there, too.
        let found = pool.install(|| {
            let matrix = matrix(Approximation::default())?;
            Ok::<_, HMatrixError>(product(&matrix, &x))
        });
        Ok(found?)
    };
    let one = in_threads(1)?;
    for threads in [2, 3, 7] {
        assert!(in_threads(threads)? == one, "{threads}");
    }
    Ok(())
}

#[test]
fn products_take_no_memory() -> Outcome {
    let matrix = matrix(Approximation::default())?;
    let (mut scratch, x, mut sum) = (matrix.scratch(), noise(1800), 0.0);
    let taken = allocation_counter::measure(|| {
        matrix.product(
            &mut scratch,
            |j| &x[2 * j..2 * j + 2],
            |_, rows| sum += rows[2],
        );
        let some = [3, 77, 500].into_iter();
        matrix.product_at(
            some,
            &mut scratch,
            |j| &x[2 * j..2 * j + 2],
            |_, rows| sum += rows[0],
        );
    });
    assert_eq!(taken.count_total, 0);
    assert!(sum.is_finite());
    Ok(())
}

#[test]
fn rows_of_some_receivers_have_the_bits_of_the_whole() -> Outcome {
    let matrix = matrix(Approximation::default())?;
    let (x, mut scratch) = (noise(1800), matrix.scratch());
    let whole = product(&matrix, &x);
    for chosen in [
        vec![],
        vec![899],
        vec![4, 5, 5, 640],
        (0..900).rev().collect(),
    ] {
        let mut shown = Vec::new();
        let columns = |source: usize| &x[2 * source..2 * source + 2];
        matrix.product_at(
            chosen.iter().copied(),
            &mut scratch,
            columns,
            |receiver, rows| {
                assert_eq!(rows, &whole[3 * receiver..3 * receiver + 3]);
                shown.push(receiver);
            },
        );
        assert_eq!(shown, chosen);
    }
    Ok(())
}

#[test]
fn far_factors_in_single_precision_take_half_of_their_memory() -> Outcome {
    let [double, single] = [
        matrix(Approximation::default())?,
        matrix(Approximation::default().in_single_precision())?,
    ];
    let [of_double, of_single] = [double.compression(), single.compression()];
    assert_eq!(of_single.near_bytes, of_double.near_bytes);
    let far = |bytes: u64| bytes - of_double.near_bytes;
    assert_eq!(2 * far(of_single.bytes), far(of_double.bytes));
    let x = noise(1800);
    assert!(error(&product(&single, &x), &product(&double, &x)) < 1e-7);
    Ok(())
}

#[test]
fn additions_to_near_pairs_are_seen_by_products() -> Outcome {
    let points = Points {
        places: sheet(30),
        shape: [3, 2],
        pair: smooth,
    };
    let mut matrix = points.compress(&Approximation::default())?;
    let (x, mut pair) = (noise(1800), [0.0; 6]);
    let before = product(&matrix, &x);
    matrix.block(100, 101, &mut pair);
    matrix.add([100, 2], [101, 1], 8.0)?;
    let mut changed = [0.0; 6];
    matrix.block(100, 101, &mut changed);
    pair[5] += 8.0;
    assert_eq!(changed, pair);
    let after = product(&matrix, &x);
    for (row, (after, before)) in after.iter().zip(&before).enumerate() {
        let added = if row == 302 { 8.0 * x[203] } else { 0.0 };
        assert!(
            (after - before - added).abs() < 1e-12 * before.abs().max(1.0),
            "{row}"
        );
    }
    let dense = exact(&points, [900; 2], &x);
    assert!(error(&before, &dense) < 1e-4);
    Ok(())
}
