//! Refusals that name the number and the limit, and mistakes that are reported once, at their place.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::lie::{LieAlgebra, LieAlgebraError};
use coadjoint_codegen::number::integer;
use coadjoint_codegen::tolerance::{Bound, Prospects, Region, Target, ToleranceError};

use crate::given::{read, said};

#[test]
fn too_many_generators_by_brackets_are_refused_before_anything_is_allocated() {
    let names: Vec<String> = (0..1000).map(|i| format!("a{i}")).collect();
    let limit = LieAlgebra::MOST_BY_BRACKETS;
    let error = LieAlgebra::from_brackets("large", names.clone(), []).unwrap_err();
    assert_eq!(error, LieAlgebraError::TooLarge { generators: 1000, limit });
    let few = names[..limit].to_vec();
    assert!(LieAlgebra::from_brackets("small enough", few, []).is_ok());
    let list = names.iter().map(|name| format!("\"{name}\"")).collect::<Vec<_>>().join(", ");
    let text = format!(
        "hamiltonian = \"mu[0]^2\"\n[algebra]\ngenerators = [{list}]\nbrackets = [\"[a0, a1] = a2\"]\n"
    );
    let said = said(&text);
    assert!(said.contains("1000 generators are known by their brackets alone"), "{said}");
    assert!(said.contains("at most 512"), "{said}");
}

#[test]
fn a_bracket_of_a_generator_with_itself_is_told_as_such() {
    let names = ["A", "B"].map(String::from).to_vec();
    let brackets = [(0, 0, vec![(1, integer(1))])];
    let error = LieAlgebra::from_brackets("wrong", names, brackets).unwrap_err();
    assert_eq!(error, LieAlgebraError::SelfBracket { generator: "A".into(), index: 0 });
    let entries = [(1, 1, 0, integer(1))];
    let error = LieAlgebra::from_structure_constants("wrong", 2, entries).unwrap_err();
    assert_eq!(error, LieAlgebraError::SelfBracket { generator: "e2".into(), index: 1 });
}

/// The momentum grows as e^t, and with it what a missing term does.
const ESCAPES: &str = r#"group = "SL2"
hamiltonian = "mu[0]^2/2 + mu[1]*mu[2]"
[initial]
momentum = [1, 0.5, 0.5]
"#;

#[test]
fn an_absurd_step_is_refused_with_the_bound_behind_it() {
    let system = read(ESCAPES);
    let limit = TermLimit { terms: 20_000, products: 2_000_000 };
    let pick = |duration, region: Option<f64>| {
        let target = Target {
            tolerance: 1e-8,
            duration,
            start: system.run.momentum.clone(),
            region: region.map(Region::Ball),
            truncation: Some(5),
        };
        Prospects::new(&system.problem, &target, limit)?.choose(target.tolerance)
    };
    for region in [None, Some(2.0)] {
        // Within the time in which the motion stays bounded there is a step.
        assert!(pick(1.0, region).unwrap().step > 1e-3);
        // Beyond it none of any use; at last not even a number.
        for duration in [100.0, 1e5] {
            let error = pick(duration, region).unwrap_err();
            let said = error.to_string();
            let ToleranceError::StepTooSmall { bound, step, scale, along_run, .. } = error else {
                panic!("{said}");
            };
            assert_eq!((bound, along_run), (Bound::Error, region.is_none()));
            assert!(step.is_nan() || step <= 1e-6 * scale, "{said}");
            assert!(said.contains("the error that the missing terms make by the end"), "{said}");
            assert!(said.contains("larger tolerance or a shorter run"), "{said}");
        }
    }
}
