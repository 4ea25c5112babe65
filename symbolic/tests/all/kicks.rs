//! A step with kicks is the sequence of its kicks and flows, each flow with coefficients of its own.

use coadjoint_program::Stepper;
use coadjoint_program::splitting::Splitting;
use coadjoint_symbolic::expr::ParameterExpr;
use coadjoint_symbolic::hamilton_jacobi::TermLimit;
use coadjoint_symbolic::integrator::{FoldTable, Integrator, Kick};
use coadjoint_symbolic::lie::{Chart, catalogue};
use coadjoint_symbolic::number::{integer, ratio};
use coadjoint_symbolic::poly::Polynomial;
use coadjoint_symbolic::potential::{Force, Potential};
use coadjoint_symbolic::problem::{FrameChoice, Problem, Symbol};
use coadjoint_symbolic::step::Step;

/// A body in a field: V = √2 g₂₂ + g₀₁ g₁₂/3.
fn body() -> (Integrator, Kick) {
    let algebra = catalogue::lookup("SO3").unwrap();
    let square = |i, divisor| (vec![(i, 2)], ratio(1, divisor));
    let problem = Problem {
        name: "body".into(),
        algebra: algebra.clone(),
        coordinates: ["x", "y", "z"].map(String::from).to_vec(),
        hamiltonian: Polynomial::from_factors(3, [square(0, 3), square(1, 4), square(2, 5)]),
        symbols: Vec::new(),
        parameters: Vec::new(),
        source: String::new(),
        chart: Chart::Exponential,
        truncation: 5,
        solver: None,
        frame: FrameChoice::Fixed,
        comoving: None,
        learned: false,
    };
    let root = ParameterExpr::Call(
        coadjoint_symbolic::expr::Function::Sqrt,
        Box::new(ParameterExpr::Rational(integer(2))),
    );
    let energy = [(vec![(8, 1), (9, 1)], integer(1)), (vec![(1, 1), (5, 1)], ratio(1, 3))];
    let potential = Potential {
        name: "field".into(),
        algebra,
        force: Force::Polynomial(Polynomial::from_factors(10, energy)),
        symbols: vec![Symbol { expr: root, text: "sqrt(2)".into() }],
        parameters: Vec::new(),
        source: String::new(),
    };
    (Integrator::build(problem, TermLimit::default()).unwrap(), Kick::build(potential))
}

#[test]
fn a_step_is_its_kicks_and_flows() {
    let (h, root) = (0.1, [2.0_f64.sqrt()]);
    let (flow, kick) = body();
    let plain = Step::build(&flow).unwrap();
    let torque = |g: &[f64]| {
        let matrix = plain.kernel().programs.matrix.run(g, &[]);
        let slots = FoldTable::of_kick(&kick).fold(1.0, &root).unwrap();
        kick.torque.run(&matrix, &slots)
    };
    for splitting in Splitting::ALL {
        let kicks: Vec<f64> = splitting.kicks().collect();
        let flows: Vec<f64> = splitting.flows().collect();
        assert_eq!(kicks.len(), flows.len() + 1, "{splitting:?}");
        for lengths in [&kicks, &flows] {
            assert!((lengths.iter().sum::<f64>() - 1.0).abs() < 1e-15, "{splitting:?}");
            assert!(lengths.iter().eq(lengths.iter().rev()), "{splitting:?}");
        }
        assert!(flows.len().div_ceil(2) <= Splitting::MAX_FLOWS, "{splitting:?}");
        let kicked = flow.clone().with_kicks(kick.clone(), splitting).unwrap();
        let step = Step::build(&kicked).unwrap();
        let slots = step.fold(h, &[]).unwrap();
        assert_eq!(slots.len(), step.kernel().slots());
        let start = (vec![0.5, 0.5, -0.5, 0.5], vec![0.4, -0.3, 0.8]);
        let (mut g, mut mu) = start.clone();
        assert_eq!(step.kernel().advance(&slots, &mut g, &mut mu, 3).steps, 3);
        // The expected state is made by hand.
        let (mut own, mut nu) = start.clone();
        for _ in 0..3 {
            for (i, length) in kicks.iter().enumerate() {
                for (mu, torque) in nu.iter_mut().zip(torque(&own)) {
                    *mu = torque.mul_add(h * length, *mu);
                }
                let Some(length) = flows.get(i) else { break };
                let slots = plain.fold(h * length, &[]).unwrap();
                assert_eq!(plain.kernel().advance(&slots, &mut own, &mut nu, 1).steps, 1);
            }
        }
        for (found, expected) in g.iter().chain(&mu).zip(own.iter().chain(&nu)) {
            assert!((found - expected).abs() < 1e-15, "{splitting:?}: {found} {expected}");
        }
        // A refused flow takes the whole step back.
        let mut tight = slots.clone();
        let flow_slots = step.kernel().slots_of_flow();
        tight[flow_slots * (flows.len() - 1) + step.radius_at()] = 0.0;
        let (mut g, mut mu) = start.clone();
        assert_eq!(step.kernel().advance(&tight, &mut g, &mut mu, 3).steps, 0);
        assert_eq!((g, mu), start);
    }
}
