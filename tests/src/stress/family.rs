//! The families of systems under stress, each with exact series and judges made once.

use std::sync::Arc;

use coadjoint_codegen::hamilton_jacobi::{TermLimit, derive};
use coadjoint_codegen::judge::Judge;
use coadjoint_codegen::lie::{Chart, LieAlgebra, catalogue};
use coadjoint_codegen::number::{nearest_float, ratio};
use coadjoint_codegen::poly::Polynomial;

use super::random::Random;
use super::runtime::{Steps, Terms};
use super::verdict::Tally;

/// A Hamiltonian, up to its parameters, with its exact series and its judge.
pub struct Template {
    pub judge: Judge,
    pub draw: Box<dyn Fn(&mut Random) -> Realisation + Send + Sync>,
}

pub struct Realisation {
    pub text: String,
    pub velocity: Vec<Polynomial>,
    /// Whether H is homogeneous quadratic, so that |μ| may be of any size.
    pub homogeneous: bool,
    pub symbols: Vec<f64>,
    /// I where steps with h|μ|/I < 1.5 must be accepted.
    pub promised: Option<f64>,
    /// Makes the steps for a step size; `None` where there are none.
    pub steps: Make,
}

/// Makes steps of this size; `None` where there are none.
pub type Make = Box<dyn Fn(f64, &mut Random) -> Option<Instance>>;

/// Steps, and a judge of their own where S is not the model's series.
pub struct Instance {
    pub steps: Box<dyn Steps>,
    /// The judge, the step size counted in it.
    pub judge: Option<Judge>,
}

impl Instance {
    /// Steps of the model's series.
    pub fn series(steps: impl Steps + 'static) -> Self {
        Self { steps: Box::new(steps), judge: None }
    }
}

/// Makes steps from the algebra, the terms of S, and the step size that these have been folded for.
pub type Maker = fn(&LieAlgebra, Terms, f64, &mut Random) -> Option<Instance>;

/// Draws systems, makes their steps and counts how they were judged.
type Judged = Box<dyn Fn(&mut Random, &mut Tally) + Send + Sync>;

pub struct Family {
    pub name: String,
    /// How many of all instances are of this family, relative to the others: where steps take long, few.
    pub weight: usize,
    pub judge: Judged,
}

/// The Hamiltonians of a family of steps by series.
pub struct Models {
    pub models: Vec<Template>,
    /// How far log₁₀|μ| goes to either side of 0.
    pub decades: f64,
    /// Whether all momenta are of those whose steps must be accepted.
    pub promise: bool,
}

impl Family {
    pub fn new(
        name: String,
        weight: usize,
        judge: impl Fn(&mut Random, &mut Tally) + Send + Sync + 'static,
    ) -> Self {
        Self { name, weight, judge: Box::new(judge) }
    }
}

/// How the Hamiltonians of a family are drawn.
#[derive(Clone, Copy, Debug)]
pub enum Distribution {
    /// A free rigid body: a triangle of inertias with ratios to 10.
    Body,
    /// A body with a full tensor of inertia.
    Tensor,
    /// A body in gravity: inertias of the first three coordinates, a weight along the last.
    Top,
    /// Every square, and some mixed products.
    Squares,
}

/// Moments of inertia that obey the triangle inequality, with ratios to 10; now and then of a symmetric body, or a
/// flat one.
pub fn inertias(random: &mut Random) -> [i64; 3] {
    loop {
        let mut part = || 1 + random.below(120) as i64;
        let (a, b, c) = (part(), part(), part());
        let (b, c) = match random.below(12) {
            0 => (a, a),
            1 => (a, c),
            2 => (b, 0),
            _ => (b, c),
        };
        let inertia = [b + c, a + c, a + b];
        let (least, most) = (inertia.iter().min(), inertia.iter().max());
        if most.copied().unwrap_or(1) <= 10 * least.copied().unwrap_or(1) {
            return inertia;
        }
    }
}

pub fn energy(kind: Distribution, dim: usize, random: &mut Random) -> (Polynomial, Option<f64>) {
    let mut least = None;
    let product =
        |i: usize, j: usize, n: i64, d: i64| (vec![(i as u32, 1), (j as u32, 1)], ratio(n, d));
    let mut terms = Vec::new();
    match kind {
        Distribution::Body | Distribution::Top | Distribution::Tensor => {
            let inertia = inertias(random);
            terms.extend((0..dim.min(3)).map(|i| product(i, i, 32, inertia[i])));
            if matches!(kind, Distribution::Body) {
                // H = ½ Σ μᵢ²/Iᵢ
                least = inertia.iter().min().map(|&least| least as f64 / 64.0);
            }
            if matches!(kind, Distribution::Tensor) {
                for (i, j) in [(0, 1), (0, 2), (1, 2)] {
                    terms.push(product(i, j, random.below(9) as i64 - 4, 40));
                }
            }
            if matches!(kind, Distribution::Top) {
                terms.push((vec![(dim as u32 - 1, 1)], ratio(1 + random.below(8) as i64, 4)));
            }
        }
        Distribution::Squares => {
            for i in 0..dim {
                terms.push(product(i, i, 1, 2 + random.below(7) as i64));
            }
            for _ in 0..random.below(3) {
                let (i, j) = (random.below(dim), random.below(dim));
                terms.push(product(i, j, 1, 12));
            }
        }
    }
    (Polynomial::from_factors(dim, terms), least)
}

/// S_h as terms in doubles; `None` where a coefficient underflows or overflows.
pub fn folded(orders: &[(u32, Polynomial)], h: f64, single: bool) -> Option<Terms> {
    let (least, most) = if single { (1e-36, 1e36) } else { (1e-290, 1e290) };
    let mut terms = Terms::new();
    for (k, order) in orders {
        let power = h.powi(*k as i32);
        for (factors, c) in order.factors() {
            let c = power * nearest_float(&c);
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
pub struct Recipe {
    pub name: &'static str,
    group: &'static str,
    energy: Distribution,
    truncations: &'static [usize],
    chart: Chart,
    /// How many Hamiltonians there are for each truncation.
    models: usize,
    single: bool,
    /// Whether steps with h|μ|/I < 1.5, I the least moment of inertia, must be accepted for K ≥ 5.
    must_accept: bool,
    /// Whether only such are made.
    promise: bool,
    pub weight: usize,
    /// How far log₁₀|μ| goes to either side of 0.
    decades: f64,
}

impl Recipe {
    /// Two Hamiltonians for each truncation, in the exponential chart, in double precision.
    pub fn new(
        name: &'static str,
        group: &'static str,
        energy: Distribution,
        truncations: &'static [usize],
    ) -> Self {
        Self {
            name,
            group,
            energy,
            truncations,
            chart: Chart::Exponential,
            models: 2,
            single: false,
            must_accept: false,
            promise: false,
            weight: 128,
            decades: 30.0,
        }
    }

    pub fn cayley(self) -> Self {
        Self { chart: Chart::Cayley, ..self }
    }

    pub fn models(self, models: usize) -> Self {
        Self { models, ..self }
    }

    pub fn weight(self, weight: usize) -> Self {
        Self { weight, ..self }
    }

    pub fn slow(self) -> Self {
        Self { decades: 1.0, ..self }
    }

    /// In single precision, of momenta of moderate size.
    pub fn single(self) -> Self {
        Self { single: true, ..self.slow() }
    }

    /// Steps with h|μ|/I < 1.5 must be accepted for K ≥ 5.
    pub fn must(self) -> Self {
        Self { must_accept: true, ..self }
    }

    pub fn promise(self) -> Self {
        Self { promise: true, ..self.must() }
    }
}

pub fn algebra(name: &str) -> LieAlgebra {
    catalogue::lookup(name).expect("a group of the catalogue")
}

impl Recipe {
    /// The Hamiltonians, whose steps are made by `steps`.
    pub fn drawn(&self, seed: u64, steps: Maker) -> Models {
        let algebra = algebra(self.group);
        let mut random = Random::new(seed);
        let mut models = Vec::new();
        for &truncation in self.truncations {
            for _ in 0..self.models {
                models.push(self.model(&algebra, truncation, &mut random, steps));
            }
        }
        Models { models, decades: self.decades, promise: self.promise }
    }

    fn model(
        &self,
        algebra: &LieAlgebra,
        truncation: usize,
        random: &mut Random,
        make: Maker,
    ) -> Template {
        let (h, least) = energy(self.energy, algebra.dim(), random);
        let series =
            derive(algebra, self.chart, &h, truncation, TermLimit::default()).expect("a series");
        let judge = Judge::new(algebra, &series).expect("a judge");
        let orders: Arc<Vec<_>> =
            Arc::new((1..=truncation).map(|k| (k as u32, series.order(k).clone())).collect());
        let (algebra, single) = (algebra.clone(), self.single);
        let text = format!("K = {truncation}, H = {h:?}");
        let velocity = h.gradient(algebra.dim());
        let homogeneous = h.factors().all(|(f, _)| f.iter().map(|f| f.1).sum::<u32>() == 2);
        let promised = least.filter(|_| self.must_accept && truncation >= 5);
        let draw = move |_: &mut Random| {
            let (orders, algebra) = (Arc::clone(&orders), algebra.clone());
            let steps = move |step: f64, random: &mut Random| {
                make(&algebra, folded(&orders, step, single)?, step, random)
            };
            Realisation {
                text: text.clone(),
                velocity: velocity.clone(),
                homogeneous,
                symbols: Vec::new(),
                promised,
                steps: Box::new(steps),
            }
        };
        Template { judge, draw: Box::new(draw) }
    }
}
