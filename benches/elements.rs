//! The product with a stiffness in space: of block rows, and by elements.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use nalgebra::Vector3;
use stickslip::fem::{Elastic, P1, elasticity, element_stiffness};
use stickslip::solvers::IntoOperator;
use stickslip::{BlockMatrix, ElementOperator, Matrix};

const ROCK: Elastic = Elastic {
    young_modulus: 8e10,
    poisson_ratio: 0.25,
};

fn product(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("product in space");
    for side in [20, 40] {
        let space = P1::<3>::grid([1.0; 3], [side; 3]).expect("a cube");
        let vertices = space.vertex_count();
        let x = space.interpolate(|x| Vector3::new(x[1], x[2] * x[0], x[0]));
        let mut y = vec![Vector3::zeros(); vertices];
        let rows: BlockMatrix<3> = elasticity(&space, &ROCK).expect("rock").into_matrix();
        let elements: ElementOperator<3> = element_stiffness(&space, &ROCK)
            .expect("rock")
            .into_operator();
        group.throughput(Throughput::Elements(vertices as u64));
        let formats: [(&str, &dyn Matrix<3>); 2] = [("block rows", &rows), ("elements", &elements)];
        for (name, matrix) in formats {
            group.bench_function(BenchmarkId::new(name, vertices), |bencher| {
                bencher.iter(|| matrix.multiply_add(1e-12, &x, &mut y));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, product);
criterion_main!(benches);
