//! Strong fields: a linear term ⟨μ, ξ⟩ that commutes with the rest of H is followed exactly, on every group.
#![allow(clippy::unwrap_used)]

use coadjoint::groups::MatrixGroup;
use coadjoint::{LieGroup, Phase};
use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::in_other_frame;
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::problem::Problem;
use coadjoint_codegen::step::Step;
use coadjoint_codegen::system::{Options, Parameters, read};
use coadjoint_program::Stepper;
use coadjoint_tests::backends::{numbers_of, phase_of};
use coadjoint_tests::bridge::matrix_group;
use coadjoint_tests::kernels::{self, unlimited};
use nalgebra::DVector;

const TWO_SPINS: &str = include_str!("../../systems/two_spins_in_a_field.toml");

/// so(3) and so(2,1) by their brackets alone.
const ROTATIONS: &str = "[A, B] = C\", \"[B, C] = A\", \"[C, A] = B";
const BOOSTS: &str = "[A, B] = -C\", \"[B, C] = A\", \"[C, A] = B";

fn problem(group: &str, hamiltonian: &str, frame: &str) -> Problem {
    let settings = format!("truncation = 5\nframe = {frame:?}\n");
    if ![ROTATIONS, BOOSTS].contains(&group) {
        return kernels::problem(group, hamiltonian, &settings, Options::default());
    }
    let text = format!(
        "coordinates = [\"a\", \"b\", \"c\"]\nhamiltonian = {hamiltonian:?}\n[algebra]\n\
         generators = [\"A\", \"B\", \"C\"]\nbrackets = [\"{group}\"]\n[integrator]\n{settings}"
    );
    read(&text, Options::default()).unwrap().problem
}

/// The state after steps of a kernel from the identity.
fn end(problem: Problem, h: f64, steps: u64, start: &[f64]) -> Phase<MatrixGroup> {
    let group = matrix_group(&problem.algebra).unwrap();
    let step = Step::build(&Integrator::build(problem, TermLimit::default()).unwrap()).unwrap();
    let mut g = numbers_of(&step, &group, &group.identity());
    let mut mu = start.to_vec();
    let made = step.kernel().advance(&unlimited(&step, h), &mut g, &mut mu, steps).steps;
    assert_eq!(made, steps);
    phase_of(step.kernel(), &group, &g, &mu)
}

/// H without the field, the field, ξ, and the momentum at the start.
type Case = (&'static str, &'static str, &'static str, &'static [f64], &'static [f64]);

/// A ring, a top whose axis is no coordinate, su(3) by its basis, compact and not compact algebras by brackets.
const CASES: [Case; 6] = [
    (
        "SO3^3",
        "a*d + b*e + c*f + d*g + e*h + f*i + g*a + h*b + i*c",
        "40*(a + d + g) + 30*(c + f + i)",
        &[40.0, 0.0, 30.0, 40.0, 0.0, 30.0, 40.0, 0.0, 30.0],
        &[0.5, -0.3, 0.4, 0.6, -0.2, 0.7, 0.1, -0.5, 0.3],
    ),
    (
        "SE3",
        "(a^2 + b^2 + c^2)/3 + (a + 2*b)^2/10 + (d + 2*e)/3",
        "-40*a - 80*b",
        &[-40.0, -80.0, 0.0, 0.0, 0.0, 0.0],
        &[0.5, -0.3, 0.4, 0.6, 0.0, 0.8],
    ),
    (
        "SU3",
        "a^2/3 + b^2/3 + c^2/4 + d^2/4 + e^2/5 + f^2/5 + (a*d - b*c)*f/3 + (a*c + b*d)*e/3",
        "60*g - 35*h",
        &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 60.0, -35.0],
        &[0.5, -0.3, 0.4, 0.6, -0.2, 0.7, 0.1, -0.5],
    ),
    ("SL2", "a*a/3 + 4*b*c/5", "3/2*a", &[1.5, 0.0, 0.0], &[0.2, 0.4, 0.3]),
    (ROTATIONS, "a^2/2 + b^2/2 + c^2/3 + c^4/9", "90*c", &[0.0, 0.0, 90.0], &[0.3, 0.8, 1.2]),
    (BOOSTS, "a^2/2 + b^2/2 + c^2/3", "90*c", &[0.0, 0.0, 90.0], &[0.3, 0.8, 1.2]),
];

#[test]
fn a_field_turns_the_motion_without_it() {
    let (h, steps) = (0.2, 10);
    for (group, rest, field, xi, start) in CASES {
        let free = problem(group, rest, "auto");
        let strong = problem(group, &format!("{rest} + {field}"), "auto");
        // Beside the field the frame may take more, such as the spin of a symmetric top.
        let free = match strong.generated() == free.generated() {
            true => free,
            false => in_other_frame(&free).unwrap_or(free),
        };
        assert!(strong.comoving.is_some(), "{rest} + {field}");
        assert_eq!(strong.generated(), free.generated(), "{rest} + {field}");
        let (free, strong) = (end(free, h, steps, start), end(strong, h, steps, start));
        let of = matrix_group(&problem(group, rest, "auto").algebra).unwrap();
        let turn = of.exp(&(DVector::from_column_slice(xi) * (h * steps as f64)));
        let turned = of.coadjoint(&of.inverse(&turn), &free.momentum);
        let element = of.compose(&free.group_element, &turn);
        let scale = 1.0 + element.amax();
        let off = (&strong.momentum - &turned).amax() / (1.0 + turned.amax());
        assert!(off < 1e-12, "{rest} + {field}: {off:e}, {} {turned}", strong.momentum);
        let off = (&strong.group_element - element).amax() / scale;
        assert!(off < 1e-12, "{rest} + {field}: {off:e}");
    }
}

/// A frame takes the part of a linear term that commutes with the rest; the series keeps the other part.
#[test]
fn a_field_is_taken_as_far_as_it_commutes() {
    let exchange = "a*d + b*e + c*f";
    for (group, hamiltonian, field) in [
        // A stronger field on one spin: the mean of both is a symmetry of the exchange.
        ("SO3^2", format!("{exchange} + 7*c + 9*f"), Some("8*c + 8*f")),
        // Of two fields that do not commute none is followed.
        ("SO3^2", format!("{exchange} + 7*c + 9*d"), None),
        ("SO3", "a^2/3 + b^2/3 + c^2/5 + 2*a + 3*c".to_owned(), None),
        ("SO3", "a^2/3 + b^2/4 + c^2/5 + 3*c".to_owned(), None),
        // A term that commutes with everything moves x alone, which the series does exactly.
        ("SO3*R1", "a^2/3 + b^2/4 + c^2/5 + 3*d".to_owned(), None),
        // Without a field nothing changes; a field alone is followed, in steps of any size.
        ("SO3", "a^2/3 + b^2/3 + c^2/5".to_owned(), None),
        ("SO3", "3*a + c".to_owned(), Some("3*a + c")),
    ] {
        let found = problem(group, &hamiltonian, "auto").comoving.map(|frame| frame.energy());
        let expected = field.map(|field| {
            let read = problem(group, &format!("{field} + a^7"), "fixed").hamiltonian;
            let seventh = problem(group, "a^7", "fixed").hamiltonian;
            &read - &seventh
        });
        assert_eq!(found, expected, "{hamiltonian}");
        assert!(problem(group, &hamiltonian, "fixed").comoving.is_none());
    }
}

/// A field of any direction is one whatever its parameters are.
#[test]
fn parameters_of_a_field_stay_symbols() {
    let text = TWO_SPINS
        .replace("B*(z[0] + z[1])", "sum(i, 0..2, B[0]*x[i] + B[1]*y[i] + B[2]*z[i])")
        .replace("B = 100", "B = [60, 0, 80]");
    let kept = Options { parameters: Parameters::Kept, ..Options::default() };
    let problem = read(&text, kept).unwrap().problem;
    let frame = problem.comoving.unwrap();
    assert_eq!(frame.energy().len(), 6);
    assert!(frame.rest.len() == 3, "{:?}", frame.rest);
}
