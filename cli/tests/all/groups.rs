//! `groups`: what is printed is what the integrators use. The page docs/book/src/groups.md is run by `docs`.

use crate::support::{json, run, text_of};
use coadjoint::groups::{Heisenberg, SE2, SU2};
use coadjoint::{LieGroup, SE3, SO3};
use coadjoint_codegen::lie::catalogue;

/// Numbers without a pattern, so that no wrong sign cancels.
fn numbers_of(n: usize, seed: f64) -> Vec<f64> {
    (1..=n).map(|i| (seed + 1.7 * i as f64).sin()).collect()
}

/// The value of a sum such as `-2*ξ1*μ3 + ξ2*μ1`.
fn value(sum: &str, xi: &[f64], mu: &[f64]) -> f64 {
    if sum == "0" {
        return 0.0;
    }
    let spaced = sum.replace(" - ", " + -");
    let factor = |text: &str| match (text.strip_prefix('ξ'), text.strip_prefix('μ')) {
        (Some(i), _) => xi[i.parse::<usize>().unwrap() - 1],
        (_, Some(i)) => mu[i.parse::<usize>().unwrap() - 1],
        _ => text.parse().unwrap(),
    };
    let term = |text: &str| {
        let (sign, rest) = text.strip_prefix('-').map_or((1.0, text), |rest| (-1.0, rest));
        sign * rest.split('*').map(factor).product::<f64>()
    };
    spaced.split(" + ").map(term).sum()
}

/// The components that the command prints are those of the runtime's group of the same name.
fn assert_sign<G: LieGroup<Scalar = f64>>(name: &str, group: &G)
where
    G::Vector: std::ops::Index<usize, Output = f64>,
{
    use coadjoint::groups::Coordinates;
    let facts = json(&format!("groups '{name}'"));
    let components = facts["ad_star"]["components"].as_array().unwrap();
    let n = components.len();
    let (xi, mu) = (numbers_of(n, 0.3), numbers_of(n, 2.9));
    let vector = |list: &[f64]| G::Vector::from_entries(n, |i| list[i]);
    let expected = group.ad_star(&vector(&xi), &vector(&mu));
    for (j, component) in components.iter().enumerate() {
        let found = value(component.as_str().unwrap(), &xi, &mu);
        assert!((found - expected[j]).abs() < 1e-14, "{name} {j}: {found} {}", expected[j]);
    }
}

#[test]
fn the_sign_of_ad_star_is_that_of_the_integrators() {
    assert_sign("SO3", &SO3::new());
    assert_sign("SU2", &SU2::new());
    assert_sign("SE2", &SE2::new());
    assert_sign("SE3", &SE3::new());
    assert_sign("Heisenberg", &Heisenberg::new());
}

/// Every group of the catalogue is listed, with its dimension and its charts.
#[test]
fn the_list_is_that_of_the_catalogue() {
    let list = json("groups");
    let list = list.as_array().unwrap();
    let names: Vec<&str> = list.iter().map(|group| group["name"].as_str().unwrap()).collect();
    assert_eq!(names, catalogue::names());
    let written = ["SO3*SE3", "SO3^64", "SO3 |x R3", "[algebra]"];
    let text = run("groups").ok().prints(&written).out;
    let page = text_of("docs/book/src/groups.md");
    for group in list {
        let name = group["name"].as_str().unwrap();
        assert!(
            page.contains(&format!("\n$ coadjoint groups {name}\n")),
            "{name} is not on the page"
        );
        let dim = catalogue::lookup(name).unwrap().dim();
        assert_eq!(group["dimension"], dim, "{name}");
        let charts = group["charts"].as_array().unwrap();
        assert_eq!(charts.len(), if ["SU3", "SU4"].contains(&name) { 1 } else { 2 }, "{name}");
        let line = text.lines().find(|line| line.split(' ').next() == Some(name)).unwrap();
        assert!(line.contains(&format!(" {dim} ")), "{line}");
    }
}
