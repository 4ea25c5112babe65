//! A learned S of any kind, the file that holds it (`model.json`), and its system for the code generator.

use std::path::Path;

use coadjoint_codegen::diagnostic::read_text;
use coadjoint_codegen::file;
use coadjoint_codegen::lie::Chart;
use coadjoint_codegen::number::Rational;
use coadjoint_codegen::poly::Polynomial;
use coadjoint_codegen::problem::{FrameChoice, Problem};
use nalgebra::DMatrix;
use num_traits::{FromPrimitive, One, Zero};
use serde::{Deserialize, Serialize};

use crate::error::LearnError;
use crate::evaluate::Figures;
use crate::function::MomentumFunction;
use crate::gaussian_process::GaussianProcess;
use crate::group::GroupChoice;
use crate::network::{DenseNetwork, Progress, TrainingOptions, fit_network};
use crate::polynomial::{Candidate, PolynomialModel, fit_gradients};

/// A learned S, of any kind.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Model {
    /// A polynomial in the Chebyshev basis.
    Polynomial(PolynomialModel),
    /// A Gaussian process conditioned on gradients.
    GaussianProcess(GaussianProcess),
    /// A dense network.
    Network(DenseNetwork),
    /// A polynomial and a network fitted to its residual.
    Hybrid {
        /// The polynomial.
        polynomial: PolynomialModel,
        /// The network, fitted to the residual.
        network: DenseNetwork,
    },
}

impl Model {
    /// The name users write: `polynomial`, `gp`, `network`, `hybrid`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Polynomial(_) => "polynomial",
            Self::GaussianProcess(_) => "gp",
            Self::Network(_) => "network",
            Self::Hybrid { .. } => "hybrid",
        }
    }

    /// The function itself, or the two of which it is the sum.
    fn parts(&self) -> (&dyn MomentumFunction, Option<&dyn MomentumFunction>) {
        match self {
            Self::Polynomial(polynomial) => (polynomial, None),
            Self::GaussianProcess(process) => (process, None),
            Self::Network(network) => (network, None),
            Self::Hybrid { polynomial, network } => (polynomial, Some(network)),
        }
    }
}

impl MomentumFunction for Model {
    fn dim(&self) -> usize {
        self.parts().0.dim()
    }

    fn value(&self, p: &[f64]) -> f64 {
        let (first, second) = self.parts();
        first.value(p) + second.map_or(0.0, |second| second.value(p))
    }

    fn gradient(&self, p: &[f64], gradient: &mut [f64]) {
        let (first, second) = self.parts();
        first.gradient(p, gradient);
        if let Some(second) = second {
            let mut rest = vec![0.0; gradient.len()];
            second.gradient(p, &mut rest);
            gradient.iter_mut().zip(&rest).for_each(|(a, b)| *a += b);
        }
    }

    fn gradient_and_hessian(&self, p: &[f64], gradient: &mut [f64], hessian: &mut [f64]) {
        let (first, second) = self.parts();
        first.gradient_and_hessian(p, gradient, hessian);
        if let Some(second) = second {
            let mut rest = (vec![0.0; gradient.len()], vec![0.0; hessian.len()]);
            second.gradient_and_hessian(p, &mut rest.0, &mut rest.1);
            gradient.iter_mut().zip(&rest.0).for_each(|(a, b)| *a += b);
            hessian.iter_mut().zip(&rest.1).for_each(|(a, b)| *a += b);
        }
    }

    fn rounding(&self) -> f64 {
        let (first, second) = self.parts();
        second.map_or(1.0, MomentumFunction::rounding).max(first.rounding())
    }
}

/// Fits a polynomial of total degree `degree` to the gradients of a function at points, a sample per column, then a
/// network to the normalised residual; also returns the network's loss after every evaluation.
///
/// # Errors
/// As [`fit_gradients`] and [`fit_network`].
pub fn fit_hybrid(
    points: &DMatrix<f64>,
    gradients: &DMatrix<f64>,
    degree: usize,
    options: &TrainingOptions,
    progress: &mut dyn FnMut(Progress),
) -> Result<(Model, Vec<f64>), LearnError> {
    let polynomial = fit_gradients(points, gradients, degree, 0.0)?;
    let mut rest = gradients.clone();
    let mut slope = vec![0.0; points.nrows()];
    for i in 0..points.ncols() {
        polynomial.gradient(points.column(i).as_slice(), &mut slope);
        for (j, s) in slope.iter().enumerate() {
            rest[(j, i)] -= s;
        }
    }
    let (network, history) = fit_network(points, &rest, None, options, progress)?;
    Ok((Model::Hybrid { polynomial, network }, history))
}

/// The first field of every model file.
const FORMAT: &str = "coadjoint-model";
/// The version this build writes, and the only one it reads.
const VERSION: u32 = 1;

/// The record of a model's training.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TrainingRecord {
    /// The number of samples of the fit.
    pub samples: usize,
    /// The seed of everything random in the fit.
    pub seed: u64,
    /// The choice and its reason, in a sentence.
    pub choice: String,
    /// The candidates of a cross-validation, if there was one.
    pub candidates: Vec<Candidate>,
    /// The loss after every step of an iterative fit.
    pub history: Vec<f64>,
    /// The errors on the training data.
    pub train: Option<Figures>,
}

/// A learned generating function with all that is needed to use it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModelFile {
    format: String,
    version: u32,
    /// The group.
    pub group: GroupChoice,
    /// The chart's name: `exp` or `cayley`.
    pub chart: String,
    /// Δt, the time one application of the map stands for.
    pub step: f64,
    /// True if the data held attitudes. If not, only the map of momenta was learned, and attitudes must not be reconstructed
    /// from it.
    pub attitude: bool,
    /// The record of its training.
    pub training: TrainingRecord,
    /// The function S.
    pub model: Model,
}

impl ModelFile {
    /// A model of the group, chart and step given.
    pub fn new(
        group: impl Into<GroupChoice>,
        chart: impl Into<String>,
        step: f64,
        attitude: bool,
        model: Model,
        training: TrainingRecord,
    ) -> Self {
        let (format, version) = (FORMAT.into(), VERSION);
        let (group, chart) = (group.into(), chart.into());
        Self { format, version, group, chart, step, attitude, training, model }
    }

    /// Writes the model as JSON; numbers read back to the same bits.
    ///
    /// # Errors
    /// [`LearnError::File`] when the file cannot be written.
    pub fn save(&self, path: &Path) -> Result<(), LearnError> {
        let fail = LearnError::file(path);
        file::write(path, &[], self.text().map_err(&fail)?.as_bytes()).map_err(fail)
    }

    /// The model as JSON, as [`ModelFile::save`] writes it.
    ///
    /// # Errors
    /// Fails if the model cannot be serialized.
    pub fn text(&self) -> Result<String, std::io::Error> {
        Ok(serde_json::to_string(self)? + "\n")
    }

    /// Reads a model.
    ///
    /// # Errors
    /// [`LearnError::File`] when the file cannot be read, [`LearnError::Model`] when it is damaged,
    /// of another version, or something else altogether.
    pub fn load(path: &Path) -> Result<Self, LearnError> {
        let text = read_text(path).map_err(|source| match source.kind() {
            std::io::ErrorKind::InvalidData => {
                LearnError::Model(path.into(), "it is not a text file; models are JSON".into())
            }
            _ => LearnError::file(path)(source),
        })?;
        Self::of_text(path, &text)
    }

    /// Reads a model from its text; `path` is what mistakes call it.
    ///
    /// # Errors
    /// [`LearnError::Model`] when it is damaged, of another version, or something else altogether.
    pub fn of_text(path: &Path, text: &str) -> Result<Self, LearnError> {
        let fail = |reason: String| LearnError::Model(path.into(), reason);
        // The kind of file is checked first, so that the message is about that.
        let value: serde_json::Value =
            serde_json::from_str(text).map_err(|e| fail(format!("it is not whole JSON: {e}")))?;
        if value.get("format").and_then(|f| f.as_str()) != Some(FORMAT) {
            return Err(fail(format!("its field `format` is not `{FORMAT}`")));
        }
        let version = value.get("version").and_then(serde_json::Value::as_u64);
        if version != Some(u64::from(VERSION)) {
            let found = version.map_or("no version".into(), |v| format!("version {v}"));
            return Err(fail(format!("it has {found}; this build reads version {VERSION}")));
        }
        let file: Self = serde_json::from_value(value).map_err(|e| fail(e.to_string()))?;
        if !(file.step.is_finite() && file.step != 0.0) {
            return Err(fail(format!("its step {} is not a usable time", file.step)));
        }
        if file.model.dim() == 0 {
            return Err(fail("its model has no coordinates".into()));
        }
        Ok(file)
    }
}

/// The exact monomial form of a polynomial model: every coefficient is the rational the
/// floating-point numbers of the model stand for.
///
/// # Errors
/// [`LearnError::NotConverged`] for a number that is not finite.
pub fn exact_polynomial(model: &PolynomialModel) -> Result<Polynomial, LearnError> {
    let dim = model.dim();
    let exact = |value: f64| {
        Rational::from_f64(value).ok_or_else(|| {
            LearnError::NotConverged(format!("the coefficient {value} is not a number"))
        })
    };
    // T_k(u_i) with u_i = (p_i − centre)/half_width, for every coordinate and degree.
    let mut tables = Vec::with_capacity(dim);
    for i in 0..dim {
        let width = exact(model.scaling.half_width[i])?;
        let shift = -exact(model.scaling.centre[i])? / &width;
        let slope = Rational::one() / width;
        let variable = Polynomial::variable(dim, i).scale(&slope);
        let u = &variable + &Polynomial::constant(dim, shift);
        let twice = u.scale(&Rational::from_integer(2.into()));
        let mut row = vec![Polynomial::constant(dim, Rational::one()), u];
        for k in 2..=model.basis.degree {
            row.push(&(&twice * &row[k - 1]) - &row[k - 2]);
        }
        tables.push(row);
    }
    let mut sum = Polynomial::zero(dim);
    for (term, coefficient) in model.basis.terms().zip(&model.coefficients) {
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
