//! The last step of every front end: checks, and the finished problem.

use num_integer::Integer;

use super::coefficient::{ONE, Table};
use super::polynomial::{Sum, polynomial};
use super::sums::name_sums;
use crate::comoving::comoving;
use crate::diagnostic::{Diagnostics, Mistake, Span};
use crate::expr::{Arena, ExprId};
use crate::lie::{Chart, LieAlgebra};
use crate::number::Rational;
use crate::poly::Polynomial;
use crate::potential::{Potential, matrix_size};
use crate::problem::{FrameChoice, Parameter, Problem, Solver, Symbol};

/// The truncation where none is given: order of accuracy 8.
pub const DEFAULT_TRUNCATION: usize = 7;

/// The largest truncation accepted.
pub const MAX_TRUNCATION: usize = 63;

/// The result of a front end. A field is `None` where the input was wrong, which has then been reported.
#[derive(Clone, Debug)]
pub struct Draft {
    /// The name of the system.
    pub name: String,
    /// The Lie algebra 𝔤.
    pub algebra: Option<LieAlgebra>,
    /// The names of the momentum's coordinates.
    pub coordinates: Vec<String>,
    /// The place where the coordinates are named.
    pub coordinates_span: Span,
    /// The nodes of the Hamiltonian's expression.
    pub arena: Arena,
    /// The Hamiltonian itself, and where it stands.
    pub hamiltonian: Option<(ExprId, Span)>,
    /// The parameters.
    pub parameters: Vec<Parameter>,
    /// The Hamiltonian as the user wrote it.
    pub source: String,
    /// The chart, and where it is given.
    pub chart: (Chart, Span),
    /// The truncation K.
    pub truncation: Option<usize>,
    /// The solver, if one is asked for.
    pub solver: Option<Solver>,
    /// The frame, and where it is given.
    pub frame: (FrameChoice, Span),
}

/// Checks what was read and turns it into a problem.
///
/// # Errors
/// All mistakes: those already in `diagnostics`, and those found here.
pub fn assemble(draft: Draft, mut diagnostics: Diagnostics) -> Result<Problem, Diagnostics> {
    let report = &mut diagnostics;
    let count = draft.coordinates.len();
    if let Some(algebra) = &draft.algebra {
        if count != algebra.dim() {
            let mistake = Mistake::Dimension(count, algebra.name().to_owned(), algebra.dim());
            report.report(draft.coordinates_span, mistake);
        }
        check_chart(draft.chart.0, algebra, draft.chart.1, report);
    }
    let mut table = Table::new();
    let root = draft.hamiltonian.map(|(root, _)| root);
    let sum = polynomial(&draft.arena, root, &mut table, report);
    if let (Some(sum), Some((_, span))) = (&sum, draft.hamiltonian)
        && sum.terms.keys().all(Vec::is_empty)
    {
        report.report(span, Mistake::NoDependence);
    }
    if !diagnostics.is_empty() {
        return Err(diagnostics);
    }
    let (Some(algebra), Some(sum), Some(truncation)) = (draft.algebra, sum, draft.truncation)
    else {
        diagnostics.report(Span::Whole, Mistake::Unreadable);
        return Err(diagnostics);
    };

    let (mut hamiltonian, mut symbols) = exact(sum, count, &mut table, &draft.parameters);
    let mut frame = None;
    if let (FrameChoice::Comoving, span) = draft.frame {
        let Some(found) = comoving(&algebra, draft.chart.0, &hamiltonian) else {
            diagnostics.report(span, Mistake::NoFrame);
            return Err(diagnostics);
        };
        let names: Vec<String> =
            draft.parameters.iter().flat_map(Parameter::scalar_names).collect();
        frame = Some(name_sums(&found, count, &mut symbols, &names));
        hamiltonian = hamiltonian.widened(count + symbols.len()).into_owned();
    }
    Ok(Problem {
        name: draft.name,
        algebra,
        coordinates: draft.coordinates,
        hamiltonian,
        symbols,
        parameters: draft.parameters,
        source: draft.source,
        chart: draft.chart.0,
        truncation,
        solver: draft.solver,
        comoving: frame,
        learned: false,
    })
}

/// The result of a front end for a potential.
#[derive(Clone, Debug)]
pub struct PotentialDraft {
    /// The name of the potential.
    pub name: String,
    /// The Lie algebra 𝔤.
    pub algebra: Option<LieAlgebra>,
    /// The numbers of rows and columns that were declared for the matrix, and where; `None` where the group
    /// determines them.
    pub declared: Option<((usize, usize), Span)>,
    /// The nodes of the potential's expression.
    pub arena: Arena,
    /// The potential itself, and where it stands.
    pub energy: Option<(ExprId, Span)>,
    /// The parameters.
    pub parameters: Vec<Parameter>,
    /// The potential as the user wrote it.
    pub source: String,
}

/// Checks what was read and turns it into a potential. Coordinates of the arena are the entries of
/// the group element's matrix, row by row.
///
/// # Errors
/// All mistakes: those already in `diagnostics`, and those found here.
pub fn assemble_potential(
    draft: PotentialDraft,
    mut diagnostics: Diagnostics,
) -> Result<Potential, Diagnostics> {
    let size = draft.algebra.as_ref().map(matrix_size);
    if let (Some(size), Some(((rows, columns), span)), Some(algebra)) =
        (size, draft.declared, &draft.algebra)
        && (rows, columns) != (size, size)
    {
        let name = algebra.name();
        let message =
            format!("elements of {name} are {size} × {size} matrices, not {rows} × {columns}");
        let help = format!("write for example g: [[f64; {size}]; {size}]");
        diagnostics.report(span, Mistake::Other(message, Some(help)));
    }
    let mut table = Table::new();
    let root = draft.energy.map(|(root, _)| root);
    let mut found = Diagnostics::new();
    let sum = polynomial(&draft.arena, root, &mut table, &mut found);
    for mistake in found.iter() {
        diagnostics.report(mistake.span, mistake.mistake.clone().in_potential());
    }
    if let (Some(sum), Some((_, span))) = (&sum, draft.energy)
        && sum.terms.keys().all(Vec::is_empty)
    {
        diagnostics.report(span, Mistake::NoDependence.in_potential());
    }
    let (Some(algebra), Some(size), Some(sum), true) =
        (draft.algebra, size, sum, diagnostics.is_empty())
    else {
        if diagnostics.is_empty() {
            diagnostics.report(Span::Whole, Mistake::Unreadable);
        }
        return Err(diagnostics);
    };
    let (energy, symbols) = exact(sum, size * size, &mut table, &draft.parameters);
    let PotentialDraft { name, parameters, source, .. } = draft;
    Ok(Potential { name, algebra, energy, symbols, parameters, source })
}

/// The polynomial in `count` variables and the symbols, and the symbols.
fn exact(
    sum: Sum,
    count: usize,
    table: &mut Table,
    parameters: &[Parameter],
) -> (Polynomial, Vec<Symbol>) {
    let scalar_names: Vec<String> = parameters.iter().flat_map(Parameter::scalar_names).collect();
    // Symbols are numbered in the order of the terms they first occur in, highest terms first.
    let mut terms: Vec<(Vec<u32>, Rational, usize)> = sum
        .terms
        .into_iter()
        .map(|(monomial, coefficient)| {
            let mut exponents = vec![0; count];
            for (coordinate, power) in monomial {
                exponents[coordinate] = power;
            }
            (exponents, coefficient.factor, coefficient.product)
        })
        .collect();
    terms.sort_by(|(a, ..), (b, ..)| b.cmp(a));
    let mut products: Vec<usize> = Vec::new();
    for &(_, _, product) in &terms {
        if product != ONE && !products.contains(&product) {
            products.push(product);
        }
    }
    let variables = count + products.len();
    let terms = terms.into_iter().map(|(mut exponents, factor, product)| {
        exponents.resize(variables, 0);
        if let Some(symbol) = products.iter().position(|&p| p == product) {
            exponents[count + symbol] = 1;
        }
        (exponents, factor)
    });
    let polynomial = Polynomial::from_terms(variables, terms);
    let symbols: Vec<Symbol> = products
        .iter()
        .map(|&product| {
            let expr = table.expression(product);
            let text = expr.text(&scalar_names);
            Symbol { expr, text }
        })
        .collect();
    (polynomial, symbols)
}

/// The truncation, if it is usable; otherwise reports why not.
pub fn check_truncation(k: usize, span: Span, diagnostics: &mut Diagnostics) -> Option<usize> {
    let mistake = match k {
        0 => Mistake::TruncationZero,
        k if k > MAX_TRUNCATION => Mistake::TruncationLarge(k, MAX_TRUNCATION),
        k if k.is_even() => Mistake::TruncationEven(k),
        k => return Some(k),
    };
    diagnostics.report(span, mistake);
    None
}

/// Reports a chart that the group does not have.
pub fn check_chart(chart: Chart, algebra: &LieAlgebra, span: Span, diagnostics: &mut Diagnostics) {
    if let Err(error) = chart.check(algebra) {
        diagnostics.report(span, Mistake::Chart(error));
    }
}

/// The chart of this name: `exp` or `cayley`.
///
/// # Errors
/// [`Mistake::UnknownChart`].
pub fn chart(name: &str) -> Result<Chart, Mistake> {
    match name {
        "exp" | "exponential" => Ok(Chart::Exponential),
        "cayley" => Ok(Chart::Cayley),
        _ => {
            let suggestion = crate::diagnostic::nearest(name, ["exp", "cayley"]);
            Err(Mistake::UnknownChart(name.to_owned(), suggestion.map(str::to_owned)))
        }
    }
}

/// The solver of this name: `newton` or `fixed_point`.
///
/// # Errors
/// [`Mistake::UnknownSolver`].
pub fn solver(name: &str) -> Result<Solver, Mistake> {
    Solver::named(name).ok_or_else(|| {
        let suggestion = crate::diagnostic::nearest(name, Solver::NAMES);
        Mistake::UnknownSolver(name.to_owned(), suggestion.map(str::to_owned))
    })
}

/// The frame of this name: `fixed` or `comoving`.
///
/// # Errors
/// [`Mistake::UnknownFrame`].
pub fn frame(name: &str) -> Result<FrameChoice, Mistake> {
    FrameChoice::named(name).ok_or_else(|| {
        let suggestion = crate::diagnostic::nearest(name, FrameChoice::NAMES);
        Mistake::UnknownFrame(name.to_owned(), suggestion.map(str::to_owned))
    })
}

/// The value of an expression in numbers alone, exact where it is rational; reports one that has none.
pub fn constant(arena: &Arena, root: ExprId, diagnostics: &mut Diagnostics) -> Option<Rational> {
    let mut table = Table::new();
    let value = polynomial(arena, Some(root), &mut table, diagnostics)?.as_constant()?;
    let value = table.value(&value);
    value.map_err(|mistake| diagnostics.report(arena.span(root), mistake)).ok()
}

/// The components of an expression that must be Σ number · coordinate; reports it if it is not.
pub fn linear(
    arena: &Arena,
    root: ExprId,
    diagnostics: &mut Diagnostics,
) -> Option<Vec<(usize, Rational)>> {
    let mut table = Table::new();
    let sum = polynomial(arena, Some(root), &mut table, diagnostics)?;
    let mut components = Vec::new();
    for (monomial, coefficient) in sum.terms {
        match (&monomial[..], table.value(&coefficient)) {
            (&[(coordinate, 1)], Ok(number)) => components.push((coordinate, number)),
            _ => {
                let message =
                    "a bracket must be linear: a sum of numbers times generators".to_owned();
                let help = "write for example \"[a, b] = 2*c - 1/2*a\"; Poisson brackets that are not linear in the \
                            coordinates (Lotka-Volterra, [x, y] = x*y) are those of no Lie algebra";
                diagnostics
                    .report(arena.span(root), Mistake::Other(message, Some(help.to_owned())));
                return None;
            }
        }
    }
    Some(components)
}
