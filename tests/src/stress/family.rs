//! What is stressed: families of systems, each with exact series and judges made once.

use coadjoint_codegen::hamilton_jacobi::{TermLimit, derive};
use coadjoint_codegen::judge::{Judge, Limits};
use coadjoint_codegen::lie::{Chart, LieAlgebra, catalogue};
use coadjoint_codegen::number::ratio;
use coadjoint_codegen::poly::Polynomial;

use super::random::Random;
use super::runtime::{Steps, Terms};
use crate::bridge::double;

/// A Hamiltonian with its exact series and its judge.
pub struct Model {
    /// What it is, for messages.
    pub text: String,
    /// Judges its steps.
    pub judge: Judge,
    /// ∂H/∂μ.
    pub velocity: Vec<Polynomial>,
    /// Whether H is homogeneous quadratic, so that |μ| may be of any size.
    pub homogeneous: bool,
    /// The values of the symbols.
    pub symbols: Vec<f64>,
    /// Whether steps with h|Ω| < 1.5 must be accepted.
    pub must_accept: bool,
    /// Makes the steps for a step size; `None` where coefficients leave the range of doubles.
    pub steps: Box<dyn Fn(f64) -> Option<Box<dyn Steps>> + Send + Sync>,
}

/// Systems of one kind.
pub struct Family {
    /// Its name.
    pub name: String,
    /// Systems to draw from.
    pub models: Vec<Model>,
    /// How far log₁₀|μ| goes to either side of 0.
    pub decades: f64,
}

/// How the Hamiltonians of a family are drawn.
#[derive(Clone, Copy, Debug)]
pub enum Energy {
    /// A free rigid body: a triangle of inertias with ratios to 10.
    Body,
    /// A body with a full tensor of inertia.
    Tensor,
    /// A body in gravity: inertias of the first three coordinates, a weight along the last.
    Top,
    /// Every square, and some mixed products.
    Squares,
}

fn inertias(random: &mut Random) -> [i64; 3] {
    loop {
        let mut part = || 1 + random.below(120) as i64;
        let (a, b, c) = (part(), part(), part());
        let inertia = [b + c, a + c, a + b];
        let (least, most) = (inertia.iter().min(), inertia.iter().max());
        if most.copied().unwrap_or(1) <= 10 * least.copied().unwrap_or(1) {
            return inertia;
        }
    }
}

/// A Hamiltonian on this many coordinates.
#[must_use]
pub fn energy(kind: Energy, dim: usize, random: &mut Random) -> Polynomial {
    let product =
        |i: usize, j: usize, n: i64, d: i64| (vec![(i as u32, 1), (j as u32, 1)], ratio(n, d));
    let mut terms = Vec::new();
    match kind {
        Energy::Body | Energy::Top | Energy::Tensor => {
            let inertia = inertias(random);
            terms.extend((0..dim.min(3)).map(|i| product(i, i, 32, inertia[i])));
            if matches!(kind, Energy::Tensor) {
                for (i, j) in [(0, 1), (0, 2), (1, 2)] {
                    terms.push(product(i, j, random.below(9) as i64 - 4, 40));
                }
            }
            if matches!(kind, Energy::Top) {
                terms.push((vec![(dim as u32 - 1, 1)], ratio(1 + random.below(8) as i64, 4)));
            }
        }
        Energy::Squares => {
            for i in 0..dim {
                terms.push(product(i, i, 1, 2 + random.below(7) as i64));
            }
            for _ in 0..random.below(3) {
                let (i, j) = (random.below(dim), random.below(dim));
                terms.push(product(i, j, 1, 12));
            }
        }
    }
    Polynomial::from_factors(dim, terms)
}

/// S_h as terms in doubles; `None` where a coefficient underflows or overflows.
fn folded(orders: &[(u32, Polynomial)], h: f64, single: bool) -> Option<Terms> {
    let (least, most) = if single { (1e-36, 1e36) } else { (1e-290, 1e290) };
    let mut terms = Terms::new();
    for (k, order) in orders {
        let power = h.powi(*k as i32);
        for (factors, c) in order.factors() {
            let c = power * double(&c);
            if !(c.abs() > least && c.abs() < most) {
                return None;
            }
            terms.push((
                *k as usize,
                c,
                factors.into_iter().map(|(i, e)| (i as usize, e)).collect(),
            ));
        }
    }
    Some(terms)
}

/// How a family of polynomial functions is made.
pub struct Recipe<'a> {
    /// The name of the family.
    pub name: &'a str,
    /// The group, as the catalogue names it.
    pub group: &'a str,
    /// The chart.
    pub chart: Chart,
    /// The Hamiltonians.
    pub energy: Energy,
    /// The truncations.
    pub truncations: &'a [usize],
    /// How many Hamiltonians there are for each.
    pub models: usize,
    /// Whether numbers are `f32`.
    pub single: bool,
    /// Whether steps with h|Ω| < 1.5 must be accepted for K ≥ 5.
    pub must_accept: bool,
    /// How far log₁₀|μ| goes to either side of 0.
    pub decades: f64,
    /// The limit of the exponential chart.
    pub limit: f64,
}

impl Default for Recipe<'_> {
    fn default() -> Self {
        Self {
            name: "",
            group: "SO3",
            chart: Chart::Exponential,
            energy: Energy::Squares,
            truncations: &[3, 5],
            models: 2,
            single: false,
            must_accept: false,
            decades: 30.0,
            limit: std::f64::consts::PI,
        }
    }
}

/// The algebra of a name of the catalogue.
///
/// # Panics
/// If there is none.
#[must_use]
pub fn algebra(name: &str) -> LieAlgebra {
    catalogue::lookup(name).expect("a group of the catalogue")
}

impl Recipe<'_> {
    /// The family whose steps are made by `steps` from the algebra and the terms of S.
    ///
    /// # Panics
    /// If a series cannot be derived.
    pub fn family<F>(&self, seed: u64, steps: F) -> Family
    where
        F: Fn(&LieAlgebra, Terms) -> Box<dyn Steps> + Clone + Send + Sync + 'static,
    {
        let algebra = algebra(self.group);
        let mut random = Random::new(seed);
        let mut models = Vec::new();
        for &truncation in self.truncations {
            for _ in 0..self.models {
                let h = energy(self.energy, algebra.dim(), &mut random);
                let limit = TermLimit::default();
                let series =
                    derive(&algebra, self.chart, &h, truncation, limit).expect("a derivation");
                let limits = Limits { exponential: self.limit, ..Limits::default() };
                let judge = Judge::new(&algebra, &series).expect("a judge").with_limits(limits);
                let orders: Vec<_> =
                    (1..=truncation).map(|k| (k as u32, series.order(k).clone())).collect();
                let (own, single, make) = (algebra.clone(), self.single, steps.clone());
                models.push(Model {
                    text: format!("K = {truncation}, H = {h:?}"),
                    judge,
                    velocity: h.gradient(algebra.dim()),
                    homogeneous: h.factors().all(|(f, _)| f.iter().map(|f| f.1).sum::<u32>() == 2),
                    symbols: Vec::new(),
                    must_accept: self.must_accept && truncation >= 5,
                    steps: Box::new(move |step| {
                        folded(&orders, step, single).map(|terms| make(&own, terms))
                    }),
                });
            }
        }
        Family { name: self.name.to_owned(), models, decades: self.decades }
    }
}
