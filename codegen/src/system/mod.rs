//! System files: a Lie–Poisson system and a run of it, in TOML.
//!
//! ```toml
//! name = "rigid-body"
//! group = "SO3"
//! coordinates = ["x", "y", "z"]
//! hamiltonian = "x^2/(2*I1) + y^2/(2*I2) + z^2/(2*I3)"
//! [parameters]
//! I1 = 1.5
//! I2 = 2.0
//! I3 = "5/2"
//! [integrator]
//! truncation = 7
//! chart = "exp"
//! step = 0.1
//! [initial]
//! momentum = [2.0, 0.5, 1.0]
//! [run]
//! time = 100.0
//! ```
//!
//! Instead of `step`, `tolerance = 1e-9` asks for an error at the end of the run; `truncation` is
//! then picked too unless it is given. `region = 2.5` (a norm of the momentum, or [low, high] for each
//! coordinate) says where it is to hold; without it, along the run from the initial state.
//!
//! In `[integrator]`, `solver` is `newton` or `fixed_point`, and `frame = "comoving"` leaves what is
//! uniform in the motion (the spin of a symmetric body, multiples of Casimirs) out of the series and lets
//! it follow each step (see [`crate::comoving`]). For a power such as SO3^64, coordinates and
//! momentum may be given for one copy: `x` then stands for `x[0]`, `x[1]`, …, the momentum may be
//! expressions in the copy's number `i`, and `sum(i, 0..64, x[i]*x[(i + 1) % 64])` is a sum over copies.
//!
//! Numbers are read from their decimals, so `0.1` is exactly 1/10. Instead of `group`, an
//! `[algebra]` table gives a `basis` of matrices, or `generators` and `brackets`.
//!
//! `[units]` gives the units that plots and reports show: `time = "s"`, `momentum = "kg m²/s"`, or one for a
//! coordinate by its name. Nothing is computed with them.
//!
//! A force that breaks the symmetry is a `potential = "…"`, a polynomial in the entries `g[0][0]`, …
//! of the group element's matrix; its kicks are composed by the `splitting` of `[integrator]`.

mod algebra;
mod hamiltonian;
mod initial;
mod options;
mod parameters;
mod potential;
mod project;
mod run;
mod splitting;
mod table;
mod tolerance;
mod units;

use toml::de::DeTable;

use crate::diagnostic::{Diagnostics, Mistake, Span, unclosed_quote};
use crate::lie::{Chart, LieAlgebra, catalogue};
use crate::pass::{
    self, DEFAULT_TRUNCATION, Draft, assemble, assemble_potential, chart, check_truncation,
};
use crate::potential::Potential;
use crate::problem::{FrameChoice, Problem, Solver};
use table::Table;

pub use crate::splitting::Splitting;
pub use options::{Options, Parameters};
pub use run::Run;
pub use units::Units;

/// The system of a file that names none.
const DEFAULT_NAME: &str = "system";

/// A system file.
#[derive(Clone, Debug)]
pub struct System {
    /// The system.
    pub problem: Problem,
    /// The potential V(g), if the file has one, and the splitting to compose its kicks by.
    pub potential: Option<(Potential, Splitting)>,
    /// Where to start, how far and in which steps; each as far as the file says.
    pub run: Run,
    /// The units that plots and reports show.
    pub units: Units,
    /// The names of all parameters, also of those whose values are put into the Hamiltonian.
    pub parameters: Vec<String>,
}

/// Reads the text of a system file.
///
/// # Errors
/// All mistakes, each at its place in `text`; [`Diagnostics::render`] writes them out.
pub fn read(text: &str, options: Options) -> Result<System, Diagnostics> {
    let mut diagnostics = Diagnostics::new();
    let (document, errors) = DeTable::parse_recoverable(text);
    // After an unclosed quote the rest parses as nonsense: only the quote is reported.
    if let Some(at) = unclosed_quote(text).filter(|_| !errors.is_empty()) {
        diagnostics.report(Span::text(at..at + 1), Mistake::UnclosedQuote);
        return Err(diagnostics);
    }
    for error in errors {
        let span = error.span().map_or(Span::Whole, Span::text);
        // One line: more would repeat the source, which is shown anyway.
        let message = error.message().lines().collect::<Vec<_>>().join("; ");
        diagnostics.report(span, Mistake::Toml(message));
    }
    if !diagnostics.is_empty() {
        return Err(diagnostics);
    }
    let parameters =
        parameters::Parameters::read(document.get_ref(), text, options, &mut diagnostics);
    let root = Table::root(document.get_ref(), &parameters.constants);
    root.check_keys(
        &[
            "name",
            "group",
            "algebra",
            "coordinates",
            "hamiltonian",
            "potential",
            "parameters",
            "units",
            "integrator",
            "initial",
            "run",
        ],
        &mut diagnostics,
    );
    let name = root.string("name", "name = \"rigid-body\"", &mut diagnostics);
    let name = name.map_or(DEFAULT_NAME.to_owned(), |(name, _)| name.to_owned());
    let algebra = group(&root, &name, &mut diagnostics);
    let written = hamiltonian::read(&root, algebra.as_ref(), &parameters, text, &mut diagnostics);
    let units = units::read(&root, &written.coordinates, &mut diagnostics);
    let integrator = root.table("integrator", &mut diagnostics);
    let chosen = match &integrator {
        Some(table) => integrator_table(table, options, &mut diagnostics),
        None => Chosen::default(),
    };
    let truncation = match options.truncation {
        Some(k) => check_truncation(k, Span::Whole, &mut diagnostics),
        None => chosen.truncation,
    };
    let chart = options.chart.map_or(chosen.chart, |chart| (chart, Span::Whole));
    let mut run = run::read(&root, integrator.as_ref(), &mut diagnostics);
    let velocity = initial::read(&root, algebra.as_ref(), &mut run, &mut diagnostics);
    if integrator.as_ref().is_some_and(|table| table.has("truncation")) {
        run.truncation = truncation;
    }
    let potential = potential::read(&root, algebra.as_ref(), &parameters, text, &mut diagnostics);
    let splitting = splitting::read(&root, integrator.as_ref(), &mut diagnostics);
    let draft = Draft {
        name,
        algebra,
        coordinates: written.coordinates,
        coordinates_span: written.coordinates_span,
        arena: written.arena,
        hamiltonian: written.hamiltonian,
        parameters: written.parameters,
        source: written.source,
        chart,
        truncation,
        solver: options.solver.or(chosen.solver),
        frame: chosen.frame,
    };
    // Mistakes of both energies at once.
    let potential = potential.and_then(|draft| {
        assemble_potential(draft, Diagnostics::new())
            .map_err(|mistakes| diagnostics.append(mistakes))
            .ok()
    });
    let problem = assemble(draft, diagnostics)?;
    if let Some((velocity, place)) = velocity {
        run.momentum = Some(initial::momentum(&problem, &velocity, place)?);
    }
    let potential = match potential {
        Some(potential) => Some((potential, splitting::choose(splitting, &problem)?)),
        None => None,
    };
    let parameters = root.get("parameters").and_then(|table| table.get_ref().as_table());
    let parameters = parameters.into_iter().flat_map(|table| table.keys());
    let parameters = parameters.map(|name| name.get_ref().to_string()).collect();
    Ok(System { problem, potential, run, units, parameters })
}

/// The Lie algebra: `group = "…"` or the table `[algebra]`.
fn group(root: &Table<'_>, name: &str, diagnostics: &mut Diagnostics) -> Option<LieAlgebra> {
    let text = root.string("group", "group = \"SO3\"", diagnostics);
    let table = root.table("algebra", diagnostics);
    match (text, table) {
        (Some((_, span)), Some(_)) => {
            let help = "keep `group` for a known group, [algebra] for one of your own".to_owned();
            let message = "both `group` and [algebra] are given".to_owned();
            diagnostics.report(span, Mistake::Other(message, Some(help)));
            None
        }
        (Some((text, span)), None) => match catalogue::lookup(text) {
            Ok(algebra) => Some(algebra),
            Err(error) => {
                diagnostics.report(span, Mistake::Group(error.to_string()));
                None
            }
        },
        (None, Some(table)) => algebra::read(&table, name, diagnostics),
        (None, None) => {
            if !root.has("group") && !root.has("algebra") {
                let example = "group = \"SO3\"".to_owned();
                let missing =
                    Mistake::MissingKey("group".to_owned(), "the file".to_owned(), example);
                diagnostics.report(Span::text(0..0), missing);
            }
            None
        }
    }
}

/// The method that `[integrator]` gives.
struct Chosen {
    truncation: Option<usize>,
    chart: (Chart, Span),
    solver: Option<Solver>,
    frame: (FrameChoice, Span),
}

impl Default for Chosen {
    fn default() -> Self {
        Self {
            truncation: Some(DEFAULT_TRUNCATION),
            chart: (Chart::default(), Span::Whole),
            solver: None,
            frame: (FrameChoice::default(), Span::Whole),
        }
    }
}

fn integrator_table(table: &Table<'_>, options: Options, diagnostics: &mut Diagnostics) -> Chosen {
    let known =
        ["truncation", "chart", "solver", "frame", "step", "tolerance", "region", "splitting"];
    table.check_keys(&known, diagnostics);
    let mut chosen = Chosen::default();
    if table.has("truncation") && options.truncation.is_none() {
        chosen.truncation = table
            .integer("truncation", "truncation = 7", diagnostics)
            .and_then(|(k, span)| check_truncation(k, span, diagnostics));
    }
    if let Some((name, span)) = table.string("chart", "chart = \"exp\"", diagnostics)
        && options.chart.is_none()
    {
        match chart(name) {
            Ok(chart) => chosen.chart = (chart, span),
            Err(mistake) => diagnostics.report(span, mistake),
        }
    }
    if let Some((name, span)) = table.string("solver", "solver = \"fixed_point\"", diagnostics) {
        match pass::solver(name) {
            Ok(named) => chosen.solver = Some(named),
            Err(mistake) => diagnostics.report(span, mistake),
        }
    }
    if let Some((name, span)) = table.string("frame", "frame = \"comoving\"", diagnostics) {
        match pass::frame(name) {
            Ok(frame) => chosen.frame = (frame, span),
            Err(mistake) => diagnostics.report(span, mistake),
        }
    }
    chosen
}
