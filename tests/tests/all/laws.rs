//! The laws of MATH.md for the derived series: every group × chart × K ∈ {1, 3, 5, 7}.
#![allow(clippy::unwrap_used, clippy::panic)]

use coadjoint::groups::{
    Aff1, Cayley, CayleyMatrixGroup, Chart, Coordinates, Exponential, Heisenberg, MatrixGroup,
    Power, Product, SE2, SE23, SL2, SO4, SO5, SU2, Sp4,
};
use coadjoint::laws::check;
use coadjoint::steps::advance;
use coadjoint::{LieGroup, Phase, SE3, SO3};
use coadjoint_codegen::hamilton_jacobi::{TermLimit, derive};
use coadjoint_codegen::lie::catalogue::lookup;
use coadjoint_codegen::lie::{Chart as ChartName, LieAlgebra, RationalMatrix};
use coadjoint_codegen::number::Rational;
use coadjoint_codegen::poly::Polynomial;
use coadjoint_tests::bridge::{matrix_group, series_function};
use coadjoint_tests::order;
use coadjoint_tests::stress::Random;

/// The Hamiltonians tried; on larger groups fewer terms, since the series of a dense one has
/// hundreds of thousands.
#[derive(Clone, Copy)]
enum Energy {
    /// Σ μ_i²/(i + 3) + μ_0 μ_last/9 + μ_0/4: different on every axis, with a cross and a linear
    /// term.
    Full,
    /// Σ μ_i²/(i + 3).
    Diagonal,
    /// Σ μ_i²/(i + 3) over these coordinates, whose brackets generate the algebra.
    Only(&'static [usize]),
}

fn hamiltonian(dim: usize, energy: Energy) -> Polynomial {
    let ratio = |n: i64, d: i64| Rational::new(n.into(), d.into());
    let unit = |entries: &[(usize, u32)]| {
        let mut exponents = vec![0; dim];
        for &(i, power) in entries {
            exponents[i] += power;
        }
        exponents
    };
    let square = |i: usize| (unit(&[(i, 2)]), ratio(1, i as i64 + 3));
    let terms: Vec<_> = match energy {
        Energy::Full => {
            let cross = (unit(&[(0, 1), (dim - 1, 1)]), ratio(1, 9));
            (0..dim).map(square).chain([cross, (unit(&[(0, 1)]), ratio(1, 4))]).collect()
        }
        Energy::Diagonal => (0..dim).map(square).collect(),
        Energy::Only(coordinates) => coordinates.iter().map(|&i| square(i)).collect(),
    };
    Polynomial::from_terms(dim, terms)
}

fn random_phase<G: LieGroup<Scalar = f64>>(group: &G, random: &mut Random) -> Phase<G> {
    let mut vector =
        |size: f64| G::Vector::from_entries(group.dim(), |_| random.between(-size, size));
    let x = vector(0.4);
    let mu = vector(1.0);
    Phase::new(group.exp(&x), mu)
}

/// Runs every law for one group, chart and truncation, and measures the order.
fn laws_hold<G, C>(
    name: &str,
    group: &G,
    chart: C,
    algebra: &LieAlgebra,
    truncation: usize,
    energy: Energy,
) where
    G: LieGroup<Scalar = f64>,
    C: Chart<G>,
{
    let kind = if C::NAME == "exp" { ChartName::Exponential } else { ChartName::Cayley };
    let h = hamiltonian(algebra.dim(), energy);
    let series = derive(algebra, kind, &h, truncation, TermLimit::new(2_000_000)).unwrap();
    let what = format!("{name}, {}, K = {truncation}", C::NAME);

    let mut random = Random::new(17);
    let count = if algebra.dim() > 4 { 1 } else { 2 };
    let points: Vec<_> = (0..count).map(|_| random_phase(group, &mut random)).collect();
    let map = series_function(group.clone(), chart, &series, 0.3).unwrap();
    let backward = series_function(group.clone(), chart, &series, -0.3).unwrap();
    for law in check(&map, Some(&backward), &points).unwrap() {
        assert!(law.pass(), "{what}: {} {:e} exceeds {:e}", law.name, law.value, law.bound);
    }

    let order = order::seen(group, &points[0], 32, |h, steps, state| {
        let map = series_function(group.clone(), chart, &series, h).unwrap();
        (0..steps).try_for_each(|_| advance(&map, state).map(|_| ()))
    });
    let order = order.unwrap_or_else(|| panic!("{what}: no order seen"));
    let expected = truncation as f64 + 1.0;
    assert!((order - expected).abs() < 0.3, "{what}: order {order:.2}, not {expected}");
}

const TRUNCATIONS: [usize; 4] = [1, 3, 5, 7];

fn named(name: &str) -> LieAlgebra {
    lookup(name).unwrap()
}

/// so(2, 1) in a skewed basis: a boost, a rotation plus half that boost, another boost.
fn by_basis() -> LieAlgebra {
    let matrix = |rows: [[(i64, i64); 3]; 3]| {
        RationalMatrix::from_rows(
            rows.map(|row| row.map(|(n, d)| Rational::new(n.into(), d.into())).to_vec()).to_vec(),
        )
    };
    let (o, one, minus, half) = ((0, 1), (1, 1), (-1, 1), (1, 2));
    let boost = matrix([[o, o, one], [o, o, o], [one, o, o]]);
    let mixed = matrix([[o, minus, half], [one, o, o], [half, o, o]]);
    let other = matrix([[o, o, o], [o, o, one], [o, one, o]]);
    LieAlgebra::from_basis("by basis", vec![boost, mixed, other]).unwrap()
}

/// Rotations and translations of the plane with a central charge, [p, q] = c/2: its adjoint
/// matrices do not see the centre.
fn by_brackets() -> LieAlgebra {
    let ratio = |n: i64, d: i64| Rational::new(n.into(), d.into());
    let (r, p, q, c) = (0, 1, 2, 3);
    let half = [(r, p, q, ratio(1, 1)), (r, q, p, ratio(-1, 1)), (p, q, c, ratio(1, 2))];
    let both = half.into_iter().flat_map(|(i, j, k, v)| [(i, j, k, v.clone()), (j, i, k, -v)]);
    LieAlgebra::from_structure_constants("by brackets", 4, both).unwrap()
}

fn tables(algebra: &LieAlgebra) -> MatrixGroup {
    matrix_group(algebra).unwrap()
}

fn cayley_tables(algebra: &LieAlgebra) -> CayleyMatrixGroup {
    tables(algebra).into_cayley().unwrap()
}

/// One test for each group and chart, over all truncations. A group without the Cayley chart says
/// so, in the derivation and at run time.
macro_rules! laws_hold_for {
    ($($test:ident: $algebra:expr, $energy:expr, exp $group:expr, $(cayley $cayley:expr)? $(, $none:ident)?;)*) => {
        $(mod $test {
            use super::*;

            #[test]
            fn exponential() {
                let algebra = $algebra;
                for truncation in TRUNCATIONS {
                    let group = $group(&algebra);
                    laws_hold(stringify!($test), &group, Exponential, &algebra, truncation, $energy);
                }
            }

            $(#[test]
            fn cayley() {
                let algebra = $algebra;
                for truncation in TRUNCATIONS {
                    let group = $cayley(&algebra);
                    laws_hold(stringify!($test), &group, Cayley, &algebra, truncation, $energy);
                }
            })?

            $(#[test]
            fn $none() {
                let algebra = $algebra;
                assert!(ChartName::Cayley.check(&algebra).is_err());
                assert!(tables(&algebra).into_cayley().is_err());
            })?
        })*
    };
}

/// A group whose type is known to the compiler, as it is to users.
macro_rules! typed {
    ($group:ty) => {
        |_: &LieAlgebra| <$group>::new()
    };
}

type SO3SO3 = Product<SO3, SO3, 6>;
type SO3SE3 = Product<SO3, SE3, 9>;
type ThreeSO3 = Power<SO3, 3, 9>;

laws_hold_for! {
    // Closed forms.
    so3: named("SO3"), Energy::Full, exp typed!(SO3), cayley typed!(SO3);
    su2: named("SU2"), Energy::Full, exp typed!(SU2), cayley typed!(SU2);
    se2: named("SE2"), Energy::Full, exp typed!(SE2), cayley typed!(SE2);
    se3: named("SE3"), Energy::Full, exp typed!(SE3), cayley typed!(SE3);
    heisenberg: named("Heisenberg"), Energy::Full, exp typed!(Heisenberg), cayley typed!(Heisenberg);
    // Tables known to the compiler, and made at run time, as the command line does.
    sl2: named("SL2"), Energy::Full, exp typed!(SL2), cayley typed!(SL2);
    so4: named("SO4"), Energy::Diagonal, exp typed!(SO4), cayley typed!(SO4);
    so3_tables: named("SO3"), Energy::Full, exp tables, cayley cayley_tables;
    aff1: named("Aff1"), Energy::Full, exp typed!(Aff1), cayley typed!(Aff1);
    u2: named("U2"), Energy::Full, exp tables, cayley cayley_tables;
    u3: named("U3"), Energy::Only(&[0, 2, 4, 6, 7]), exp tables, cayley cayley_tables;
    so5: named("SO5"), Energy::Only(&[0, 4, 7, 9]), exp typed!(SO5), cayley typed!(SO5);
    sp4: named("Sp4"), Energy::Only(&[0, 1, 5, 8]), exp typed!(Sp4), cayley typed!(Sp4);
    su3: named("SU3"), Energy::Diagonal, exp tables, , no_cayley;
    su4: named("SU4"), Energy::Only(&[0, 6, 10, 12]), exp tables, , no_cayley;
    // Products and powers.
    so3_so3: named("SO3*SO3"), Energy::Full, exp typed!(SO3SO3), cayley typed!(SO3SO3);
    so3_se3: named("SO3*SE3"), Energy::Diagonal, exp typed!(SO3SE3), cayley typed!(SO3SE3);
    so3_cubed: named("SO3^3"), Energy::Diagonal, exp typed!(ThreeSO3), cayley typed!(ThreeSO3);
    so3_se2_tables: named("SO3*SE2"), Energy::Diagonal, exp tables, cayley cayley_tables;
    // Semidirect products, and algebras of one's own.
    heavy_top: named("SO3 |x R3"), Energy::Full, exp tables, cayley cayley_tables;
    extended_poses: named("SE23"), Energy::Diagonal, exp typed!(SE23), cayley typed!(SE23);
    symmetric_matrices: named("SO3 |x Sym3"), Energy::Diagonal, exp tables, , no_cayley;
    by_basis: by_basis(), Energy::Full, exp tables, cayley cayley_tables;
    by_brackets: by_brackets(), Energy::Full, exp tables, , no_cayley;
}
