//! Time and size of derivations as the truncation K and the number of variables n grow.
//!
//! `cargo run -p coadjoint-symbolic --example derivation` measures the cost within a macro (macros are never optimised).
//! Arguments choose systems by parts of their names.

use coadjoint_symbolic::hamilton_jacobi::{TermLimit, derive, predictor};
use coadjoint_symbolic::lie::{Chart, catalogue};
use coadjoint_symbolic::number::{Rational, ratio};
use coadjoint_symbolic::poly::Polynomial;
use std::error::Error;
use std::time::{Duration, Instant};

/// Coefficients times products of variables.
type Terms = Vec<(Vec<usize>, Rational)>;

struct Case {
    name: &'static str,
    group: String,
    variables: usize,
    terms: Terms,
    truncations: &'static [usize],
    /// The degree in t of the predictor that goes with the last truncation.
    predictor: Option<usize>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let chosen: Vec<String> = std::env::args().skip(1).collect();
    let limit = TermLimit::new(10_000_000);
    println!("{:<28} {:>4} {:>3} {:>12} {:>8} {:>9}", "system", "n", "K", "time", "S_K", "all S_k");
    for Case { name, group, variables, terms, truncations, predictor: degree } in cases() {
        if !chosen.is_empty() && !chosen.iter().any(|part| name.contains(part.as_str())) {
            continue;
        }
        let (algebra, chart) = (catalogue::lookup(&group)?, Chart::Exponential);
        let factor = |variable| (variable as u32, 1);
        let terms = terms.into_iter();
        let terms = terms.map(|(list, value)| (list.into_iter().map(factor).collect(), value));
        let hamiltonian = Polynomial::from_factors(variables, terms);
        for &truncation in truncations {
            let (time, (last, all)) = fastest(|| {
                let series = derive(&algebra, chart, &hamiltonian, truncation, limit)?;
                let sizes = (1..=truncation).map(|k| series.order(k).len());
                Ok((series.order(truncation).len(), sizes.sum::<usize>()))
            })?;
            println!("{name:<28} {variables:>4} {truncation:>3} {time:>12.2?} {last:>8} {all:>9}");
        }
        if let Some(degree) = degree {
            let (time, terms) = fastest(|| {
                let rows = predictor(&algebra, chart, &hamiltonian, degree, limit)?;
                Ok(rows.iter().flatten().map(Polynomial::len).sum::<usize>())
            })?;
            println!("{name:<28} {:>8} {time:>12.2?} {terms:>18}", format!("p t^{degree}"));
        }
    }
    Ok(())
}

/// The shortest of up to five runs within about two seconds.
fn fastest<T>(
    mut run: impl FnMut() -> Result<T, Box<dyn Error>>,
) -> Result<(Duration, T), Box<dyn Error>> {
    let begin = Instant::now();
    let mut result = run()?;
    let mut best = begin.elapsed();
    for _ in 0..4 {
        if begin.elapsed() > Duration::from_secs(2) {
            break;
        }
        let start = Instant::now();
        result = run()?;
        best = best.min(start.elapsed());
    }
    Ok((best, result))
}

fn cases() -> Vec<Case> {
    let case = |name, group: &str, variables, terms, truncations, predictor| Case {
        name,
        group: group.to_owned(),
        variables,
        terms,
        truncations,
        predictor,
    };
    // ½ aᵢ pᵢ², the aᵢ being variables from this one on.
    let symbolic = |count: usize, first: usize| -> Terms {
        (0..count).map(|i| (vec![i, i, first + i], ratio(1, 2))).collect()
    };
    let squares = |numerator: i64, denominators: &[i64]| -> Terms {
        let square = |(i, &d): (usize, &i64)| (vec![i, i], ratio(numerator, d));
        denominators.iter().enumerate().map(square).collect()
    };
    let heavy_top = [symbolic(3, 6), vec![(vec![5, 9], ratio(1, 1))]].concat();
    let decimals = squares(500_000, &[1_534_271, 2_117_933, 2_534_289]);
    let mixed = [(0, 1, 7), (0, 2, 11), (1, 2, 13)];
    let mixed = mixed.map(|(i, j, d)| (vec![i, j], ratio(1, d))).to_vec();
    let inertia = [squares(1, &[3, 4, 5]), mixed].concat();
    let kirchhoff = squares(1, &[2, 4, 6, 2, 4, 8]);
    let su3 = squares(1, &[2, 3, 4, 5, 6, 7, 8, 9]);
    let coupling: Terms = (0..7).map(|i| (vec![i, i + 1], ratio(1, 10))).collect();
    let coupled = [su3.clone(), coupling].concat();
    let mut cases = vec![
        case("rigid body, symbolic", "SO3", 6, symbolic(3, 3), &[3, 5, 7, 9], Some(8)),
        case("heavy top, symbolic", "SE3", 10, heavy_top, &[3, 5, 7], Some(6)),
        case("rigid body, six decimals", "SO3", 3, decimals, &[3, 5, 7, 9], Some(8)),
        case("full inertia tensor", "SO3", 3, inertia, &[7, 11, 15, 21], None),
        case("Kirchhoff body", "SE3", 6, kirchhoff, &[5, 7, 9], None),
        case("Kirchhoff body, symbolic", "SE3", 12, symbolic(6, 6), &[3, 5, 7], Some(6)),
        case("SU3, diagonal", "SU3", 8, su3, &[3, 5, 7], None),
        case("SU3, coupled", "SU3", 8, coupled, &[3, 5, 7], None),
        case("ring of spins", "SO3^4", 12, ring(4), &[3, 5], None),
    ];
    cases.extend([16, 64, 256].map(|sites| {
        let group = format!("SO3^{sites}");
        case("ring of spins", &group, 3 * sites, ring(sites), &[3], Some(4))
    }));
    cases
}

/// Heisenberg coupling of neighbours, with an anisotropy and a field along z.
fn ring(sites: usize) -> Terms {
    let mut terms = Vec::new();
    for site in 0..sites {
        let next = (site + 1) % sites;
        for axis in 0..3 {
            terms.push((vec![3 * site + axis, 3 * next + axis], ratio(-1, 1)));
        }
        terms.push((vec![3 * site + 2, 3 * site + 2], ratio(1, 5)));
        terms.push((vec![3 * site + 2], ratio(1, 3)));
    }
    terms
}
