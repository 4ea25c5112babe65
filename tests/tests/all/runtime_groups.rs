//! Systems on a group that the runtime knows are on the runtime's group.

use std::collections::BTreeMap;

use coadjoint::groups::{
    Aff1Algebra, CayleyAlgebra, HeisenbergAlgebra, Rotations, SL2Algebra, SO4, SpecialUnitary,
    StaticAlgebra,
};
use coadjoint::{Phase, StepError, lie_poisson};
use coadjoint_codegen::emit;
use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::lie::catalogue::lookup;
use coadjoint_codegen::lie::{Chart, LieAlgebra, casimirs};
use coadjoint_codegen::system;
use num_traits::ToPrimitive;

#[lie_poisson(group = SO4, truncation = 3)]
fn spherical(mu: [f64; 6], k: f64) -> f64 {
    mu[0] * mu[0] + k * mu[1] * mu[1]
}

#[lie_poisson(group = "SO(4)", truncation = 3)]
fn coupled(mu: [f64; 6]) -> f64 {
    mu[0] * mu[1] + mu[3] * mu[5]
}

#[test]
fn one_state_serves_two_systems() -> Result<(), StepError> {
    let mut state = Phase::<SO4>::at_identity([0.1, 0.2, 0.3, 0.4, 0.5, 0.6]);
    Spherical::new(0.1, 2.0)?.advance(&mut state)?;
    Coupled::new(0.1)?.advance(&mut state)?;
    assert!(state.momentum.iter().all(|entry| entry.is_finite()));
    Ok(())
}

/// The tables of the type against those of codegen's catalogue, entry for entry.
fn agrees<A: StaticAlgebra>(name: &str) -> Result<(), Box<dyn std::error::Error>> {
    assert!(emit::RUNTIME_TABLES.contains(&name), "{name} is not used");
    let algebra = lookup(name)?;
    let mut brackets = BTreeMap::new();
    for constant in algebra.structure() {
        let value = constant.value.to_f64().ok_or("too large")?;
        brackets.insert((constant.i, constant.j, constant.k), value);
        brackets.insert((constant.j, constant.i, constant.k), -value);
    }
    let here: BTreeMap<_, _> = A::STRUCTURE.iter().map(|&(i, j, k, v)| ((i, j, k), v)).collect();
    assert_eq!(here, brackets, "{name}");

    let mut basis = BTreeMap::new();
    for (i, matrix) in algebra.basis().unwrap_or_default().iter().enumerate() {
        assert_eq!(matrix.rows(), A::MATRIX_SIZE, "{name}");
        for (row, column, value) in matrix.entries() {
            basis.insert((i, row, column), value.to_f64().ok_or("too large")?);
        }
    }
    basis.retain(|_, value| *value != 0.0);
    let here = A::BASIS.unwrap_or_default().iter();
    assert_eq!(here.map(|&(i, r, c, v)| ((i, r, c), v)).collect::<BTreeMap<_, _>>(), basis);

    let invariants = casimirs(&algebra, if A::DIM <= 9 { 3 } else { 2 })?;
    let terms = invariants.iter().map(|casimir| {
        let own = |factors: Vec<(u32, u32)>| {
            factors.into_iter().map(|(i, power)| (i as usize, power)).collect::<Vec<_>>()
        };
        let terms = casimir.factors().map(|(factors, value)| (own(factors), value.to_f64()));
        terms.collect::<BTreeMap<_, _>>()
    });
    let here = A::CASIMIRS.iter().map(|casimir| {
        casimir
            .iter()
            .map(|&(value, factors)| (factors.to_vec(), Some(value)))
            .collect::<BTreeMap<_, _>>()
    });
    assert_eq!(here.collect::<Vec<_>>(), terms.collect::<Vec<_>>(), "{name}");
    Ok(())
}

/// Compares an algebra that has the Cayley chart too.
fn agrees_with_cayley<A: CayleyAlgebra>(name: &str) -> Result<(), Box<dyn std::error::Error>> {
    Chart::Cayley.check(&lookup(name)?)?;
    agrees::<A>(name)
}

#[test]
fn the_runtimes_tables_are_the_catalogues() -> Result<(), Box<dyn std::error::Error>> {
    agrees_with_cayley::<Aff1Algebra>("Aff1")?;
    agrees_with_cayley::<HeisenbergAlgebra>("Heisenberg")?;
    agrees_with_cayley::<SL2Algebra>("SL2")?;
    agrees_with_cayley::<Rotations<4>>("SO4")?;
    agrees_with_cayley::<Rotations<5>>("SO5")?;
    assert!(Chart::Cayley.check(&lookup("SU3")?).is_err());
    agrees::<SpecialUnitary<3>>("SU3")?;
    assert_eq!(emit::RUNTIME_TABLES.len(), 6);
    Ok(())
}

#[test]
fn an_algebra_of_the_users_own_keeps_its_tables() -> Result<(), Box<dyn std::error::Error>> {
    // Named as one of the catalogue, with brackets of its own.
    let text = r#"
name = "own"
hamiltonian = "a^2 + b*c"

[algebra]
generators = ["a", "b", "c"]
brackets = ["[a, b] = 2*c", "[b, c] = a", "[c, a] = 3*b"]
"#;
    let mut system = system::read(text, system::Options::default())
        .map_err(|mistakes| mistakes.render("own.toml", text))?;
    let constants = system.problem.algebra.structure().iter();
    let constants: Vec<_> = constants.map(|s| (s.i, s.j, s.k, s.value.clone())).collect();
    system.problem.algebra = LieAlgebra::from_structure_constants("SO3", 3, constants)?;
    let integrator = Integrator::build(system.problem, TermLimit::default())?;
    let code = emit::file(emit::items(&integrator, &emit::Options::for_problem("own")));
    assert!(code.contains("pub struct OwnAlgebra;"), "{code}");
    assert!(!code.contains("::coadjoint::SO3"), "{code}");
    Ok(())
}
