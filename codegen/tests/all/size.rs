//! Large systems: work and code grow in proportion to the number of sites.
#![allow(clippy::unwrap_used)]

use coadjoint_codegen::emit;
use coadjoint_codegen::graph::Program;
use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::problem::Solver;
use coadjoint_codegen::system::Options;

use crate::given::{kept, read, read_with};

/// A Heisenberg ring with anisotropy and field, couplings to the next neighbours only.
fn ring(sites: usize) -> Integrator {
    let text = format!(
        r#"
group = "SO3^{sites}"
coordinates = ["x", "y", "z"]
hamiltonian = """
sum(i, 0..{sites}, 0.3*z[i]^2 - 0.5*z[i]
  - (x[i]*x[(i + 1) % {sites}] + y[i]*y[(i + 1) % {sites}] + z[i]*z[(i + 1) % {sites}]))
"""
[integrator]
truncation = 3
"#
    );
    Integrator::build(read(&text).problem, TermLimit::default()).unwrap()
}

#[test]
fn terms_and_operations_of_a_ring_are_linear_in_its_length() {
    // S₃ couples spins at most three sites apart, so that beyond seven every site costs the same.
    let rings = [16, 24, 32].map(ring);
    let linear = |what: &str, count: fn(&Integrator) -> usize| {
        let [a, b, c] = [&rings[0], &rings[1], &rings[2]].map(count);
        assert!(b > a, "{what}");
        assert_eq!(b - a, c - b, "{what}: {a}, {b}, {c}");
    };
    fn operations(program: &Program) -> usize {
        program.cost().total()
    }
    linear("terms", Integrator::terms);
    linear("gradient", |ring| operations(&ring.gradient));
    linear("predictor", |ring| operations(&ring.predictor));
    linear("energy", |ring| operations(&ring.energy));
    linear("S", |ring| operations(&ring.value));
    linear("coefficients", |ring| ring.coefficients.slots().len());
}

#[test]
fn large_systems_are_emitted_without_a_hessian_and_in_proportion() {
    let length = |sites| {
        let ring = ring(sites);
        assert_eq!(ring.plan.solver, Solver::FixedPoint);
        assert!(ring.hessian.is_none());
        let code = emit::file(emit::items(&ring, &emit::Options::for_problem("ring")));
        let words: String = code.split_whitespace().collect();
        assert!(
            words.contains(&format!("Power<::coadjoint::groups::SO3<T>,{sites},{},>", 3 * sites))
        );
        assert!(words.contains("fngradient(") && !code.contains("gradient_and_hessian"));
        code.len() as f64
    };
    // Programs of short rings are printed, those of long ones are not. In each kind numbers of coordinates and coefficients
    // get longer, which is all.
    for (short, long) in [(9, 16), (32, 48)] {
        let growth = (length(long) / length(short)) / (long as f64 / short as f64);
        assert!((0.9..1.1).contains(&growth), "{short} {long} {growth}");
    }
}

#[test]
fn small_systems_use_newtons_method_unless_told_otherwise() {
    let text = |solver: &str| {
        format!(
            "group = \"SO3^2\"\ncoordinates = [\"x\", \"y\", \"z\"]\n\
             hamiltonian = \"x[0]*x[1] + y[0]^2/2 + z[1]^2/2\"\n[integrator]\n{solver}"
        )
    };
    let solver = |line: &str, options| read_with(&text(line), options).problem.solver();
    let plain = Options::default();
    assert_eq!(solver("", plain), Solver::Newton);
    assert_eq!(solver("solver = \"fixed_point\"", plain), Solver::FixedPoint);
    let option = Options { solver: Some(Solver::Newton), ..plain };
    assert_eq!(solver("solver = \"fixed_point\"", option), Solver::Newton);
}

#[test]
fn too_many_terms_are_refused_by_their_number() {
    let ring = ring(24);
    assert!(emit::check_size(&ring).is_ok());
    let each = ring.terms() / 24;
    let large = self::ring(emit::MOST_TERMS / each + 8);
    let refused = emit::check_size(&large).unwrap_err();
    assert_eq!(refused.terms, large.terms());
    assert!(refused.to_string().contains(&format!("{} terms", large.terms())));
}

#[test]
fn a_refusal_says_what_literals_would_leave() {
    let text = r#"
group = "SO3"
hamiltonian = "x^2/(2*a) + y^2/(2*b) + z^2/(2*c)"
coordinates = ["x", "y", "z"]
[parameters]
a = 1.5
b = 2.0
c = 2.5
[integrator]
truncation = 5
"#;
    let [kept, substituted] = [kept(text), read(text)]
        .map(|system| Integrator::build(system.problem, TermLimit::default()).unwrap());
    assert!(emit::check_size(&kept).is_ok());
    // The number that a refusal gives is that of the terms with literals, or a little more.
    let promised = kept.coefficients.series();
    assert!(substituted.terms() <= promised && promised < kept.terms());

    let refused = emit::TooManyTerms { terms: 31_000, with_literals: Some(412), limit: 20_000 };
    let message = refused.to_string();
    for part in ["31000 terms", "the limit of 20000", "at most 412: write literals"] {
        assert!(message.contains(part), "{message}");
    }
}

/// The parameters of a gyrostat with a full tensor are data beside programs no longer than those of literals.
#[test]
fn kept_parameters_of_a_full_tensor_are_emitted_as_data() {
    let text = r#"
group = "SO3"
coordinates = ["x", "y", "z"]
hamiltonian = """
(A*(x - h[0])^2 + B*(y - h[1])^2 + C*(z - h[2])^2)/2
+ D*(x - h[0])*(y - h[1]) + E*(y - h[1])*(z - h[2]) + F*(x - h[0])*(z - h[2])
"""
[parameters]
A = 0.05
B = 0.07
C = 0.09
D = 0.002
E = 0.003
F = -0.001
h = [0.4, -0.3, 0.7]
[integrator]
truncation = 7
"#;
    let [kept, literal] = [kept(text), read(text)]
        .map(|system| Integrator::build(system.problem, TermLimit::default()).unwrap());
    assert_eq!(kept.problem.parameters.len(), 7);
    assert!(kept.terms() > emit::MOST_TERMS, "{}", kept.terms());
    emit::check_size(&kept).unwrap();
    assert_eq!(kept.coefficients.series(), literal.coefficients.series());
    assert_eq!(kept.gradient.cost().total(), literal.gradient.cost().total());
    let parameters = [0.05, 0.07, 0.09, 0.002, 0.003, -0.001, 0.4, -0.3, 0.7];
    let symbols = kept.problem.symbols.iter().map(|symbol| symbol.expr.evaluate(&parameters));
    let momentum = [2.0, 0.5, -1.25];
    let s = |integrator: &Integrator, symbols: &[f64]| {
        let slots = integrator.fold_table().fold(0.5, symbols).unwrap();
        integrator.value.run(&momentum, &slots)[0]
    };
    let (with, without) = (s(&kept, &symbols.collect::<Vec<_>>()), s(&literal, &[]));
    assert!((with - without).abs() < 1e-15, "{with} {without}");
}
