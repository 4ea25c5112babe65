//! Bodies people write, read as polynomials, and compared with the same function run by Rust.

// The bodies are written as people write them.
#![allow(clippy::unwrap_used, clippy::needless_return, clippy::unnecessary_cast)]

use coadjoint_codegen::problem::Problem;
use coadjoint_codegen::smooth::Hamiltonian;
use nalgebra::{Matrix3, Vector3, Vector6};

fn read(arguments: &str, function: &str) -> Problem {
    match crate::smooth::read(arguments, function) {
        Hamiltonian::Polynomial(problem, _) => *problem,
        Hamiltonian::Smooth(_) => panic!("no polynomial: {function}"),
    }
}

/// The energy at a point, by the polynomial.
fn energy(problem: &Problem, mu: &[f64], parameters: &[f64]) -> f64 {
    let mut point = mu.to_vec();
    point.extend(problem.symbols.iter().map(|symbol| symbol.expr.evaluate(parameters)));
    problem.hamiltonian.evaluate(&point)
}

/// Defines a function and checks that what is read computes what it computes.
macro_rules! same_as_rust {
    ($test:ident, $group:literal, $call:expr, $mu:expr, $parameters:expr, $function:item) => {
        #[test]
        fn $test() {
            $function
            let problem =
                read(concat!("group = ", $group, ", truncation = 5"), stringify!($function));
            let expected: f64 = $call;
            let found = energy(&problem, &$mu, &$parameters);
            assert!((found - expected).abs() <= 1e-14 * expected.abs(), "{found} ≠ {expected}");
        }
    };
}

const MU: [f64; 3] = [2.0, 0.5, -1.25];
const INERTIA: [f64; 3] = [1.5, 2.0, 2.5];

same_as_rust! { plain, "SO3", h(MU, INERTIA), MU, INERTIA,
    fn h(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
        0.5 * (mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[2] * mu[2] / inertia[2])
    }
}

same_as_rust! { destructured_with_shadowing_and_a_typed_let, "SO3", h(MU, INERTIA), MU, INERTIA,
    fn h([x, y, z]: [f64; 3], inertia: [f64; 3]) -> f64 {
        let [a, b, c] = inertia;
        let x: f64 = x * x / a;
        let (y, z) = (y.powi(2) / b, z * z / c);
        let sum = x + y;
        let sum = sum + z;
        sum / 2.0
    }
}

same_as_rust! { loops_with_an_accumulator, "SO3", h(&MU, INERTIA), MU, INERTIA,
    fn h(mu: &[f64; 3], inertia: [f64; 3]) -> f64 {
        const N: usize = 3;
        const HALF: f64 = 1.0 / 2.0;
        let mut sum = 0.0;
        let mut weights = [0.0; N];
        for i in 0..N {
            weights[i] = HALF / inertia[i];
        }
        for i in 0..=N - 1 {
            if i % 2 == 0 {
                sum += weights[i] * mu[i] * mu[i];
            } else {
                sum -= -weights[i] * mu[i].powi(1 + 1);
            }
        }
        let mut k = 0;
        while k < 2 {
            sum += mu[k] * mu[k + 1] * (k as f64 + 1.0) / 10.0;
            k += 1;
        }
        return sum;
    }
}

// Behind a `return` nothing counts towards the limit of operations, however long the loop.
same_as_rust! { return_from_a_long_loop, "SO3", long(MU), MU, [],
    fn long(mu: [f64; 3]) -> f64 {
        for i in 0..150_000 {
            if i == 2 {
                return mu[0] * mu[0] + mu[i] * mu[i];
            }
        }
        0.0
    }
}

same_as_rust! { lists_of_edges, "SO3", h(MU, INERTIA), MU, INERTIA,
    fn h(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
        const P: [usize; 3] = [0, 1, 2];
        const Q: [usize; 3] = [1, 2, 0];
        (0..P.len()).map(|b| inertia[b] * mu[P[b]] * mu[Q[b]]).sum()
    }
}

same_as_rust! { iterators_and_closures, "SO3", h(MU, INERTIA), MU, INERTIA,
    fn h(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
        fn square(x: f64) -> f64 { x * x }
        let half = |x: f64| 0.5 * x;
        let kinetic: f64 = mu.iter().zip(inertia.iter()).map(|(m, i)| square(*m) / i).sum::<f64>();
        let cubic = mu.iter().enumerate().fold(0.0, |s, (i, m)| s + f64::from(i as u8) * m.powi(3));
        half(kinetic) + 0.01 * cubic + (0..3).rev().map(|i| mu[i]).sum::<f64>()
    }
}

same_as_rust! { nested_arrays, "SO3",
    h(MU, [[2.0, 0.1, 0.2], [0.1, 3.0, 0.3], [0.2, 0.3, 4.0]]), MU,
    [2.0, 0.1, 0.2, 0.1, 3.0, 0.3, 0.2, 0.3, 4.0],
    fn h(mu: [f64; 3], a: [[f64; 3]; 3]) -> f64 {
        let mut sum = 0.0;
        for (i, row) in a.iter().enumerate() {
            for j in 0..3 {
                sum += 0.5 * mu[i] * row[j] * mu[j];
            }
        }
        sum
    }
}

same_as_rust! { nalgebra_vectors_and_matrices, "SO3",
    h(Vector3::from(MU), Vector3::new(0.1, 0.2, 0.3), Matrix3::new(2.0, 0.1, 0.2, 0.1, 3.0, 0.3, 0.2, 0.3, 4.0)),
    MU, [0.1, 0.2, 0.3, 2.0, 0.1, 0.2, 0.1, 3.0, 0.3, 0.2, 0.3, 4.0],
    fn h(mu: Vector3<f64>, rotor: nalgebra::Vector3<f64>, a: Matrix3<f64>) -> f64 {
        let body = mu - rotor * 2.0;
        0.5 * body.dot(&(a * body)) + mu.norm_squared() / 3.0 + mu.cross(&rotor).dot(&mu.cross(&rotor))
            + mu.x * mu[1] - mu.z + a[(0, 1)] * mu.component_mul(&mu).sum()
    }
}

same_as_rust! { six_coordinates, "SE3",
    h(Vector6::new(0.3, -0.2, 0.9, 0.1, 0.2, 0.97), INERTIA, 0.7),
    [0.3, -0.2, 0.9, 0.1, 0.2, 0.97], [1.5, 2.0, 2.5, 0.7],
    fn h(mu: Vector6<f64>, inertia: [f64; 3], mgl: f64) -> f64 {
        let pi = mu.fixed_rows::<3>(0).into_owned();
        let gamma = mu.fixed_rows::<3>(3).into_owned();
        let i = Vector3::from(inertia);
        0.5 * pi.component_div(&i).dot(&pi) + mgl * gamma.dot(&Vector3::z())
    }
}

same_as_rust! { functions_of_parameters, "SO3", h(MU, 1.5, 0.3), MU, [1.5, 0.3],
    fn h(mu: [f64; 3], m: f64, angle: f64) -> f64 {
        let c = (m.sqrt() + 1.0).recip() * angle.cos().powi(-2);
        let w = std::f64::consts::PI.mul_add(m, angle.sin().abs());
        c * mu[0] * mu[0] + mu[1].powi(2) * m.powf(1.5) + (mu[2] * mu[2]).mul_add(w, -mu[0]) + (2 as f64)
    }
}

/// The paper's Hamiltonian has exactly the three opaque coefficients 1/I₁, 1/I₂, 1/I₃.
#[test]
fn equal_coefficients_share_a_symbol() {
    let problem = read(
        "group = SO3, truncation = 7",
        "fn rigid_body(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
            0.5 * (mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[2] * mu[2] / inertia[2])
        }",
    );
    let texts: Vec<&str> = problem.symbols.iter().map(|s| s.text.as_str()).collect();
    assert_eq!(texts, ["1/inertia[0]", "1/inertia[1]", "1/inertia[2]"]);
    assert_eq!(problem.hamiltonian.len(), 3);

    let problem = read(
        "group = SO3, truncation = 7",
        "fn h(mu: [f64; 3], a: f64, b: f64) -> f64 {
            let d = a - b;
            mu[0].powi(2) * d * d * 3.0 - mu[1].powi(2) / 7.0 * (b - a).powi(2) + mu[2] * (a + b) / (2.0 * a)
        }",
    );
    let texts: Vec<&str> = problem.symbols.iter().map(|s| s.text.as_str()).collect();
    assert_eq!(texts, ["(a - b)^2", "(a + b)/a"]);
}

/// so(3) written into the attribute, by its matrices and by its brackets, and products of groups.
#[test]
fn groups_are_read_as_people_write_them() {
    let so3 = read("group = SO3", "fn h(mu: [f64; 3]) -> f64 { mu[0] }").algebra;
    for group in [
        "algebra(basis = [[[0, 0, 0], [0, 0, -1], [0, 1, 0]], [[0, 0, 1], [0, 0, 0], [-1.0, 0, 0]], \
         [[0, \"-1\", 0], [2 / 2, 0, 0], [0, 0, 0]]])",
        "algebra(generators = [a, b, c], brackets = [\"[a, b] = c\", \"[b, c] = a\", \"[c, a] = b\"])",
    ] {
        let problem = read(&format!("group = {group}"), "fn h(mu: [f64; 3]) -> f64 { mu[0] }");
        assert_eq!(problem.algebra.structure(), so3.structure());
    }
    for (group, dim) in [("SO3 * SO3", 6), ("SO3^2", 6), ("\"SO3 |x R3\"", 6), ("SE3", 6)] {
        let problem = read(&format!("group = {group}"), "fn h(mu: [f64; 6]) -> f64 { mu[0] }");
        assert_eq!(problem.algebra.dim(), dim, "{group}");
    }
}
