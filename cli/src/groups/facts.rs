//! Description about a group, computed from its algebra.

use std::collections::BTreeMap;

use coadjoint_codegen::lie::{Chart, LieAlgebra, RationalMatrix, casimirs, catalogue};
use coadjoint_codegen::number::Rational;
use coadjoint_codegen::poly::Polynomial;
use coadjoint_run::series::sum;
use num_traits::Zero;

use crate::error::CliError;

/// The largest number of monomials of one degree among which Casimirs are looked for.
const MONOMIALS: u128 = 1000;
/// An algebra of more dimensions is described by its factors.
pub(crate) const LARGEST: usize = 24;

/// A group of the catalogue, or a product.
pub(crate) struct Description {
    /// Its algebra.
    pub algebra: LieAlgebra,
    /// A description in a few words.
    pub summary: Option<String>,
    /// True if the basis is written as complex matrices.
    pub complex: bool,
    /// True if the algebra is nilpotent: exp is then regular at every x.
    pub nilpotent: bool,
    /// The reason for which there is no Cayley chart.
    pub no_cayley: Option<String>,
    /// The degree up to which Casimirs were looked for.
    pub degree: u32,
    /// Generators of the polynomial Casimirs of at most this degree.
    pub casimirs: Vec<Polynomial>,
}

impl Description {
    /// Looks a group up; Casimirs are looked for by [`Description::with_casimirs`].
    pub(crate) fn new(name: &str) -> Result<Self, CliError> {
        let algebra = catalogue::lookup(name).map_err(|error| refused(&error))?;
        let factors = algebra.factors();
        let summary = catalogue::summary(algebra.name());
        // The families of complex matrices; SO2 has the same form, but is real.
        let name = algebra.name();
        let family = name.starts_with("SU") || name.starts_with('U');
        Ok(Self {
            complex: family && summary.is_some(),
            summary,
            nilpotent: factors.iter().all(LieAlgebra::is_nilpotent),
            no_cayley: Chart::Cayley.check(&algebra).err().map(|error| error.to_string()),
            degree: 0,
            casimirs: Vec::new(),
            algebra,
        })
    }

    /// Finds the Casimirs up to this degree; 0 stands for as high as is quick, 4 at most.
    pub(crate) fn with_casimirs(mut self, degree: u32) -> Result<Self, CliError> {
        let quick = |factor: &LieAlgebra| {
            (1..=4).rev().find(|&d| monomials(factor.dim(), d) <= MONOMIALS).unwrap_or(1)
        };
        self.degree = match degree {
            0 => self.algebra.factors().iter().map(quick).min().unwrap_or(1),
            degree => degree,
        };
        self.casimirs = casimirs(&self.algebra, self.degree)
            .map_err(|error| refused(&format!("{error}: --degree {}", self.degree)))?;
        Ok(self)
    }

    /// The size of the group's matrices.
    pub(crate) fn size(&self) -> Option<usize> {
        self.algebra.basis().and_then(<[_]>::first).map(RationalMatrix::rows)
    }

    /// A basis matrix as a sum of matrices E(a,b) with a one in row a and column b; of A + iB in (A, -B; B, A).
    pub(crate) fn entries(&self, matrix: &RationalMatrix) -> String {
        let n = if self.complex { matrix.rows() / 2 } else { matrix.rows() };
        let name = |a: usize, b: usize| match a < n {
            true => format!("E({},{})", a + 1, b + 1),
            false => format!("i*E({},{})", a - n + 1, b + 1),
        };
        let (names, terms): (Vec<_>, Vec<_>) = matrix
            .entries()
            .filter(|(_, b, _)| *b < n)
            .enumerate()
            .map(|(k, (a, b, value))| (name(a, b), (vec![k], value.clone())))
            .unzip();
        written(&names, terms)
    }

    /// The brackets \[e_i, e_j\], i < j, that are not zero: i and j from 1, and the value.
    pub(crate) fn brackets(&self) -> Vec<(usize, usize, String)> {
        let mut found: BTreeMap<(usize, usize), Vec<Term>> = BTreeMap::new();
        for c in self.algebra.structure().iter().filter(|c| c.i < c.j) {
            found.entry((c.i + 1, c.j + 1)).or_default().push((vec![c.k], c.value.clone()));
        }
        let names = self.names(&["e"]);
        found.into_iter().map(|((i, j), terms)| (i, j, written(&names, terms))).collect()
    }

    /// (ad*_ξ μ)_j = Σ ξ_i c_ij^l μ_l, written out for j from 0.
    pub(crate) fn ad_star(&self, j: usize) -> String {
        let terms = self.algebra.structure().iter().filter(|c| c.j == j);
        let dim = self.algebra.dim();
        let terms = terms.map(|c| (vec![c.i, dim + c.k], c.value.clone())).collect();
        written(&self.names(&["ξ", "μ"]), terms)
    }

    /// Names of coordinates with these letters, counted from 1.
    fn names(&self, letters: &[&str]) -> Vec<String> {
        let indices = 1..=self.algebra.dim();
        letters.iter().flat_map(|name| indices.clone().map(move |i| format!("{name}{i}"))).collect()
    }

    /// True if the algebra has the structure constants of this group.
    fn is_like(&self, name: &str) -> bool {
        catalogue::lookup(name).is_ok_and(|it| it.structure() == self.algebra.structure())
    }

    /// ad* in vectors, where the algebra has the constants of SO3 or SE3.
    pub(crate) fn ad_star_in_vectors(&self) -> Option<&'static str> {
        let known =
            [("SO3", "ad*_ξ μ = μ × ξ"), ("SE3", "ad*_(ω, v) (Π, P) = (Π × ω + P × v, P × ω)")];
        known.into_iter().find(|(name, _)| self.is_like(name)).map(|(_, formula)| formula)
    }

    /// True if tr ad_x is zero for every x.
    fn is_unimodular(&self) -> bool {
        let mut traces: BTreeMap<usize, Rational> = BTreeMap::new();
        for c in self.algebra.structure().iter().filter(|c| c.j == c.k) {
            *traces.entry(c.i).or_default() += &c.value;
        }
        traces.values().all(Zero::is_zero)
    }

    /// The domain of exp as a chart of the runtime.
    pub(crate) fn exp_domain(&self) -> String {
        const GENERAL: &str = "|Im λ| < π for every eigenvalue λ of ad_x";
        if self.nilpotent {
            return "all x: the algebra is nilpotent".to_owned();
        }
        let known = [
            ("SO3", "that is |x| < π: a half turn"),
            ("SE3", "that is |ω| < π for x = (ω, v)"),
            ("SE2", "that is |x1| < π"),
        ];
        if let Some((_, meaning)) = known.into_iter().find(|(name, _)| self.is_like(name)) {
            return format!("{GENERAL}, {meaning}");
        }
        if !self.is_unimodular() {
            return format!(
                "{GENERAL}, and |tr ad_x| < π (the group is not unimodular: a step may stretch by e^π at most)"
            );
        }
        GENERAL.to_owned()
    }

    /// The domain of Cayley's map as a chart, or the reason for which it is none.
    pub(crate) fn cayley_domain(&self) -> Result<&'static str, &str> {
        let turns = ["SO3", "SE3"].contains(&self.algebra.name());
        match &self.no_cayley {
            Some(why) => Err(why),
            None if turns => Ok(
                "(1 - x/2)^-1 (1 + x/2) in the matrices; a turn by 2 atan(|ω|/2), to |ω| = 2: a quarter turn",
            ),
            None => Ok("(1 - x/2)^-1 (1 + x/2) in the matrices, where 1 - x/2 is well conditioned"),
        }
    }

    /// A Casimir in μ1, μ2, ….
    pub(crate) fn casimir(&self, casimir: &Polynomial) -> String {
        sum(casimir, &self.names(&["μ"]), &[])
    }
}

/// Variables to be multiplied, and a coefficient.
type Term = (Vec<usize>, Rational);

/// A sum of such terms in variables with these names.
fn written(names: &[String], terms: Vec<Term>) -> String {
    let factors = |list: Vec<usize>| list.into_iter().map(|i| (i as u32, 1)).collect();
    let terms = terms.into_iter().map(|(list, value)| (factors(list), value));
    sum(&Polynomial::from_factors(names.len(), terms), names, &[])
}

fn refused(reason: &dyn std::fmt::Display) -> CliError {
    CliError::Option(format!("groups: {reason}"))
}

/// The number of monomials of this degree in `n` variables.
fn monomials(n: usize, degree: u32) -> u128 {
    (1..=u128::from(degree)).fold(1, |product, k| product.saturating_mul(n as u128 + k - 1) / k)
}
