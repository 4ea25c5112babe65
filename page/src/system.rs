//! A system ready to run: derived, lowered, folded for its step size.

use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::lie::{self, LieAlgebra, catalogue};
use coadjoint_codegen::poly::{Numeric, Polynomial};
use coadjoint_codegen::problem::{Problem, values};
use coadjoint_codegen::step::{Energy, Invariants, Step};
use coadjoint_codegen::system::{self, Options, Units};

use crate::fields::Fields;
use crate::file::File;
use crate::file::Mistake;
use crate::rival::Rival;

/// Steps of more operations than this are too slow for a page.
const MOST_OPERATIONS: usize = 60_000;
/// Series may become this large: beyond, a page would stand still.
pub const LIMIT: TermLimit = TermLimit { terms: 20_000, products: 4_000_000 };

/// The kind of a factor of the group, for pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// SO(3), or SU(2) as the real matrices of quaternions.
    Rotation,
    Motion,
    Plane,
    Matrix,
}

#[derive(Clone, Debug, serde::Serialize)]
pub struct Factor {
    /// Rotations, vectors or other.
    pub kind: Kind,
    /// Where its coordinates begin, and how many there are.
    pub coordinate: usize,
    pub dim: usize,
    /// The first row of its block in the matrix of the group.
    pub row: usize,
    pub size: usize,
}

#[derive(Debug)]
pub struct System {
    pub file: String,
    /// The integrator, with numbers for the parameters.
    pub integrator: Integrator,
    /// A step as programs.
    pub step: Step,
    /// Their folded coefficients.
    pub slots: Vec<f64>,
    pub h: f64,
    /// μ at the start.
    pub momentum: Vec<f64>,
    pub energy: Numeric,
    pub casimirs: Vec<Polynomial>,
    /// The conserved quantities, as numbers.
    pub invariants: Invariants,
    pub factors: Vec<Factor>,
    /// Runge and Kutta's method of order four for the same equations.
    pub rival: Rival,
    pub units: Units,
}

impl System {
    /// The system of these fields.
    pub fn new(fields: &Fields) -> Result<Self, Vec<Mistake>> {
        let file = File::of(fields);
        let read = match system::read(&file.text, Options::default()) {
            Ok(read) if file.unwritten.is_empty() => read,
            Ok(_) => return Err(file.unwritten),
            Err(diagnostics) => return Err(file.mistakes(&diagnostics)),
        };
        let problem = read.problem;
        let h = read.run.step.unwrap_or(0.1);
        let Some(momentum) = read.run.momentum else {
            return Err(vec![Mistake::of(
                "momentum",
                "the momentum at the start is missing",
                "give a number for each coordinate",
            )]);
        };
        let integrator = Integrator::build(problem, LIMIT)
            .map_err(|error| vec![Mistake::of("truncation", error, "lower the truncation")])?;
        let refused = |error: &dyn std::fmt::Display| vec![Mistake::of_all(error, None)];
        let step = Step::build(&integrator).map_err(|error| refused(&error))?;
        let programs = &step.kernel().programs;
        let operations = programs.correct.nodes().len() + programs.transport.nodes().len();
        if operations > MOST_OPERATIONS {
            let message = format!(
                "a step has {operations} operations, more than the {MOST_OPERATIONS} that this page runs"
            );
            return Err(vec![Mistake::of("truncation", message, "lower the truncation")]);
        }
        let slots = step.fold(h, &[]).map_err(|error| refused(&error))?;
        let Problem { algebra, hamiltonian, symbols, .. } = &integrator.problem;
        let energy = Numeric::new(hamiltonian, algebra.dim(), &values(symbols));
        let invariants = Invariants::new(algebra, Energy::Polynomial(energy.clone()), None);
        let casimirs = lie::watched_casimirs(algebra);
        let factors = factors(algebra);
        let rival = Rival::new(algebra, &energy);
        Ok(Self {
            file: file.text,
            integrator,
            step,
            slots,
            h,
            momentum,
            energy,
            casimirs,
            invariants,
            factors,
            rival,
            units: read.units,
        })
    }

    pub fn dim(&self) -> usize {
        self.integrator.problem.algebra.dim()
    }
}

/// The factors of a group as the programs of its steps have them.
fn factors(algebra: &LieAlgebra) -> Vec<Factor> {
    let (mut coordinate, mut row) = (0, 0);
    let factor = |factor: LieAlgebra| {
        let is = |name: &str| {
            catalogue::lookup(name).is_ok_and(|known| known.renamed(factor.name()) == factor)
        };
        let dim = factor.dim();
        let size = factor.matrix_size();
        let kind = match () {
            () if is("SO3") || is("SU2") => Kind::Rotation,
            () if is("SE3") => Kind::Motion,
            () if is("SE2") => Kind::Plane,
            () => Kind::Matrix,
        };
        let found = Factor { kind, coordinate, dim, row, size };
        (coordinate, row) = (coordinate + dim, row + size);
        found
    };
    algebra.factors().into_iter().map(factor).collect()
}
