//! The last step of every front end: checks, and the finished problem.

use super::choice::Choice;
use super::coefficient::{Interner, ONE};
use super::frame;
use super::polynomial::{Sum, polynomial};
use super::program::{Kinked, Lowered, lower};
use crate::diagnostic::{Diagnostic, Diagnostics, Mistake, Span};
use crate::drive::{Acts, Drive, Ingredients};
use crate::expr::{Arena, ExprId, Node};
use crate::lie::{Chart, LieAlgebra};
use crate::number::Rational;
use crate::poly::Polynomial;
use crate::potential::{Force, Potential, Programs};
#[cfg(feature = "system")]
use crate::problem::values;
use crate::problem::{FrameChoice, Method, Parameter, Problem, Symbol};
use crate::signal::Signal;
use crate::smooth::{Given, Hamiltonian, Smooth};
use coadjoint_symbolic::spatial::Spatial;

/// An energy as a front end has read it: a Hamiltonian, or a potential.
#[derive(Clone, Debug, Default)]
pub(crate) struct Formula {
    /// The nodes of its expression. Coordinates are those of the momentum, or the entries of the group element's
    /// matrix, row by row.
    pub arena: Arena,
    /// The energy itself, and where it stands; `None` where the input was wrong, which has been reported.
    pub root: Option<(ExprId, Span)>,
    pub parameters: Vec<Parameter>,
    /// The energy as the user wrote it.
    pub source: String,
}

impl Formula {
    /// It as a polynomial; `None` where something is wrong, which has then been reported.
    fn polynomial(&self, table: &mut Interner, diagnostics: &Diagnostics) -> Option<Sum> {
        let root = self.root.map(|(root, _)| root);
        let sum = polynomial(&self.arena, root, table, diagnostics);
        if let (Some(sum), Some((_, span))) = (&sum, self.root)
            && sum.terms.keys().all(Vec::is_empty)
        {
            diagnostics.report(span, Mistake::NoDependence);
        }
        sum
    }

    pub(crate) fn moves(&self) -> bool {
        let of_time = |node: &Node| matches!(node, Node::Time | Node::Signal(_));
        self.arena.iter().any(|(_, node, _)| of_time(node))
    }

    fn scalar_names(&self) -> Vec<String> {
        self.parameters.iter().flat_map(Parameter::scalar_names).collect()
    }
}

/// A system as a front end has read it.
#[derive(Clone, Debug)]
pub(crate) struct Draft {
    pub name: String,
    /// `None` where the input was wrong, which has been reported.
    pub algebra: Option<LieAlgebra>,
    /// The names of the momentum's coordinates.
    pub coordinates: Vec<String>,
    /// The place where the coordinates are named.
    pub coordinates_span: Span,
    pub hamiltonian: Formula,
    /// The inputs of the Hamiltonian and the drive.
    pub signals: Vec<Signal>,
    /// The velocity and the torque beside the Hamiltonian, where there are any.
    pub drive: Option<Drive>,
    /// The times besides those of inputs at which steps end, and where they are named.
    pub breaks: (Vec<f64>, Span),
    pub choice: Choice,
}

/// Checks what was read and turns it into a problem, or into programs where steps are to be made by collocation, as where the
/// Hamiltonian is no polynomial or depends on time; `None` where something is wrong, which has then been reported.
pub(crate) fn assemble_either(draft: Draft, diagnostics: &Diagnostics) -> Option<Hamiltonian> {
    let read = Read::new(&draft.hamiltonian);
    let of_series = |found: &Diagnostic| found.mistake.is_of_series();
    let smooth = match draft.choice.method {
        Some((method, place)) if method == Method::Series && draft.drive.is_some() => {
            let message = "`method = \"series\"`: a velocity, a torque and damping have no series";
            diagnostics.report_other(place, message, "leave `method` out");
            true
        }
        Some((method, _)) => method == Method::Collocation,
        None => {
            draft.drive.is_some() || draft.hamiltonian.moves() || read.found.iter().any(of_series)
        }
    };
    if smooth {
        let polynomial = match read.found.is_empty() {
            true => assemble_polynomial(draft.clone(), read, &Diagnostics::new()),
            false => {
                let alone = draft.drive.is_none();
                let others = read.found.into_iter().filter(|found| {
                    let level = matches!(found.mistake, Mistake::NoDependence);
                    !found.mistake.is_of_series() && (alone || !level)
                });
                others.for_each(|found| diagnostics.report(found.span, found.mistake));
                None
            }
        };
        let smooth = in_units(assemble_smooth(draft, None, diagnostics)?, polynomial.as_ref());
        return Some(smooth.into());
    }
    if !draft.breaks.0.is_empty() {
        let message =
            "`breaks` are times at which a function of the time jumps: nothing here depends on t";
        diagnostics.report_other(draft.breaks.1, message, "leave `breaks` out");
    }
    let open = open(&draft);
    let problem = assemble_polynomial(draft, read, diagnostics)?;
    let open = open.and_then(|draft| assemble_smooth(draft, None, &Diagnostics::new()));
    let open = open.map(|smooth| Box::new(in_units(smooth, Some(&problem))));
    Some(Hamiltonian::Polynomial(Box::new(problem), open))
}

/// Compares sizes in the units of H, where it is this polynomial.
fn in_units(smooth: Smooth, polynomial: Option<&Problem>) -> Smooth {
    Smooth { units: polynomial.map_or(smooth.units, Problem::units), ..smooth }
}

/// The draft for collocation, where the method is left open: none is named, and nothing but of the series.
fn open(draft: &Draft) -> Option<Draft> {
    let Choice { chart: (chart, _), solver, frame: (frame, _), method, .. } = &draft.choice;
    let of_series = *chart != Chart::default() || *frame == FrameChoice::Comoving;
    (method.is_none() && solver.is_none() && !of_series).then(|| {
        let choice = Choice { chart: (*chart, Span::Whole), ..draft.choice.clone() };
        Draft { choice, ..draft.clone() }
    })
}

/// Reports coordinates of another number than the algebra has; none where they could not be read, which is a mistake already.
fn check_dimension(
    algebra: Option<&LieAlgebra>,
    count: usize,
    place: Span,
    diagnostics: &Diagnostics,
) {
    let unread = count == 0 && matches!(place, Span::Whole);
    if let Some(algebra) = algebra.filter(|algebra| algebra.dim() != count && !unread) {
        let name = algebra.name().to_owned();
        diagnostics.report(place, Mistake::Dimension(count, name, algebra.dim()));
    }
}

/// Assembles a system whose Hamiltonian is a given function; the draft has only its name.
#[cfg(feature = "system")]
pub(crate) fn assemble_given(
    draft: Draft,
    function: Given,
    diagnostics: &Diagnostics,
) -> Option<Hamiltonian> {
    if let Some((Method::Series, place)) = draft.choice.method {
        let message = "`method = \"series\"`: a Hamiltonian that is a function has no series";
        diagnostics.report_other(place, message, "leave `method` out");
    }
    if !draft.hamiltonian.parameters.is_empty() {
        let message = "[parameters]: a Hamiltonian that is a function has its own";
        diagnostics.report_other(Span::Whole, message, "leave them out");
    }
    assemble_smooth(draft, Some(function), diagnostics).map(Hamiltonian::from)
}

/// The largest truncation of collocation: 8 nodes.
const MOST_OF_COLLOCATION: usize = 15;

/// Assembles steps by collocation, of the given function if there is one.
fn assemble_smooth(
    draft: Draft,
    given: Option<Given>,
    diagnostics: &Diagnostics,
) -> Option<Smooth> {
    let Draft { name, algebra, coordinates, coordinates_span, hamiltonian: energy, .. } = draft;
    let (signals, choice, drive, breaks) =
        (draft.signals, draft.choice, draft.drive, draft.breaks.0);
    check_dimension(algebra.as_ref(), coordinates.len(), coordinates_span, diagnostics);
    let placed = |place| !matches!(place, Span::Whole);
    let chosen = [
        ("chart", choice.chart.0 != Chart::default() || placed(choice.chart.1), choice.chart.1),
        ("solver", choice.solver.is_some(), Span::Whole),
        ("frame", choice.frame.0 == FrameChoice::Comoving, choice.frame.1),
    ];
    for (key, _, place) in chosen.into_iter().filter(|(_, chosen, _)| *chosen) {
        let message = format!("`{key}` is one of a series: here steps are made by collocation");
        diagnostics.report_other(place, message, &format!("leave `{key}` out"));
    }
    if let Some(k) = choice.truncation.filter(|k| *k > MOST_OF_COLLOCATION) {
        let mistake = Mistake::TruncationLarge(k, MOST_OF_COLLOCATION);
        diagnostics.report(Span::Whole, mistake);
    }
    if !diagnostics.is_empty() {
        return None;
    }
    let moves = energy.moves();
    let lowered = match &given {
        Some(_) => Lowered::default(),
        None => {
            let (root, place) = energy.root?;
            let mut table = Interner::new();
            let inputs: Vec<String> = signals.iter().map(|signal| signal.name.clone()).collect();
            let names = [&coordinates[..], &energy.scalar_names(), &inputs];
            let kinked = if breaks.is_empty() { Kinked::Nowhere } else { Kinked::InTime };
            let roots = (&[root][..], kinked);
            let lowered = lower(&energy.arena, roots, names, &mut table, diagnostics)?;
            let level = |node: &coadjoint_program::Node| *node == coadjoint_program::Node::Zero;
            if drive.is_none() && lowered.gradient.nodes().iter().all(level) {
                diagnostics.report(place, Mistake::NoDependence);
                return None;
            }
            lowered
        }
    };
    let smooth = Smooth {
        units: vec![1.0; coordinates.len()],
        moves,
        signals,
        breaks,
        name,
        algebra: algebra?,
        coordinates,
        value: lowered.value,
        gradient: lowered.gradient,
        watched: lowered.watched,
        reach: lowered.reach,
        expressions: lowered.expressions,
        symbols: lowered.symbols,
        parameters: energy.parameters,
        source: energy.source,
        truncation: choice.truncation?,
        given,
        kicks: None,
        drive: None,
    };
    Some(match drive {
        Some(drive) => smooth.with_drive(drive),
        None => smooth,
    })
}

/// Checks what was read and turns it into a problem; `None` where something is wrong, which has then been reported.
#[cfg(feature = "system")]
pub(crate) fn assemble(draft: Draft, diagnostics: &Diagnostics) -> Option<Problem> {
    if let Some((Method::Collocation, place)) = draft.choice.method {
        let message = "`method = \"collocation\"`: here steps are made by the series alone";
        diagnostics.report_other(place, message, "leave `method` out");
    }
    if draft.drive.is_some() {
        let message = "a velocity, a torque, damping: here steps are made by the series alone";
        diagnostics.report_other(Span::Whole, message, "leave them out");
    }
    let read = Read::new(&draft.hamiltonian);
    assemble_polynomial(draft, read, diagnostics)
}

/// An energy read as a polynomial.
struct Read {
    table: Interner,
    sum: Option<Sum>,
    /// The mistakes, if it is no polynomial.
    found: Vec<Diagnostic>,
}

impl Read {
    fn new(energy: &Formula) -> Self {
        let (mut table, found) = (Interner::new(), Diagnostics::new());
        let sum = energy.polynomial(&mut table, &found);
        Self { table, sum, found: found.list() }
    }
}

/// Assembles a problem from a Hamiltonian already read as a polynomial.
fn assemble_polynomial(draft: Draft, read: Read, diagnostics: &Diagnostics) -> Option<Problem> {
    let Read { mut table, sum, found } = read;
    let Draft { name, algebra, coordinates, hamiltonian: energy, choice, .. } = draft;
    let count = coordinates.len();
    let (chart, chart_span) = choice.chart;
    check_dimension(algebra.as_ref(), count, draft.coordinates_span, diagnostics);
    if let Some(algebra) = &algebra {
        diagnostics.check(chart_span, chart.check(algebra).map_err(Mistake::Chart));
    }
    found.into_iter().for_each(|found| diagnostics.report(found.span, found.mistake));
    if !diagnostics.is_empty() {
        return None;
    }
    let (algebra, truncation) = (algebra?, choice.truncation?);
    let names = energy.scalar_names();
    let (hamiltonian, symbols) = exact(sum?, count, &mut table, &names);
    let (asked, frame_span) = choice.frame;
    let problem = Problem {
        name,
        algebra,
        coordinates,
        hamiltonian,
        symbols,
        parameters: energy.parameters,
        source: energy.source,
        chart,
        truncation,
        solver: choice.solver,
        frame: asked,
        comoving: None,
        learned: false,
    };
    match asked {
        FrameChoice::Fixed => Some(problem),
        FrameChoice::Auto if !frame::is_taken(&problem) => Some(problem),
        FrameChoice::Auto => Some(frame::comoving(&problem).unwrap_or(problem)),
        FrameChoice::Comoving => {
            diagnostics.check(frame_span, frame::comoving(&problem).ok_or(Mistake::NoFrame))
        }
    }
}

/// Functions that are not H, and what they depend on.
const POTENTIAL: [&str; 2] = ["potential", "the group element"];

/// The program of functions of coordinates with these names and the time, without parameters, and its slots; `None` where
/// something is wrong, which has then been reported.
#[cfg(feature = "system")]
pub(crate) fn function(
    (arena, roots): (&Arena, &[ExprId]),
    names: &[String],
    diagnostics: &Diagnostics,
) -> Option<(coadjoint_program::Program, Vec<f64>)> {
    let (names, roots) = ([names, &[], &[]], (roots, Kinked::Nowhere));
    let lowered = lower(arena, roots, names, &mut Interner::new(), diagnostics)?;
    Some((lowered.value, values(&lowered.symbols)))
}

/// An energy of sites.
#[cfg(feature = "system")]
pub(crate) enum OfSites {
    /// Of degree at most two in the coordinates, with symbols after them.
    Quadratic(Polynomial, Vec<Symbol>),
    /// Any other: its value and its gradient, with their symbols.
    Programs(Box<[coadjoint_program::Program; 2]>, Vec<Symbol>),
}

/// Checks what was read and turns it into an energy of sites with these coordinates; `None` where something is wrong, which has
/// then been reported.
#[cfg(feature = "system")]
pub(crate) fn of_sites(
    energy: &Formula,
    coordinates: &[String],
    diagnostics: &Diagnostics,
) -> Option<OfSites> {
    let Read { mut table, sum, found } = Read::new(energy);
    let (root, _) = energy.root?;
    let (scalars, count) = (energy.scalar_names(), coordinates.len());
    let (of_series, others): (Vec<_>, Vec<_>) =
        found.into_iter().partition(|found| found.mistake.is_of_series());
    if !others.is_empty() {
        others.into_iter().for_each(|found| diagnostics.report(found.span, found.mistake));
        return None;
    }
    if of_series.is_empty() {
        let (polynomial, symbols) = exact(sum?, count, &mut table, &scalars);
        let degree = |factors: Vec<(u32, u32)>| {
            let own = factors.iter().filter(|(variable, _)| (*variable as usize) < count);
            own.map(|(_, power)| power).sum::<u32>()
        };
        if polynomial.factors().all(|(factors, _)| degree(factors) <= 2) {
            return Some(OfSites::Quadratic(polynomial, symbols));
        }
    }
    let names = [coordinates, &scalars, &[]];
    let lowered =
        lower(&energy.arena, (&[root], Kinked::Nowhere), names, &mut Interner::new(), diagnostics)?;
    Some(OfSites::Programs(Box::new([lowered.value, lowered.gradient]), lowered.symbols))
}

/// Checks what was read and turns it into a potential; `None` where something is wrong, which has then been reported.
/// `declared` are the rows and columns of the matrix where the input says them, and where.
pub(crate) fn assemble_potential(
    name: String,
    algebra: Option<LieAlgebra>,
    declared: Option<((usize, usize), Span)>,
    energy: &Formula,
    diagnostics: &Diagnostics,
) -> Option<Potential> {
    let before = diagnostics.len();
    let size = algebra.as_ref().map(LieAlgebra::matrix_size);
    if let (Some(size), Some(((rows, columns), span)), Some(algebra)) = (size, declared, &algebra)
        && (rows, columns) != (size, size)
    {
        let name = algebra.name();
        let message =
            format!("elements of {name} are {size} × {size} matrices, not {rows} × {columns}");
        let help = format!("write for example g: [[f64; {size}]; {size}]");
        diagnostics.report_other(span, message, &help);
    }
    let Read { mut table, sum, found } = Read::new(energy);
    let (of_series, others): (Vec<_>, Vec<_>) =
        found.into_iter().partition(|found| found.mistake.is_of_series());
    for found in others {
        diagnostics.report(found.span, found.mistake.in_formula(POTENTIAL));
    }
    if diagnostics.len() > before {
        return None;
    }
    let (algebra, size, names) = (algebra?, size?, energy.scalar_names());
    let (force, symbols) = if of_series.is_empty() {
        let (polynomial, symbols) = exact(sum?, size * size, &mut table, &names);
        (Force::Polynomial(polynomial), symbols)
    } else {
        let (programs, symbols) = smooth_potential(&algebra, energy, &[], diagnostics)?;
        (Force::Smooth(Box::new(programs)), symbols)
    };
    let (parameters, source) = (energy.parameters.clone(), energy.source.clone());
    Some(Potential { name, algebra, force, symbols, parameters, source })
}

/// The programs of a potential, and their slots.
fn smooth_potential(
    algebra: &LieAlgebra,
    energy: &Formula,
    inputs: &[String],
    diagnostics: &Diagnostics,
) -> Option<(Programs, Vec<Symbol>)> {
    let (entries, scalars) = (entries(algebra.matrix_size()), energy.scalar_names());
    let (root, place) = energy.root?;
    let names = [&entries[..], &scalars, inputs];
    let Lowered { value, gradient, watched, expressions, symbols, .. } =
        formula(&energy.arena, &[root], names, POTENTIAL, diagnostics)?;
    if gradient.nodes().iter().all(|node| *node == coadjoint_program::Node::Zero) {
        diagnostics.report(place, Mistake::NoDependence.in_formula(POTENTIAL));
        return None;
    }
    let programs = [&value, &gradient, &watched];
    Some((Programs::of_potential(algebra, programs, expressions, energy.moves()), symbols))
}

/// Lowers expressions that are not H, and says of mistakes what they are in.
fn formula(
    arena: &Arena,
    roots: &[ExprId],
    names: [&[String]; 3],
    of: [&str; 2],
    diagnostics: &Diagnostics,
) -> Option<Lowered> {
    let found = Diagnostics::new();
    let kinked = if of == POTENTIAL { Kinked::Nowhere } else { Kinked::Anywhere };
    let lowered = lower(arena, (roots, kinked), names, &mut Interner::new(), &found);
    for found in found.list() {
        diagnostics.report(found.span, found.mistake.in_formula(of));
    }
    lowered
}

pub(crate) fn entries(size: usize) -> Vec<String> {
    (0..size * size).map(|at| format!("g[{}][{}]", at / size, at % size)).collect()
}

/// The expressions of a velocity and of a torque as a front end has read them; coordinates are the entries of the group element's
/// matrix, row by row, then the momentum, then ∂H/∂μ.
#[derive(Debug)]
pub(crate) struct Acting {
    /// The nodes of the expressions, of which none is an energy.
    pub energy: Formula,
    /// The components of the velocity and of the torque in the body, of those in space, and the rates of damping, where they are given.
    pub roots: [Option<Vec<ExprId>>; 5],
}

/// The reason for which no velocity and no torque is along the axes of space, where it can be none.
pub(crate) fn without_space(algebra: &LieAlgebra) -> Option<String> {
    let reason = "are not rotations and motions, whose axes are those of space";
    Spatial::new(algebra).is_none().then(|| format!("elements of {} {reason}", algebra.name()))
}

/// Checks what was read and turns it into a drive, with a potential that joins it; `None` where something is wrong, which has then been
/// reported.
pub(crate) fn assemble_drive(
    algebra: &LieAlgebra,
    (coordinates, signals): (&[String], &[Signal]),
    acting: Option<Acting>,
    functions: [Option<Acts>; 2],
    potential: Option<&Formula>,
    diagnostics: &Diagnostics,
) -> Option<Drive> {
    let size = algebra.matrix_size();
    let inputs: Vec<String> = signals.iter().map(|signal| signal.name.clone()).collect();
    let mut parts = Ingredients { functions, ..Ingredients::default() };
    let named = |energy: &Formula| format!("potential = {}", energy.source);
    let sources = acting.iter().map(|own| own.energy.source.clone()).chain(potential.map(named));
    parts.source = sources.collect::<Vec<_>>().join(", ");
    if let Some(Acting { energy, roots }) =
        acting.filter(|own| own.roots.iter().any(Option::is_some))
    {
        let omega = (0..coordinates.len()).map(|i| format!("omega[{i}]"));
        // Rates of damping read no element.
        let reads = roots[..4].iter().any(Option::is_some);
        let entries = if reads { entries(size) } else { Vec::new() };
        let names: Vec<String> =
            entries.into_iter().chain(coordinates.iter().cloned()).chain(omega).collect();
        let names = [&names[..], &energy.scalar_names(), &inputs];
        let all: Vec<ExprId> = roots.iter().flatten().flatten().copied().collect();
        let of = if roots[1].is_some() || roots[3].is_some() { "torque" } else { "velocity" };
        let lowered = formula(&energy.arena, &all, names, [of, "the state"], diagnostics)?;
        parts.given = roots.each_ref().map(Option::is_some);
        parts.moves = energy.moves();
        parts.kinks = lowered.kinks;
        parts.own = Some((lowered.value, lowered.watched, lowered.expressions, lowered.symbols));
    }
    if let Some(potential) = potential {
        let (programs, symbols) = smooth_potential(algebra, potential, &inputs, diagnostics)?;
        parts.moves |= potential.moves();
        parts.potential = Some(Potential {
            name: "potential".to_owned(),
            algebra: algebra.clone(),
            force: Force::Smooth(Box::new(programs)),
            symbols,
            parameters: potential.parameters.clone(),
            source: potential.source.clone(),
        });
    }
    Drive::new(algebra, signals, parts)
}

/// The polynomial in `count` variables and the symbols, and the symbols.
fn exact(
    sum: Sum,
    count: usize,
    table: &mut Interner,
    names: &[String],
) -> (Polynomial, Vec<Symbol>) {
    // Symbols are numbered in the order of the terms they first occur in, highest terms first.
    let mut terms: Vec<(Vec<u32>, Rational, usize)> = sum
        .terms
        .into_iter()
        .map(|(monomial, coefficient)| {
            let mut exponents = vec![0; count];
            for (coordinate, power) in monomial {
                exponents[coordinate as usize] = power;
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
            let text = expr.text(names);
            Symbol { expr, text }
        })
        .collect();
    (polynomial, symbols)
}

/// The value of an expression in numbers alone, exact where it is rational; reports one that has none.
#[cfg(feature = "system")]
pub(crate) fn constant(arena: &Arena, root: ExprId, diagnostics: &Diagnostics) -> Option<Rational> {
    let mut table = Interner::new();
    let value = polynomial(arena, Some(root), &mut table, diagnostics)?.as_constant()?;
    diagnostics.check(arena.span(root), table.value(&value))
}

/// The components of an expression that must be Σ number · coordinate; reports it if it is not.
pub(crate) fn linear(
    arena: &Arena,
    root: ExprId,
    diagnostics: &Diagnostics,
) -> Option<Vec<(usize, Rational)>> {
    let mut table = Interner::new();
    let sum = polynomial(arena, Some(root), &mut table, diagnostics)?;
    let mut components = Vec::new();
    for (monomial, coefficient) in sum.terms {
        match (&monomial[..], table.value(&coefficient)) {
            (&[(coordinate, 1)], Ok(number)) => components.push((coordinate as usize, number)),
            _ => {
                let message = "a bracket must be linear: a sum of numbers times generators";
                let help = "write for example \"[a, b] = 2*c - 1/2*a\"; Poisson brackets that are not linear in the \
                            coordinates (Lotka-Volterra, [x, y] = x*y) are those of no Lie algebra";
                diagnostics.report_other(arena.span(root), message, help);
                return None;
            }
        }
    }
    Some(components)
}
