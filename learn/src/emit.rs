//! A learned polynomial as a system for the code generator.

use coadjoint_codegen::lie::Chart;
use coadjoint_codegen::number::Rational;
use coadjoint_codegen::poly::Polynomial;
use coadjoint_codegen::problem::{FrameChoice, Problem};
use num_traits::{FromPrimitive, One, Zero};

use crate::error::LearnError;
use crate::model::Model;
use crate::polynomial::PolynomialModel;
use crate::save::ModelFile;

/// The exact monomial form of a polynomial model: every coefficient is the rational the
/// floating-point numbers of the model stand for.
///
/// # Errors
/// [`LearnError::NotConverged`] for a number that is not finite.
pub fn exact_polynomial(model: &PolynomialModel) -> Result<Polynomial, LearnError> {
    let dim = model.basis().dim();
    let exact = |value: f64| {
        Rational::from_f64(value).ok_or_else(|| {
            LearnError::NotConverged(format!("the coefficient {value} is not a number"))
        })
    };
    // T_k(u_i) with u_i = (p_i − centre)/half_width, for every coordinate and degree.
    let mut tables = Vec::with_capacity(dim);
    for i in 0..dim {
        let width = exact(model.scaling().half_width[i])?;
        let shift = -exact(model.scaling().centre[i])? / &width;
        let slope = Rational::one() / width;
        let variable = Polynomial::variable(dim, i).scale(&slope);
        let u = &variable + &Polynomial::constant(dim, shift);
        let twice = u.scale(&Rational::from_integer(2.into()));
        let mut row = vec![Polynomial::constant(dim, Rational::one()), u];
        for k in 2..=model.basis().degree() {
            row.push(&(&twice * &row[k - 1]) - &row[k - 2]);
        }
        tables.push(row);
    }
    let mut sum = Polynomial::zero(dim);
    for (term, coefficient) in model.basis().terms().zip(model.coefficients()) {
        let value = exact(*coefficient)?;
        if value.is_zero() {
            continue;
        }
        let mut product = Polynomial::constant(dim, value);
        for (row, &k) in tables.iter().zip(term) {
            if k > 0 {
                product = &product * &row[usize::from(k)];
            }
        }
        sum = &sum + &product;
    }
    Ok(sum)
}

/// The system whose integrator of truncation 1 is the learned map: with H = S/Δt, S₁·Δt is S.
/// Built with the step Δt the emitted integrator is the model, to rounding; other steps mean
/// nothing.
///
/// # Errors
/// [`LearnError::InvalidOption`] for models that are no polynomials, [`LearnError::UnknownGroup`] for groups that are none.
pub fn problem(file: &ModelFile, name: &str) -> Result<Problem, LearnError> {
    let Model::Polynomial(model) = &file.model else {
        let requirement = "only polynomial models are programs: they alone are emitted, derived and run in ensembles";
        return Err(LearnError::option("model", file.model.name(), requirement));
    };
    let algebra = file.group.algebra()?;
    let chart = if file.chart == "cayley" { Chart::Cayley } else { Chart::Exponential };
    let step = Rational::from_f64(file.step).unwrap_or_else(Rational::one);
    let polynomial = exact_polynomial(model)?;
    let hamiltonian = polynomial.scale(&(Rational::one() / step));
    Ok(Problem {
        solver: None,
        frame: FrameChoice::Fixed,
        comoving: None,
        name: name.into(),
        coordinates: (1..=algebra.dim()).map(|i| format!("mu_{i}")).collect(),
        algebra,
        hamiltonian,
        symbols: Vec::new(),
        parameters: Vec::new(),
        source: format!("learned from {} samples, dt = {}", file.training.samples, file.step),
        chart,
        truncation: 1,
        learned: true,
    })
}
