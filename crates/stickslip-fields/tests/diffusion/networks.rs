//! Networks of cells.

use stickslip_fields::{
    Boundary, Diffusion, Edge, Hydraulics, Line, Network, Place, Plane, RateHistory, Side, Well,
};

use crate::march::{March, zone};

/// The cells of a plane of 10 m as a network, in another order: that of `number`.
fn as_network([columns, rows]: [usize; 2], number: impl Fn(usize) -> usize) -> Network {
    let count = columns * rows;
    let mut edges = Vec::new();
    for cell in 0..count {
        let mut join = |other: usize| {
            let cells = [number(cell), number(other)];
            edges.push(Edge {
                cells,
                length: 10.0,
                distances: [5.0; 2],
            });
        };
        if cell % columns + 1 < columns {
            join(cell + 1);
        }
        if cell + columns < count {
            join(cell + columns);
        }
    }
    Network::new(vec![100.0; count], edges).expect("network")
}

#[test]
fn a_network_is_the_plane_of_its_cells() {
    // 10 is prime to 63.
    let number = |cell: usize| 10 * cell % 63;
    let (counts, network) = ([9, 7], as_network([9, 7], number));
    let plane = Plane::new([[0.0, 90.0], [0.0, 70.0]], counts).expect("plane");
    let permeability = |cell: usize| 1e-14 * 1.5_f64.powi((cell % 7) as i32);
    let mut mixed = vec![0.0; 63];
    (0..63).for_each(|cell| mixed[number(cell)] = permeability(cell));
    let sorted: Vec<f64> = (0..63).map(permeability).collect();
    let rates = || RateHistory::constant(1e-4).expect("rate");
    let of = |values: Vec<f64>| Hydraulics {
        permeability: values.into(),
        ..zone(0.0)
    };
    let plane = Diffusion::new(plane, &of(sorted)).expect("field");
    let plane = plane
        .with_well(Well::new(Place::Cell(30), rates()))
        .expect("well");
    let network = Diffusion::new(network, &of(mixed)).expect("field");
    let network = network
        .with_well(Well::new(Place::Cell(number(30)), rates()))
        .expect("well");
    let (mut plane, mut network) = (March::new(&plane), March::new(&network));
    for dt in [10.0, 1e3, 1e5, 1e7] {
        plane.step(dt);
        network.step(dt);
        let (plane, network) = (plane.pressure(), network.pressure());
        let most = plane.iter().fold(0.0_f64, |most, p| most.max(p.abs()));
        for (cell, pressure) in plane.iter().enumerate() {
            assert!((pressure - network[number(cell)]).abs() < 1e-10 * most);
        }
    }
    let (injected, stored) = (
        network.total("injected_volume"),
        network.total("stored_volume"),
    );
    assert!((stored / injected - 1.0).abs() < 1e-13);
}

/// `cos(pi x/H) exp(-alpha (pi/H)^2 t)` on a tilted square of triangles, to second order.
#[test]
fn a_wave_on_triangles_decays_at_its_rate() {
    let errors = [16_usize, 32].map(|n| {
        let side = 100.0 / n as f64;
        let mut points = Vec::new();
        for i in 0..=n {
            for j in 0..=n {
                // A plane that dips at 60 degrees.
                let [x, y] = [j as f64 * side, i as f64 * side];
                points.push([x, 0.5 * y, 0.75_f64.sqrt() * y]);
            }
        }
        let mut triangles = Vec::new();
        for i in 0..n {
            for j in 0..n {
                let at = i * (n + 1) + j;
                triangles.push([at, at + 1, at + n + 2]);
                triangles.push([at, at + n + 2, at + n + 1]);
            }
        }
        let wave = |x: f64| (std::f64::consts::PI * x / 100.0).cos();
        let initial: Vec<f64> = points.iter().map(|point| 1e6 * wave(point[0])).collect();
        let network = Network::triangles(&points, &triangles).expect("network");
        let field = Diffusion::new(network, &zone(1e-13)).expect("field");
        let field = field.with_initial_pressure(initial).expect("pressure");
        let mut march = March::new(&field);
        let rate = 0.1 * (std::f64::consts::PI / 100.0).powi(2);
        (0..200).for_each(|_| march.step(1.0 / rate / 200.0));
        let exact = |point: &[f64; 3]| 1e6 * wave(point[0]) * (-1.0_f64).exp();
        let pairs = march.pressure().into_iter().zip(&points);
        pairs.fold(0.0, |most: f64, (p, point)| {
            most.max((p - exact(point)).abs())
        })
    });
    assert!(
        errors[1] < 2e3 && (errors[0] / errors[1]).log2() > 1.7,
        "{errors:?}"
    );
}

/// Multigrid on odd numbers of cells, some sealed, whose permeability changes by up to 1e4 from cell to cell; the network
/// has another solver.
#[test]
fn a_plane_of_many_permeabilities_is_its_network() {
    for counts in [[37, 23], [1, 40], [40, 1], [16, 33]] {
        let count = counts[0] * counts[1];
        let permeability: Vec<f64> = (0..count)
            .map(|cell| match cell * 7919 % 101 {
                0 => 0.0,
                k => 1e-16 * 10.0_f64.powf(0.04 * k as f64),
            })
            .collect();
        let initial: Vec<f64> = (0..count)
            .map(|cell| 1e4 * (cell * 31 % 17) as f64)
            .collect();
        let hydraulics = Hydraulics {
            permeability: permeability.into(),
            ..zone(0.0)
        };
        let ends = counts.map(|count| [0.0, 10.0 * count as f64]);
        let plane = Plane::new(ends, counts).expect("plane");
        let fields = [
            Diffusion::new(plane, &hydraulics),
            Diffusion::new(as_network(counts, |cell| cell), &hydraulics),
        ];
        let [plane, network] = fields.map(|field| {
            let field = field.and_then(|field| field.with_initial_pressure(initial.clone()));
            let field = field.expect("field");
            let mut march = March::new(&field);
            [1.0, 1e3, 1e5, 1e7].map(|dt| {
                march.step(dt);
                march.pressure()
            })
        });
        for (plane, network) in plane.iter().flatten().zip(network.iter().flatten()) {
            assert!(
                (plane - network).abs() < 1e-8 * 1.6e5,
                "{counts:?}: {plane:e} {network:e}"
            );
        }
    }
}

/// A row of cells with an open face at its end is a line with a side of given pressure.
#[test]
fn an_open_face_is_a_side() {
    let row = as_network([8, 1], |cell| cell);
    let network = Diffusion::new(row, &zone(1e-13))
        .and_then(|field| field.with_open_face(Place::Cell(7), [10.0, 5.0], 2e5))
        .expect("field");
    let line = Line::uniform([0.0, 80.0], 8).expect("line");
    let line = Diffusion::new(line, &zone(1e-13))
        .and_then(|field| field.with_side(Side::End, Boundary::Pressure(2e5)))
        .expect("field");
    let (mut network, mut line) = (March::new(&network), March::new(&line));
    for dt in [10.0, 1e3, 1e5, 1e7] {
        network.step(dt);
        line.step(dt);
        for (a, b) in network.pressure().iter().zip(line.pressure()) {
            assert!((a - b).abs() < 1e-10 * 2e5, "{a:e} {b:e}");
        }
    }
    let (stored, drained) = (
        network.total("stored_volume"),
        network.total("drained_volume"),
    );
    assert!((stored + drained).abs() < 1e-12 * stored);
}
