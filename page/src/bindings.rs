//! The functions that the page's script calls.

use coadjoint_codegen::poly::Numeric;
use serde::Serialize;
use wasm_bindgen::prelude::wasm_bindgen;

use crate::fields::Fields;
use crate::file::Mistake;
use crate::formula;
use crate::orbit::{Curve, Orbit};
use crate::run::Animation;
use crate::system::{Component, START, System};

/// The systems to choose from, as JSON: `[{id, title, family, about, fields}]`.
#[wasm_bindgen]
pub fn gallery() -> String {
    json(&crate::gallery::gallery())
}

/// The groups of the catalogue with a name, as JSON: `[[name, summary]]`.
#[wasm_bindgen]
pub fn groups() -> String {
    use coadjoint_codegen::lie::catalogue::{names, summary};
    let list: Vec<(&str, String)> =
        names().iter().map(|name| (*name, summary(name).unwrap_or_default())).collect();
    json(&list)
}

fn json(value: &impl Serialize) -> String {
    // Of texts, numbers and lists alone.
    serde_json::to_string(value).unwrap_or_default()
}

#[wasm_bindgen]
#[derive(Debug)]
pub struct Session {
    system: System,
    run: Animation,
    orbit: Option<Orbit>,
}

/// The facts that a page shows of a system.
#[derive(Serialize)]
struct About<'a> {
    name: &'a str,
    group: &'a str,
    dim: usize,
    coordinates: &'a [String],
    order: usize,
    chart: &'a str,
    step: f64,
    momentum: &'a [f64],
    conserves_energy: bool,
    /// The orders of a series, and how many terms each has.
    terms: Vec<(usize, usize)>,
    comoving: bool,
    casimirs: Vec<String>,
    factors: &'a [Component],
    /// Triples of coordinates that stay on a sphere.
    spheres: Vec<[usize; 3]>,
    /// The second derivatives of H in the first three coordinates, and all first ones.
    inverse_inertia: Vec<f64>,
    slope: Vec<f64>,
    time_unit: Option<&'a str>,
    substeps: usize,
    cost: [usize; 2],
}

#[wasm_bindgen]
impl Session {
    /// A session of these fields, given as JSON; or, as an error, the mistakes as JSON.
    #[wasm_bindgen(constructor)]
    pub fn new(fields: &str) -> Result<Session, String> {
        let fields: Fields = serde_json::from_str(fields).map_err(|error| {
            json(&[Mistake::of_all(format!("the state is not readable: {error}"), None)])
        })?;
        let system = System::new(&fields).map_err(|mistakes| json(&mistakes))?;
        let run = Animation::new(&system, &system.momentum);
        Ok(Self { system, run, orbit: None })
    }

    /// The facts that a page shows of the system, as JSON.
    pub fn about(&self) -> String {
        let System { step, factors, momentum, units, .. } = &self.system;
        let (origin, series) = (&self.system.origin, self.system.series());
        let (facts, n) = (origin.facts(), self.system.dim());
        let programs = &step.kernel().programs;
        let list = [&programs.guess, &programs.correct, &programs.accept, &programs.transport];
        let ours = list.iter().map(|program| program.cost().total()).sum();
        let terms = series.map_or_else(Vec::new, |integrator| {
            let orders = (1..=facts.truncation).step_by(2);
            orders.map(|k| (k, integrator.series.order(k).len())).collect()
        });
        let [slope, curvature] = self.system.slopes();
        let leading = n.min(3);
        json(&About {
            name: facts.name,
            group: facts.algebra.name(),
            dim: n,
            coordinates: facts.coordinates,
            order: facts.truncation + 1,
            chart: series.map_or("exp", |integrator| integrator.problem.chart.name()),
            step: self.system.h,
            momentum,
            conserves_energy: self.system.invariants.energy,
            terms,
            comoving: series.is_some_and(|integrator| integrator.problem.comoving.is_some()),
            casimirs: self
                .system
                .casimirs
                .iter()
                .enumerate()
                .map(|(i, exact)| {
                    formula::equation(
                        &format!("<msub><mi>C</mi><mn>{}</mn></msub>", i + 1),
                        exact,
                        origin,
                    )
                })
                .collect(),
            factors,
            spheres: spheres(factors),
            inverse_inertia: (0..leading * leading)
                .map(|at| curvature[at / leading * n + at % leading])
                .collect(),
            slope,
            time_unit: units.time.as_deref(),
            substeps: self.run.substeps,
            cost: [ours, self.system.rival.cost()],
        })
    }

    /// The run anew, from this momentum.
    pub fn restart(&mut self, momentum: &[f64]) {
        if momentum.len() == self.system.dim() {
            self.run = Animation::new(&self.system, momentum);
        }
    }

    /// Makes up to `steps` steps; returns how many were made.
    pub fn advance(&mut self, steps: u32) -> u32 {
        self.run.advance(&self.system, steps)
    }

    /// The refusal of the next step as JSON `{reason, text, usable}`; nothing if the step was not refused.
    pub fn refusal(&self) -> Option<String> {
        #[derive(Serialize)]
        struct Shown {
            reason: String,
            text: String,
            usable: Option<f64>,
        }
        self.run.refusal.as_ref().map(|refusal| {
            let reason = format!("{:?}", refusal.reason);
            json(&Shown { reason, text: refusal.reason.text().to_owned(), usable: refusal.usable })
        })
    }

    pub fn time(&self) -> f64 {
        self.run.time()
    }

    pub fn steps(&self) -> f64 {
        self.run.steps as f64
    }

    pub fn energy(&self) -> f64 {
        self.run.energy(&self.system)
    }

    pub fn momentum(&self) -> Vec<f64> {
        self.run.momentum().to_vec()
    }

    /// The matrices of the group element, before and after the last step, row by row.
    pub fn matrices(&self) -> Vec<f64> {
        self.run.matrices(&self.system)
    }

    /// μ a part of the way from the last state but one to the last, for pictures.
    pub fn between(&self, part: f64) -> Vec<f64> {
        self.run.between(part)
    }

    /// The recent trail of three coordinates of μ, as points (x, y, z); coordinates that do not exist are 0.
    pub fn trail(&self, of_rival: bool, a: usize, b: usize, c: usize, part: f64) -> Vec<f32> {
        self.run.trail(of_rival, [a, b, c], part)
    }

    /// The drifts so far, seven numbers a moment: t, then energy, momentum, Casimirs, ours and the rival's.
    pub fn history(&self) -> Vec<f64> {
        let samples = self.run.history.samples.iter();
        samples
            .flat_map(|sample| [sample.time].into_iter().chain(sample.drifts.into_iter().flatten()))
            .collect()
    }

    /// The largest drifts so far: energy, momentum, Casimirs, ours and the rival's.
    pub fn most(&self) -> Vec<f64> {
        self.run.history.most.into_iter().flatten().collect()
    }

    /// The level curves of the energy on the orbit of this momentum, where the algebra has three dimensions and a
    /// Casimir: the radius of a sphere or 0, the extent, how many curves are of spread levels; then for each curve how
    /// many points it has, and those with the surface's normals, six numbers each.
    pub fn curves(&mut self, momentum: &[f64]) -> Vec<f32> {
        let energy = self.system.energy();
        // An energy that moves in time has no curves.
        let conserved = self.system.invariants.energy;
        // A momentum dragged over its sphere changes only its own curve.
        if !self.orbit.as_ref().is_some_and(|orbit| orbit.holds(momentum)) {
            self.orbit = match (&self.system.casimirs[..], self.system.dim(), momentum.len()) {
                ([casimir], 3, 3) if conserved => {
                    Orbit::new(&energy, &Numeric::new(casimir, 3, &[]), momentum)
                }
                _ => None,
            };
        }
        let Some(Orbit { surface, spread, .. }) = &self.orbit else { return Vec::new() };
        let own = self.orbit.as_ref().map(|orbit| orbit.level(energy.value(START, momentum)));
        let mut out =
            vec![surface.radius.unwrap_or(0.0) as f32, surface.extent as f32, spread.len() as f32];
        let mut push = |curve: &Curve| {
            out.push(curve.len() as f32);
            out.extend(curve.iter().flatten().map(|&x| x as f32));
        };
        spread.iter().chain(own.iter().flatten()).for_each(&mut push);
        out
    }

    /// H, and where it is a polynomial S₁, S₃, …, as MathML, a JSON list.
    pub fn formulas(&self) -> String {
        let origin = &self.system.origin;
        let Some(integrator) = origin.series() else {
            let source = origin.smooth().map_or("", |smooth| &smooth.source);
            return json(&[formula::written("<mi>H</mi>", source)]);
        };
        let problem = &integrator.problem;
        let mut list = vec![formula::equation("<mi>H</mi>", &problem.hamiltonian, origin)];
        if let Some(frame) = &problem.comoving {
            list.push(formula::equation("<mi>f</mi>", &frame.energy(), origin));
        }
        let orders = (1..=problem.truncation).step_by(2);
        let of = |k| formula::equation(&formula::order(k), integrator.series.order(k), origin);
        list.extend(orders.map(of));
        json(&list)
    }

    /// The system file.
    pub fn file(&self) -> String {
        self.system.file.clone()
    }
}

/// Triples of coordinates that stay on a sphere: of rotations, and the translations' of motions.
fn spheres(factors: &[Component]) -> Vec<[usize; 3]> {
    use crate::system::Depiction;
    let triple = |start: usize| [start, start + 1, start + 2];
    factors
        .iter()
        .filter_map(|factor| match factor.kind {
            Depiction::Rotation => Some(triple(factor.coordinate)),
            Depiction::Motion => Some(triple(factor.coordinate + 3)),
            _ => None,
        })
        .collect()
}
